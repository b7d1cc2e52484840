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
