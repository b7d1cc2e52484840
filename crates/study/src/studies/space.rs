//! Errors in space without a scene: the manufactured solution, and volumetric locking.

use super::Settings;
use crate::runs::convergence_order::{ConvergenceOrder, asymptotic};
use crate::runs::row::{Configuration, Errors, Row, Times};
use crate::runs::states::{Snapshot, write_reference, write_state};
use crate::study::Result;
use fem_engine::cantilever::moduli;
use fem_model::Integrator;
use fem_model::element::Element;
use fem_reference::space::locking::{self, TipDeflection};
use fem_reference::space::manufactured;
use fem_reference::space::norms;
use fem_reference::{LINEAR, WITHOUT_LOCKING};
use serde::{Deserialize, Serialize};

/// The results.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct SpaceStudy {
    /// A row for each material and mesh of the manufactured solution.
    pub rows: Vec<Row>,
    /// Orders of each material and kind of elements.
    pub orders: Vec<SpaceOrders>,
    /// Tip deflections of the cantilever.
    pub tip_deflections: Vec<TipDeflection>,
}

/// Orders in space of a material with one kind of elements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceOrders {
    /// Name of the scene.
    pub scene: String,
    /// The elements, by their name.
    #[serde(with = "by_name")]
    pub element: &'static Element,
    /// Observed orders in L2 and H1.
    pub observed: [Option<ConvergenceOrder>; 2],
}

/// Elements are stored by their names.
mod by_name {
    use fem_model::element::Element;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    pub fn serialize<S: Serializer>(element: &Element, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(element.name)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static Element, D::Error> {
        let name = String::deserialize(deserializer)?;
        Element::ALL.into_iter().find(|element| element.name == name).ok_or_else(|| D::Error::custom("no such element"))
    }
}

/// Number of meshes of a fitted order: coarser ones are outside the asymptotic range.
const FINEST: usize = 2;

/// Solves on a sequence of meshes.
pub fn study(settings: &Settings) -> Result<SpaceStudy> {
    super::make_folders(&settings.out)?;
    let mut space = SpaceStudy::default();
    for element in Element::ALL {
        for model in ["linear", "neo_hookean"] {
            let orders = sequence(settings, model, element, &mut space.rows)?;
            space.orders.push(orders);
        }
    }
    let meshes: &[usize] = if settings.is_quick { &[1, 2] } else { &[1, 2, 4, 6, 8] };
    for &cells in meshes {
        (settings.tell)(cells, 8, &format!("locking, {cells} cells per metre"));
        for poisson in locking::RATIOS {
            space.tip_deflections.push(locking::bend(LINEAR, poisson, cells)?);
        }
    }
    let cells = if settings.is_quick { 1 } else { 2 };
    for elements in WITHOUT_LOCKING {
        (settings.tell)(cells, 8, &format!("locking, {elements}"));
        for poisson in locking::ratios(elements) {
            space.tip_deflections.push(locking::bend(elements, poisson, cells)?);
        }
    }
    Ok(space)
}

/// Solves on a sequence of meshes and adds their rows.
fn sequence(settings: &Settings, model: &str, element: &'static Element, rows: &mut Vec<Row>) -> Result<SpaceOrders> {
    let cells: &[usize] = match (element.dimension, element.order, settings.is_quick) {
        // 17³ and 33³ nodes already.
        (3, 2, true) => &[2, 4, 8],
        (3, 2, false) => &[2, 4, 8, 16],
        (_, _, true) => &[4, 8, 16],
        (3, _, false) => &[2, 4, 8, 16, 32],
        (_, _, false) => &[4, 8, 16, 32, 64, 128],
    };
    let (from, name) = (rows.len(), manufactured::label(element));
    for (number, &per_unit) in cells.iter().enumerate() {
        (settings.tell)(number, cells.len(), &format!("manufactured solution, {name}, {per_unit} cells"));
        let row = solved(settings, model, element, per_unit, rows.len())?;
        rows.push(row);
    }
    let rows = &rows[from..];
    let order = |error: fn(&Errors) -> Option<f64>| {
        let pairs: Vec<_> = rows.iter().filter_map(|row| Some((spacing(row), error(&row.errors)?))).collect();
        asymptotic(&pairs, FINEST, 0.0)
    };
    let observed = [order(|errors| errors.space_l2), order(|errors| errors.space_h1)];
    Ok(SpaceOrders { scene: rows[0].config.scene.clone(), element, observed })
}

/// Edge of a cell of the unit cube or square, m: six tetrahedra or two triangles fill a cell.
pub fn spacing(row: &Row) -> f64 {
    let elements = row.config.elements as f64;
    let is_in_plane = ["-triangles", "-quadratic"].iter().any(|ending| row.config.scene.ends_with(ending));
    if is_in_plane { (2.0 / elements).sqrt() } else { (6.0 / elements).cbrt() }
}

fn solved(settings: &Settings, model: &str, element: &Element, cells: usize, number: usize) -> Result<Row> {
    let solved = manufactured::solve(model, element, cells)?;
    let id = format!("manufactured-{:03}", number + 1);
    let kind = manufactured::ending(element);
    let state = format!("states/{id}.json");
    let reference_state = format!("states/manufactured{kind}-{cells}-reference.json");
    let qdot = nalgebra::DVector::zeros(solved.q.len());
    let snapshot = Snapshot { time: 1.0, q: &solved.q, qdot: &qdot, energies: (0.0, f64::NAN) };
    write_state(&settings.out.join(&state), &snapshot)?;
    let mesh = &solved.mesh;
    write_reference(&settings.out.join(&reference_state), mesh, solved.material.density, None)?;
    let moduli = moduli(&solved.material);
    let seconds = Some(solved.seconds);
    let config = Configuration {
        id,
        scene: solved.name.clone(),
        group: "space".to_owned(),
        method: format!("static, {cells} cells"),
        pipeline: "engine".to_owned(),
        mesh_hash: norms::mesh_hash(mesh),
        nodes: mesh.vertices().len(),
        elements: mesh.elements(),
        young: moduli.map(|moduli| moduli.young),
        poisson: moduli.map(|moduli| moduli.poisson),
        integrator: Integrator::Static,
        projection: "when_needed".to_owned(),
        solver: "cholesky".to_owned(),
        dt: 1.0,
        steps: 1,
        tolerance: Some(1e-13),
        max_iterations: Some(50),
        precision: "f64".to_owned(),
    };
    Ok(Row {
        times: Times {
            step_ms: [seconds.map(|s| 1e3 * s); 3],
            total_s: [seconds; 3],
            repetitions: 1,
            ..Times::default()
        },
        errors: Errors { space_l2: Some(solved.l2), space_h1: Some(solved.h1), ..Errors::default() },
        counters: solved.counters,
        ..Row::new(config, state, reference_state)
    })
}
