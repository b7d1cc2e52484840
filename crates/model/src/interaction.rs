//! Springs by which a scene or a user pulls a running body: those of `[drag]`, or those of the mouse, which replace them.

use nalgebra::Vector3;

use crate::Drag;
use crate::simulation::Pull;

/// A spring of zero rest length between a node and a point of space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// The node, as the mesh numbers it.
    pub node: usize,
    /// Displacement of the node from its undeformed position at which the spring is at rest, m.
    pub displacement: Vector3<f64>,
}

/// The anchor springs of a simulation at any time, and their common stiffness.
#[derive(Clone, Debug, PartialEq)]
pub struct Interaction {
    /// The scene's drag.
    drag: Option<Drag>,
    /// The user's pull.
    pull: Option<Pull>,
    /// Stiffness of every spring, N/m.
    pub stiffness: f64,
}

impl Interaction {
    /// The scene's drag. `stiffness` (N/m) is that of a pull if the scene has no drag.
    pub fn new(drag: Option<Drag>, stiffness: f64) -> Self {
        Self { stiffness: drag.map_or(stiffness, |drag| drag.stiffness), drag, pull: None }
    }

    /// Returns true if the scene has a drag.
    pub fn has_drag(&self) -> bool {
        self.drag.is_some()
    }

    /// Replaces the scene's drag by a user's pull; `None` brings the drag back.
    pub fn set_pull(&mut self, pull: Option<Pull>) {
        self.pull = pull;
    }

    /// The springs at a time (s). `vertices` are the undeformed positions of the mesh's nodes, m.
    pub fn anchors<'a>(&'a self, vertices: &'a [Vector3<f64>], time: f64) -> impl Iterator<Item = Anchor> + 'a {
        let pulled = self.pull.iter().flat_map(move |pull| {
            let displacement = move |node: usize, place: Vector3<f64>| place + pull.offset - vertices[node];
            pull.anchors.iter().map(move |&(node, place)| Anchor { node, displacement: displacement(node, place) })
        });
        let dragged = self.drag.iter().filter(|_| self.pull.is_none());
        pulled.chain(dragged.map(move |drag| Anchor { node: drag.node, displacement: drag.displacement(time) }))
    }
}
