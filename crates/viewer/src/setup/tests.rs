//! Tests of the brush and of loads by dragging, without a window.

use fem_model::BodyMesh;
use fem_scene::{Conditions, Scene};
use kiss3d::camera::Camera3d;
use kiss3d::glamx::Vec2;
use nalgebra::Vector3;

use super::brush::Target;
use super::*;
use crate::editing::edits::Motion;
use crate::picture::camera::View;

const BEAM: &str = r#"
pipeline = "engine"
[mesh]
box = { size = [4, 1, 1], cells_per_unit = 2 }
[material]
model = "neo_hookean"
young = 1e5
poisson = 0.3
density = 1000
[time]
dt = 0.01
integrator = "implicit_euler"
"#;

/// A body at rest before a camera, with the tools.
struct Desk {
    shape: Shape,
    positions: Vec<Vec3>,
    camera: Camera,
    scene: SceneSetup,
    setup: Setup,
}

impl Desk {
    fn new(mode: Mode) -> Self {
        let mesh: BodyMesh = fem_mesh::box_mesh([4.0, 1.0, 1.0], 2, fem_mesh::Pattern::Alternating).unwrap().into();
        let shape = Shape { boundary: mesh.surface(), mesh, display: None, picture: None };
        let positions: Vec<Vec3> = shape.mesh.vertices().iter().map(single).collect();
        let size = Vec2::new(1000.0, 800.0);
        let mut camera = Camera::framing(View::Orbit, &Bounds::of(&positions), Vec3::Z, size, 0.0);
        camera.orbit(Vec2::new(-120.0, 0.0)); // so that the end x = 4 is seen
        let scene = fem_scene::parse(BEAM, "beam.toml".as_ref()).unwrap();
        let mut setup = Setup::default();
        setup.choose(mode);
        let scene = SceneSetup { conditions: Conditions::of(&scene, &shape).unwrap(), scene, offers: Vec::new() };
        Desk { shape, positions, camera, scene, setup }
    }

    /// The pixel in which the picture shows a point.
    fn pixel(&self, point: [f32; 3]) -> Vec2 {
        let clip = self.camera.transformation() * Vec3::from(point).extend(1.0);
        Vec2::new(500.0 * (1.0 + clip.x / clip.w), 400.0 * (1.0 - clip.y / clip.w))
    }

    fn with_pointer<R>(&mut self, cursor: Vec2, control: bool, act: impl FnOnce(&mut Setup, &Pointer) -> R) -> R {
        let Desk { shape, positions, camera, scene, setup } = self;
        act(setup, &Pointer { cursor, control, camera, positions, shape, scene })
    }

    fn press(&mut self, point: [f32; 3], control: bool) -> bool {
        let cursor = self.pixel(point);
        self.with_pointer(cursor, control, |setup, pointer| setup.press(pointer))
    }

    fn move_to(&mut self, point: [f32; 3]) -> Option<Change> {
        let cursor = self.pixel(point);
        self.with_pointer(cursor, false, |setup, pointer| setup.moved(pointer))
    }

    fn release(&mut self) -> Option<Change> {
        self.setup.release(&self.shape, Some(&self.scene))
    }

    /// Makes a change, as the simulation's thread does.
    fn apply(&mut self, change: Option<Change>) -> Scene {
        let Some(Change::Edit(edit)) = change else { panic!("no edit: {:?}", self.setup.message) };
        let scene = self.scene.scene.changed(&edit.overrides).unwrap();
        let conditions = Conditions::of(&scene, &self.shape).unwrap();
        self.scene = SceneSetup { conditions, scene: scene.clone(), offers: Vec::new() };
        self.setup.settle(&self.shape, &self.scene);
        scene
    }
}

const END: [f32; 3] = [4.0, 0.4, 0.6];

#[test]
fn a_stroke_constrains_the_nodes_under_the_brush_and_control_erases_them() {
    let mut desk = Desk::new(Mode::Fix);
    desk.setup.brush.radius = Some(0.3);
    assert!(desk.press([4.0, 0.5, 0.5], false));
    desk.move_to([4.0, 0.5, 0.95]);
    let change = desk.release();
    let painted = desk.apply(change).fixed.unwrap().nodes.unwrap();
    let mut places: Vec<Vector3<f64>> = painted.iter().map(|&node| desk.shape.mesh.vertices()[node]).collect();
    places.sort_by(|a, b| a.z.total_cmp(&b.z));
    assert_eq!(places, [Vector3::new(4.0, 0.5, 0.5), Vector3::new(4.0, 0.5, 1.0)]);
    desk.press([4.0, 0.5, 0.95], true);
    let change = desk.release();
    assert_eq!(desk.apply(change).fixed.unwrap().nodes.unwrap().len(), 1);
}

