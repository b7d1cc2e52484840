//! Constraints of drag springs, `[drag]` and the user's interaction: a node to a point in space, with the compliance 1/k.

use crate::forces::drag::DragSprings;
use fem_solvers::Real;

/// The drag springs of a step.
pub(super) struct DragConstraints<T> {
    /// Node, displacement at which the spring is at rest (m), and its force on the node (N).
    springs: Vec<(usize, [T; 3], [T; 3])>,
    /// N/m
    stiffness: T,
}

impl<T: Real> DragConstraints<T> {
    pub fn new() -> Self {
        Self { springs: Vec::new(), stiffness: T::default() }
    }

    /// Takes the springs at the end of a step, s.
    pub fn begin_step(&mut self, drag: &DragSprings, end: f64) {
        self.stiffness = T::of(drag.interaction.stiffness);
        self.springs.clear();
        self.springs.extend(drag.springs(end).map(|(node, target)| (node, target, [T::default(); 3])));
    }

    /// Corrects the nodes: Δf = (k (target − u) − f)/(1 + k Δt²/m), which is exact, as the force is linear.
    pub fn sweep(&mut self, dt2: f64, inverse_masses: &[[T; 3]], u: &mut [[T; 3]]) {
        for (node, target, force) in &mut self.springs {
            for i in 0..3 {
                let w = T::of(dt2) * inverse_masses[*node][i];
                let change = (self.stiffness * (target[i] - u[*node][i]) - force[i]) / (T::one() + self.stiffness * w);
                force[i] += change;
                u[*node][i] += w * change;
            }
        }
    }
}
