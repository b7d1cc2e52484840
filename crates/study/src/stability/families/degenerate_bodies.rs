//! Bodies of one element, of unconnected parts, and with too many or too few constraints.

use fem_mesh::TetrahedralMesh;
use fem_model::Integrator;
use nalgebra::Vector3;

use crate::stability::case::{Case, Finding, Outcome};
use crate::stability::march::march;
use crate::stability::scene_text::{CLAMPED, SceneText, dynamic, gravity, moved_box};

const FAMILY: &str = "degenerate bodies";

/// A time step below the stability limit of all these bodies, s.
const DT: f64 = 1e-3;

/// The step of explicit Euler, which has no limit: so short that its growth is small, s.
const DT_OF_GROWTH: f64 = 1e-4;

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let steps = if quick { 20 } else { 200 };
    for body in &BODIES {
        for integrator in dynamic().chain([Integrator::Static]) {
            cases.push(case(body, integrator, steps));
        }
    }
}

/// A body with too many or too few constraints.
pub struct Body {
    /// Its name in tables.
    pub name: &'static str,
    /// Tables of its scene.
    pub tables: &'static str,
    /// Its mesh.
    pub mesh: fn() -> Result<TetrahedralMesh, Finding>,
    /// Without enough constraints the body has no static equilibrium.
    is_free: bool,
}

/// The bodies.
pub const BODIES: [Body; 6] = [
    Body { name: "a single tetrahedron, free", tables: "", mesh: single, is_free: true },
    Body {
        name: "a single tetrahedron, three corners fixed",
        tables: "[fixed]\nnodes = [0, 1, 2]\n",
        mesh: single,
        is_free: false,
    },
    Body { name: "two unconnected parts", tables: CLAMPED, mesh: parts, is_free: false },
    Body {
        name: "two unconnected boxes with coincident vertices on a face",
        tables: CLAMPED,
        mesh: coincident,
        is_free: true,
    },
    Body {
        name: "all nodes fixed",
        tables: "[fixed]\nplane = { axis = \"x\", below = 9 }\n",
        mesh: plain,
        is_free: false,
    },
    Body { name: "no node fixed", tables: "", mesh: plain, is_free: true },
];

fn single() -> Result<TetrahedralMesh, Finding> {
    let vertices = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    Ok(TetrahedralMesh::new(vertices, vec![[0, 1, 2, 3]]))
}

fn plain() -> Result<TetrahedralMesh, Finding> {
    moved_box([2.0, 1.0, 1.0], 1, |x| *x)
}

/// Side by side, both with a face at x = 0.
fn parts() -> Result<TetrahedralMesh, Finding> {
    Ok(together(plain()?, moved_box([2.0, 1.0, 1.0], 1, |x| x + 3.0 * Vector3::y())?))
}

/// One behind the other: only the first has a clamp.
fn coincident() -> Result<TetrahedralMesh, Finding> {
    Ok(together(plain()?, moved_box([2.0, 1.0, 1.0], 1, |x| x + 2.0 * Vector3::x())?))
}

fn together(mut one: TetrahedralMesh, other: TetrahedralMesh) -> TetrahedralMesh {
    let first = one.vertices.len();
    one.vertices.extend(other.vertices);
    one.elements.extend(other.elements.iter().map(|element| element.map(|node| node + first)));
    one
}

fn case(body: &Body, integrator: Integrator, steps: usize) -> Case {
    let dt = if integrator == Integrator::ExplicitEuler { DT_OF_GROWTH } else { DT };
    let text = SceneText { dt, ..SceneText::small(integrator, "neo_hookean") };
    let text = text.with(body.tables).with(&gravity([0.0, 0.0, -9.81]));
    let is_static = integrator == Integrator::Static;
    let (steps, mesh) = (if is_static { 1 } else { steps }, body.mesh);
    let parameters = format!("E = 1e5 Pa, dt = {dt:e} s, under its weight, {steps} steps");
    Case {
        expected: if is_static && body.is_free { Outcome::Refused } else { Outcome::Survives },
        ..text.clone().case(FAMILY, body.name, parameters, move |deadline| {
            Ok(march(&mut text.build_on(mesh()?)?, steps, deadline).survival())
        })
    }
}
