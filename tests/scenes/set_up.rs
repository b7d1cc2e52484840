//! Scenes that are set up by hand in the window: the saved file, run headless, gives the numbers of the window, bit by bit.

use std::path::Path;

use fem_model::simulation::{Shape, Simulation};
use fem_model::{Integrator, Preconditioner, SolverKind};
use fem_scene::Scene;
use fem_scene::tables::SolverTable;
use fem_viewer::scene_edits::{self, Force};
use fem_viewer::{Change, Editing, Motion, SceneEditor};
use nalgebra::Vector3;
use serde_json::Value;

use crate::program::Desk;

const STEPS: usize = 25;

const BEAM: &str = r#"pipeline = "engine"
[mesh]
box = { size = [4, 1, 1], cells_per_unit = 3 }
[material]
model = "neo_hookean"
C = 2e5
D = 1e6
density = 1000.0
[gravity]
acceleration = [0, 0, -9.81]
[fixed]
plane = { axis = "x", below = 1e-9 }
[time]
dt = 0.01
integrator = "implicit_euler"
"#;

const STRIP: &str = r#"pipeline = "engine"
[mesh]
rectangle = { size = [2, 1], cells_per_unit = 4 }
[material]
model = "stable_neo_hookean"
young = 1e5
poisson = 0.3
density = 1000.0
[fixed]
plane = { axis = "x", below = 1e-9 }
[time]
dt = 0.005
integrator = "verlet"
"#;

/// The simulation of a scene and its editor, as the window has them.
struct Window {
    editor: SceneEditor,
    simulation: Box<dyn Simulation>,
}

impl Window {
    fn open(text: &str) -> Self {
        let scene = fem_scene::parse(text, "hand.toml".as_ref()).unwrap();
        let build = |scene: &Scene| {
            let body = fem_scene::body(scene, "no data".as_ref()).map_err(|error| error.problem())?;
            fem_engine::simulator::build(body, &scene.method()).map_err(|refusal| scene.refused(refusal).to_string())
        };
        let simulation = build(&scene).unwrap();
        let builder = std::sync::Arc::new(move |scene: &Scene, _: Option<&Shape>| build(scene));
        let editing = Editing { scene, objects: Vec::new(), data: "no data".into(), builder };
        Self { editor: SceneEditor::new(editing, Vector3::z()), simulation }
    }

    fn change(&mut self, change: Change) -> Result<Motion, String> {
        self.editor.apply(&[change], &mut self.simulation)
    }

    /// Adds or removes a table by its button.
    fn click(&mut self, name: &str) -> Motion {
        self.editor.find_conditions(&*self.simulation);
        let setup = self.editor.setup().unwrap();
        let offer = setup.offers.iter().find(|offer| offer.name == name).unwrap();
        self.change(Change::Edit(offer.edit.clone())).unwrap()
    }

    /// The boundary faces of a solid body, or the edges of a flat one, whose nodes all have this largest x.
    fn end(&self, x: f64) -> Vec<Vec<usize>> {
        let shape = self.simulation.shape();
        let is_there = |face: &&Vec<usize>| face.iter().all(|&node| shape.mesh.vertices()[node].x > x - 1e-9);
        shape.faces().iter().filter(is_there).cloned().collect()
    }

    fn load(&mut self, x: f64, force: Force) -> Motion {
        let faces = self.end(x);
        let faces: Vec<&[usize]> = faces.iter().map(|face| &face[..]).collect();
        let number = self.editor.scene().traction.len();
        self.change(Change::Edit(scene_edits::load(self.editor.scene(), number, &faces, force))).unwrap()
    }

    fn step(&mut self, steps: usize) {
        (0..steps).for_each(|_| self.simulation.step().unwrap());
    }

    /// Starts again, runs, and compares the end with that of the saved file.
    fn assert_saved_file_has_the_same_end(mut self) {
        self.simulation.reset();
        self.step(STEPS);
        let desk = Desk::new();
        fem_scene::write_state(&desk.path("window.json"), self.editor.scene(), &*self.simulation).unwrap();
        self.editor.save(&desk.path("saved.toml"), &*self.simulation).unwrap();
        desk.run_well(&format!("saved.toml --headless --steps {STEPS} --state headless.json"));
        let read = |name: &str| serde_json::from_str::<Value>(&desk.read(name)).unwrap();
        let (window, headless) = (read("window.json"), read("headless.json"));
        for key in ["time", "steps", "q", "qdot", "displacements"] {
            assert!(window[key] == headless[key], "{key} of\n{}", desk.read("saved.toml"));
        }
    }
}

fn solver(kind: SolverKind, preconditioner: Option<Preconditioner>) -> Change {
    Change::Edit(scene_edits::of_method(
        "solver",
        Some(&SolverTable { kind, tolerance: Some(1e-10), preconditioner, precision: None }),
    ))
}

