//! Energies of a body, and the energy ledger of a run.

use serde::Serialize;

/// Energies of the body now, and those supplied and dissipated since the start, J:
/// start + loads + motions + obstacles = kinetic + stored + plastic + rayleigh + dampers + friction + numerical.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct EnergyLedger {
    /// Kinetic and stored energy at the start.
    pub start: f64,
    /// Work of gravity, body forces, tractions, pressures and pulls.
    pub loads: f64,
    /// Work of prescribed motions.
    pub motions: f64,
    /// Work of moving planes.
    pub obstacles: f64,
    /// ½ vᵀ M v
    pub kinetic: f64,
    /// Elastic energy, that of springs, and that of the barriers of planes.
    pub stored: f64,
    /// Dissipated by plastic flow.
    pub plastic: f64,
    /// Dissipated by Rayleigh damping.
    pub rayleigh: f64,
    /// Dissipated by the dampers of springs.
    pub dampers: f64,
    /// Dissipated by friction on planes.
    pub friction: f64,
    /// The largest rise of the left-over energy so far, by the kinetic energy that the method keeps: energy from nothing.
    pub gain: f64,
    /// The largest energy supplied so far, the start included.
    pub turned_over: f64,
}

impl EnergyLedger {
    /// Supplied by loads, motions and obstacles, J.
    pub fn supplied(&self) -> f64 {
        self.loads + self.motions + self.obstacles
    }

    /// Dissipated by plastic flow, damping and friction, J.
    pub fn dissipated(&self) -> f64 {
        self.plastic + self.rayleigh + self.dampers + self.friction
    }

    /// Energy that the method and impacts on planes have dissipated, J; negative if energy has come from nothing.
    pub fn numerical(&self) -> f64 {
        self.start + self.supplied() - self.kinetic - self.stored - self.dissipated()
    }
}

/// Energies of the whole body, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// ½ vᵀ M v
    pub kinetic: f64,
    /// Elastic energy, gravity, dead loads and springs, and pressures that have a potential: those whose surface is closed or
    /// has a fixed edge. Of a plastic body it is the stored energy; [`PlasticFlow`](super::PlasticFlow) has the dissipated one.
    pub potential: f64,
}

impl Energies {
    /// Kinetic and potential energy together.
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential
    }
}
