//! Matrices that a device assembles beside those of the processor, and runs with them.

use std::sync::Arc;

use fem_engine::simulator::Simulator;
use fem_engine::sparse::Block;
use fem_gpu::{BlockPattern, ConjugateGradients, Device, Matrix, Number, Stiffness};
use fem_model::simulation::Simulation;
use fem_scene::parse;
use rand::{RngExt, SeedableRng};

use crate::forces::{device_laws, tetrahedra};
use crate::on_device;

/// A box with fixed nodes, and nodes that slide along a face.
const SCENE: &str = r#"pipeline = "engine"
[mesh]
box = { size = [2, 1, 1], cells_per_unit = 2 }
[material]
model = "MODEL"
young = 1e5
poisson = 0.35
density = 1000
[fixed]
plane = { axis = "x", below = 1e-9 }
[[prescribed]]
on = { axis = "x", side = "max", within = 1e-9 }
displacement = [0, 0, 0]
components = ["x", "z"]
[time]
dt = 0.01
integrator = "implicit_euler"
[solver]
kind = "cg"
"#;

/// Factors of two stiffness matrices and of the mass (1/s²), and a scale.
const FACTORS: [f64; 2] = [1.0, 0.3];
const MASS: f64 = 2e4;
const SCALE: f64 = 1.0 / 131_072.0;

fn blocks(values: &[Block<f64, 3>]) -> impl Iterator<Item = f64> {
    values.iter().flatten().flatten().copied()
}

/// Largest difference of an entry of f K(u) + g K(v) + m M + D from that on the processor, as a part of the largest, for two random
/// deformations u and v, and a random matrix D.
fn error<N: Number>(device: &Arc<Device>, law: usize, amplitude: f64) -> f64 {
    let (name, law, moduli) = device_laws()[law];
    let scene = parse(&SCENE.replace("MODEL", name), "box.toml".as_ref()).unwrap();
    let body = fem_scene::body(&scene, "no data".as_ref()).unwrap();
    let elements = body.shape.mesh.elements();
    let mut arrays = tetrahedra(&body);
    let simulator = Simulator::<f64>::new(body, &scene.method()).unwrap();
    let system = simulator.system();
    let (pattern, nodes) = (&system.pattern, system.nodes());
    for corner in arrays.corners.iter_mut().flatten() {
        *corner = system.numbering.engine_node[*corner as usize];
    }

    let mut random = rand::rngs::ChaCha8Rng::seed_from_u64(11);
    let mut displacements = || -> Vec<[f64; 3]> {
        (0..nodes).map(|_| [0, 1, 2].map(|_| f64::from((amplitude * random.random_range(-1.0..1.0)) as f32))).collect()
    };
    let [u, v] = [displacements(), displacements()];
    let mut others = vec![[[0.0; 3]; 3]; pattern.blocks()];
    others.iter_mut().flatten().flatten().for_each(|entry| *entry = 1e4 * random.random_range(-1.0..1.0));
    let mut free = vec![[1.0; 3]; nodes];
    system.dirichlet.eliminate(pattern, &mut others);
    system.dirichlet.clear_constrained(&mut free);

    let mut expected = others.clone();
    system.elements.add_stiffness(FACTORS[0], &u, &mut expected);
    system.elements.add_stiffness(FACTORS[1], &v, &mut expected);
    system.mass.add_to(MASS, pattern, &mut expected);
    system.dirichlet.eliminate(pattern, &mut expected);

    let starts = (0..pattern.rows()).map(|row| pattern.row(row).start as u32);
    let of_device =
        BlockPattern { starts: starts.chain([pattern.blocks() as u32]).collect(), columns: pattern.columns.clone() };
    let mut masses = vec![[[0.0; 3]; 3]; pattern.blocks()];
    system.mass.add_to(1.0, pattern, &mut masses);
    let masses: Vec<f64> = masses.iter().map(|block| block[0][0]).collect();
    let mut solver = ConjugateGradients::<N>::new(device, &of_device, None).unwrap();
    let moduli = vec![moduli; elements];
    let assembly = Stiffness::new(&solver, &of_device, nodes, &arrays, law, &moduli, &masses).unwrap();
    let others: Vec<_> = others.into_iter().enumerate().collect();
    let sum = Matrix {
        stiffness: &[(FACTORS[0], u), (FACTORS[1], v)],
        mass: MASS,
        others: &others,
        free: &free,
        scale: SCALE,
    };
    // Twice, and first with few other blocks: nothing of an earlier matrix remains.
    assembly.assemble(&mut solver, &Matrix { others: &others[..2], mass: 1.0, ..sum }).unwrap();
    assembly.assemble(&mut solver, &sum).unwrap();
    let found = solver.matrix().unwrap();

    let largest = blocks(&expected).fold(0.0, |most: f64, x| most.max(x.abs()));
    let worst = blocks(&expected).zip(blocks(&found)).map(|(a, b)| (a - b / SCALE).abs()).fold(0.0, f64::max) / largest;
    println!("{name}, {amplitude} m, {}: {worst:.1e}", N::WGSL);
    worst
}

