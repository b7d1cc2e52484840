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