#[test]
fn a_scene_that_is_put_together_by_hand_runs_headless_with_the_same_numbers() {
    let mut window = Window::open(BEAM);
    window.step(5);
    let painted: Vec<usize> = (0..260).step_by(13).take(9).collect();
    let fixed = Change::Edit(scene_edits::fixed(window.editor.scene(), &painted));
    assert_eq!(window.change(fixed), Ok(Motion::StartsAgain));
    assert_eq!(window.simulation.time(), 0.0);
    window.step(3);
    assert_eq!(window.load(4.0, Force::Pressure(-2e4)), Motion::GoesOn);
    assert!(window.simulation.time() > 0.0);
    window.change(solver(SolverKind::Pcg, Some(Preconditioner::Ssor))).unwrap();
    let midpoint = scene_edits::integrator(window.editor.scene(), Integrator::ImplicitMidpoint);
    window.change(Change::Edit(midpoint)).unwrap();
    assert_eq!(window.simulation.integrator(), "implicit_midpoint");
    window.simulation.set_parameter("dt", 0.004).unwrap();
    window.simulation.set_parameter("substeps", 2.0).unwrap();
    window.change(Change::Number("density", 1200.0)).unwrap();
    window.assert_saved_file_has_the_same_end();
}

#[test]
fn prescribed_nodes_and_a_load_that_keeps_its_direction_are_saved_too() {
    let mut window = Window::open(BEAM);
    let nodes: Vec<usize> = window.end(4.0).concat();
    let turn = scene_edits::prescribed(0, &nodes, Some((scene_edits::Motion::Velocity, [0.3, 0.0, 0.1])));
    window.change(Change::Edit(turn)).unwrap();
    window.load(4.0, Force::PerArea([1e3, 0.0, 0.0]));
    window
        .change(Change::Edit(scene_edits::prescribed_vector(0, scene_edits::Motion::Velocity, [0.0, 0.2, 0.0])))
        .unwrap();
    window.assert_saved_file_has_the_same_end();
}

#[test]
fn loads_on_the_outline_of_a_flat_body_are_saved_too() {
    let mut window = Window::open(STRIP);
    window.load(2.0, Force::Pressure(300.0));
    assert_eq!(window.editor.scene().traction[0].edges.as_ref().unwrap().len(), 4);
    window.assert_saved_file_has_the_same_end();
}

#[test]
fn a_scene_whose_integrator_was_switched_while_it_ran_is_saved_with_it() {
    for (scene, switches) in [(BEAM, 1), (STRIP, 1), (STRIP, 3), (STRIP, 4)] {
        let mut window = Window::open(scene);
        for _ in 0..switches {
            window.simulation.next_integrator();
        }
        window.assert_saved_file_has_the_same_end();
    }
}

#[test]
fn tables_that_the_panel_adds_take_effect_at_once_and_are_saved_too() {
    let law =
        BEAM.replace("\"neo_hookean\"", "\"corotated\"").replace("C = 2e5\nD = 1e6", "young = 1e6\npoisson = 0.3");
    let mut window = Window::open(&law.replace("[gravity]\nacceleration = [0, 0, -9.81]\n", ""));
    assert!(window.simulation.weight().is_none());
    let motions = [
        ("gravity", Motion::GoesOn),
        ("floor", Motion::StartsAgain),
        ("plastic flow", Motion::StartsAgain),
        ("damping", Motion::GoesOn),
    ];
    for (name, motion) in motions {
        window.step(5);
        assert_eq!(window.click(name), motion, "{name}");
    }
    assert!(window.simulation.weight().unwrap() > 0.0 && window.simulation.plastic_flow().is_some());
    assert_eq!(window.simulation.planes()[0].point, Vector3::new(0.0, 0.0, -0.1));
    assert_eq!(window.editor.scene().damping.as_ref().unwrap().alpha, 0.5);
    window.step(5);
    assert_eq!(window.click("planes"), Motion::StartsAgain);
    assert!(window.simulation.planes().is_empty());
    assert_eq!(window.click("floor"), Motion::StartsAgain);
    window.assert_saved_file_has_the_same_end();
}

#[test]
fn an_unusable_change_is_refused_with_a_remedy_and_leaves_the_run_as_it_is() {
    let text = BEAM.replace("\"implicit_euler\"", "\"static\"");
    let mut window = Window::open(&text);
    let none = Change::Edit(scene_edits::fixed(window.editor.scene(), &[]));
    let message = window.change(none).unwrap_err();
    assert!(message.contains("fixed"), "{message}");
    assert!(window.editor.scene().fixed.is_some());
    window.step(1);

    let mut window = Window::open(BEAM);
    window.load(4.0, Force::Pressure(1.0));
    let xpbd = scene_edits::integrator(window.editor.scene(), Integrator::Xpbd);
    let message = window.change(Change::Edit(xpbd)).unwrap_err();
    assert!(message.contains("pressure that follows the surface"), "{message}");
    assert_eq!(window.simulation.integrator(), "implicit_euler");
    let message = window.change(Change::Number("cells", 4.0)).unwrap_err();
    assert!(message.contains("remove the loads on picked faces first"), "{message}");
    window.change(Change::Number("scale", 2.0)).unwrap();
    assert!(window.editor.save(Path::new("a/b.toml"), &*window.simulation).unwrap_err().contains("folder"));
}
