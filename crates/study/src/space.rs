//! Errors in space that no scene is needed for: the manufactured solution, and locking.

use super::locking::{self, Bent};
use super::manufactured;
use super::norms;
use super::order::{Order, asymptotic};
use super::plan;
use super::row::{Case, Errors, Row, Times};
use super::scene::Setting;
use super::states::{Snapshot, write_reference, write_state};
use fem_scene::Model;
use fem_scene::cantilever::moduli;

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Space {
    /// A row for each law and mesh of the manufactured solution.
    pub rows: Vec<Row>,
    /// For each law: its scene, and the orders in L2 and H1.
    pub orders: Vec<(String, Option<Order>, Option<Order>)>,
    /// Beams that lock.
    pub bent: Vec<Bent>,
}

/// The finest meshes that an order is taken from: coarser ones are not yet where it holds.
const FINEST: usize = 2;

/// Solves on finer and finer meshes.
pub fn study(setting: &Setting) -> Result<Space, String> {
    let mut space = Space::default();
    let cells: &[usize] = if setting.is_quick { &[4, 8, 16] } else { &[2, 4, 8, 16, 32] };
    for model in [Model::Linear, Model::NeoHookean] {
        let from = space.rows.len();
        for (number, &cells) in cells.iter().enumerate() {
            (setting.tell)(number, cells_count(setting), &format!("manufactured solution, {cells} cells"));
            let row = solved(setting, model, cells, space.rows.len())?;
            space.rows.push(row);
        }
        let rows = &space.rows[from..];
        let order = |error: fn(&Errors) -> Option<f64>| {
            let pairs: Vec<_> = rows.iter().filter_map(|row| Some((spacing(row), error(&row.errors)?))).collect();
            asymptotic(&pairs, FINEST, 0.0)
        };
        let orders = (rows[0].case.scene.clone(), order(|errors| errors.space_l2), order(|errors| errors.space_h1));
        space.orders.push(orders);
    }
    let meshes: &[usize] = if setting.is_quick { &[1, 2] } else { &[1, 2, 4, 6, 8] };
    for &cells in meshes {
        (setting.tell)(cells, 8, &format!("locking, {cells} cells per metre"));
        for poisson in locking::RATIOS {
            space.bent.push(locking::bend(poisson, cells)?);
        }
    }
    Ok(space)
}

fn cells_count(setting: &Setting) -> usize {
    if setting.is_quick { 3 } else { 5 }
}

/// Edge of a cell of the unit cube, m.
pub fn spacing(row: &Row) -> f64 {
    1.0 / ((row.case.nodes as f64).cbrt().round() - 1.0)
}

fn solved(setting: &Setting, model: Model, cells: usize, number: usize) -> Result<Row, String> {
    let solved = manufactured::solve(model, cells)?;
    let scene = &solved.scene;
    let id = format!("manufactured-{:03}", number + 1);
    let (state, reference_state) = (format!("states/{id}.json"), format!("states/manufactured-{cells}-reference.json"));
    let qdot = nalgebra::DVector::zeros(solved.q.len());
    let snapshot = Snapshot { time: 1.0, q: &solved.q, qdot: &qdot, energies: (0.0, f64::NAN) };
    write_state(&setting.out.join(&state), &snapshot)?;
    write_reference(&setting.out.join(&reference_state), &solved.mesh, scene.material.density, None)?;
    let moduli = moduli(&scene.material);
    let seconds = Some(solved.seconds);
    Ok(Row {
        case: Case {
            id,
            scene: scene.name.clone(),
            group: "space".to_owned(),
            method: format!("static, {cells} cells"),
            pipeline: "engine",
            mesh_hash: norms::mesh_hash(&solved.mesh),
            nodes: solved.mesh.vertices.len(),
            elements: solved.mesh.elements.len(),
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
