//! Equilibrium paths through limit points.

use fem_engine::forces::{AddBlock, Energy, HessianKind, Moment, Potential};
use fem_engine::numbering::Numbering;
use fem_engine::simulator::Simulator;
use fem_model::simulation::{Diagnostics, Simulation};
use fem_scene::{Scene, parse};
use std::path::Path;

use crate::shipped_scenes::data;
use crate::{distance, run, side, soft, try_build};

/// The load at λ = 1, N.
const LOAD: f64 = 200.0;

/// A force of `LOAD` down on one node, times the load factor.
struct PointLoad {
    node: usize,
}

impl Potential<f64> for PointLoad {
    fn name(&self) -> &'static str {
        "point_load"
    }

    fn description(&self) -> String {
        format!("{LOAD} N on a node")
    }

    fn bytes(&self) -> usize {
        0
    }

    fn energy(&self, u: &[[f64; 3]], moment: Moment) -> Energy {
        Energy::of(moment.load_factor.unwrap_or(1.0) * LOAD * u[self.node][1])
    }

    fn add_gradient(&self, _: &[[f64; 3]], moment: Moment, gradient: &mut [[f64; 3]]) {
        gradient[self.node][1] += moment.load_factor.unwrap_or(1.0) * LOAD;
    }

    fn hessian(&self, _: &[[f64; 3]], _: Moment, _: HessianKind, _: &mut AddBlock<f64>) {}
}

