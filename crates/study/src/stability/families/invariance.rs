//! Invariance under translation, scaling, renumbering and rigid motion.

use fem_engine::simulator::Simulator;
use fem_mesh::TetrahedralMesh;
use fem_model::Integrator;
use nalgebra::Vector3;

use super::*;
use fem_reference::{Elements, LINEAR};

const FAMILY: &str = "invariance";

/// Integrators with time steps below all limits, s, and numbers of steps.
const METHODS: [(Integrator, f64, usize); 9] = [
    (Integrator::ImplicitEuler, 0.02, 20),
    (Integrator::ImplicitMidpoint, 0.02, 20),
    (Integrator::Newmark, 0.02, 20),
    (Integrator::GeneralizedAlpha, 0.02, 20),
    (Integrator::Bdf2, 0.02, 20),
    (Integrator::LinearlyImplicitEuler, 0.005, 40),
    (Integrator::Verlet, 0.002, 100),
    (Integrator::Rk4, 0.002, 100),
    (Integrator::Static, 1.0, 1),
];

/// Largest difference of two displacements, relative to the body's length.
const SAME: f64 = 1e-8;

const MARGIN_IS: &str = "largest difference / 1e-8 of the length, round-off; must be at most 1";

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let methods = if quick { &METHODS[..1] } else { &METHODS };
    for (&(integrator, dt, steps), law) in pairs(methods, NEO_HOOKEAN) {
        let setup = Setup { dt, ..Setup::finer(integrator, law) }.newton(1e-12);
        cases.push(shifted(setup.clone(), steps));
        cases.extend([1e-6, 1e6].map(|scale| scaled(setup.clone(), scale, steps)));
        cases.extend((0..if quick { 1 } else { 5 }).map(|seed| renumbered(setup.clone(), seed, steps)));
    }
    for (integrator, is_lumped) in pairs(dynamic(), [false, true]) {
        cases.push(rigid(integrator, LINEAR, is_lumped, if quick { 100 } else { 1000 }));
    }
}

/// Acceleration of gravity at rest, m/s².
const WEIGHT: [f64; 3] = [1.0, 0.0, -4.0];

fn unmoved() -> Result<TetrahedralMesh, Finding> {
    moved_box([2.0, 1.0, 1.0], 2, |x| *x)
}

/// Displacements in the mesh's numbering, relative to the body's length.
fn answer(
    setup: &Setup,
    mesh: TetrahedralMesh,
    steps: usize,
    deadline: Deadline,
) -> Result<Vec<Vector3<f64>>, Finding> {
    let mut simulation = setup.build_on::<f64>(mesh)?;
    march(&mut simulation, steps, deadline).survived()?;
    let (system, u) = (simulation.system(), &simulation.state().u);
    Ok(system.numbering.to_mesh(u).into_iter().map(|u| Vector3::from(u) / system.length).collect())
}

