//! The energy ledger of a run: the energy of the body, what has been supplied to it, and what has been dissipated.
//!
//! T + U + dissipated − supplied is constant in an exact solution. A method that loses energy lowers it; if it rises, the run has made
//! energy from nothing. The rise above its lowest value so far is the gain. A gain of more than [`LARGEST_GAIN`] of the energy turned
//! over, which is the largest energy that the initial state, loads, prescribed motions and obstacles have supplied, ends the run.
//!
//! An explicit method is judged every [`EXPLICIT`] steps, and at once if the largest speed allows far more energy than that; an implicit one
//! every [`IMPLICIT`] steps. Works that depend on the path are summed in every step, by the rule that is exact for a linear
//! body: see [`work`](super::work).

use fem_model::simulation::{Cause, EnergyLedger, History};

use super::energies::{Bounds, kinetic_of_motions, plastic, rounding, steady_potential, steady_potentials, stored};
use super::work::StepWork;
use crate::forces::Moment;
use crate::integrators::Integrator;
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::history::{put_option, take, take_option};
use fem_elements::vector::dot;
use fem_solvers::Real;

/// Largest gain of energy, as a part of the energy turned over.
pub(super) const LARGEST_GAIN: f64 = 0.05;

/// Steps between judgements of an explicit and of an implicit method.
const EXPLICIT: usize = 64;
const IMPLICIT: usize = 4;

/// Kinetic energy over the energy turned over from which a step fails at once.
const LEAP: f64 = 2.0;

/// The ledger of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Ledger {
    /// Kinetic and stored energy at the start, and the potential of the steady loads then, J; `None` before the first step.
    start: Option<[f64; 2]>,
    /// Sums since the start.
    pub(super) sums: StepWork,
    /// Steps so far.
    steps: usize,
    /// Lowest left-over so far, and the largest gain over it, J.
    lowest: f64,
    gain: f64,
    /// Energy turned over, J.
    turned_over: f64,
    /// A gain is not an error.
    may_gain: bool,
}

/// A step to be judged: its end, the state before it, and the time between them, s.
pub(super) struct Step<'a, T: Real> {
    pub system: &'a System<T>,
    pub integrator: &'a dyn Integrator<T>,
    pub before: &'a State<T>,
    pub state: &'a State<T>,
    pub dt: f64,
    /// Forces of changing loads at the end of the step, N; empty without.
    pub loads: &'a [[T; 3]],
    /// Works of the step.
    pub work: &'a StepWork,
    /// Is overwritten.
    pub room: &'a mut Vec<[T; 3]>,
}

impl<T: Real> Step<'_, T> {
    /// The displacements and the time at which the energies of a method are those of one moment: where velocities lie half a step
    /// behind, that is the start of the step.
    fn place(&self) -> (&[[T; 3]], Moment) {
        match self.integrator.has_staggered_velocities() {
            true => (&self.before.u, Moment::at(self.before.time)),
            false => (&self.state.u, Moment::at(self.before.time + self.dt)),
        }
    }

    /// Kinetic energy there, J.
    fn kinetic(&self) -> f64 {
        let Self { system, before, state, .. } = self;
        match self.integrator.has_staggered_velocities() {
            true => {
                let [a, b, c] = [(before, before), (before, state), (state, state)]
                    .map(|(one, other)| system.mass.product(&one.v, &other.v));
                (a + 2.0 * b + c) / 8.0
            }
            false => system.mass.kinetic_energy(&state.v),
        }
    }

    /// The kinetic energy with which the method keeps the energy of a linear body, J.
    fn kept(&self) -> f64 {
        let Self { system, integrator, before, state, dt, .. } = self;
        match integrator.has_staggered_velocities() {
            true => system.mass.product(&before.v, &state.v) / 2.0,
            false => integrator.kinetic_energy(system, state, *dt),
        }
    }

    /// The potential of steady loads, its lowest value now or after a further step at the present velocities, and the work of changing loads in
    /// such a step, J: displacements of explicit Euler do not change in its first step.
    fn ahead(&mut self) -> [f64; 3] {
        let Self { system, before, state, dt, loads, ref mut room, .. } = *self;
        let [now, then] = steady_potentials(system, state, dt, Moment::at(before.time + dt), room);
        [now, f64::min(now, then), f64::max(0.0, dt * dot(loads, &state.v))]
    }
}

