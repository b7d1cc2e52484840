// St. Venant–Kirchhoff: P = F S, S = 2μ E + λ tr(E) 1. Sifakis and Barbič, FEM Simulation of 3D Deformable Solids (2012), part one, §3.3.

const ALLOWS_INVERSION = true;

// S; the moduli are μ and λ, Pa.
fn second_stress(G: Tensor, mu: real, lambda: real) -> Tensor {
    let E = green_strain(G);
    return plus_diagonal(scaled(real(2.0) * mu, E), lambda * trace_of(E));
}

fn stress(G: Tensor, mu: real, lambda: real) -> Tensor {
    return product(plus_diagonal(G, real(1.0)), second_stress(G, mu, lambda));
}

// ψ = μ E:E + λ/2 tr(E)²
fn energy(G: Tensor, mu: real, lambda: real) -> real {
    let E = green_strain(G);
    let volume = trace_of(E);
    return mu * dot_of(E, E) + real(0.5) * lambda * volume * volume;
}

struct Tangent {
    F: Tensor,
    S: Tensor,
    mu: real,
    lambda: real,
}

fn tangent(G: Tensor, mu: real, lambda: real) -> Tangent {
    return Tangent(plus_diagonal(G, real(1.0)), second_stress(G, mu, lambda), mu, lambda);
}

// D S + F S', S' = 2μ E' + λ tr(E') 1, where E' is the symmetric part of DᵀF.
fn stress_change(at: Tangent, D: Tensor) -> Tensor {
    return sum_of(product(D, at.S), product(at.F, hooke_stress(product(transposed(D), at.F), at.mu, at.lambda)));
}

fn lame(mu: real, lambda: real) -> array<real, 2> {
    return array<real, 2>(mu, lambda);
}
