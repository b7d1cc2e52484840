//! Bodies that hit planes: fast, stiff, with much friction or none. No node is behind a plane after any step.

use fem_model::simulation::Diagnostics;
use fem_model::{ContactPlane, Integrator};
use nalgebra::Vector3;

use super::*;

const FAMILY: &str = "contact";

/// Meshes of a solid and of a flat block.
pub const BODIES: [(&str, Grid); 2] = [("solid", Grid::Solid([1.0; 3], 2)), ("flat", Grid::Flat([1.0; 2], 3))];

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let bodies = if quick { &BODIES[1..] } else { &BODIES[..] };
    let stiffness: &[f64] = if quick { &[1e5] } else { &[1e4, 1e7, 2e11] };
    let frictions: &[f64] = if quick { &[0.5] } else { &[0.0, 0.5, 10.0] };
    // Fractions of the speed of waves in the body.
    let speeds = [1e-3, 0.2];
    for (((&(name, grid), &young), &friction), speed) in pairs(pairs(pairs(bodies, stiffness), frictions), speeds) {
        let methods = [Integrator::ImplicitEuler, Integrator::Verlet, Integrator::SemiImplicitEuler];
        // Bathe's method has no contact.
        let second_order = Integrator::second_order_implicit().filter(|integrator| *integrator != Integrator::Bathe);
        for integrator in methods.into_iter().chain(second_order) {
            let setup = Setup { grid, young, ..Setup::small(integrator, "stable_neo_hookean") };
            cases.push(hit(setup, name, friction, speed));
        }
    }
}

/// A block that flies into the corner of two planes.
pub fn hit(setup: Setup, body: &str, friction: f64, part: f64) -> Case {
    let wave = (setup.young / setup.density).sqrt();
    let speed = part * wave;
    let plane = move |point: [f64; 3], normal: [f64; 3]| ContactPlane {
        friction,
        ..ContactPlane::new(Vector3::from(point), Vector3::from(normal))
    };
    let is_explicit = !setup.integrator.has_newton() && !setup.integrator.is_iterated();
    let (dt, steps) = if is_explicit { (0.01 / wave, 400) } else { (0.1 / wave, 60) };
    let setup = Setup { dt, ..setup }.with_if(is_explicit, lump).with(move |body, method| {
        let planes = vec![plane([0.0, -0.05, 0.0], [0.0, 1.0, 0.0]), plane([1.3, 0.0, 0.0], [-1.0, 1.0, 0.0])];
        body.velocity([0.5 * speed, -speed, 0.0])?.obstacles(planes, method)
    });
    let parameters = format!(
        "{body}, E = {:e} Pa, friction {friction}, {part} of the speed of waves, dt = {dt:.2e} s, {steps} steps",
        setup.young
    );
    Case {
        // The line search of projective dynamics would need the barrier, so the method refuses contact.
        expected: if setup.integrator.facts().contact.is_some() { Outcome::Survives } else { Outcome::Refused },
        margin_is: "smallest distance from a plane in steps, m; must not be negative",
        ..setup.case(FAMILY, "flies into a corner", parameters, move |setup, deadline| watched(setup, steps, deadline))
    }
}

fn watched(setup: &Setup, steps: usize, deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = setup.build()?;
    let mut smallest = f64::INFINITY;
    let end = march_with(&mut simulation, steps, deadline, |simulation| {
        smallest = simulation.contacts().iter().map(|plane| plane.smallest_gap).fold(smallest, f64::min);
    });
    end.survived()?;
    let outcome = if smallest >= -1e-12 { Outcome::Survives } else { Outcome::Deviates };
    Ok(Finding::new(outcome, smallest, end.note()))
}
