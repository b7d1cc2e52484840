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

#[cfg(test)]
mod tests {
    use super::*;

    fn dragged() -> Interaction {
        let direction = Vector3::new(0.0, 2.0, 0.0);
        let drag = Drag { node: 1, stiffness: 5.0, direction, amplitude: 0.5, frequency: 0.25 };
        Interaction::new(Some(drag), 0.0)
    }

    const VERTICES: [Vector3<f64>; 2] = [Vector3::new(0.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0)];

    #[test]
    fn the_target_of_a_drag_is_a_sine_of_time() {
        let interaction = dragged();
        let at = |time| interaction.anchors(&VERTICES, time).next().unwrap();
        assert_eq!(at(0.0), Anchor { node: 1, displacement: Vector3::zeros() });
        assert_eq!(at(1.0).displacement, Vector3::new(0.0, 1.0, 0.0));
        assert!((at(3.0).displacement - Vector3::new(0.0, -1.0, 0.0)).norm() < 1e-15);
    }

    #[test]
    fn a_pull_replaces_the_drag_until_it_ends() {
        let mut interaction = dragged();
        let place = Vector3::new(0.0, 0.0, 0.25);
        interaction.set_pull(Some(Pull { anchors: vec![(0, place)], offset: Vector3::x() }));
        let expected = Anchor { node: 0, displacement: Vector3::new(1.0, 0.0, 0.25) };
        assert_eq!(interaction.anchors(&VERTICES, 1.0).collect::<Vec<_>>(), [expected]);
        interaction.set_pull(None);
        assert_eq!(interaction.anchors(&VERTICES, 1.0).next().unwrap().node, 1);
    }
}
