//! Line search for a node: its step must not increase the energy around it.

use super::solve::Inertia;
use fem_elements::number::Float;
use fem_elements::number::Number;

/// Largest number of halvings of a step; a node that needs more is not moved in this sweep.
pub(super) const HALVINGS: usize = 16;

/// Rounding errors of an energy, in units of the machine epsilon.
const ROUNDING: f64 = 16.0;

/// A step of the nodes of a batch, and the change of the energy around each node that it makes.
#[derive(Clone, Copy)]
pub(super) struct Change<T: Float> {
    /// m
    pub step: [T::Lanes; 3],
    /// J
    pub energy: T::Lanes,
    /// Magnitude of the terms whose sum the change is, J.
    pub size: T::Lanes,
}

impl<T: Float> Change<T> {
    /// A step whose change of energy is not known yet.
    pub fn of(step: [T::Lanes; 3]) -> Self {
        Self { step, energy: T::Lanes::zero(), size: T::Lanes::zero() }
    }

    /// The step in a lane, m.
    pub fn in_lane(&self, lane: usize) -> [T; 3] {
        self.step.map(|step| step.lane(lane))
    }

    /// Adds a change of the energy in a lane, J.
    pub fn add(&mut self, lane: usize, energy: T, size: T) {
        self.energy.set_lane(lane, self.energy.lane(lane) + energy);
        self.size.set_lane(lane, self.size.lane(lane) + size);
    }

    /// Adds the change of the inertial term, m/Δt² (u − y + Δu/2)·Δu.
    pub fn add_inertia(&mut self, inertia: Inertia<T>, batch: usize, nodes: &[u32], u: &[[T; 3]]) {
        for (lane, &node) in nodes.iter().enumerate() {
            let step = self.in_lane(lane);
            for i in 0..3 {
                let weight = T::of(inertia.over_dt2) * inertia.masses[batch][i].lane(lane);
                let moved = u[node as usize][i] - inertia.inertial[node as usize][i];
                let change = weight * (moved + T::of(0.5) * step[i]) * step[i];
                self.add(lane, change, magnitude(change));
            }
        }
    }

    /// Subtracts the work of the forces of planes on the nodes.
    pub fn add_work(&mut self, nodes: &[u32], force_on: impl Fn(usize) -> nalgebra::Vector3<f64>) {
        for (lane, &node) in nodes.iter().enumerate() {
            let (force, step) = (force_on(node as usize), self.in_lane(lane));
            for i in 0..3 {
                let work = T::of(force[i]) * step[i];
                self.add(lane, -work, magnitude(work));
            }
        }
    }

    /// Halves the steps that increase the energy by more than rounding errors, or cancels them. Returns whether a step has changed.
    pub fn shorten(&mut self, is_last: bool) -> bool {
        let mut has_changed = false;
        for lane in 0..T::WIDTH {
            let allowed = T::of(ROUNDING) * T::EPSILON * self.size.lane(lane);
            // NaN fails the comparison. An infinite change has infinite terms, which must not excuse it.
            let energy = self.energy.lane(lane);
            let is_allowed = energy <= allowed && energy.as_f64() < f64::INFINITY;
            if is_allowed || self.in_lane(lane) == [T::default(); 3] {
                continue;
            }
            has_changed = true;
            let factor = T::of(if is_last { 0.0 } else { 0.5 });
            for i in 0..3 {
                self.step[i].set_lane(lane, factor * self.step[i].lane(lane));
            }
        }
        (self.energy, self.size) = (T::Lanes::zero(), T::Lanes::zero());
        has_changed
    }
}

/// |x|
pub(super) fn magnitude<T: Float>(x: T) -> T {
    if x < T::default() { -x } else { x }
}

#[cfg(test)]
mod tests {
    use super::Change;
    use fem_elements::number::{Float, Number};

    #[test]
    fn steps_that_raise_the_energy_are_halved_and_at_last_taken_back() {
        let mut change = Change::<f64>::of([<f64 as Float>::Lanes::one(); 3]);
        change.add(0, 1.0, 1.0);
        change.add(1, -1.0, 1.0);
        change.add(2, f64::INFINITY, 1.0);
        change.add(3, f64::NAN, 1.0);
        assert!(change.shorten(false));
        assert_eq!([0, 1, 2, 3].map(|lane| change.in_lane(lane)[1]), [0.5, 1.0, 0.5, 0.5]);
        change.add(0, 1e-17, 1.0);
        change.add(3, 1.0, 1.0);
        assert!(change.shorten(true));
        assert_eq!([0, 1, 2, 3].map(|lane| change.in_lane(lane)[2]), [0.5, 1.0, 0.5, 0.0]);
        assert!(!change.shorten(false));
    }

    #[test]
    fn a_step_to_an_infinite_energy_is_halved_though_its_terms_are_infinite() {
        let mut change = Change::<f64>::of([<f64 as Float>::Lanes::one(); 3]);
        change.add(1, f64::INFINITY, f64::INFINITY);
        assert!(change.shorten(false));
        assert_eq!([0, 1].map(|lane| change.in_lane(lane)[0]), [1.0, 0.5]);
    }
}