/// The scene `snap` without its traction, with other tables in place of `[static]`.
fn arch(statics: &str) -> Scene {
    let text = std::fs::read_to_string(data().join("scenes/snap.toml")).unwrap();
    let (before, rest) = text.split_once("[[traction]]").unwrap();
    let (_, time) = rest.split_once("[time]").unwrap();
    let (time, _) = time.split_once("[static]").unwrap();
    let text = format!("{before}[time]{time}\n[newton]\ntolerance = 1e-13\n{statics}");
    parse(&text, &data().join("scenes/snap.toml")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The highest node of the crown.
fn crown(scene: &Scene) -> usize {
    let body = fem_scene::body(scene, &data()).unwrap();
    let at = |node: &(usize, &nalgebra::Vector3<f64>)| (node.1.x * 1e3).round() as i64;
    let vertices = body.shape.mesh.vertices();
    let highest = |a: &(usize, &nalgebra::Vector3<f64>), b: &(usize, &nalgebra::Vector3<f64>)| {
        at(a).cmp(&at(b)).then(a.1.y.total_cmp(&b.1.y))
    };
    vertices.iter().enumerate().max_by(highest).unwrap().0
}

fn loaded(scene: &Scene) -> (Simulator<f64>, usize) {
    let (body, crown) = (fem_scene::body(scene, &data()).unwrap(), crown(scene));
    let load = |numbering: &Numbering| -> Vec<Box<dyn Potential<f64>>> {
        vec![Box::new(PointLoad { node: numbering.engine_node[crown] as usize })]
    };
    (Simulator::with_forces(body, &scene.method(), &load).unwrap_or_else(|error| panic!("{error}")), crown)
}

/// Load factor and way of the crown down, m, after each step up to the full load.
fn path(scene: &Scene) -> (Vec<(f64, f64)>, Simulator<f64>) {
    let (mut simulation, crown) = loaded(scene);
    let start = simulation.positions()[3 * crown + 1];
    let mut path = vec![(0.0, 0.0)];
    while path.last().is_none_or(|at| at.0 < 1.0) {
        run(&mut simulation, 1);
        path.push((simulation.load_factor().unwrap(), start - simulation.positions()[3 * crown + 1]));
        assert!(path.len() < 500, "{path:?}");
    }
    (path, simulation)
}

const ARC: &str = "[static]\nload_steps = 10\narc_length = true\n";

#[test]
fn an_arch_snaps_through_along_the_path_that_a_prescribed_displacement_finds() {
    let scene = arch(ARC);
    let (path, _) = path(&scene);
    let factors: Vec<f64> = path.iter().map(|at| at.0).collect();
    let top = (1..factors.len() - 1).find(|&i| factors[i] > factors[i + 1]).expect("a limit point");
    let bottom = (top..factors.len() - 1).find(|&i| factors[i] < factors[i + 1]).expect("a second limit point");
    assert!(factors[top] < 1.0 && factors[bottom] < 0.8 * factors[top], "{factors:?}");
    assert_eq!(factors.last(), Some(&1.0));
    for at in [top / 2, top, (top + bottom) / 2, bottom, path.len() - 1] {
        let (factor, way) = path[at];
        let moved = format!(
            "[[prescribed]]\nnodes = [{}]\ncomponents = [\"y\"]\ndisplacement = [0, {:e}, 0]\n",
            crown(&scene),
            -way
        );
        let scene = arch(&format!("[static]\nload_steps = 12\n{moved}"));
        let body = fem_scene::body(&scene, &data()).unwrap();
        let mut simulation = Simulator::<f64>::new(body, &scene.method()).unwrap();
        run(&mut simulation, 12);
        let reactions = simulation.reactions();
        let reaction = reactions.iter().find(|reaction| reaction.name == "prescribed[1]").unwrap().force[1];
        assert!((reaction + factor * LOAD).abs() < 1e-6 * LOAD, "{at}: {reaction} N at {factor} of {LOAD} N");
    }
}

#[test]
fn reactions_balance_the_load_at_every_point_of_the_path_and_the_full_load_stays() {
    let (mut simulation, _) = loaded(&arch(ARC));
    for _ in 0..120 {
        run(&mut simulation, 1);
        let factor = simulation.load_factor().unwrap();
        let sum: f64 = simulation.reactions().iter().map(|reaction| reaction.force[1]).sum();
        assert!((sum - factor * LOAD).abs() < 1e-8 * LOAD, "{sum} N at {factor}");
    }
    assert_eq!(simulation.load_factor(), Some(1.0));
    let before = simulation.positions();
    run(&mut simulation, 2);
    assert_eq!(simulation.positions(), before);
}

#[test]
fn without_arc_length_the_arch_jumps_to_the_same_equilibrium_at_full_load_or_fails() {
    let (_, along) = path(&arch(ARC));
    let (mut jumping, _) = loaded(&arch("[static]\nload_steps = 10\n"));
    let mut factors = Vec::new();
    for _ in 0..10 {
        match jumping.step() {
            Ok(()) => factors.push(jumping.load_factor().unwrap()),
            Err(_) => return,
        }
    }
    assert!(factors.windows(2).all(|factors| factors[0] < factors[1]), "{factors:?}");
    assert!(distance(&jumping.positions(), &along.positions()) < 1e-8);
}

#[test]
fn a_path_goes_on_bit_for_bit_and_from_its_start_after_a_reset() {
    let (mut whole, _) = loaded(&arch(ARC));
    run(&mut whole, 4);
    let middle = whole.checkpoint();
    run(&mut whole, 6);
    let (mut resumed, _) = loaded(&arch(ARC));
    resumed.restore(&middle).unwrap();
    run(&mut resumed, 6);
    assert_eq!(resumed.positions(), whole.positions());
    assert_eq!(resumed.load_factor(), whole.load_factor());
    whole.reset();
    assert_eq!(whole.load_factor(), Some(0.0));
    run(&mut whole, 10);
    assert_eq!(resumed.positions(), whole.positions());
}

#[test]
fn motions_obstacles_and_solvers_of_positive_definite_matrices_are_refused_with_a_remedy() {
    let clamp = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
    let refused = |tables: &str| match try_build(&soft("static", 1.0, &format!("{clamp}{ARC}{tables}"))) {
        Ok(_) => panic!("{tables} is not refused"),
        Err(error) => error.to_string(),
    };
    assert!(refused(&side("x", "max", 0.1)).contains("prescribed[0] is a motion"));
    let plane = "[[planes]]\npoint = [0, 0, -1]\nnormal = [0, 0, 1]\n";
    assert!(refused(plane).contains("remove [[planes]]"));
    assert!(refused("[solver]\nkind = \"cholesky\"\n").contains("\"lu\""));
    let pressure = "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\npressure = 10\n";
    assert!(refused(pressure).contains("force_per_area"));
}

#[test]
fn the_shipped_arch_reaches_its_full_load_within_its_steps() {
    let scene = fem_scene::load("snap", &data()).unwrap();
    let body = fem_scene::body(&scene, Path::new(&data())).unwrap();
    let mut simulation = fem_engine::simulator::build(body, &scene.method()).unwrap();
    run(&mut *simulation, scene.time.steps.unwrap());
    assert_eq!(simulation.load_factor(), Some(1.0));
}
