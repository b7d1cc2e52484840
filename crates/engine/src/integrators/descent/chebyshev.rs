//! Chebyshev's semi-iterative method over the sweeps of a step: Wang, A Chebyshev semi-iterative approach for accelerating projective and
//! position-based dynamics (2015), algorithm 1, as Chen et al. 2024, section 3.8, have it: x_k = ω_k (x̂_k − x_(k−2)) + x_(k−2), where x̂_k
//! is the result of the sweep.

use fem_solvers::Real;

/// The last two iterates of a step, and the weight of the next.
pub(super) struct Chebyshev<T> {
    /// Square of the estimated spectral radius of a sweep.
    radius2: f64,
    weight: f64,
    /// Sweeps since the start, or since the last restart.
    sweeps: usize,
    /// Displacements before the last sweep, m.
    previous: Vec<[T; 3]>,
    /// Those before the sweep before it.
    older: Vec<[T; 3]>,
}

impl<T: Real> Chebyshev<T> {
    /// Acceleration for an estimated spectral radius, 0 to below 1.
    pub fn new(radius: f64, nodes: usize) -> Self {
        let zero = || vec![[T::default(); 3]; nodes];
        Self { radius2: radius * radius, weight: 1.0, sweeps: 0, previous: zero(), older: zero() }
    }

    /// Starts again from these displacements.
    pub fn restart(&mut self, u: &[[T; 3]]) {
        (self.weight, self.sweeps) = (1.0, 0);
        self.previous.copy_from_slice(u);
    }

    /// Extrapolates the displacements after a sweep, except at nodes for which `stays` is true. An infeasible result is dropped, and the
    /// acceleration restarts.
    pub fn accelerate(
        &mut self,
        u: &mut [[T; 3]],
        stays: impl Fn(usize) -> bool,
        is_feasible: impl Fn(&[[T; 3]]) -> bool,
    ) {
        self.sweeps += 1;
        self.weight = match self.sweeps {
            1 => 1.0,
            2 => 2.0 / (2.0 - self.radius2),
            _ => 4.0 / (4.0 - self.radius2 * self.weight),
        };
        let weight = T::of(self.weight);
        for (node, (older, u)) in self.older.iter_mut().zip(&*u).enumerate() {
            *older = if self.sweeps == 1 || stays(node) {
                *u
            } else {
                [0, 1, 2].map(|i| weight * (u[i] - older[i]) + older[i])
            };
        }
        std::mem::swap(&mut self.previous, &mut self.older);
        if self.sweeps > 1 && !is_feasible(&self.previous) {
            self.restart(u);
        } else {
            u.copy_from_slice(&self.previous);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Chebyshev;

    /// Iterations of x = r x, from x = 1, until x is small.
    fn iterations(radius: f64, rates: [f64; 3]) -> usize {
        let mut u = [[1.0_f64; 3]];
        let mut acceleration = Chebyshev::new(radius, 1);
        acceleration.restart(&u);
        for iteration in 1..10_000 {
            u[0] = [0, 1, 2].map(|i| rates[i] * u[0][i]);
            acceleration.accelerate(&mut u, |_| false, |_| true);
            if u[0].iter().all(|x| x.abs() < 1e-10) {
                return iteration;
            }
        }
        10_000
    }

    #[test]
    fn acceleration_takes_about_the_square_root_of_the_iterations() {
        let rates = [0.99, 0.5, 0.1];
        let (plain, accelerated) = (iterations(0.0, rates), iterations(0.99, rates));
        assert!((2280..2310).contains(&plain) && accelerated < plain / 6, "{plain} {accelerated}");
    }

    #[test]
    fn an_infeasible_iterate_is_dropped_and_nodes_that_stay_are_not_carried_further() {
        let mut acceleration = Chebyshev::new(0.9, 2);
        let mut u = [[1.0_f64; 3], [1.0; 3]];
        acceleration.restart(&u);
        for feasible in [true, true, false] {
            u = u.map(|u| u.map(|x| 0.5 * x));
            let swept = u;
            acceleration.accelerate(&mut u, |node| node == 1, |_| feasible);
            assert_eq!(u[1], swept[1]);
            assert_eq!(u[0] == swept[0], swept[0][0] == 0.5 || !feasible, "{u:?}");
        }
    }
}
