//! What changes in a run.

use crate::number::Real;

/// Where a body is, node by node in the engine's order.
///
/// Displacements instead of positions: they lose no digits far from the origin, and few in single precision.
#[derive(Clone, Debug, PartialEq)]
pub struct State<T> {
    /// Displacement of each node from where it is at rest, m.
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

    /// Becomes the same as another state of the body, without new memory.
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

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.u[..]) + size_of_val(&self.v[..])
    }
}
