//! The plastic flow of a body, for files and statistics.

/// The plastic flow of a body since the start.
#[derive(Clone, Debug, PartialEq)]
pub struct PlasticFlow {
    /// Plastic strain of each element now: the accumulated equivalent one of `j2`, the Frobenius norm of the plastic strain of
    /// `additive`.
    pub strains: Vec<f64>,
    /// Energy that it has dissipated, J.
    pub dissipated: f64,
}

impl PlasticFlow {
    /// The largest plastic strain.
    pub fn largest_strain(&self) -> f64 {
        self.strains.iter().copied().fold(0.0, f64::max)
    }
}
