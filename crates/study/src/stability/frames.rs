//! The same body elsewhere, larger, smaller, renumbered, or moving as a whole: the answer must be the same.

use nalgebra::Vector3;

use super::case::{Case, Clock, Finding, Outcome};
use super::march::march;
use super::scene_text::{CLAMPED, DYNAMIC, LUMPED, Text, gravity, moved_box};
use super::start::{Random, place_moving};
use fem_engine::simulator::Simulator;
use fem_mesh::TetrahedralMesh;

const FAMILY: &str = "frames of reference";

/// Methods and steps that answer alike in every frame; the step is below all limits.
const METHODS: [(&str, f64, usize); 5] = [
    ("implicit_euler", 0.02, 20),
    ("linearly_implicit_euler", 0.005, 40),
    ("verlet", 0.002, 100),
    ("rk4", 0.002, 100),
    ("static", 1.0, 1),
];

/// Largest distance between two answers, in lengths of the body.
const SAME: f64 = 1e-8;

const MARGIN_IS: &str = "largest difference / 1e-8 lengths of the body, round-off; must be at most 1";

/// Adds the chapter.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let methods = if quick { &METHODS[..1] } else { &METHODS };
    for &(integrator, dt, steps) in methods {
        for model in ["neo_hookean", "stable_neo_hookean"] {
            let text = Text { dt, ..Text::finer(integrator, model) }.with(CLAMPED);
            let text = text.with("[newton]\ntolerance = 1e-12\n");
            cases.push(shifted(text.clone(), steps));
            for scale in [1e-6, 1e6] {
                cases.push(scaled(text.clone(), scale, steps));
            }
            for seed in 0..if quick { 1 } else { 5 } {
                cases.push(renumbered(text.clone(), seed, steps));
            }
        }
    }
    for integrator in DYNAMIC {
        for mass in ["", LUMPED] {
            cases.push(rigid(integrator, mass, if quick { 100 } else { 1000 }));
        }
    }
}

fn case(name: String, parameters: String, text: &Text, seed: Option<u64>, work: Work) -> Case {
    Case {
        family: FAMILY,
        case: name,
        parameters,
        integrator: text.integrator.to_owned(),
        material: text.model.to_owned(),
        expected: Outcome::Survives,
        margin_is: MARGIN_IS,
        seed,
        work,
    }
}

type Work = Box<dyn FnOnce(Clock) -> Finding + Send>;

/// Weight across the body at rest.
const WEIGHT: [f64; 3] = [1.0, 0.0, -4.0];

fn unmoved() -> Result<TetrahedralMesh, Finding> {
    moved_box([2.0, 1.0, 1.0], 2, |x| *x)
}

/// Displacements in the mesh's order, in lengths of the body.
fn answer(text: &Text, mesh: TetrahedralMesh, steps: usize, clock: Clock) -> Result<Vec<Vector3<f64>>, Finding> {
    let mut simulation = text.build_on(mesh)?;
    match march(&mut simulation, steps, clock).trouble() {
        Some(trouble) => Err(trouble),
        None => Ok(relative(&simulation)),
    }
}

fn relative(simulation: &Simulator<f64>) -> Vec<Vector3<f64>> {
    let (system, u) = (simulation.system(), &simulation.state().u);
    system.numbering.to_mesh(u).into_iter().map(|u| Vector3::from(u) / system.length).collect()
}

