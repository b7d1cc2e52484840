//! A graphics device as solver, behind the feature `gpu`. A scene that does not ask for it opens no device.

#[cfg(feature = "gpu")]
mod gpu;

#[cfg(feature = "gpu")]
pub use gpu::{device, is_software, name, solver, unusable};

#[cfg(not(feature = "gpu"))]
pub use absent::{is_software, name, solver, unusable};

#[cfg(not(feature = "gpu"))]
mod absent {
    use fem_model::Precision;

    use crate::ApproximateInverse;
    use fem_elements::Real;
    use fem_elements::sparse::Pattern;

    /// Name of the graphics device, or the reason why there is none.
    pub fn name() -> Result<String, String> {
        Err(ABSENT.to_owned())
    }

    /// There is no device.
    pub fn is_software() -> bool {
        false
    }

    const ABSENT: &str = "this program was built without the feature `gpu`";

    /// Returns the reason why no system can be solved on a device in this precision.
    pub fn unusable(_precision: Precision) -> Option<String> {
        Some(ABSENT.to_owned())
    }

    /// Scenes that ask for a device were refused.
    pub fn solver<T: Real>(_: Precision, _: &Pattern, _: &[[f64; 3]]) -> Box<dyn ApproximateInverse<T>> {
        unreachable!("a scene that asks for a device is refused without the feature `gpu`")
    }
}
