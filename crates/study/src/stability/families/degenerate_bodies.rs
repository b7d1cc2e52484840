//! Bodies of one element, of unconnected parts, and with too many or too few constraints.

use fem_mesh::TetrahedralMesh;
use fem_model::{Integrator, Selector};
use nalgebra::Vector3;

use super::*;

const FAMILY: &str = "degenerate bodies";

/// A time step below the stability limit of all these bodies, s.
const DT: f64 = 1e-3;

/// The step of explicit Euler, which has no limit: so short that its growth is small, s.
const DT_OF_GROWTH: f64 = 1e-4;

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let methods: Vec<_> = dynamic().chain([Integrator::Static]).collect();
    let all = pairs(&BODIES, methods);
    cases.extend(all.map(|(body, integrator)| case(body, integrator, if quick { 20 } else { 200 })));
}

/// A body with too many or too few constraints.
pub struct Body {
    /// Its name in tables.
    pub name: &'static str,
    /// Adds its constraints.
    pub constrained: fn(Setup) -> Setup,
    /// Its mesh.
    pub mesh: fn() -> Result<TetrahedralMesh, Finding>,
    /// Without enough constraints the body has no static equilibrium.
    is_free: bool,
}

/// The bodies.
pub const BODIES: [Body; 6] = [
    Body { name: "a single tetrahedron, free", constrained: free, mesh: single, is_free: true },
    Body {
        name: "a single tetrahedron, three corners fixed",
        constrained: |setup| setup.with(|body, _| body.fix(&Selector::Nodes(vec![0, 1, 2]))),
        mesh: single,
        is_free: false,
    },
    Body { name: "two unconnected parts", constrained: clamped, mesh: parts, is_free: false },
    Body {
        name: "two unconnected boxes with coincident vertices on a face",
        constrained: clamped,
        mesh: coincident,
        is_free: true,
    },
    Body { name: "all nodes fixed", constrained: |setup| setup.with(clamp_within(9.0)), mesh: plain, is_free: false },
    Body { name: "no node fixed", constrained: free, mesh: plain, is_free: true },
];

fn free(setup: Setup) -> Setup {
    setup
}

fn clamped(setup: Setup) -> Setup {
    setup.with(clamp)
}

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
    let setup = Setup { dt, ..Setup::small(integrator, "neo_hookean") };
    let setup = (body.constrained)(setup).with(gravity([0.0, 0.0, -9.81]));
    let is_static = integrator == Integrator::Static;
    let (steps, mesh) = (if is_static { 1 } else { steps }, body.mesh);
    let parameters = format!("E = 1e5 Pa, dt = {dt:e} s, under its weight, {steps} steps");
    Case {
        expected: if is_static && body.is_free { Outcome::Refused } else { Outcome::Survives },
        ..setup.case(FAMILY, body.name, parameters, move |setup, deadline| {
            Ok(march(&mut setup.build_on::<f64>(mesh()?)?, steps, deadline).survival())
        })
    }
}
