//! Mistakes that only the arguments of the closures show: the answers are right, because the forces of the trials do not depend on them.

use std::cell::RefCell;

use grader::implementation::Implementation;
use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

use super::{Case, Diagnosis};
use crate::reference::systems::solve;
use crate::reference::trial::{Input, Step};

/// Positions and velocity of a call.
type State = (DVector<f64>, DVector<f64>);

/// Relative difference from which on two velocities differ.
const DIFFERENCE: f64 = 1e-9;

/// A step of implicit Euler that hands a trial position and the velocity at the start of the step to force or stiffness.
pub fn old_velocity(cases: &[Case], subject: &dyn Implementation) -> Option<Diagnosis> {
    let steps = cases.iter().filter(|case| case.trial.function == "implicit_euler");
    let steps = steps.filter_map(|case| if let Input::Step(step) = &case.trial.input { Some(step) } else { None });
    let told: Vec<_> = steps.filter_map(|step| Some((step, states(step, subject)?))).collect();
    let is_old = |step: &Step, (_, v): &State| (v - &step.qdot).norm() <= DIFFERENCE * (1.0 + step.qdot.norm());
    // The velocity that leads to the position of a call.
    let moves = |step: &Step, (q, _): &State| {
        let led = (q - &step.q) / step.dt;
        (led - &step.qdot).norm() > 1e-3 * (1.0 + step.qdot.norm())
    };
    let mistaken = |closure: usize| {
        let calls = || told.iter().flat_map(|(step, states)| states[closure].iter().map(move |state| (*step, state)));
        calls().all(|(step, state)| is_old(step, state)) && calls().any(|(step, state)| moves(step, state))
    };
    let name = match [mistaken(0), mistaken(1)] {
        [true, true] => "old velocity in the force and in the stiffness",
        [true, false] => "old velocity in the force",
        [false, true] => "old velocity in the stiffness",
        [false, false] => return None,
    };
    let sentence = "Positions and velocity that are handed to a closure do not belong together: the velocity is that at the start of the \
                    step, and the positions are not. Which velocity leads to them?";
    Some(Diagnosis::new(name, sentence))
}

/// The states at which a step evaluates force and stiffness; `None` if it does not answer.
fn states(step: &Step, subject: &dyn Implementation) -> Option<[Vec<State>; 2]> {
    let (mut q, mut v, system, dt) = (step.q.clone(), step.qdot.clone(), &step.system, step.dt);
    let [forces, stiffnesses] = [(); 2].map(|()| RefCell::new(Vec::new()));
    let fits = |state: &State| state.0.len() == step.q.len() && state.1.len() == step.q.len();
    let note = |list: &RefCell<Vec<State>>, q: &DVector<f64>, v: &DVector<f64>| {
        let state = (q.clone(), v.clone());
        if fits(&state) {
            list.borrow_mut().push(state);
        }
    };
    let energy = |v: &DVector<f64>| {
        let gained = v - &step.qdot;
        0.5 * gained.dot(&(&system.mass * &gained)) + system.potential(&(&step.q + v * dt))
    };
    let force = |q: &DVector<f64>, v: &DVector<f64>| {
        note(&forces, q, v);
        system.force(q, v)
    };
    let stiffness = |q: &DVector<f64>, v: &DVector<f64>| {
        note(&stiffnesses, q, v);
        system.stiffness(q)
    };
    let mass = CsrMatrix::from(&system.mass);
    subject.implicit_euler(&mut q, &mut v, dt, &mass, &energy, &force, &stiffness, &solve).ok()?;
    Some([forces.into_inner(), stiffnesses.into_inner()])
}
