//! Errors in space without a scene: the manufactured solution, and volumetric locking.

use super::Settings;
use crate::runs::convergence_order::{ConvergenceOrder, asymptotic};
use crate::runs::plan;
use crate::runs::row::{Configuration, Errors, Row, Times};
use crate::runs::states::{Snapshot, write_reference, write_state};
use crate::space::locking::{self, TipDeflection};
use crate::space::manufactured;
use crate::space::norms;
use fem_engine::cantilever::moduli;
use fem_scene::BodyMesh;

/// The results.
#[derive(Clone, Debug, Default)]
pub struct SpaceStudy {
    /// A row for each material and mesh of the manufactured solution.
    pub rows: Vec<Row>,
    /// Scene, and orders in L2 and H1, of each material.
    pub orders: Vec<(String, Option<ConvergenceOrder>, Option<ConvergenceOrder>)>,
    /// Tip deflections of the cantilever.
    pub tip_deflections: Vec<TipDeflection>,
}

/// Number of meshes of a fitted order: coarser ones are outside the asymptotic range.
const FINEST: usize = 2;

/// Solves on a sequence of meshes.
pub fn study(settings: &Settings) -> Result<SpaceStudy, String> {
    let mut space = SpaceStudy::default();
    let cells: &[usize] = if settings.is_quick { &[4, 8, 16] } else { &[2, 4, 8, 16, 32] };
    for model in ["linear", "neo_hookean"] {
        let from = space.rows.len();
        for (number, &cells) in cells.iter().enumerate() {
            (settings.tell)(number, cells_count(settings), &format!("manufactured solution, {cells} cells"));
            let row = solved(settings, model, cells, space.rows.len())?;
            space.rows.push(row);
        }
        let rows = &space.rows[from..];
        let order = |error: fn(&Errors) -> Option<f64>| {
            let pairs: Vec<_> = rows.iter().filter_map(|row| Some((spacing(row), error(&row.errors)?))).collect();
            asymptotic(&pairs, FINEST, 0.0)
        };
        let orders = (rows[0].config.scene.clone(), order(|errors| errors.space_l2), order(|errors| errors.space_h1));
        space.orders.push(orders);
    }
    let meshes: &[usize] = if settings.is_quick { &[1, 2] } else { &[1, 2, 4, 6, 8] };
    for &cells in meshes {
        (settings.tell)(cells, 8, &format!("locking, {cells} cells per metre"));
        for poisson in locking::RATIOS {
            space.tip_deflections.push(locking::bend(poisson, cells)?);
        }
    }
    Ok(space)
}

fn cells_count(settings: &Settings) -> usize {
    if settings.is_quick { 3 } else { 5 }
}

/// Edge of a cell of the unit cube, m.
pub fn spacing(row: &Row) -> f64 {
    1.0 / ((row.config.nodes as f64).cbrt().round() - 1.0)
}

fn solved(settings: &Settings, model: &str, cells: usize, number: usize) -> Result<Row, String> {
    let solved = manufactured::solve(model, cells)?;
    let scene = &solved.scene;
    let id = format!("manufactured-{:03}", number + 1);
    let (state, reference_state) = (format!("states/{id}.json"), format!("states/manufactured-{cells}-reference.json"));
    let qdot = nalgebra::DVector::zeros(solved.q.len());
    let snapshot = Snapshot { time: 1.0, q: &solved.q, qdot: &qdot, energies: (0.0, f64::NAN) };
    write_state(&settings.out.join(&state), &snapshot)?;
    let mesh = BodyMesh::from(solved.mesh);
    write_reference(&settings.out.join(&reference_state), &mesh, scene.material.density, None)?;
    let moduli = moduli(&scene.material);
    let seconds = Some(solved.seconds);
    Ok(Row {
        config: Configuration {
            id,
            scene: scene.name.clone(),
            group: "space".to_owned(),
            method: format!("static, {cells} cells"),
            pipeline: "engine",
            mesh_hash: norms::mesh_hash(&mesh),
            nodes: mesh.vertices().len(),
            elements: mesh.elements(),
            young: moduli.map(|moduli| moduli.0),
            poisson: moduli.map(|moduli| moduli.1),
            integrator: "static",
            projection: "when_needed",
            solver: plan::solver_name(scene).replace("automatic", "cholesky"),
            dt: 1.0,
            steps: 1,
            tolerance: Some(1e-13),
            max_iterations: Some(50),
            precision: "f64",
        },
        times: Times {
            step_ms: [seconds.map(|s| 1e3 * s); 3],
            total_s: [seconds; 3],
            repetitions: 1,
            ..Times::default()
        },
        errors: Errors { space_l2: Some(solved.l2), space_h1: Some(solved.h1), ..Errors::default() },
        counters: solved.counters,
        status: "done".to_owned(),
        state,
        reference_state,
        ..Row::default()
    })
}
