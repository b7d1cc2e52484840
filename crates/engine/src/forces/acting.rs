//! What acts on a body from outside, as energy, gradient and stiffness.

use std::ops::Add;

use crate::forces::pulls::AnchorSpring;
use crate::model::system::{Energy, dot};
use crate::number::Real;
use crate::sparse::{Block, Pattern};

/// Pulls and loads of one moment.
#[derive(Clone, Copy, Debug)]
pub struct Acting<'a, T> {
    /// Pulls at nodes.
    pub pulls: &'a [AnchorSpring<T>],
    /// Forces on all nodes that do not depend on where they are, N; `None` for none.
    pub load: Option<&'a [[T; 3]]>,
}

impl<T: Real> Acting<'_, T> {
    /// Energy of the pulls less the work of the loads from rest on.
    pub fn potential(&self, u: &[[T; 3]]) -> Energy {
        let stretched = |spring: &AnchorSpring<T>| {
            let d: [T; 3] = std::array::from_fn(|i| u[spring.node][i] - spring.target[i]);
            0.5 * spring.stiffness.as_f64() * dot(&d, &d)
        };
        let pulls = self.pulls.iter().map(|spring| Energy::of(stretched(spring)));
        let loads = self.load.into_iter().flatten().zip(u).map(|(f, u)| Energy::of(-dot(f, u)));
        pulls.chain(loads).fold(Energy::default(), Add::add)
    }

    /// Adds what loads add to the gradient of [`potential`](Self::potential), N.
    pub fn add_load_gradient(&self, gradient: &mut [[T; 3]]) {
        for (sum, load) in gradient.iter_mut().zip(self.load.into_iter().flatten()) {
            for i in 0..3 {
                sum[i] -= load[i];
            }
        }
    }

    /// Adds what pulls add to it, N.
    pub fn add_pull_gradient(&self, u: &[[T; 3]], gradient: &mut [[T; 3]]) {
        for spring in self.pulls {
            for i in 0..3 {
                gradient[spring.node][i] += spring.stiffness * (u[spring.node][i] - spring.target[i]);
            }
        }
    }

    /// Adds the Hessian of [`potential`](Self::potential), N/m. Without it a stiff pull would be explicit and blow up.
    pub fn add_stiffness(&self, pattern: &Pattern, values: &mut [Block<T, 3>]) {
        for spring in self.pulls {
            if let Some(block) = pattern.find(spring.node, spring.node) {
                for i in 0..3 {
                    values[block][i][i] += spring.stiffness;
                }
            }
        }
    }

    /// Sum of the loads, N.
    pub fn total_load(&self) -> [f64; 3] {
        std::array::from_fn(|i| self.load.into_iter().flatten().map(|load| load[i].as_f64()).sum())
    }
}
