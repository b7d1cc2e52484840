//! Springs of zero rest length from nodes to points in space: ½ k |u − target|². `[drag]` moves its target along a sine; a user's
//! interaction replaces it.

use std::sync::Arc;

use fem_model::simulation::Shape;
use fem_model::{Anchor, Body, EdgeStiffness, Interaction, Law, NeoHookean};

use super::{AddBlock, Energy, HessianKind, Moment, Potential};
use fem_elements::number::is_positive;
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// Key in the statistics.
pub const NAME: &str = "drag";

/// The drag springs of a body.
pub struct DragSprings {
    /// Those of the scene's drag and of the user's interaction.
    pub interaction: Interaction,
    shape: Arc<Shape>,
    engine_node: Vec<u32>,
}

impl DragSprings {
    /// The drag springs of a body with these meshes.
    pub fn new(interaction: Interaction, shape: &Arc<Shape>, numbering: &Numbering) -> Self {
        Self { interaction, shape: Arc::clone(shape), engine_node: numbering.engine_node.clone() }
    }

    /// Returns true if there is a spring now.
    pub fn is_active(&self) -> bool {
        self.interaction.anchors(self.shape.mesh.vertices(), 0.0).next().is_some()
    }

    /// The engine's number of each spring's node, and the displacement at which the spring is at rest, m.
    pub fn springs<T: Real>(&self, time: f64) -> impl Iterator<Item = (usize, [T; 3])> {
        let drag = self.interaction.anchors(self.shape.mesh.vertices(), time);
        drag.map(|Anchor { node, displacement: d }| {
            (self.engine_node[node] as usize, [T::of(d.x), T::of(d.y), T::of(d.z)])
        })
    }
}

impl<T: Real> Potential<T> for DragSprings {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        "[drag]: a spring in force and stiffness".to_owned()
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.engine_node[..])
    }

    fn energy(&self, u: &[[T; 3]], moment: Moment) -> Energy {
        let energy = |(node, target): (usize, [T; 3])| {
            let square = |i: usize| (u[node][i] - target[i]).as_f64().powi(2);
            Energy::of(0.5 * self.interaction.stiffness * (square(0) + square(1) + square(2)))
        };
        self.springs::<T>(moment.time).map(energy).sum()
    }

    fn add_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) {
        let stiffness = T::of(self.interaction.stiffness);
        for (node, target) in self.springs::<T>(moment.time) {
            for i in 0..3 {
                gradient[node][i] += stiffness * (u[node][i] - target[i]);
            }
        }
    }

    fn nodes_of_hessian(&self) -> Option<Vec<u32>> {
        Some(self.springs::<T>(0.0).map(|(node, _)| node as u32).collect())
    }

    /// Without it a stiff spring would be integrated explicitly and become unstable.
    fn hessian(&self, _: &[[T; 3]], _: Moment, _: HessianKind, add: &mut AddBlock<T>) {
        let (k, zero) = (T::of(self.interaction.stiffness), T::zero());
        for (node, _) in self.springs::<T>(0.0) {
            add(node, node, [[k, zero, zero], [zero, k, zero], [zero, zero, k]]);
        }
    }

    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        let fits = !self.interaction.has_drag() || is_positive(T::of(self.interaction.stiffness));
        (!fits).then_some(("drag", "a stiffness"))
    }
}

/// Modulus of the springs of a user's interaction, Pa. Times the body's length it gives a stiffness that deforms the body visibly.
pub fn pull_modulus(body: &Body) -> f64 {
    match body.material.law {
        Law::NeoHookean(NeoHookean::Moduli { C, .. }) => C,
        Law::MassSpring { stiffness: EdgeStiffness::Young(young), .. } => young / 5.0,
        law => law.elastic().map_or(1e5, |elastic| elastic.young / 5.0),
    }
}
