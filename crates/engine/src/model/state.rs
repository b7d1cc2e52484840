//! The state of a body: everything that changes in a run.

use fem_elements::vector::max_norm;
use fem_solvers::Real;

/// Displacements and velocities of all nodes, in the engine's numbering.
///
/// Displacements are exact far from the origin, where positions lose digits, and they need fewer digits in single precision.
#[derive(Clone, Debug, PartialEq)]
pub struct State<T> {
    /// Displacement of each node, m.
    pub u: Vec<[T; 3]>,
    /// Velocity of each node, m/s.
    pub v: Vec<[T; 3]>,
    /// Seconds since the start.
    pub time: f64,
    /// Steps since the start.
    pub steps: usize,
}

impl<T: Real> State<T> {
    /// At rest.
    pub fn at_rest(nodes: usize) -> Self {
        Self { u: vec![[T::default(); 3]; nodes], v: vec![[T::default(); 3]; nodes], time: 0.0, steps: 0 }
    }

    /// Undeformed, with these velocities, m/s; at rest if there are none.
    pub fn at_start(nodes: usize, velocities: &[[T; 3]]) -> Self {
        let mut state = Self::at_rest(nodes);
        if !velocities.is_empty() {
            state.v.copy_from_slice(velocities);
        }
        state
    }

    /// Copies another state of the body without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        self.u.copy_from_slice(&other.u);
        self.v.copy_from_slice(&other.v);
        (self.time, self.steps) = (other.time, other.steps);
    }

    /// The first node whose displacement or velocity is not finite.
    pub fn first_not_finite(&self) -> Option<usize> {
        let finite = |x: &[T; 3]| x.iter().all(|x| x.as_f64().is_finite());
        self.u.iter().zip(&self.v).position(|(u, v)| !finite(u) || !finite(v))
    }

    /// A bound of the largest squared speed of a node, m²/s².
    pub fn largest_squared_speed(&self) -> f64 {
        3.0 * max_norm(&self.v).powi(2)
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.u[..]) + size_of_val(&self.v[..])
    }
}
