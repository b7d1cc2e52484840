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

// (g·S g) 1 + μ |g|² F Fᵀ + (μ + λ) F g⊗F g
fn block(G: Tensor, gradient: vector, mu: real, lambda: real) -> Block {
    let F = plus_diagonal(G, real(1.0));
    let along = inner(gradient, times(second_stress(G, mu, lambda), gradient));
    let of_left = mu * inner(gradient, gradient);
    let left = Block(
        vector(inner(F.x, F.x), inner(F.y, F.y), inner(F.z, F.z)),
        vector(inner(F.x, F.y), inner(F.x, F.z), inner(F.y, F.z)),
    );
    let sum = Block(vector(along, along, along) + of_left * left.diagonal, of_left * left.off);
    return plus_outer(sum, mu + lambda, times(F, gradient));
}

fn lame(mu: real, lambda: real) -> array<real, 2> {
    return array<real, 2>(mu, lambda);
}