#[test]
fn matrices_of_every_law_are_those_of_the_processor() {
    let device = match Device::open() {
        Ok(device) => device,
        Err(error) => return println!("skipped: {error}"),
    };
    for law in 0..device_laws().len() {
        for amplitude in [0.05, 1e-4] {
            assert!(error::<f32>(&device, law, amplitude) < 1e-6);
            if device.has_double_precision() {
                assert!(error::<f64>(&device, law, amplitude) < 1e-14);
            } else {
                println!("skipped: no double precision");
            }
        }
    }
}

const GPU: &str = "solver={kind=\"gpu\"}";

/// The plan's remark on the matrix of a scene on the device. Prints one line and returns `None` without a device.
fn place_of_assembly(scene: &str, keys: &[&str]) -> Option<String> {
    let simulation = on_device(scene, &[keys, &[GPU]].concat())?;
    simulation.parts().iter().find(|part| part.name == "stiffness").map(|part| part.why.to_string())
}

#[test]
fn explain_tells_where_the_matrix_is_assembled() {
    let Some(place) = place_of_assembly("beam", &[]) else { return };
    assert!(place.ends_with("the graphics device assembles it"), "{place}");
    for (key, reason) in [
        (
            "material={model=\"hencky\",young=1e5,poisson=0.3,density=1e3}",
            "the processor assembles it: the device does not know hencky",
        ),
        ("material={model=\"linear\",young=1e5,poisson=0.3,density=1e3}", "a linear body has one matrix"),
        ("time.integrator=\"linearly_implicit_euler\"", "this method solves once, to the last digit"),
        ("newton.projection=\"always\"", "newton.projection is \"always\""),
    ] {
        let place = place_of_assembly("beam", &[key]).unwrap();
        assert!(place.ends_with(reason), "{key}: {place}");
    }
}

#[test]
fn a_run_on_the_device_goes_on_bit_for_bit() {
    let build = || on_device("arma-engine", &[GPU]);
    let Some(mut whole) = build() else { return };
    let steps = |simulation: &mut Box<dyn Simulation>, count: usize| {
        (0..count).for_each(|_| simulation.step().unwrap_or_else(|failure| panic!("{failure}")));
    };
    steps(&mut whole, 4);
    let middle = whole.checkpoint();
    steps(&mut whole, 6);
    let mut resumed = build().unwrap();
    resumed.restore(&middle).unwrap();
    steps(&mut resumed, 6);
    assert_eq!(resumed.positions(), whole.positions());
}

/// Springs, a pull, damping of both kinds, nodes that slide and a pressure beside the elements, which the device assembles alone.
#[test]
fn a_body_with_other_forces_ends_where_it_ends_on_the_processor() {
    let keys = [
        "mesh.box.cells_per_unit=3",
        "damping={alpha=0.5,beta=2e-3}",
        "springs=[{nodes=[0,40],stiffness=2e3}]",
        "prescribed=[{on={axis=\"x\",side=\"max\",within=1e-9},components=[\"y\"],velocity=[0,0.3,0]}]",
    ];
    crate::compare("beam", &keys, 5, "f32", 1e-10);
    crate::compare("beam", &keys, 5, "f64", 1e-10);
}
