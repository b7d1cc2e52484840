// Stable neo-Hookean: Smith, de Goes and Kim, Stable Neo-Hookean Flesh Simulation (2018), eq. 14. With i = I − 3, j = J − 1 and
// λ' = λ + 5μ/6: P = μ i/(3 (I + 1)) F + λ' j cof F + μ (F − cof F), and F − cof F = G + Gᵀ − tr G 1 − cof G cancels nowhere.

const ALLOWS_INVERSION = true;

fn lambda_prime(mu: real, lambda: real) -> real {
    return lambda + real(5.0) * mu / real(6.0);
}

// P; the moduli are μ and λ, Pa.
fn stress(G: Tensor, mu: real, lambda: real) -> Tensor {
    let F = plus_diagonal(G, real(1.0));
    let trace = trace_of(G);
    let i = real(2.0) * trace + dot_of(G, G);
    let of_F = mu * i / (real(3.0) * (i + real(4.0)));
    let of_cof = lambda_prime(mu, lambda) * volume_change(G);
    let difference = sum_of(sum_of(G, transposed(G)), scaled(real(-1.0), cofactor(G)));
    let elastic = sum_of(scaled(of_F, F), scaled(of_cof, cofactor(F)));
    return plus_diagonal(sum_of(elastic, scaled(mu, difference)), -mu * trace);
}

// x − ln(1 + x) for x > −1 with the digits of a small x: 1 + x = 2^k (1 + y), and with s = y/(2 + y), ln(1 + y) = 2 (s + s³/3 + …).
fn minus_ln_1p(x: real) -> real {
    let z = real(1.0) + x;
    let k = i32(floor(log2(f32(z)) + 0.5f));
    let power = real(bitcast<f32>(u32(127 - k) << 23u));
    let y = select(z * power - real(1.0), x, k == 0);
    let s = y / (real(2.0) + y);
    let squared = s * s;
    var series = real(0.0);
    for (var n = 11; n >= 1; n--) {
        series = series * squared + real(1.0) / real(2 * n + 1);
    }
    return s * (y - real(2.0) * squared * series) + ((x - y) - real(k) * real(0.6931471805599453));
}

// ψ = μ/2 (G:G − 2 (tr cof G + det G)) + 2μ/3 (x − ln(1 + x)) + λ'/2 j², x = i/4
fn energy(G: Tensor, mu: real, lambda: real) -> real {
    let squares = dot_of(G, G);
    let second_order = second_order_volume_change(G);
    let j = trace_of(G) + second_order;
    let x = real(0.5) * trace_of(G) + real(0.25) * squares;
    let shear = real(0.5) * squares - second_order + real(2.0) / real(3.0) * minus_ln_1p(x);
    return mu * shear + real(0.5) * lambda_prime(mu, lambda) * j * j;
}

// a = μ' I/(I + 1), b = λ' j − μ, s = 2μ'/(I + 1)², t = 0, r = λ', where μ' = 4μ/3
fn tangent(G: Tensor, mu: real, lambda: real) -> Tangent {
    let F = plus_diagonal(G, real(1.0));
    let I = dot_of(F, F);
    let mu_prime = real(4.0) * mu / real(3.0);
    let inverse = real(1.0) / (I + real(1.0));
    let r = lambda_prime(mu, lambda);
    let s = real(2.0) * mu_prime * inverse * inverse;
    return Tangent(F, cofactor(F), mu_prime * I * inverse, r * volume_change(G) - mu, s, real(0.0), r);
}

fn lame(mu: real, lambda: real) -> array<real, 2> {
    return array<real, 2>(mu, lambda);
}
