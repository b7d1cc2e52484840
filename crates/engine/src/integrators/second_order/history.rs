//! State of earlier steps that a step needs.

use fem_model::simulation::History;

use super::coefficients::Combination;
use fem_elements::history::{put, put_option, take, take_option};
use fem_elements::vector::axpy;
use fem_solvers::Real;

/// The acceleration of a method that keeps one, and the last increment of a multistep method.
#[derive(Clone, Debug, Default)]
pub struct Known<T> {
    /// Acceleration without that of obstacles, m/s²; empty for a method without.
    pub acceleration: Vec<[T; 3]>,
    /// True if `acceleration` is that of the current state.
    pub has_acceleration: bool,
    /// Displacement increment of the step before, m; empty for a method of one step.
    pub increment: Vec<[T; 3]>,
    /// Velocity at its start, m/s.
    pub earlier_velocity: Vec<[T; 3]>,
    /// Its duration, s; `None` if there is none.
    pub dt: Option<f64>,
    /// Mean acceleration of the last step without that of obstacles, m/s²; empty where no error is estimated.
    pub mean: Vec<[T; 3]>,
    /// Time since the middle of that step, s; `None` if there is none.
    pub age: Option<f64>,
}

impl<T: Real> Known<T> {
    /// Allocates the vectors of a method for so many nodes: an acceleration, the previous increment, its mean acceleration.
    pub fn new(nodes: usize, [has_acceleration, has_step, has_mean]: [bool; 3]) -> Self {
        let zero = |is_kept: bool| vec![[T::default(); 3]; if is_kept { nodes } else { 0 }];
        Self {
            acceleration: zero(has_acceleration),
            has_acceleration: false,
            increment: zero(has_step),
            earlier_velocity: zero(has_step),
            dt: None,
            mean: zero(has_mean),
            age: None,
        }
    }

    /// Drops the history, because the state was not changed by a step.
    pub fn forget(&mut self) {
        (self.has_acceleration, self.dt, self.age) = (false, None, None);
    }

    /// Writes a combination with the velocities `v` of the state.
    pub fn combine(&self, combination: &Combination, v: &[[T; 3]], sum: &mut [[T; 3]]) {
        for (sum, v) in sum.iter_mut().zip(v) {
            *sum = v.map(|v| T::of(combination.velocity) * v);
        }
        let terms = [
            (combination.acceleration, &self.acceleration),
            (combination.increment, &self.increment),
            (combination.earlier_velocity, &self.earlier_velocity),
        ];
        for (factor, x) in terms.into_iter().filter(|(factor, _)| *factor != 0.0) {
            axpy(factor, x, sum);
        }
    }

    /// Adds it to the history of a checkpoint.
    pub fn save(&self, history: &mut History) {
        let acceleration: &[[T; 3]] = if self.has_acceleration { &self.acceleration } else { &[] };
        put(history, "second_order.acceleration", acceleration.as_flattened());
        put_option(history, "second_order.dt", self.dt);
        put(history, "second_order.increment", self.increment.as_flattened());
        put(history, "second_order.earlier_velocity", self.earlier_velocity.as_flattened());
        put(history, "second_order.mean", self.mean.as_flattened());
        put_option(history, "second_order.age", self.age);
    }

    /// Restores the quantities that [`save`](Self::save) has added.
    pub fn restore(&mut self, history: &History) -> Result<(), String> {
        self.has_acceleration = !history.get("second_order.acceleration")?.is_empty();
        if self.has_acceleration {
            take(history, "second_order.acceleration", self.acceleration.as_flattened_mut())?;
        }
        self.dt = take_option(history, "second_order.dt")?;
        take(history, "second_order.increment", self.increment.as_flattened_mut())?;
        take(history, "second_order.earlier_velocity", self.earlier_velocity.as_flattened_mut())?;
        take(history, "second_order.mean", self.mean.as_flattened_mut())?;
        self.age = take_option(history, "second_order.age")?;
        Ok(())
    }
}
