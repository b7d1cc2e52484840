//! Setting up a scene by hand: nodes are constrained by a brush, faces loaded by a drag.

pub mod brush;
pub mod facets;
pub mod loads;
pub mod marks;
#[cfg(test)]
mod tests;

use std::cell::OnceCell;
use std::collections::BTreeSet;

use fem_model::simulation::Shape;
use kiss3d::glamx::{Vec2, Vec3};

use crate::editing::change::Change;
use crate::editing::editor::SceneSetup;
use crate::picture::camera::Camera;
use crate::picture::geometry::{Bounds, first_hit, single};
use crate::setup::facets::Facets;
use brush::Brush;
use loads::Loads;

/// Use of the left mouse button on the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// It drags the body.
    #[default]
    Pull,
    /// It paints constrained nodes.
    Fix,
    /// It picks faces, and sets a traction by dragging.
    Load,
}

/// The state of the tools between frames.
#[derive(Default)]
pub struct Setup {
    /// The tool in use.
    pub mode: Mode,
    /// The brush for nodes.
    pub brush: Brush,
    /// The picked faces and their load.
    pub loads: Loads,
    /// The reason why the last use of a tool had no effect.
    pub message: Option<String>,
    body: OnceCell<Body>,
}

/// The parts of a body that the tools need.
pub struct Body {
    /// The faces that can carry loads.
    pub facets: Facets,
    /// The nodes of the surface, in ascending order; all nodes of a flat body.
    pub nodes: BTreeSet<usize>,
    triangles: Vec<[usize; 3]>,
    /// Half of the undeformed body's diagonal, m.
    pub radius: f32,
}

impl Body {
    fn of(shape: &Shape) -> Self {
        let points: Vec<Vec3> = shape.mesh.vertices().iter().map(single).collect();
        Body {
            facets: Facets::of(shape),
            nodes: shape.boundary.iter().flatten().copied().collect(),
            triangles: shape.boundary.clone(),
            radius: Bounds::of(&points).radius(),
        }
    }

    /// The point of the surface under the mouse, m. `positions` are those of the nodes now.
    fn hit(&self, (origin, ray): (Vec3, Vec3), positions: &[Vec3]) -> Option<Vec3> {
        first_hit(origin, ray, positions, &self.triangles).map(|(_, distance)| origin + ray * distance)
    }
}

/// The mouse on the picture of a body.
pub struct Pointer<'a> {
    /// Physical pixels from the upper left.
    pub cursor: Vec2,
    /// The control key is down: it swaps painting and erasing, and adds to a selection.
    pub control: bool,
    /// The camera.
    pub camera: &'a Camera,
    /// Positions of the nodes now, m.
    pub positions: &'a [Vec3],
    /// The undeformed body.
    pub shape: &'a Shape,
    /// The scene, and the nodes and faces that it names.
    pub scene: &'a SceneSetup,
}

impl Setup {
    /// The parts of the body.
    pub fn body(&self, shape: &Shape) -> &Body {
        self.body.get_or_init(|| Body::of(shape))
    }

    /// Forgets what belongs to a body that was replaced by another.
    pub fn forget_body(&mut self) {
        self.body = OnceCell::new();
        self.brush.forget();
        self.loads = Loads::default();
        self.message = None;
    }

    /// Chooses a tool.
    pub fn choose(&mut self, mode: Mode) {
        self.mode = mode;
        self.message = None;
        self.brush.forget();
    }

    /// Handles the left button pressed; returns whether the tool takes it.
    pub fn press(&mut self, pointer: &Pointer) -> bool {
        self.message = None;
        let body = self.body.get_or_init(|| Body::of(pointer.shape));
        match self.mode {
            Mode::Pull => false,
            Mode::Fix => self.brush.press(body, pointer),
            Mode::Load => self.loads.press(body, pointer),
        }
    }

    /// Handles a motion of the mouse, and returns the change of the scene that it makes.
    pub fn moved(&mut self, pointer: &Pointer) -> Option<Change> {
        let body = self.body.get_or_init(|| Body::of(pointer.shape));
        match self.mode {
            Mode::Pull => None,
            Mode::Fix => {
                self.brush.moved(body, pointer);
                None
            }
            Mode::Load => self.loads.moved(pointer).then(|| self.load(pointer.shape, pointer.scene)).flatten(),
        }
    }

    /// Handles the button released, and returns the change of the scene that it makes.
    pub fn release(&mut self, shape: &Shape, scene: Option<&SceneSetup>) -> Option<Change> {
        if self.loads.release() {
            return self.load(shape, scene?);
        }
        let change = self.brush.release(scene?)?;
        self.tell(change)
    }

    /// The change; a message gives the reason if there is none.
    fn tell(&mut self, change: Result<Change, String>) -> Option<Change> {
        change.map_err(|message| self.message = Some(message)).ok()
    }

    /// The change that gives the picked faces their traction; a message gives the reason if there is none.
    pub fn load(&mut self, shape: &Shape, scene: &SceneSetup) -> Option<Change> {
        let body = self.body.get_or_init(|| Body::of(shape));
        let change = self.loads.change(body, scene);
        self.tell(change)
    }

    /// Picks the faces of a load of the scene.
    pub fn choose_load(&mut self, shape: &Shape, scene: &SceneSetup, load: usize) {
        self.loads.choose(self.body.get_or_init(|| Body::of(shape)), scene, load);
    }

    /// Takes over the scene once all changes are done or refused.
    pub fn settle(&mut self, shape: &Shape, scene: &SceneSetup) {
        self.brush.settle(scene);
        if self.loads.is_used() {
            let body = self.body.get_or_init(|| Body::of(shape));
            self.loads.settle(body, scene);
        }
    }
}
