//! Quadratic tetrahedra, and elements whose volume is averaged or has pressures of its own, in the extremes of the other families.

use fem_model::{Integrator, Motion, Volumetric};

use super::slivers::{Thin, sliver};
use super::stiffness_and_step::{DT, YOUNG, add_weighed, vibrating};
use super::*;
use super::{invariance, recovery};
use fem_reference::{Elements, LINEAR, QUADRATIC};

const FAMILY: &str = "elements";

/// Elements without locking, with Poisson's ratios that they are made for.
const INCOMPRESSIBLE: [(Elements, f64); 6] = [
    (LINEAR.with(Volumetric::Averaged), 0.4999),
    (LINEAR.with(Volumetric::Mixed), 0.4999),
    (LINEAR.with(Volumetric::Mixed), 0.5),
    (QUADRATIC.with(Volumetric::Averaged), 0.4999),
    (QUADRATIC.with(Volumetric::Mixed), 0.4999),
    (QUADRATIC.with(Volumetric::Mixed), 0.5),
];

/// Weight over E times the cross-section: with a few times as much, corners of some elements turn inside out.
const WEIGHT: f64 = 0.1;

/// Motions of the face of largest x along x, m. The last one turns corners of elements inside out between their quadrature points, which
/// ends the run with an error that names the element; in equilibrium round-off decides how the body buckles, and whether corners turn.
const MOTIONS: [(&str, f64, Outcome); 3] = [
    ("stretched to 5 times its length", 8.0, Outcome::Survives),
    ("compressed to 70 % of its length", -0.6, Outcome::Survives),
    ("compressed to 20 % of its length", -1.6, Outcome::Explodes),
];

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let omega = unit_omega("linear", QUADRATIC);
    let stiffness: &[f64] = if quick { &[1e5] } else { &YOUNG };
    for integrator in dynamic() {
        for (&young, dt) in pairs(stiffness, DT) {
            let setup = Setup { elements: QUADRATIC, ..clamped(integrator, "neo_hookean", young, dt) };
            cases.push(vibrating(setup, omega, quick));
        }
        cases.push(invariance::rigid(integrator, QUADRATIC, true, if quick { 100 } else { 1000 }));
    }
    for &young in stiffness {
        let form = |elements, poisson| {
            move |integrator, dt| Setup { elements, poisson, ..clamped(integrator, "neo_hookean", young, dt) }
        };
        add_weighed(cases, WEIGHT, form(QUADRATIC, 0.3));
        INCOMPRESSIBLE.iter().for_each(|&(elements, poisson)| add_weighed(cases, WEIGHT, form(elements, poisson)));
    }
    for (((elements, poisson), law), dt) in pairs(pairs(INCOMPRESSIBLE, ["linear", "neo_hookean"]), DT) {
        cases.push(sagging(elements, poisson, law, dt, if quick { 10 } else { 50 }));
    }
    let methods = [Integrator::ImplicitEuler, Integrator::Static, Integrator::Verlet];
    // Each solution with the mass matrix of quadratic needles is slow.
    let is_slow =
        |(thin, integrator): &(Thin, Integrator)| matches!((thin, integrator), (Thin::Needle, Integrator::Verlet));
    for (thin, integrator) in pairs([Thin::Sheet, Thin::Needle], methods).filter(|case| !quick || !is_slow(case)) {
        let setup = Setup { elements: QUADRATIC, ..Setup::small(integrator, "neo_hookean") };
        cases.push(sliver(thin, setup, if quick { 10 } else { 100 }));
    }
    let driven = |((name, motion, expected), integrator)| driven(name, motion, expected, integrator);
    cases.extend(pairs(MOTIONS, [Integrator::ImplicitEuler]).map(driven));
    cases.extend(pairs([MOTIONS[0], MOTIONS[1]], [Integrator::Static]).map(driven));
    recovery::add_of(cases, QUADRATIC, if quick { 0 } else { 5 });
}

/// A clamped body under its weight, a nearly or wholly incompressible one.
fn sagging(elements: Elements, poisson: f64, model: &'static str, dt: f64, steps: usize) -> Case {
    let setup = Setup { elements, poisson, young: 1e6, dt, ..Setup::small(Integrator::ImplicitEuler, model) };
    let parameters = format!("nu = {poisson}, E = 1e6 Pa, dt = {dt:e} s, {steps} steps");
    let setup = setup.with(clamp).with(gravity([0.0, 0.0, -9.81]));
    setup.surviving(FAMILY, "clamped body, sagging under its weight", parameters, steps)
}

/// The face of largest x moved so far along x, m, in a hundred steps.
fn driven(name: &str, motion: f64, expected: Outcome, integrator: Integrator) -> Case {
    let setup = Setup { elements: QUADRATIC, poisson: 0.4, ..Setup::finer(integrator, "neo_hookean") };
    let setup = setup.load_steps(100).with(clamp).with(prescribed_end(Motion::by([motion, 0.0, 0.0]), 1.0));
    Case { expected, ..setup.surviving(FAMILY, name, "nu = 0.4, E = 1e5 Pa, dt = 0.01 s, 100 steps".to_owned(), 100) }
}
