//! Environments on the processor: a simulation each.

use fem_model::simulation::{Failure, Simulation};
use fem_model::{Batch as Values, Body, Method, Refusal};
use rayon::prelude::*;

use super::{EnvironmentFailure, EnvironmentState, Environments};
use crate::simulator;

/// Largest number of elements of all environments together; an element takes a few hundred bytes.
const MOST_ELEMENTS: usize = 1 << 24;

/// The environments with their simulations.
pub(super) struct OnProcessor(Vec<OneOf>);

/// An environment.
struct OneOf {
    simulation: Box<dyn Simulation>,
    failure: Option<Failure>,
}

impl OnProcessor {
    /// Builds all simulations.
    pub(super) fn new(body: &Body, method: &Method, values: &Values) -> Result<Self, Refusal> {
        let (count, elements) = (values.0.len(), body.shape.mesh.elements());
        let most = (MOST_ELEMENTS / elements.max(1)).max(1);
        if count > most {
            let problem = format!(
                "is {count}, and so many bodies of {elements} elements take too much memory; give {most} at most, or a coarser mesh"
            );
            return Err(Refusal::new("batch.count", problem));
        }
        let of = |values| {
            let simulation = simulator::build(body.environment(values), method)?;
            Ok(OneOf { simulation, failure: None })
        };
        values.0.par_iter().map(of).collect::<Result<_, Refusal>>().map(Self)
    }
}

impl OneOf {
    fn advance(&mut self, steps: usize) {
        for _ in 0..steps {
            if self.failure.is_some() {
                return;
            }
            self.failure = self.simulation.step().err();
        }
    }
}

impl Environments for OnProcessor {
    fn advance(&mut self, steps: usize) -> Result<(), String> {
        self.0.par_iter_mut().for_each(|environment| environment.advance(steps));
        Ok(())
    }

    fn state(&mut self, environment: usize) -> Result<EnvironmentState, String> {
        let simulation = &self.0[environment].simulation;
        let nodes = |stacked: nalgebra::DVector<f64>| stacked.as_slice().as_chunks::<3>().0.to_vec();
        Ok(EnvironmentState { positions: nodes(simulation.positions()), velocities: nodes(simulation.velocities()) })
    }

    fn failures(&mut self) -> Result<Vec<EnvironmentFailure>, String> {
        let failures = self.0.iter().enumerate().filter_map(|(environment, of)| {
            let failure = of.failure.clone()?;
            Some(EnvironmentFailure { environment, failure })
        });
        Ok(failures.collect())
    }

    fn check_ends(&mut self) -> Result<(), String> {
        for environment in self.0.iter_mut().filter(|environment| environment.failure.is_none()) {
            environment.failure = environment.simulation.failure_at_end();
        }
        Ok(())
    }

    fn unconverged_steps(&self) -> usize {
        self.0.iter().map(|environment| environment.simulation.counters().unconverged_steps).sum()
    }

    fn place(&self) -> String {
        match rayon::current_num_threads() {
            1 => "one thread of the processor".to_owned(),
            threads => format!("{threads} threads of the processor"),
        }
    }
}
