//! XPBD, extended position-based dynamics: Macklin, Müller and Chentanez, XPBD: position-based simulation of compliant constrained
//! dynamics (2016), algorithm 1, for the material of the body.

use fem_model::IterationSettings;

use super::projection::{Constraints, Rule};
use super::relaxation::Relaxed;
use crate::forces::contact::planes::Planes;
use crate::forces::springs::Spring;
use crate::model::system::System;
use fem_solvers::Real;

/// XPBD: each sweep corrects every element and every spring once.
///
/// With the residual of the equation of motion, the stress of each element is an unknown, and sweeps converge to implicit Euler: the second
/// remedy (FP-PXPBD) of Chen, Han, Chen, Ma, Fedkiw and Teran, Primal residual reduction with extended position based dynamics and
/// hyperelasticity (2024). Without it each element has the one constraint C = √(2ψ) of the original method, whose sweeps converge
/// to another motion if ∇C rotates during the sweeps.
pub type Xpbd<T> = Relaxed<T, Constraints<T>>;

/// XPBD for the elements and springs of a body.
pub fn xpbd<T: Real>(settings: &IterationSettings, system: &System<T>, planes: Option<&Planes>) -> Xpbd<T> {
    let springs: Vec<Spring<T>> = system.forces.all().flat_map(|(force, _)| force.springs()).copied().collect();
    let rule = if settings.residual { Rule::Stress } else { Rule::Energy };
    Relaxed::new(Constraints::new(system, &springs, rule), settings, system, planes)
}
