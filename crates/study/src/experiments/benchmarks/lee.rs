//! Lee's frame: S.-L. Lee, F. S. Manuel and E. C. Rossow, Large Deflections and Stability of Elastic Frames (1968). A column and a beam with a rigid corner
//! and hinged ends snap through under a force on the beam.

use std::path::Path;
use std::time::Instant;

use fem_engine::simulator::Simulator;
use fem_model::simulation::Diagnostics;
use fem_model::{Body, Elastic, Integrator, Law, Material, Method, PlaneState, Selector};

use super::case::{Level, Mapped, Quantity, part};
use crate::scenes::{displacement, step};
use crate::study::{Part, Result};

/// Length of column and beam, m.
const LENGTH: f64 = 120.0;
/// Width of the section, m; the mesh has a thickness of 1 m.
const WIDTH: f64 = 3.0;
/// The force at the end of the path, N.
const FORCE: f64 = 2.0;
const STEPS: usize = 400;

/// The limit loads and the drops of the loaded point there.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let quantity = |name, reference| Quantity {
        name,
        reference,
        tolerance: 1e-2,
        source: "extensible Euler–Bernoulli beam; with shear the loads are 1.8544 and −0.9395",
    };
    let of = [
        quantity("largest load (N)", 1.8556),
        quantity("drop there (m)", 48.53),
        quantity("least load (N)", -0.9418),
        quantity("drop there (m) ", 58.37),
    ];
    let text = "A column from (0, 0) to (0, 120) m and a beam to (120, 120) m, 3 m wide and 2 m deep, with hinged ends, a dead force down on the beam 24 m from the \
                corner, E = 720 Pa, ν = 0.3. Corotated law, plane stress, one quadratic cell across, the path by arc length. \
                The corner of the solid is a block: a beam with shear whose legs are rigid over half a metre there has limit loads of 1.8602 and −0.9331 N.";
    part(("lee", text), &of, (&[60, 90, 120], 1), quick, solve)
}

/// Cells along column and beam.
fn solve(cells: usize) -> Result<Level> {
    let mapped = Mapped::square([cells, 1], |s, t| {
        // From the line of the inner sides to that of the outer ones, which meet in a mitre.
        let (out, along) = (2.0 * t - 1.0, 2.0 * s);
        if along < 1.0 { [-out, along * (LENGTH + out)] } else { [-out + (along - 1.0) * (LENGTH + out), LENGTH + out] }
    })?;
    let (nodes, loaded) = (mapped.places.len(), mapped.node_at([0.6, 0.5, 0.0]));
    let hinges = [0.0, 1.0].map(|end| mapped.node_at([end, 0.5, 0.0])).to_vec();
    let material =
        Material { plane: PlaneState::Stress, ..Material::new(Law::Corotated(Elastic::new(720.0, 0.3)), 1.0) };
    let body = Body::new(mapped.mesh, material)
        .and_then(|body| body.fix(&Selector::Nodes(hinges)))
        .and_then(|body| body.force(&Selector::Nodes(vec![loaded]), [0.0, -FORCE / WIDTH, 0.0]));
    let method = Method { load_steps: 20, arc_length: true, ..Method::new(Integrator::Static, 1.0) };
    let mut simulation = body.and_then(|body| Simulator::<f64>::new(body, &method))?;
    let start = Instant::now();
    let mut path = vec![[0.0; 2]];
    while simulation.load_factor() != Some(1.0) && path.len() < STEPS {
        step(&mut simulation)?;
        let factor = simulation.load_factor().unwrap_or(f64::NAN);
        path.push([-displacement(&simulation, loaded).y, FORCE * factor]);
    }
    let turns =
        |sign: f64| path.windows(3).find(|at| sign * at[1][1] > sign * at[0][1] && sign * at[1][1] >= sign * at[2][1]);
    let (most, least) = turns(1.0)
        .zip(turns(-1.0))
        .ok_or_else(|| format!("{cells} cells: the path has no two limit points up to {:?}", path.last()))?;
    let values = [most, least].map(|at| {
        let [drop, load] = vertex(at);
        [load, drop]
    });
    Ok(Level { nodes, values: values.concat(), seconds: start.elapsed().as_secs_f64() })
}

/// The vertex of the parabola through three points.
fn vertex(at: &[[f64; 2]]) -> [f64; 2] {
    let [[x0, y0], [x1, y1], [x2, y2]] = [at[0], at[1], at[2]];
    let [first, second] = [(y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1)];
    let curvature = (second - first) / (x2 - x0);
    let x = 0.5 * (x0 + x1) - 0.5 * first / curvature;
    [x, y0 + (x - x0) * (first + curvature * (x - x1))]
}
