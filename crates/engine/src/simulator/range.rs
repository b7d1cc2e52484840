//! Whether a scene's numbers, and what follows from them, fit into the float type that it is computed with.

use super::Refusal;
use crate::model::system::System;
use crate::number::Real;
use fem_scene::{Method, Precision};

/// Refuses a scene of which a derived quantity would be zero or infinite. Each of its own numbers has been checked; products of
/// several can still be out of range, in single precision above all.
pub(super) fn check<T: Real>(method: &Method, system: &System<T>) -> Result<(), Refusal> {
    let [shear, bulk] = system.law.moduli();
    let mass = system.mass.diagonal();
    let rate = T::of(1.0 / (method.dt * method.dt));
    let volumes = fem_mesh::volumes(&system.shape.mesh);
    let has_range = |volume: &f64| is_positive(T::of(*volume)) && is_positive(T::of(1.0 / volume));
    let forces = system.dead_load.iter().flatten().flatten();
    let derived = [
        ("mesh", "a volume of an element", volumes.iter().all(has_range)),
        ("material", "moduli", is_positive(shear) && bulk.is_finite()),
        ("material.density", "a mass of a node", mass.iter().all(|&mass| is_positive(mass))),
        ("time.dt", "a mass over the time step squared", mass.iter().all(|&mass| is_positive(mass * rate))),
        ("material", "a stiffness of an element", volumes.iter().all(|volume| is_stiff(T::of(shear), *volume))),
        ("gravity", "a force on a node", forces.clone().all(|force| force.as_f64().is_finite())),
        ("drag", "a stiffness", system.drag.iter().all(|drag| is_positive(T::of(drag.stiffness)))),
        ("springs", "a stiffness", system.springs.iter().all(|spring| is_positive(spring.stiffness))),
        ("traction", "a pressure", system.pressures.iter().all(|pressure| pressure.pressure.as_f64().is_finite())),
    ];
    match derived.iter().find(|(_, _, fits)| !fits) {
        Some((field, what, _)) => Err((field, problem(method.precision, what))),
        None => Ok(()),
    }
}

/// Neither zero nor so small that it has lost digits, and not infinite.
fn is_positive<T: Real>(x: T) -> bool {
    let x = x.as_f64();
    // What is normal in single precision may be far below in double.
    let least = if size_of::<T>() == 4 { f64::from(f32::MIN_POSITIVE) } else { f64::MIN_POSITIVE };
    x >= least && x.is_finite()
}

/// μ V^(1/3), the stiffness of an element, N/m.
fn is_stiff<T: Real>(modulus: T, volume: f64) -> bool {
    is_positive(modulus * T::of(volume.cbrt()))
}

fn problem(precision: Precision, what: &str) -> String {
    let (name, remedy) = match precision {
        Precision::F32 => ("single", ", or remove time.precision"),
        Precision::F64 => ("double", ""),
    };
    format!("leads to {what} out of the range of {name} precision; give a more ordinary number{remedy}")
}
