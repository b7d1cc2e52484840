//! Limited-memory BFGS: updates of a kept inverse Hessian from the gradients.

use std::collections::VecDeque;

use fem_model::simulation::History;

use fem_elements::history::{put, take};
use fem_elements::vector::{axpy, dot};
use fem_solvers::Real;

/// Number of pairs of steps and gradient changes that are kept.
const DEPTH: usize = 6;

/// The last steps and the changes of the gradient along them: limited-memory BFGS, Nocedal, Updating Quasi-Newton Matrices with
/// Limited Storage (1980), with a kept factor of the Hessian as initial matrix, Liu, Bouaziz, Kavan, Quasi-Newton Methods for
/// Real-Time Simulation of Hyperelastic Materials (2017).
#[derive(Clone, Debug)]
pub struct Lbfgs<T> {
    pairs: VecDeque<Pair<T>>,
    spare: Vec<Pair<T>>,
}

#[derive(Clone, Debug)]
struct Pair<T> {
    step: Vec<[T; 3]>,
    change: Vec<[T; 3]>,
    /// step · change
    curvature: f64,
}

impl<T: Real> Lbfgs<T> {
    /// Allocates pairs of vectors for so many nodes.
    pub fn new(nodes: usize) -> Self {
        let pair =
            || Pair { step: vec![[T::default(); 3]; nodes], change: vec![[T::default(); 3]; nodes], curvature: 0.0 };
        Self { pairs: VecDeque::with_capacity(DEPTH), spare: (0..DEPTH).map(|_| pair()).collect() }
    }

    /// Drops all pairs: the Hessian has been factored again.
    pub fn clear(&mut self) {
        self.spare.extend(self.pairs.drain(..));
    }

    /// Keeps the step `length` × `direction` and the change of the gradient along it, unless its curvature is not positive: the
    /// update would not be positive definite.
    pub fn push(&mut self, length: f64, direction: &[[T; 3]], before: &[[T; 3]], after: &[[T; 3]]) {
        let Some(mut pair) = self.spare.pop().or_else(|| self.pairs.pop_front()) else { return };
        for node in 0..direction.len() {
            for i in 0..3 {
                pair.step[node][i] = T::of(length) * direction[node][i];
                pair.change[node][i] = after[node][i] - before[node][i];
            }
        }
        let curvature = dot(&pair.step, &pair.change);
        pair.curvature = curvature;
        if curvature > 0.0 && curvature.is_finite() {
            self.pairs.push_back(pair);
        } else {
            self.spare.push(pair);
        }
    }

    /// Adds its pairs.
    pub fn save(&self, history: &mut History) {
        let numbers = |pair: &Pair<T>| [&pair.step, &pair.change].map(|x| x.as_flattened().to_vec()).concat();
        put(history, "lbfgs.pairs", &self.pairs.iter().flat_map(numbers).collect::<Vec<T>>());
        history.put("lbfgs.curvatures", self.pairs.iter().map(|pair| pair.curvature));
    }

    /// Restores the pairs that [`save`](Self::save) has added.
    pub fn restore(&mut self, history: &History) -> Result<(), String> {
        self.clear();
        let curvatures = history.get("lbfgs.curvatures")?;
        let length = 3 * self.spare.first().map_or(0, |pair| pair.step.len());
        let mut numbers = vec![T::default(); 2 * length * curvatures.len()];
        take(history, "lbfgs.pairs", &mut numbers)?;
        for (number, &curvature) in curvatures.iter().enumerate() {
            let Some(mut pair) = self.spare.pop() else { return Err("its history has too many pairs".to_owned()) };
            let (step, change) = numbers[2 * length * number..][..2 * length].split_at(length);
            pair.step.as_flattened_mut().copy_from_slice(step);
            pair.change.as_flattened_mut().copy_from_slice(change);
            pair.curvature = curvature;
            self.pairs.push_back(pair);
        }
        Ok(())
    }

    /// Replaces x by H⁻¹ x by Nocedal's two-loop recursion; `solve` applies the kept inverse.
    pub fn apply(&self, x: &mut [[T; 3]], solve: impl FnOnce(&mut [[T; 3]])) {
        let mut weights = [0.0; DEPTH];
        for (pair, weight) in self.pairs.iter().zip(&mut weights).rev() {
            *weight = dot(&pair.step, x) / pair.curvature;
            axpy(-*weight, &pair.change, x);
        }
        solve(x);
        for (pair, weight) in self.pairs.iter().zip(weights) {
            let other = dot(&pair.change, x) / pair.curvature;
            axpy(weight - other, &pair.step, x);
        }
    }
}
