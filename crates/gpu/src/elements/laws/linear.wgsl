// Hooke's law for small strain: P = 2μ ε + λ tr(ε) 1. Sifakis and Barbič, FEM Simulation of 3D Deformable Solids (2012), part one, §3.2.

const ALLOWS_INVERSION = true;

// P; the moduli are μ and λ, Pa.
fn stress(G: Tensor, mu: real, lambda: real) -> Tensor {
    return hooke_stress(G, mu, lambda);
}

fn energy(G: Tensor, mu: real, lambda: real) -> real {
    return hooke_energy(G, mu, lambda);
}

struct Tangent {
    mu: real,
    lambda: real,
}

fn tangent(G: Tensor, mu: real, lambda: real) -> Tangent {
    return Tangent(mu, lambda);
}

fn stress_change(at: Tangent, D: Tensor) -> Tensor {
    return hooke_stress(D, at.mu, at.lambda);
}

fn lame(mu: real, lambda: real) -> array<real, 2> {
    return array<real, 2>(mu, lambda);
}
