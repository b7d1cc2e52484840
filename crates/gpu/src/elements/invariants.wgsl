// The stress derivative of a law of the invariants I = tr(FᵀF) and J = det F:
// P = a F + b cof F, and ∂P/∂F = a 1 + s F⊗F + t (F⊗cof + cof⊗F) + r cof⊗cof + b ∂cof/∂F.

struct Tangent {
    F: Tensor,
    cof: Tensor,
    a: real,
    b: real,
    s: real,
    t: real,
    r: real,
}

// ∂P/∂F D
fn stress_change(at: Tangent, D: Tensor) -> Tensor {
    let F = at.F;
    let along_F = dot_of(F, D);
    let along_cof = dot_of(at.cof, D);
    let of_F = scaled(at.s * along_F + at.t * along_cof, F);
    let of_cof = scaled(at.t * along_F + at.r * along_cof, at.cof);
    let cofactor_change = Tensor(
        cross_of(D.y, F.z) + cross_of(F.y, D.z),
        cross_of(D.z, F.x) + cross_of(F.z, D.x),
        cross_of(D.x, F.y) + cross_of(F.x, D.y),
    );
    return sum_of(sum_of(scaled(at.a, D), of_F), sum_of(of_cof, scaled(at.b, cofactor_change)));
}
