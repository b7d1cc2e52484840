//! Elements with an aspect ratio of a million.

use fem_mesh::TetrahedralMesh;
use fem_model::Integrator;
use nalgebra::Vector3;

use super::*;

const FAMILY: &str = "slivers";

/// Edge over thickness.
const ASPECT: f64 = 1e6;

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let methods =
        [Integrator::ImplicitEuler, Integrator::LinearlyImplicitEuler, Integrator::Static, Integrator::Verlet];
    for ((thin, law), integrator) in pairs(pairs([Thin::Sheet, Thin::Needle], NEO_HOOKEAN), methods) {
        cases.push(sliver(thin, Setup::small(integrator, law), if quick { 10 } else { 100 }));
    }
}

/// A mesh with thin elements.
#[derive(Clone, Copy, Debug)]
pub enum Thin {
    /// A layer of flat elements between two blocks.
    Sheet,
    /// Two crossing layers, with elements that are thin in two directions.
    Needle,
}

/// Maps 0, 1, 2, 3 to 0, 1, 1 + thickness, 2 + thickness.
fn thinned(x: f64) -> f64 {
    if x > 1.5 { x - 1.0 + 1.0 / ASPECT } else { x }
}

fn mesh(thin: Thin) -> Result<TetrahedralMesh, Finding> {
    match thin {
        Thin::Sheet => moved_box([3.0, 1.0, 1.0], 1, |x| Vector3::new(thinned(x.x), x.y, x.z)),
        Thin::Needle => moved_box([3.0, 3.0, 1.0], 1, |x| Vector3::new(thinned(x.x), thinned(x.y), x.z)),
    }
}

/// A clamped body with such a mesh under its weight.
pub fn sliver(thin: Thin, setup: Setup, steps: usize) -> Case {
    let integrator = setup.integrator;
    let setup = setup.with(clamp).with(gravity([0.0, 0.0, -2.0]));
    let steps = if integrator == Integrator::Static { 1 } else { steps };
    let step = if integrator == Integrator::Verlet { "half of the largest stable step" } else { "0.01 s" };
    let name = match thin {
        Thin::Sheet => "a layer of flat elements",
        Thin::Needle => "crossing layers with needles",
    };
    let parameters = format!("aspect ratio {ASPECT:e}, dt = {step}, {steps} steps");
    setup.case(FAMILY, name, parameters, move |setup, deadline| {
        let mut setup = setup.clone();
        if setup.integrator == Integrator::Verlet {
            setup.dt = 1.0 / excite(&mut setup.build_on(mesh(thin)?)?, 0.0)?.omega;
        }
        Ok(march(&mut setup.build_on::<f64>(mesh(thin)?)?, steps, deadline).survival())
    })
}
