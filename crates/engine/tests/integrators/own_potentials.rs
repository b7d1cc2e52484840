//! Forces of a program's own, through the trait `Potential` and its facets.

use fem_engine::forces::{AddBlock, Barrier, Energy, Follower, HessianKind, Moment, Potential};
use fem_engine::numbering::Numbering;
use fem_engine::simulator::Simulator;
use fem_model::simulation::Simulation;
use nalgebra::Vector3;

use crate::{block, scene, side, soft, symmetry};

/// A force along x on each of some nodes, with an energy of its displacement there, times the node's area.
struct Along {
    /// Energy per area, J/m², and its derivatives, at a displacement, m.
    energy: fn(f64) -> [f64; 3],
    /// Nodes and their areas, m², in the engine's numbering.
    areas: Vec<(usize, f64)>,
    has_barrier: bool,
    follows: bool,
}

impl Potential<f64> for Along {
    fn name(&self) -> &'static str {
        "along"
    }

    fn description(&self) -> String {
        "a force along x".to_owned()
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.areas[..])
    }

    fn energy(&self, u: &[[f64; 3]], _: Moment) -> Energy {
        self.areas.iter().map(|&(node, area)| Energy::of(area * (self.energy)(u[node][0])[0])).sum()
    }

    fn add_gradient(&self, u: &[[f64; 3]], _: Moment, gradient: &mut [[f64; 3]]) {
        self.areas.iter().for_each(|&(node, area)| gradient[node][0] += area * (self.energy)(u[node][0])[1]);
    }

    fn hessian(&self, u: &[[f64; 3]], _: Moment, kind: HessianKind, add: &mut AddBlock<f64>) {
        for &(node, area) in &self.areas {
            let k = area * (self.energy)(u[node][0])[2];
            let k = if kind == HessianKind::Projected { k.max(0.0) } else { k };
            add(node, node, [[k, 0.0, 0.0], [0.0; 3], [0.0; 3]]);
        }
    }

    fn barrier(&self) -> Option<&dyn Barrier<f64>> {
        self.has_barrier.then_some(self)
    }

    fn follower(&self) -> Option<&dyn Follower<f64>> {
        self.follows.then_some(self)
    }
}

impl Barrier<f64> for Along {
    fn scale(&self) -> f64 {
        1.0
    }

    fn largest_step(&self, _: &[[f64; 3]], _: Moment, _: &[[f64; 3]]) -> f64 {
        1.0
    }

    fn make_feasible(&self, _: &[[f64; 3]], _: Moment, _: &mut [[f64; 3]]) -> bool {
        false
    }
}

impl Follower<f64> for Along {
    fn add_follower_gradient(&self, _: &[[f64; 3]], _: Moment, _: &mut [[f64; 3]]) {}

    fn reported_energy(&self, _: &[[f64; 3]], _: Moment) -> f64 {
        0.0
    }
}

/// Springs along x of 1e5 N/m between pairs of nodes: ½ k (u_b − u_a)², coupled from a displacement on.
struct Links {
    pairs: Vec<[usize; 2]>,
    /// m
    from: f64,
}

const LINK: f64 = 1e5;

impl Potential<f64> for Links {
    fn name(&self) -> &'static str {
        "links"
    }

    fn description(&self) -> String {
        "springs along x".to_owned()
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.pairs[..])
    }

    fn energy(&self, u: &[[f64; 3]], _: Moment) -> Energy {
        self.pairs.iter().map(|&[a, b]| Energy::of(0.5 * LINK * (u[b][0] - u[a][0]).powi(2))).sum()
    }

    fn add_gradient(&self, u: &[[f64; 3]], _: Moment, gradient: &mut [[f64; 3]]) {
        for &[a, b] in &self.pairs {
            let force = LINK * (u[b][0] - u[a][0]);
            gradient[a][0] -= force;
            gradient[b][0] += force;
        }
    }

    fn hessian(&self, u: &[[f64; 3]], _: Moment, _: HessianKind, add: &mut AddBlock<f64>) {
        let block = |k: f64| [[k, 0.0, 0.0], [0.0; 3], [0.0; 3]];
        for &[a, b] in self.pairs.iter().filter(|[_, b]| u[*b][0] >= self.from) {
            for (row, column, k) in [(a, a, LINK), (b, b, LINK), (a, b, -LINK), (b, a, -LINK)] {
                add(row, column, block(k));
            }
        }
    }
}

