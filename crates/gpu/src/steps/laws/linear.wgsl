// Hooke's law for small strain: P = 2μ ε + λ tr(ε) 1. Sifakis and Barbič, FEM Simulation of 3D Deformable Solids (2012), part one, §3.2.

const ALLOWS_INVERSION = true;

// P; the moduli are μ and λ, Pa.
fn stress(G: Tensor, mu: real, lambda: real) -> Tensor {
    return hooke_stress(G, mu, lambda);
}

fn energy(G: Tensor, mu: real, lambda: real) -> real {
    return hooke_energy(G, mu, lambda);
}

fn block(G: Tensor, gradient: vector, mu: real, lambda: real) -> Block {
    return hooke_block(gradient, mu, lambda);
}

fn lame(mu: real, lambda: real) -> array<real, 2> {
    return array<real, 2>(mu, lambda);
}
