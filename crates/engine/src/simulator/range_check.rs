//! Checks that a scene's numbers, and the quantities derived from them, fit into the number type of the simulation.

use fem_model::{Integrator, Material, Method, Precision, Refusal};

use super::integrator::SMALLEST_TOLERANCE;
use crate::model::system::System;
use fem_elements::materials::AnyLaw;
use fem_elements::number::is_positive;
use fem_solvers::Real;

/// Largest strain from rounding errors of positions.
const STRAIN: f64 = 1e-2;

/// Refuses a tolerance of Newton's method below rounding error: it would iterate to its limit in every step.
pub(super) fn check_tolerance(method: &Method, epsilon: f64) -> Result<(), Refusal> {
    let least = SMALLEST_TOLERANCE * epsilon;
    match method.newton.tolerance {
        Some(tolerance) if tolerance < least => {
            let problem =
                format!("is {tolerance:e}, which rounding error does not let a step reach; give {least:.1e} or more");
            let remedy = if method.precision == Precision::F32 { ", or remove time.precision" } else { "" };
            Err(Refusal::new("newton.tolerance", problem + remedy))
        }
        _ => Ok(()),
    }
}

/// Refuses a scene with a derived quantity that would be zero or infinite. Each of its numbers has been checked when it was read;
/// products of several can still be out of range, above all in single precision.
pub(super) fn check<T: Real>(method: &Method, system: &System<T>) -> Result<(), Refusal> {
    let moduli: Vec<[T; 2]> = system.elements.moduli().map(|moduli| moduli.map(T::of)).collect();
    let mass = system.mass.diagonal();
    let dt = method.dt / method.substeps as f64;
    let rate = T::of(1.0 / (dt * dt));
    let volumes = system.shape.mesh.volumes();
    let has_range = |volume: &f64| is_positive(T::of(*volume)) && is_positive(T::of(1.0 / volume));
    let derived = [
        ("mesh", "a volume of an element", volumes.iter().all(has_range)),
        ("material", "moduli", moduli.as_flattened().iter().all(|&modulus| is_positive(modulus))),
        ("material.density", "a mass of a node", mass.iter().all(|&mass| is_positive(mass))),
        ("time.dt", "a mass over the time step squared", mass.iter().all(|&mass| is_positive(mass * rate))),
        (
            "material",
            "a stiffness of an element",
            volumes.iter().all(|volume| moduli.iter().all(|[shear, _]| is_stiff(*shear, *volume))),
        ),
    ];
    let derived = derived.into_iter().find(|(_, _, fits)| !fits).map(|(field, quantity, _)| (field, quantity));
    let forces = || system.forces.all().find_map(|(potential, _)| potential.out_of_range());
    match derived.or_else(forces) {
        Some((field, quantity)) => Err(Refusal::new(field, problem(method, quantity))),
        None => check_motions(method, system, &volumes),
    }
}

/// Refuses a motion to equilibrium so long that rounding errors of the positions strain the smallest element by [`STRAIN`].
fn check_motions<T: Real>(method: &Method, system: &System<T>, volumes: &[f64]) -> Result<(), Refusal> {
    if method.integrator != Integrator::Static {
        return Ok(());
    }
    let size = volumes.iter().fold(f64::INFINITY, |least, &volume| least.min(volume)).cbrt();
    for (condition, motion) in system.dirichlet.motions() {
        let moved = |&node: &usize| (motion.position(&system.rest[node], 1.0) - system.rest[node]).amax();
        let farthest = condition.nodes.iter().map(moved).fold(0.0, f64::max);
        if farthest * T::EPSILON.as_f64() > STRAIN * size {
            let (name, remedy) = precision(method);
            let problem = format!(
                "moves nodes by {farthest:.1e} m, where {name} precision does not resolve elements of {size:.1e} m; give a smaller motion{remedy}"
            );
            return Err(Refusal::new(&condition.name, problem));
        }
    }
    Ok(())
}

/// Refuses parameters whose signs make the material unstable at rest. Double precision rounds no allowed parameter to
/// zero.
pub(super) fn check_shear_modulus(table: &Material) -> Result<(), String> {
    // Springs are stiff only along their direction.
    if table.is_mass_spring() {
        return Ok(());
    }
    let shear = AnyLaw::<f64>::new(table).map_or(0.0, |law| law.moduli()[0]);
    if shear > 0.0 {
        return Ok(());
    }
    Err(format!("has the shear modulus {shear:e} Pa at small strain; give parameters that make it positive"))
}

/// Returns true if μ V^(1/3), the stiffness of an element (N/m), is in range.
fn is_stiff<T: Real>(modulus: T, volume: f64) -> bool {
    is_positive(modulus * T::of(volume.cbrt()))
}

fn problem(method: &Method, quantity: &str) -> String {
    let (name, remedy) = precision(method);
    format!("leads to {quantity} out of the range of {name} precision; give a less extreme number{remedy}")
}

/// The precision in words, and the remedy beside a less extreme number.
fn precision(method: &Method) -> (&'static str, &'static str) {
    match method.precision {
        Precision::F32 => ("single", ", or remove time.precision"),
        Precision::F64 => ("double", ""),
    }
}
