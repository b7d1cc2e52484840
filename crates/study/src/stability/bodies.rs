//! Bodies that are hardly one, and what holds them.

use nalgebra::Vector3;

use super::case::{Case, Finding, Outcome};
use super::march::{SMALLEST_J, march};
use super::scene_text::{CLAMPED, DYNAMIC, Text, gravity, moved_box};
use fem_mesh::TetrahedralMesh;

const FAMILY: &str = "bodies";

/// Below every limit of these bodies, s.
const DT: f64 = 1e-3;

/// Adds the chapter.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let integrators: Vec<&str> = DYNAMIC.into_iter().chain(["static"]).collect();
    let steps = if quick { 20 } else { 200 };
    for (name, tables, mesh) in BODIES {
        for &integrator in &integrators {
            cases.push(body(name, tables, mesh, integrator, steps));
        }
    }
}

type Mesh = fn() -> Result<TetrahedralMesh, Finding>;

const BODIES: [(&str, &str, Mesh); 6] = [
    ("a single tetrahedron, free", "", single),
    ("a single tetrahedron, three corners held", "[fixed]\nnodes = [0, 1, 2]\n", single),
    ("two parts that nothing joins", CLAMPED, parts),
    ("two boxes with the same vertices on a face, not joined", CLAMPED, doubled),
    ("every node held", "[fixed]\nplane = { axis = \"x\", below = 9 }\n", plain),
    ("no node held", "", plain),
];

fn single() -> Result<TetrahedralMesh, Finding> {
    let vertices = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    Ok(TetrahedralMesh { vertices, elements: vec![[0, 1, 2, 3]] })
}

fn plain() -> Result<TetrahedralMesh, Finding> {
    moved_box([2.0, 1.0, 1.0], 1, |x| *x)
}

/// Beside each other, both with a side at x = 0.
fn parts() -> Result<TetrahedralMesh, Finding> {
    Ok(together(plain()?, moved_box([2.0, 1.0, 1.0], 1, |x| x + 3.0 * Vector3::y())?))
}

/// One behind the other: the second hangs on nothing, and its vertices lie where the first one ends.
fn doubled() -> Result<TetrahedralMesh, Finding> {
    Ok(together(plain()?, moved_box([2.0, 1.0, 1.0], 1, |x| x + 2.0 * Vector3::x())?))
}

fn together(mut one: TetrahedralMesh, other: TetrahedralMesh) -> TetrahedralMesh {
    let first = one.vertices.len();
    one.vertices.extend(other.vertices);
    one.elements.extend(other.elements.iter().map(|element| element.map(|node| node + first)));
    one
}

fn body(name: &str, tables: &'static str, mesh: Mesh, integrator: &'static str, steps: usize) -> Case {
    let text = Text { dt: DT, ..Text::small(integrator, "neo_hookean") }.with(tables).with(&gravity([0.0, 0.0, -9.81]));
    let is_static = integrator == "static";
    // Equilibrium is not defined for what can fall for ever.
    let falls = name.ends_with("free") || name.starts_with("no node") || name.starts_with("two boxes");
    let steps = if is_static { 1 } else { steps };
    Case {
        family: FAMILY,
        case: name.to_owned(),
        parameters: format!("E = 1e5 Pa, dt = {DT:e} s, falling, {steps} steps"),
        integrator: integrator.to_owned(),
        material: text.model.to_owned(),
        expected: if is_static && falls { Outcome::Refused } else { Outcome::Survives },
        margin_is: SMALLEST_J,
        seed: None,
        work: Box::new(move |clock| match mesh().and_then(|mesh| text.build_on(mesh)) {
            Ok(mut simulation) => march(&mut simulation, steps, clock).survival(),
            Err(finding) => finding,
        }),
    }
}