fn compared(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> Finding {
    let largest = a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    let size = a.iter().map(Vector3::norm).fold(0.0, f64::max);
    Finding::within(largest / SAME, format!("difference {largest:.1e}, displacement {size:.2e}"))
}

fn shifted(setup: Setup, steps: usize) -> Case {
    let setup = setup.with(gravity(WEIGHT));
    let parameters = "translated by (1e6, -1e6, 1e6) m and a third".to_owned();
    let case = setup.case(FAMILY, "far from the origin", parameters, move |setup, deadline| {
        let away = Vector3::new(1e6, -1e6, 1e6).add_scalar(1.0 / 3.0);
        let far = moved_box([2.0, 1.0, 1.0], 2, |x| x + away)?;
        // The tolerance of the clamp is 1e-9 m at the origin, which is round-off far away.
        let near = answer(&setup.clone().with(clamp), unmoved()?, steps, deadline)?;
        Ok(compared(&near, &answer(&setup.clone().with(clamp_within(1e-6)), far, steps, deadline)?))
    });
    Case { margin_is: MARGIN_IS, ..case }
}

/// The weight is scaled so that the body bends alike, and the time step so that waves pass as many elements.
fn scaled(setup: Setup, scale: f64, steps: usize) -> Case {
    let parameters = format!("dt and 1/g scaled by {scale:e}");
    let case = setup.case(FAMILY, format!("scaled by {scale:e}"), parameters, move |setup, deadline| {
        let unit = setup.clone().with(clamp).with(gravity(WEIGHT));
        let other = Setup { dt: setup.dt * scale, ..setup.clone() }.with(clamp_within(1e-9 * scale));
        let other = other.with(gravity(WEIGHT.map(|g| g / scale)));
        let near = answer(&unit, unmoved()?, steps, deadline)?;
        Ok(compared(&near, &answer(&other, moved_box([2.0, 1.0, 1.0], 2, |x| x * scale)?, steps, deadline)?))
    });
    Case { margin_is: MARGIN_IS, ..case }
}

/// Nodes and elements in random order, with rotated corners of elements.
fn renumbered(setup: Setup, seed: u64, steps: usize) -> Case {
    let setup = setup.with(clamp).with(gravity(WEIGHT));
    let name = "nodes, elements and corners renumbered";
    let case = setup.case(FAMILY, name, "random permutations".to_owned(), move |setup, deadline| {
        let mesh = unmoved()?;
        let (other, number) = shuffled(&mesh, seed);
        let plain = answer(setup, mesh, steps, deadline)?;
        let found = answer(setup, other, steps, deadline)?;
        Ok(compared(&plain, &number.into_iter().map(|node| found[node]).collect::<Vec<_>>()))
    });
    Case { margin_is: MARGIN_IS, seed: Some(seed), ..case }
}

/// The mesh in random order, and the new number of each node.
fn shuffled(mesh: &TetrahedralMesh, seed: u64) -> (TetrahedralMesh, Vec<usize>) {
    let mut random = Random::new(seed);
    let number = random.permutation(mesh.vertices.len());
    let mut vertices = mesh.vertices.clone();
    for (vertex, &new) in mesh.vertices.iter().zip(&number) {
        vertices[new] = *vertex;
    }
    let order = random.permutation(mesh.elements.len());
    let turned = |(i, &element): (usize, &usize)| {
        let [a, b, c, d] = mesh.elements[element].map(|node| number[node]);
        // Even permutations keep the volume positive.
        [[a, b, c, d], [b, c, a, d], [c, a, b, d], [b, a, d, c]][i % 4]
    };
    (TetrahedralMesh::new(vertices, order.iter().enumerate().map(turned).collect()), number)
}

/// A free box in rigid motion.
pub fn rigid(integrator: Integrator, elements: Elements, is_lumped: bool, steps: usize) -> Case {
    let setup = Setup { dt: 1e-3, elements, ..Setup::small(integrator, "neo_hookean") }.with_if(is_lumped, lump);
    let name = if is_lumped { "lumped" } else { "consistent" };
    let parameters = format!("{name} mass, dt = 1e-3 s, {steps} steps");
    in_rigid_motion(setup, FAMILY, parameters, steps)
}

/// A free body in rigid motion without loads, which conserves its momentum; a flat one stays in its plane too.
pub fn in_rigid_motion(setup: Setup, family: &'static str, parameters: String, steps: usize) -> Case {
    let case = setup.case(family, "translating and rotating", parameters, move |setup, deadline| {
        let mut simulation = setup.build()?;
        let is_flat = simulation.system().shape.mesh.dimension() == 2;
        let (spin, speed, middle) = match is_flat {
            true => (Vector3::new(0.0, 0.0, 0.5), Vector3::new(3.0, 2.0, 0.0), Vector3::new(1.0, 0.5, 0.0)),
            false => (Vector3::new(0.3, -0.2, 0.5), Vector3::new(3.0, 2.0, -1.0), Vector3::new(1.0, 0.5, 0.5)),
        };
        place_moving(&mut simulation, |X| (*X, speed + spin.cross(&(X - middle))));
        let before = momentum(&simulation);
        let end = march(&mut simulation, steps, deadline);
        let change = (momentum(&simulation) - before).norm() / (1e-12 * before.norm());
        let has_left = is_flat && simulation.state().u.iter().any(|u| u[2] != 0.0);
        let change = if has_left { f64::INFINITY } else { change };
        end.survived()?;
        Ok(Finding::within(change, end.note()))
    });
    Case { margin_is: "relative change of momentum / 1e-12, round-off; must be at most 1", ..case }
}

/// Σ M v, kg m/s.
pub fn momentum(simulation: &Simulator<f64>) -> Vector3<f64> {
    let (masses, v) = (simulation.system().mass.row_sums(), &simulation.state().v);
    masses.iter().zip(v).map(|(mass, v)| *mass * Vector3::from(*v)).sum()
}
