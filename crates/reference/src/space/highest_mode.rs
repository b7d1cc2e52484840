//! The mode of a body's highest natural frequency, which limits explicit time steps.

use fem_engine::integrators::MassInverse;
use fem_engine::simulator::double::{System, add_stiffness_times, solve_mass};
use fem_engine::vector::{dot, norm};
use fem_model::simulation::Cause;

/// The mode of the highest natural frequency.
pub struct HighestMode {
    /// Natural frequency, 1/s.
    pub omega: f64,
    /// Mode shape in the engine's numbering; the largest component is 1.
    pub shape: Vec<[f64; 3]>,
}

/// Upper limit of power iterations.
const MAX_ITERATIONS: usize = 20_000;

/// ω_max at rest: the square root of the largest eigenvalue of M⁻¹ K by power iteration (Golub and Van Loan, Matrix Computations,
/// 2013, ch. 8.2) with the Rayleigh quotient, whose error is the square of the mode's.
/// `start` must contain the mode.
pub fn highest_mode(system: &System, start: Vec<[f64; 3]>) -> Result<HighestMode, Cause> {
    let mut inverse = MassInverse::new(&system.mass);
    let rest = vec![[0.0; 3]; system.nodes()];
    let mut x = start;
    let (mut force, mut next) = (rest.clone(), rest.clone());
    let mut omega2: f64 = 0.0;
    for _ in 0..MAX_ITERATIONS {
        system.dirichlet.clear_constrained(&mut x);
        let length = norm(&x);
        scale(&mut x, 1.0 / length);
        force.fill([0.0; 3]);
        add_stiffness_times(system, &rest, &x, &mut force);
        let quotient = dot(&x, &force) / (2.0 * system.mass.kinetic_energy(&x));
        let is_settled = (quotient - omega2).abs() <= 1e-13 * quotient;
        omega2 = quotient;
        if is_settled {
            break;
        }
        solve_mass(&mut inverse, system, &mut force, &mut next)?;
        std::mem::swap(&mut x, &mut next);
    }
    let largest = x.as_flattened().iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    scale(&mut x, 1.0 / largest);
    Ok(HighestMode { omega: omega2.sqrt(), shape: x })
}

fn scale(x: &mut [[f64; 3]], factor: f64) {
    x.as_flattened_mut().iter_mut().for_each(|x| *x *= factor);
}
