// Compressible neo-Hookean, ψ = C (Ī − 3) + D (J − 1)², Ī = J^(−2/3) tr(FᵀF): Bonet and Wood, Nonlinear Continuum Mechanics for Finite
// Element Analysis (2008), §6.5. With y = J^(−1/3), i = I − 3, j = J − 1 and y² − 1 = −j w, near rest no term of first order cancels.

const ALLOWS_INVERSION = false;

// J^(−1/3) for J > 0: twice a step of y (1 − r)^(−1/3) by its series up to r³, r = 1 − J y³, from a power in single precision.
fn inverse_cube_root(J: real) -> real {
    var y = real(pow(f32(J), -1.0f / 3.0f));
    for (var k = 0; k < 2; k++) {
        let r = real(1.0) - y * y * (J * y);
        let of_square = real(2.0) / real(9.0) + r * (real(14.0) / real(81.0));
        y = y + y * (r / real(3.0) + r * r * of_square);
    }
    return y;
}

// P; the moduli are C and D, Pa. The stress of an element with J ≤ 0 means nothing.
fn stress(G: Tensor, C: real, D: real) -> Tensor {
    let j = volume_change(G);
    let J = real(1.0) + j;
    let y = inverse_cube_root(J);
    let sum = y * y + y + real(1.0);
    let inverse = real(1.0) / (J * sum);
    let trace = trace_of(G);
    let i = real(2.0) * trace + dot_of(G, G);
    let w = (y + real(1.0)) * inverse;
    let two_C = real(2.0) * C;
    let three = real(3.0);
    let of_F = -two_C * j * w;
    let of_cof = two_C * (three * j - i + (three + i) * j * w) * (sum * inverse / three) + real(2.0) * D * j;
    let F = plus_diagonal(G, real(1.0));
    let difference = sum_of(sum_of(G, transposed(G)), scaled(real(-1.0), cofactor(G)));
    let elastic = sum_of(scaled(of_F, F), scaled(of_cof, cofactor(F)));
    return plus_diagonal(sum_of(elastic, scaled(two_C, difference)), -two_C * trace);
}

// C (Ī − 3) + D j², where Ī − 3 = G:G − 2 (tr cof G + det G) − 3j (w − 2/3) − j w i; beyond all others where J ≤ 0.
fn energy(G: Tensor, C: real, D: real) -> real {
    let second_order = second_order_volume_change(G);
    let j = trace_of(G) + second_order;
    let J = real(1.0) + j;
    if !(J > real(0.0)) { return real(1e30); }
    let y = inverse_cube_root(J);
    let inverse = real(1.0) / (J * (y * y + y + real(1.0)));
    let squares = dot_of(G, G);
    let i = real(2.0) * trace_of(G) + squares;
    let two = real(2.0);
    let three = real(3.0);
    let e = -j * inverse;
    let w_change = (three * e - real(6.0) * (j + J * e) - two * J * e * e) * (inverse / three);
    let w = (y + real(1.0)) * inverse;
    return C * (squares - two * second_order - three * j * w_change - j * w * i) + D * j * j;
}

// With g = J^(−2/3): a = 2C g, b = C I g' + 2D j, s = 0, t = 2C g', r = C I g'' + 2D
fn tangent(G: Tensor, C: real, D: real) -> Tangent {
    let F = plus_diagonal(G, real(1.0));
    let j = volume_change(G);
    let y = inverse_cube_root(real(1.0) + j);
    let over_J = real(1.0) / (real(1.0) + j);
    let g0 = y * y;
    let g1 = real(-2.0) / real(3.0) * g0 * over_J;
    let g2 = real(-5.0) / real(3.0) * g1 * over_J;
    let two = real(2.0);
    let CI = C * dot_of(F, F);
    return Tangent(F, cofactor(F), two * C * g0, CI * g1 + two * D * j, real(0.0), two * C * g1, CI * g2 + two * D);
}

// Lamé's constants of small strain: the shear modulus is 2C, the bulk modulus 2D.
fn lame(C: real, D: real) -> array<real, 2> {
    return array<real, 2>(real(2.0) * C, real(2.0) * D - real(4.0) * C / real(3.0));
}