/// Springs of 1e5 Pa/m³ that harden, to places 1 m away: ¼ k (u − 1)⁴.
fn hardening(u: f64) -> [f64; 3] {
    let (k, d) = (1e5, u - 1.0);
    [0.25 * k * d.powi(4), k * d.powi(3), 3.0 * k * d * d]
}

/// Linear springs of 1e5 Pa/m, to places 0.5 m away.
fn linear(u: f64) -> [f64; 3] {
    [0.5e5 * (u - 0.5).powi(2), 1e5 * (u - 0.5), 1e5]
}

/// A wall without thickness at u = 0.2 m, and a load of 2e4 Pa.
fn wall(u: f64) -> [f64; 3] {
    if u < 0.2 { [-2e4 * u, -2e4, 0.0] } else { [f64::INFINITY, 0.0, 0.0] }
}

/// An attraction that grows towards its centre 2 m away: −μ/(2 − u), which is stiffer than the bar near it.
fn attraction(u: f64) -> [f64; 3] {
    let (mu, r) = (2e4, 2.0 - u);
    [-mu / r, -mu / r.powi(2), -2.0 * mu / r.powi(3)]
}

/// A scene whose body has its end at x = 2 m, with a force along x there.
fn with(text: &str, energy: fn(f64) -> [f64; 3], has_barrier: bool, follows: bool) -> Result<Simulator<f64>, String> {
    let scene = scene(text);
    let body = fem_scene::body(&scene, "no data".as_ref()).unwrap();
    let shape = body.shape.clone();
    let own = |numbering: &Numbering| -> Vec<Box<dyn Potential<f64>>> {
        let is_at_end = |face: &&[usize; 3]| face.iter().all(|&node| shape.mesh.vertices()[node].x > 2.0 - 1e-9);
        let of_face =
            |face: &[usize; 3]| face.map(|node| (numbering.engine_node[node] as usize, shape.mesh.area(face) / 3.0));
        let areas = shape.boundary.iter().filter(is_at_end).flat_map(of_face).collect();
        vec![Box::new(Along { energy, areas, has_barrier, follows })]
    };
    Simulator::with_forces(body, &scene.method(), &own).map_err(|error| error.to_string())
}

/// A bar of 2 m with E = 1e5 Pa, so 5e4 Pa/m, in equilibrium with a force along x at its end.
fn bar(model: &str, force: fn(f64) -> [f64; 3], rest: &str) -> Simulator<f64> {
    with(&block(model, &(symmetry() + rest)), force, false, false).unwrap()
}

/// Smallest and largest displacement of the end, m.
fn stretch(simulation: &Simulator<f64>) -> [f64; 2] {
    let (shape, positions) = (simulation.shape(), simulation.positions());
    let ends = shape.mesh.vertices().iter().enumerate().filter(|(_, X)| X.x > 2.0 - 1e-9);
    ends.map(|(node, _)| positions[3 * node] - 2.0).fold([f64::INFINITY, 0.0], |[a, b], u| [a.min(u), b.max(u)])
}

/// The displacement at which the bar and a force are in balance: 5e4 u + V'(u) = 0, by bisection between 0 and 1 m.
fn balance(force: fn(f64) -> [f64; 3]) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if 5e4 * middle + force(middle)[1] < 0.0 { &mut low } else { &mut high }) = middle;
    }
    low
}

#[test]
fn a_linear_bar_with_springs_that_harden_is_in_balance_with_them() {
    // One solve with the stiffness at u = 0 ends at 1/3.5 = 0.286 m.
    let expected = balance(hardening);
    assert!((expected - 0.4102).abs() < 1e-4, "{expected}");
    for force in [hardening, attraction] {
        let mut simulation = bar("linear", force, "");
        simulation.step().unwrap_or_else(|failure| panic!("{failure}"));
        let [low, high] = stretch(&simulation);
        let expected = balance(force);
        assert!((low - expected).abs() < 1e-9 && (high - expected).abs() < 1e-9, "{low} {high} {expected}");
        assert_eq!(simulation.counters().unconverged_steps, 0);
    }
}

#[test]
fn a_linear_bar_with_linear_springs_is_solved_once() {
    let mut simulation = bar("linear", linear, "");
    simulation.step().unwrap();
    let [low, high] = stretch(&simulation);
    assert!((low - 1.0 / 3.0).abs() < 1e-12 && (high - 1.0 / 3.0).abs() < 1e-12, "{low} {high}");
    let counters = simulation.counters();
    assert_eq!((counters.factorizations, counters.newton_iterations, counters.energy_evaluations), (1, 0, 0));
}

