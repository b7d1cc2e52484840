//! Loads that follow the surface, and loads that grow.

use crate::forces::acting::Acting;
use crate::model::system::System;
use crate::newton::Newton;
use crate::newton::incremental_potential::IncrementalPotential;
use crate::number::Real;
use fem_scene::simulation::{Cause, Counters};

/// The most times that loads are computed anew in a step.
const MOST: usize = 100;

/// Loads on the nodes where the dead loads are not all of them.
#[derive(Clone, Debug)]
pub struct Loads<T> {
    /// Empty where the dead loads in full are all that there is.
    force: Vec<[T; 3]>,
    /// Displacements that they are gathered at, and what they were before; empty where nothing follows.
    u: Vec<[T; 3]>,
    old: Vec<[T; 3]>,
}

impl<T: Real> Loads<T> {
    /// For a body whose loads grow, or only follow its surface, if any.
    pub fn new(system: &System<T>, grow: bool) -> Self {
        let follows = !system.pressures.is_empty();
        let grows = grow && system.dead_load.is_some();
        let zero = |needed: bool| if needed { vec![[T::default(); 3]; system.nodes()] } else { Vec::new() };
        Self { force: zero(follows || grows), u: zero(follows), old: zero(follows) }
    }

    /// The objective with these loads: those that were gathered last.
    pub fn on<'a>(&'a self, objective: IncrementalPotential<'a, T>) -> IncrementalPotential<'a, T> {
        let dead = objective.system.dead_load.as_deref();
        let load = if self.force.is_empty() { dead } else { Some(&self.force[..]) };
        IncrementalPotential { acting: Acting { load, ..objective.acting }, ..objective }
    }

    /// Gathers the part `factor` of the dead loads, and of pressures on the surface at u₀ + w.
    pub fn gather(&mut self, system: &System<T>, factor: f64, start: &[[T; 3]], w: &[[T; 3]]) {
        if self.force.is_empty() {
            return;
        }
        let factor = T::of(factor);
        for (u, (start, w)) in self.u.iter_mut().zip(start.iter().zip(w)) {
            *u = std::array::from_fn(|i| start[i] + w[i]);
        }
        self.force.fill([T::default(); 3]);
        for (sum, load) in self.force.iter_mut().zip(system.dead_load.iter().flatten()) {
            *sum = load.map(|load| factor * load);
        }
        system.add_pressures(factor, &self.u, &mut self.force);
    }

    /// Moves w to the minimum of the objective at these loads. Pressure has no energy where its surface has an edge that
    /// moves; so it stays as it is while Newton's method runs, and is gathered anew until that moves nothing any more.
    pub fn minimize(
        &mut self,
        newton: &mut Newton<T>,
        objective: IncrementalPotential<T>,
        factor: f64,
        w: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<bool, Cause> {
        let system = objective.system;
        let mut before = f64::INFINITY;
        for _ in 0..MOST {
            let converged = newton.minimize(&self.on(objective), w, counters)?;
            if system.pressures.is_empty() || !converged {
                return Ok(converged);
            }
            let change = self.follow(system, factor, objective.start, w);
            // Round-off may leave it at its last digits.
            if change <= newton.limits().tolerance || (change < 1e-8 && change >= before) {
                return Ok(true);
            }
            before = change;
        }
        Ok(false)
    }

    /// Gathers the loads anew, and returns their largest change, as a part of the largest of them.
    fn follow(&mut self, system: &System<T>, factor: f64, start: &[[T; 3]], w: &[[T; 3]]) -> f64 {
        self.old.copy_from_slice(&self.force);
        self.gather(system, factor, start, w);
        let largest = |x: &mut dyn Iterator<Item = f64>| x.fold(0.0, f64::max);
        let pairs = self.old.as_flattened().iter().zip(self.force.as_flattened());
        let change = largest(&mut pairs.map(|(a, b)| (b.as_f64() - a.as_f64()).abs()));
        let size = largest(&mut self.force.as_flattened().iter().map(|x| x.as_f64().abs()));
        if size > 0.0 { change / size } else { 0.0 }
    }
}
