// Hooke's law for small strain: P = 2μ ε + λ tr(ε) 1. Sifakis and Barbič, FEM Simulation of 3D Deformable Solids (2012), part one, §3.2.

const ALLOWS_INVERSION = true;

// P; the moduli are μ and λ, Pa.
fn stress(G: Tensor, mu: real, lambda: real) -> Tensor {
    return plus_diagonal(scaled(mu, sum_of(G, transposed(G))), lambda * trace_of(G));
}