#[test]
fn every_load_step_is_in_balance_and_a_resumed_run_is_the_same() {
    let steps = "[static]\nload_steps = 3\n";
    let (mut whole, mut resumed) = (bar("linear", hardening, steps), bar("linear", hardening, steps));
    whole.step().unwrap();
    let checkpoint = whole.checkpoint();
    resumed.restore(&checkpoint).unwrap();
    for _ in 0..2 {
        whole.step().unwrap();
        resumed.step().unwrap();
        assert_eq!(whole.positions(), resumed.positions());
        assert!((stretch(&whole)[0] - balance(hardening)).abs() < 1e-9);
    }
}

#[test]
fn a_linear_bar_does_not_end_where_the_energy_of_a_force_is_infinite() {
    // The solve without the wall ends at 0.4 m, where the wall has neither a force nor a stiffness.
    let mut simulation = bar("linear", wall, "");
    let outcome = simulation.step();
    assert!(outcome.is_err() || simulation.counters().unconverged_steps == 1 || stretch(&simulation)[1] < 0.2);
}

#[test]
fn methods_refuse_facets_that_they_do_not_know() {
    let refusal = |text: &str, has_barrier, follows| with(text, linear, has_barrier, follows).err().unwrap_or_default();
    let path = block("neo_hookean", &(symmetry() + "[static]\nload_steps = 4\narc_length = true\n"));
    assert!(refusal(&path, true, false).contains("obstacles"), "{}", refusal(&path, true, false));
    assert!(refusal(&path, false, true).contains("static.arc_length"), "{}", refusal(&path, false, true));
    let projective = soft("projective_dynamics", 0.01, "");
    let found = refusal(&projective, false, true);
    assert!(found.contains("time.integrator") && found.contains("follower"), "{found}");
    assert_eq!(refusal(&projective, false, false), "");
}

/// A bar whose side x = 0 moves by 0.1 m, with a link from each of its nodes to the opposite one, after a load step.
fn linked(model: &str, from: f64) -> Simulator<f64> {
    let sides = side("x", "min", 0.1) + &side("y", "min", 0.0) + &side("z", "min", 0.0);
    let scene = scene(&block(model, &sides));
    let body = fem_scene::body(&scene, "no data".as_ref()).unwrap();
    let vertices = body.shape.mesh.vertices().to_vec();
    let own = |numbering: &Numbering| -> Vec<Box<dyn Potential<f64>>> {
        let node = |X: Vector3<f64>| vertices.iter().position(|other| (other - X).norm() < 1e-9).unwrap();
        let pair = |X: &Vector3<f64>| [node(*X), node(X + Vector3::new(2.0, 0.0, 0.0))];
        let pairs = vertices.iter().filter(|X| X.x < 1e-9).map(pair);
        let pairs = pairs.map(|pair| pair.map(|node| numbering.engine_node[node] as usize)).collect();
        vec![Box::new(Links { pairs, from })]
    };
    let mut simulation = Simulator::with_forces(body, &scene.method(), &own).unwrap_or_else(|error| panic!("{error}"));
    simulation.step().unwrap_or_else(|failure| panic!("{failure}"));
    simulation
}

#[test]
fn links_to_nodes_that_are_moved_take_part_in_one_linear_solve() {
    let simulation = linked("linear", f64::NEG_INFINITY);
    assert_eq!(simulation.counters().factorizations, 1);
    // The bar moves as a whole. Without the links in the right-hand side, each has a force of up to 1e4 N.
    let (positions, shape) = (simulation.positions(), simulation.shape());
    let moved = shape.mesh.vertices().iter().enumerate().map(|(node, X)| positions[3 * node] - X.x);
    assert!(moved.clone().all(|u| (u - 0.1).abs() < 1e-12), "{:?}", moved.collect::<Vec<_>>());
}

#[test]
#[should_panic(expected = "couples nodes")]
fn a_block_without_a_place_in_the_matrix_is_an_error() {
    // No link is coupled at u = 0.
    let simulation = linked("linear", 0.5);
    let system = simulation.system();
    let (links, _) = system.forces.all().find(|(force, _)| force.name() == "links").unwrap();
    let (u, mut values) = (vec![[1.0; 3]; system.nodes()], vec![[[0.0; 3]; 3]; system.pattern.blocks()]);
    links.add_hessian(1.0, &u, Moment::at(0.0), HessianKind::Exact, &system.pattern, &mut values);
}