#[test]
fn a_stroke_without_effect_tells_why() {
    let mut desk = Desk::new(Mode::Fix);
    desk.setup.brush.radius = Some(0.01);
    assert!(desk.press(END, false));
    assert_eq!(desk.release(), None);
    assert!(desk.setup.message.as_ref().unwrap().contains("touched no node"), "{:?}", desk.setup.message);
    desk.setup.brush.radius = Some(0.5);
    desk.press(END, true);
    assert_eq!(desk.release(), None);
    assert!(desk.setup.message.as_ref().unwrap().contains("not painted"));
    assert!(!desk.press([4.0, 0.5, 3.0], false), "beside the body the camera moves");
}

#[test]
fn a_new_motion_is_made_by_its_first_stroke() {
    let mut desk = Desk::new(Mode::Fix);
    desk.setup.brush.target = Target::Prescribed(0);
    desk.setup.brush.new = Some((Motion::Velocity, [0.1, 0.0, 0.0]));
    desk.press([4.0, 0.5, 0.5], false);
    let change = desk.release();
    let scene = desk.apply(change);
    assert_eq!((scene.prescribed.len(), scene.prescribed[0].velocity), (1, Some([0.1, 0.0, 0.0])));
    assert_eq!((desk.setup.brush.target, desk.setup.brush.new), (Target::Prescribed(0), None));
}

#[test]
fn a_drag_on_the_end_of_a_beam_pulls_it_as_far_as_the_mouse_would_stretch_a_bar() {
    let mut desk = Desk::new(Mode::Load);
    desk.setup.loads.follows = false;
    assert!(desk.press(END, false));
    assert_eq!(desk.setup.loads.faces.len(), 8, "the whole end");
    assert_eq!(desk.release(), None, "a click alone loads nothing");
    desk.press(END, false);
    let change = desk.move_to([4.5, 0.4, 0.6]);
    let force = desk.apply(change).traction[0].force_per_area.unwrap();
    assert!(force[0] > 1e3 && force[0] < 2e4 && force[1..] == [0.0, 0.0], "{force:?}");
    let change = desk.move_to([3.5, 0.4, 0.6]);
    let scene = desk.apply(change);
    assert!(scene.traction.len() == 1 && scene.traction[0].force_per_area.unwrap()[0] < 0.0, "pushed");
}

#[test]
fn faces_are_added_and_removed_and_a_load_is_picked_again_by_a_click_on_it() {
    let mut desk = Desk::new(Mode::Load);
    desk.press(END, false);
    desk.release();
    desk.setup.loads.traction = 500.0;
    let change = desk.setup.load(&desk.shape, &desk.scene);
    assert_eq!(desk.apply(change).traction[0].pressure, Some(-500.0), "a pull is a negative pressure");
    desk.press([2.1, 0.4, 1.0], true);
    let change = desk.release();
    assert_eq!(desk.apply(change).traction[0].faces.as_ref().unwrap().len(), 8 + 32, "the top too");
    desk.press([2.1, 0.4, 1.0], true);
    let change = desk.release();
    assert_eq!(desk.apply(change).traction[0].faces.as_ref().unwrap().len(), 8);
    desk.press([2.1, 0.4, 1.0], false);
    desk.release();
    assert_eq!((desk.setup.loads.current, desk.setup.loads.traction), (None, 0.0), "other faces");
    desk.press(END, false);
    desk.release();
    assert_eq!((desk.setup.loads.current, desk.setup.loads.traction), (Some(0), 500.0));
    let change = desk.setup.loads.remove();
    assert!(desk.apply(change).traction.is_empty());
}

#[test]
fn a_load_without_faces_or_without_a_direction_tells_why_there_is_none() {
    let mut desk = Desk::new(Mode::Load);
    assert_eq!(desk.setup.load(&desk.shape, &desk.scene), None);
    assert!(desk.setup.message.as_ref().unwrap().contains("no face is picked"));
    desk.setup.loads.angle = 180.0;
    desk.press(END, false);
    desk.release();
    desk.setup.loads.follows = false;
    let all = desk.setup.body(&desk.shape).facets.nodes.len();
    desk.setup.loads.faces = (0..all).collect();
    assert_eq!(desk.setup.load(&desk.shape, &desk.scene), None);
    assert!(desk.setup.message.as_ref().unwrap().contains("no common normal"));
}
