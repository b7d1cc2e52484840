//! The coarse matrix in the history of a checkpoint: it may be that of a much earlier step.

use fem_model::simulation::History;

use super::Coarse;
use crate::ApproximateInverse;
use fem_elements::history::{put, put_flag, put_option, take, take_flag, take_option};

impl Coarse {
    /// Adds the coarse matrix and the data that decide on its next assembly.
    pub fn save(&self, history: &mut History) {
        put(history, "coarse.free", self.free.as_flattened());
        put(history, "coarse.weight", &[self.weight]);
        put_option(history, "coarse.scale", self.scale);
        if self.scale.is_some() {
            put(history, "coarse.values", self.values.as_flattened().as_flattened());
        }
        put_option(history, "coarse.effort", self.effort);
        put_flag(history, "coarse.is_outdated", self.is_outdated);
    }

    /// Restores the data that [`save`](Self::save) has added, and factorises the coarse matrix again.
    pub fn restore(&mut self, history: &History) -> Result<(), String> {
        take(history, "coarse.free", self.free.as_flattened_mut())?;
        take(history, "coarse.weight", std::slice::from_mut(&mut self.weight))?;
        self.scale = take_option(history, "coarse.scale")?;
        self.effort = take_option(history, "coarse.effort")?;
        self.is_outdated = take_flag(history, "coarse.is_outdated")?;
        if self.scale.is_none() {
            return Ok(());
        }
        take(history, "coarse.values", self.values.as_flattened_mut().as_flattened_mut())?;
        self.factor.prepare(&self.values).map_err(|_| "its coarse matrix cannot be factored again".to_owned())
    }
}
