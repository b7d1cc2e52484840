//! The parts of a body on which the Dirichlet conditions and surface loads of a scene act.

use fem_model::DirichletCondition;
use fem_model::simulation::Shape;

use crate::values::{dirichlet_conditions, faces_of_loads};
use crate::{Scene, SceneError};

/// Constrained nodes and loaded faces of a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Conditions {
    /// `[fixed]` first if there is one, then each `[[prescribed]]` in order.
    pub dirichlet: Vec<DirichletCondition>,
    /// Of each `[[traction]]` in order, the nodes of its faces: triangles of a solid body, edges of a flat one, as in
    /// [`BodyMesh::faces`](fem_model::BodyMesh::faces).
    pub loaded: Vec<Vec<Vec<usize>>>,
}

impl Conditions {
    /// The conditions of a scene on the body that was made of it. Returns the first problem.
    pub fn of(scene: &Scene, shape: &Shape) -> Result<Self, SceneError> {
        let refused = |refusal| scene.refused(refusal);
        let loaded = faces_of_loads(scene, shape).map_err(refused)?;
        Ok(Self { dirichlet: dirichlet_conditions(scene, &shape.mesh).map_err(refused)?, loaded })
    }

    /// The nodes of `[fixed]`, ascending; empty without the table.
    pub fn fixed(&self) -> &[usize] {
        self.dirichlet.iter().find(|condition| condition.motion.is_none()).map_or(&[], |condition| &condition.nodes)
    }

    /// The nodes of a `[[prescribed]]`, ascending; empty if there is no such table.
    pub fn prescribed(&self, number: usize) -> &[usize] {
        let prescribed = self.dirichlet.iter().filter(|condition| condition.motion.is_some());
        prescribed.into_iter().nth(number).map_or(&[], |condition| &condition.nodes)
    }
}