/// Whether two answers are the same.
fn compared(a: Result<Vec<Vector3<f64>>, Finding>, b: Result<Vec<Vector3<f64>>, Finding>) -> Finding {
    match (a, b) {
        (Ok(a), Ok(b)) => {
            let largest = a.iter().zip(&b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            let size = a.iter().map(Vector3::norm).fold(0.0, f64::max);
            Finding::within(largest / SAME, format!("differ by {largest:.1e}, of {size:.2e} moved"))
        }
        (Err(finding), _) | (_, Err(finding)) => finding,
    }
}

fn shifted(text: Text, steps: usize) -> Case {
    let text = text.with(&gravity(WEIGHT));
    let parameters = "moved by (1e6, -1e6, 1e6) m and a third".to_owned();
    case(
        "far from the origin".to_owned(),
        parameters,
        &text.clone(),
        None,
        Box::new(move |clock| {
            let away = Vector3::new(1e6, -1e6, 1e6).add_scalar(1.0 / 3.0);
            let far = moved_box([2.0, 1.0, 1.0], 2, |x| x + away);
            // The side at the clamp is 1e-9 m thick at the origin, and rounded there.
            let far_text = Text { rest: text.rest.replace("1e-9", "1e-6"), ..text.clone() };
            let near = unmoved().and_then(|mesh| answer(&text, mesh, steps, clock));
            compared(near, far.and_then(|mesh| answer(&far_text, mesh, steps, clock)))
        }),
    )
}

/// With the weight that bends it alike, and the step in which sound passes as many elements.
fn scaled(text: Text, scale: f64, steps: usize) -> Case {
    let name = format!("{scale:e} times as large");
    case(
        name,
        format!("dt and 1/g {scale:e} times as large"),
        &text.clone(),
        None,
        Box::new(move |clock| {
            let unit = text.clone().with(&gravity(WEIGHT));
            let other =
                Text { dt: text.dt * scale, rest: text.rest.replace("1e-9", &format!("{:e}", 1e-9 * scale)), ..text };
            let other = other.with(&gravity(WEIGHT.map(|g| g / scale)));
            let mesh = moved_box([2.0, 1.0, 1.0], 2, |x| x * scale);
            let near = unmoved().and_then(|mesh| answer(&unit, mesh, steps, clock));
            compared(near, mesh.and_then(|mesh| answer(&other, mesh, steps, clock)))
        }),
    )
}

/// Nodes and elements in another order, and each element's corners turned.
fn renumbered(text: Text, seed: u64, steps: usize) -> Case {
    let text = text.with(&gravity(WEIGHT));
    let name = "nodes, elements and corners renumbered".to_owned();
    case(
        name,
        "random orders".to_owned(),
        &text.clone(),
        Some(seed),
        Box::new(move |clock| {
            let both = || {
                let mesh = unmoved()?;
                let plain = answer(&text, mesh.clone(), steps, clock)?;
                let (other, number) = shuffled(&mesh, seed);
                let found = answer(&text, other, steps, clock)?;
                Ok((plain, number.into_iter().map(|node| found[node]).collect()))
            };
            match both() {
                Ok((plain, found)) => compared(Ok(plain), Ok(found)),
                Err(finding) => finding,
            }
        }),
    )
}

/// The mesh in another order, and the new number of each node.
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
    (TetrahedralMesh { vertices, elements: order.iter().enumerate().map(turned).collect() }, number)
}

/// A free body thrown with a spin: nothing acts on it, so its momentum stays.
fn rigid(integrator: &'static str, mass: &'static str, steps: usize) -> Case {
    let text = Text { dt: 1e-3, ..Text::small(integrator, "neo_hookean") }.with(mass);
    let name = if mass.is_empty() { "consistent" } else { "lumped" };
    Case {
        margin_is: "change of momentum / 1e-12 of itself, round-off; must be at most 1",
        ..case(
            "thrown with a spin".to_owned(),
            format!("{name} mass, dt = 1e-3 s, {steps} steps"),
            &text.clone(),
            None,
            Box::new(move |clock| {
                let mut simulation = match text.build() {
                    Ok(simulation) => simulation,
                    Err(finding) => return finding,
                };
                let (spin, speed) = (Vector3::new(0.3, -0.2, 0.5), Vector3::new(3.0, 2.0, -1.0));
                place_moving(&mut simulation, |X| (*X, speed + spin.cross(&(X - Vector3::new(1.0, 0.5, 0.5)))));
                let before = momentum(&simulation);
                let end = march(&mut simulation, steps, clock);
                let change = (momentum(&simulation) - before).norm() / (1e-12 * before.norm());
                end.trouble().unwrap_or_else(|| Finding::within(change, end.note()))
            }),
        )
    }
}

/// Σ M v, kg m/s.
fn momentum(simulation: &Simulator<f64>) -> Vector3<f64> {
    let (masses, v) = (simulation.system().mass.lumped(), &simulation.state().v);
    masses.iter().zip(v).map(|(mass, v)| *mass * Vector3::from(*v)).sum()
}
