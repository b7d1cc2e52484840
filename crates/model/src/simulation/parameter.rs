//! Parameters that the user changes while a simulation runs.

/// A number that the user may change while the simulation runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name for [`Interactive::set_parameter`](super::Interactive::set_parameter).
    pub key: &'static str,
    /// Name on the screen.
    pub label: &'static str,
    /// SI unit, such as `Pa`.
    pub unit: &'static str,
    /// Value in use.
    pub value: f64,
    /// Smallest and largest value that is accepted.
    pub range: (f64, f64),
    /// True if a slider should be logarithmic.
    pub logarithmic: bool,
}

impl Parameter {
    /// The time step, s.
    pub fn dt(value: f64, range: (f64, f64)) -> Self {
        Self { key: "dt", label: "time step", unit: "s", value, range, logarithmic: true }
    }

    /// The number of substeps of a step.
    pub fn substeps(value: usize) -> Self {
        let range = (1.0, 1000.0_f64.max(value as f64));
        Self { key: "substeps", label: "substeps", unit: "", value: value as f64, range, logarithmic: true }
    }

    /// The stiffness of the springs of `[drag]` and of the mouse, N/m.
    pub fn drag(value: f64) -> Self {
        Self { key: "drag", label: "drag stiffness", unit: "N/m", value, range: (1.0, 1e8), logarithmic: true }
    }

    /// Returns an error if the value is not finite or out of range.
    pub(super) fn check(&self, value: f64) -> Result<(), String> {
        let (low, high) = self.range;
        // NaN fails the comparison.
        if low <= value && value <= high {
            return Ok(());
        }
        Err(format!("{} = {value} {}; give {low} to {high}", self.label, self.unit))
    }
}