impl Ledger {
    /// An empty ledger. `may_gain` tells whether a gain of energy is accepted.
    pub(super) fn new(may_gain: bool) -> Self {
        Self { may_gain, ..Self::default() }
    }

    /// Starts again: the state is a new one.
    pub(super) fn forget(&mut self) {
        *self = Self::new(self.may_gain);
    }

    /// Takes the energies of the state before the first step.
    pub(super) fn open<T: Real>(&mut self, system: &System<T>, start: &State<T>) {
        if self.start.is_none() {
            let moment = Moment::at(start.time);
            let energy = system.mass.kinetic_energy(&start.v) + stored(system, &start.u, moment);
            self.start = Some([energy, steady_potential(system, &start.u, moment)]);
            self.turned_over = energy;
        }
    }

    /// Adds the works of a step that has been accepted.
    pub(super) fn add(&mut self, work: &StepWork) {
        self.sums += work;
        self.steps += 1;
    }

    /// Takes the works of the last step out again.
    pub(super) fn without(mut self, work: &StepWork) -> Self {
        let (sums, last) = (self.sums.to_array(), work.to_array());
        self.sums = StepWork::from_array(std::array::from_fn(|i| sums[i] - last[i]));
        self
    }

    /// Returns true if there has been a step whose end can be judged.
    pub(super) fn has_steps(&self) -> bool {
        self.steps > 1
    }

    /// Returns true while the energy that the method keeps is not yet known: in the first step velocities begin to lie half a step behind, and
    /// prescribed motions may jump.
    fn is_opening<T: Real>(&self, integrator: &dyn Integrator<T>) -> bool {
        self.steps <= 1 && integrator.has_staggered_velocities()
    }

    /// Returns true if the method is due for a judgement after the step that has just been accepted.
    pub(super) fn is_due<T: Real>(&self, integrator: &dyn Integrator<T>, is_explicit: bool) -> bool {
        let every = if is_explicit { EXPLICIT } else { IMPLICIT };
        let is_first = self.is_opening(integrator);
        is_first || integrator.may_stop_early() || self.steps > 0 && self.steps.is_multiple_of(every)
    }

    /// The cause of failure of a step, not yet accepted, in which the kinetic energy has leapt. Bounds at its start and at its end come
    /// first: most steps need no energy at all.
    pub(super) fn leap<T: Real>(&mut self, step: &mut Step<T>, [start, end]: [Bounds; 2]) -> Option<Cause> {
        let Step { system, state, .. } = *step;
        let bound = 0.5 * system.total_mass * f64::max(start.squared_speed, end.squared_speed);
        if self.may_gain || bound <= LEAP * self.turned_over {
            return None;
        }
        let mut then = self.clone();
        then.add(step.work);
        then.turn_over(step);
        self.turned_over = then.turned_over;
        // The energy of a mean velocity is at most the larger one.
        let kinetic =
            if step.integrator.has_staggered_velocities() { start.kinetic.max(end.kinetic) } else { end.kinetic };
        if kinetic <= LEAP * self.turned_over {
            return None;
        }
        let excess = step.kinetic() - self.turned_over;
        let is_leap = excess > (LEAP - 1.0) * self.turned_over && excess > rounding(system, &state.u);
        is_leap.then_some(Cause::EnergyGained { gained: excess, turned_over: self.turned_over })
    }

    /// Takes the energies at the end of a step. Returns true if energy has been gained that nothing explains.
    pub(super) fn judge<T: Real>(&mut self, step: &mut Step<T>) -> bool {
        let lag = self.turn_over(step);
        let left = self.left_over(step);
        let is_first = self.is_opening(step.integrator);
        self.lowest = if is_first { left } else { self.lowest.min(left) };
        let gain = left - self.lowest;
        self.gain = self.gain.max(gain);
        // NaN counts as a gain.
        let is_explained =
            gain <= LARGEST_GAIN * self.turned_over + lag || gain <= rounding(step.system, &step.state.u);
        !is_explained && !self.may_gain
    }

