//! The brush that paints constrained nodes.

use std::collections::BTreeSet;

use kiss3d::glamx::Vec3;

use super::{Body, Pointer};
use crate::editing::change::Change;
use crate::editing::editor::SceneSetup;
use crate::editing::edits::{self, Motion};

/// Radius of a new brush, in radii of the body.
const RADIUS: f32 = 0.08;

/// The Dirichlet condition whose nodes are painted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Target {
    /// `[fixed]`
    #[default]
    Fixed,
    /// A `[[prescribed]]`, by its number; that after the last is a new one.
    Prescribed(usize),
}

/// The brush and its stroke. It paints the nodes of the surface in a ball about the point under the mouse, on the body as it is now.
#[derive(Default)]
pub struct Brush {
    /// Radius of the ball, m; `None` before the first use.
    pub radius: Option<f32>,
    /// The brush erases; the control key reverses this.
    pub erases: bool,
    /// The condition that it paints.
    pub target: Target,
    /// The motion of a new `[[prescribed]]`, m or m/s.
    pub new: Option<(Motion, [f64; 3])>,
    stroke: Option<Stroke>,
    hover: Option<Vec3>,
}

/// The nodes of a condition while they are painted, and until the scene has them.
struct Stroke {
    nodes: BTreeSet<usize>,
    erases: bool,
    is_down: bool,
    /// A node was under the brush.
    touches: bool,
}

impl Brush {
    /// The radius on a body, m.
    pub fn radius_on(&self, body: &Body) -> f32 {
        self.radius.unwrap_or(RADIUS * body.radius)
    }

    /// The nodes of the condition that is painted.
    pub fn nodes(&self, scene: &SceneSetup) -> Vec<usize> {
        match (&self.stroke, self.target) {
            (Some(stroke), _) => stroke.nodes.iter().copied().collect(),
            (None, Target::Fixed) => scene.conditions.fixed().to_vec(),
            (None, Target::Prescribed(number)) => scene.conditions.prescribed(number).to_vec(),
        }
    }

    /// The point of the surface under the mouse, m.
    pub fn hover(&self) -> Option<Vec3> {
        self.hover
    }

    /// Ends a stroke without effect.
    pub fn forget(&mut self) {
        (self.stroke, self.hover) = (None, None);
    }

    /// Begins a stroke if the mouse is on the body.
    pub(super) fn press(&mut self, body: &Body, pointer: &Pointer) -> bool {
        if body.hit(pointer.camera.ray(pointer.cursor), pointer.positions).is_none() {
            return false;
        }
        let nodes = self.nodes(pointer.scene).into_iter().collect();
        let erases = self.erases != pointer.control;
        self.stroke = Some(Stroke { nodes, erases, is_down: true, touches: false });
        self.moved(body, pointer);
        true
    }

    /// Paints under the mouse during a stroke.
    pub(super) fn moved(&mut self, body: &Body, pointer: &Pointer) {
        self.hover = body.hit(pointer.camera.ray(pointer.cursor), pointer.positions);
        let radius = self.radius_on(body);
        let (Some(stroke), Some(centre)) = (&mut self.stroke, self.hover) else { return };
        if !stroke.is_down {
            return;
        }
        for &node in body.nodes.iter().filter(|node| pointer.positions[**node].distance(centre) <= radius) {
            stroke.touches = true;
            if stroke.erases {
                stroke.nodes.remove(&node)
            } else {
                stroke.nodes.insert(node)
            };
        }
    }

    /// Ends a stroke: the change of the scene, or the reason why there is none; `None` if no stroke was begun.
    pub(super) fn release(&mut self, scene: &SceneSetup) -> Option<Result<Change, String>> {
        let stroke = self.stroke.as_mut().filter(|stroke| stroke.is_down)?;
        stroke.is_down = false;
        let nodes: Vec<usize> = stroke.nodes.iter().copied().collect();
        let (touches, erases) = (stroke.touches, stroke.erases);
        let stroke = self.stroke.take();
        if !touches {
            return Some(Err("the brush has touched no node; enlarge it, or go over a node of the surface".to_owned()));
        }
        if nodes == self.nodes(scene) {
            let text = if erases { "the erased nodes were not painted" } else { "these nodes are painted already" };
            return Some(Err(text.to_owned()));
        }
        self.stroke = stroke; // shown until the scene has its nodes
        let edit = match self.target {
            Target::Fixed => edits::fixed(&scene.scene, &nodes),
            Target::Prescribed(number) => {
                let is_new = number >= scene.scene.prescribed.len();
                edits::prescribed(number, &nodes, self.new.filter(|_| is_new))
            }
        };
        Some(Ok(Change::Edit(edit)))
    }

    /// Takes over the nodes of the scene once all changes are done.
    pub(super) fn settle(&mut self, scene: &SceneSetup) {
        self.stroke.take_if(|stroke| !stroke.is_down);
        let count = scene.scene.prescribed.len();
        match self.target {
            Target::Prescribed(number) if number < count => self.new = None,
            Target::Prescribed(number) if number > count || self.new.is_none() => self.target = Target::Fixed,
            _ => {}
        }
    }
}
