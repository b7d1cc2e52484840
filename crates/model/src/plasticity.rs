//! Plastic flow.

/// The plastic flow of all elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Plasticity {
    /// Strain beyond the yield strain flows into a plastic strain in the course of time.
    Additive {
        /// Frobenius norm of the elastic strain beyond which it flows.
        yield_strain: f64,
        /// Rate of the flow, 1/s.
        creep: f64,
        /// Largest Frobenius norm of the plastic strain.
        maximum: f64,
    },
    /// Von Mises plasticity with linear isotropic hardening.
    J2 {
        /// Yield stress in tension, Pa.
        yield_stress: f64,
        /// Growth of the yield stress with the equivalent plastic strain, Pa.
        hardening: f64,
    },
}