    /// Counts what is left over after the first step with prescribed motions as their work: where they jump, their forces within the step are
    /// not known.
    pub(super) fn explain_jump<T: Real>(&mut self, step: &Step<T>) {
        let left = self.left_over(step);
        self.sums.motions += f64::max(0.0, left);
    }

    /// The energy at the end of a step that nothing explains, less what the method has dissipated, J.
    fn left_over<T: Real>(&self, step: &Step<T>) -> f64 {
        let Some([start, potential]) = self.start else { return 0.0 };
        let (u, moment) = step.place();
        // At the start of a step the impulses and half of its powers have acted.
        let half = if step.integrator.has_staggered_velocities() { 0.5 } else { 0.0 };
        let StepWork { motions, rayleigh, dampers, .. } = *step.work;
        let jump = step.integrator.work_of_stages().map_or(0.0, |work| 2.0 * half * work.jump);
        let of_motions = jump + half * (motions - jump);
        let energy = step.kept() + stored(step.system, u, moment) + plastic(step.system);
        let energy = energy + self.sums.dissipated() + half * (rayleigh + dampers);
        let supplied = start + self.sums.supplied() + of_motions + potential - steady_potential(step.system, u, moment);
        energy - supplied
    }

    /// The failure of a gain.
    pub(super) fn cause(&self) -> Cause {
        Cause::EnergyGained { gained: self.gain, turned_over: self.turned_over }
    }

    /// Takes the energy supplied so far into the energy turned over. Who moves nodes supplies at least their kinetic energy. Returns the work of
    /// the loads in a further step, J: displacements of explicit Euler lag one step behind its velocities, which is a tenth of the energy of
    /// a body that has fallen for ten steps.
    fn turn_over<T: Real>(&mut self, step: &mut Step<T>) -> f64 {
        let Some([start, potential]) = self.start else { return 0.0 };
        let [now, lowest, work] = step.ahead();
        let has_motion = step.system.dirichlet.has_motion();
        let of_motions = if has_motion { kinetic_of_motions(step.system, &step.state.v, step.room) } else { 0.0 };
        let supplied = start + self.sums.supplied() + work + potential - lowest;
        self.turned_over = self.turned_over.max(supplied).max(of_motions);
        now - lowest + work
    }

    /// The ledger as reports show it, of a state.
    pub(super) fn report<T: Real>(&self, system: &System<T>, state: &State<T>) -> EnergyLedger {
        let moment = Moment::at(state.time);
        let (kinetic, stored) = (system.mass.kinetic_energy(&state.v), stored(system, &state.u, moment));
        let steady = steady_potential(system, &state.u, moment);
        let [start, potential] = self.start.unwrap_or([kinetic + stored, steady]);
        EnergyLedger {
            start,
            kinetic,
            stored,
            loads: self.sums.loads + potential - steady,
            motions: self.sums.motions,
            obstacles: self.sums.obstacles,
            plastic: plastic(system),
            rayleigh: self.sums.rayleigh,
            dampers: self.sums.dampers,
            friction: self.sums.friction,
            gain: self.gain,
            turned_over: self.turned_over,
        }
    }

    /// Adds its numbers to a history.
    pub(super) fn save(&self, history: &mut History) {
        let [energy, potential] = self.start.map_or([None; 2], |start| start.map(Some));
        put_option(history, "ledger.start", energy);
        put_option(history, "ledger.potential", potential);
        history.put("ledger.judged", [self.steps as f64, self.lowest, self.gain, self.turned_over]);
        history.put("ledger.sums", self.sums.to_array());
    }

    /// Restores the numbers that [`save`](Self::save) has added.
    pub(super) fn restore(&mut self, history: &History) -> Result<(), String> {
        let (energy, potential) = (take_option(history, "ledger.start")?, take_option(history, "ledger.potential")?);
        self.start = energy.zip(potential).map(|(energy, potential)| [energy, potential]);
        let (mut judged, mut sums) = ([0.0; 4], StepWork::default().to_array());
        take(history, "ledger.judged", &mut judged)?;
        take(history, "ledger.sums", &mut sums)?;
        let [steps, lowest, gain, turned_over] = judged;
        (self.steps, self.lowest, self.gain, self.turned_over) = (steps as usize, lowest, gain, turned_over);
        self.sums = StepWork::from_array(sums);
        Ok(())
    }
}
