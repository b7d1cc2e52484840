//! Errors in space of boxes by Richardson extrapolation over three nested meshes, each with half the cell size of the one before.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use crate::space::norms;
use fem_model::BodyMesh;

/// The state of a box on one mesh.
#[derive(Clone, Debug)]
pub struct Level {
    /// Cells per metre.
    pub cells: usize,
    /// The mesh.
    pub mesh: BodyMesh,
    /// Positions of all nodes, m.
    pub q: DVector<f64>,
}

/// Extrapolated errors of three levels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RichardsonEstimate {
    /// Observed orders in L2 and H1.
    pub orders: (f64, f64),
    /// Of each level: cells per metre, error in L2 relative to the body's length, error of the displacement gradient in L2 relative to
    /// the gradient's norm.
    pub errors: Vec<(usize, f64, f64)>,
    /// Extrapolated displacements at the coarsest level's nodes, m.
    pub limit: Vec<f64>,
}

/// Range of plausible orders; outside, the meshes are too coarse.
const PLAUSIBLE: (f64, f64) = (0.5, 3.0);

/// Compares three levels, from coarse to fine, at the nodes of the coarsest. `None` if the meshes are not nested.
///
/// With p = log₂(‖u₁ − u₂‖ / ‖u₂ − u₃‖) the limit is u₃ + (u₃ − u₂)/(2^p − 1), and an error is a distance from it (L. F. Richardson,
/// "The approximate arithmetical solution by finite differences", 1911). Gradients: ‖∇(u − u_l)‖ = ‖∇(u_{l+1} − u_l)‖ / √(1 − 4^−p),
/// because the increments of nested meshes are orthogonal to the remaining error.
pub fn compare(levels: &[Level; 3]) -> Option<RichardsonEstimate> {
    let places = [0, 1, 2].map(|level| places(&levels[level]));
    let coarse = &levels[0].mesh;
    let on_coarse = |level: usize| -> Option<Vec<f64>> {
        let Level { mesh, q, .. } = &levels[level];
        let mut values = Vec::with_capacity(3 * coarse.vertices().len());
        for node in 0..coarse.vertices().len() {
            let ratio = levels[level].cells / levels[0].cells;
            let fine = places[level].get(&places_of(coarse, node, levels[0].cells).map(|i| i * ratio as i64))?;
            values.extend((0..3).map(|i| q[3 * fine + i] - mesh.vertices()[*fine][i]));
        }
        Some(values)
    };
    let u = [on_coarse(0)?, on_coarse(1)?, on_coarse(2)?];
    let weights = norms::weights(coarse);
    let apart = [norms::l2(&weights, &u[0], &u[1]), norms::l2(&weights, &u[1], &u[2])];
    let p = (apart[0] / apart[1]).log2();
    let factor = 2f64.powf(p.clamp(PLAUSIBLE.0, PLAUSIBLE.1)) - 1.0;
    let limit: Vec<f64> = u[2].iter().zip(&u[1]).map(|(fine, coarse)| fine + (fine - coarse) / factor).collect();
    let length = norms::length(coarse);
    let slopes = [slope_apart(&levels[0], &levels[1])?, slope_apart(&levels[1], &levels[2])?];
    let p1 = (slopes[0] / slopes[1]).log2();
    let remaining = (1.0 - 4f64.powf(-p1.clamp(PLAUSIBLE.0, PLAUSIBLE.1))).sqrt();
    let size = slope_norm(&levels[2]);
    let steep = [slopes[0] / remaining, slopes[1] / remaining, slopes[1] / remaining / 2f64.powf(p1)];
    let error =
        |level: usize| (levels[level].cells, norms::l2(&weights, &u[level], &limit) / length, steep[level] / size);
    Some(RichardsonEstimate { orders: (p, p1), errors: (0..3).map(error).collect(), limit })
}

/// Nodes by their indices on the grid of a level.
fn places(level: &Level) -> std::collections::HashMap<[i64; 3], usize> {
    (0..level.mesh.vertices().len()).map(|node| (places_of(&level.mesh, node, level.cells), node)).collect()
}

fn places_of(mesh: &BodyMesh, node: usize, cells: usize) -> [i64; 3] {
    mesh.vertices()[node].map(|x| (x * cells as f64).round() as i64).into()
}

/// ‖∇(u_fine − u_coarse)‖. A fine node lies at a coarse node or in the middle of a coarse edge, since all edges of the box mesh point
/// along (0 or 1, 0 or 1, 0 or 1).
fn slope_apart(coarse: &Level, fine: &Level) -> Option<f64> {
    if fine.cells != 2 * coarse.cells {
        return None;
    }
    let there = places(coarse);
    let displacement = |level: &Level, node: usize| -> [f64; 3] {
        std::array::from_fn(|i| level.q[3 * node + i] - level.mesh.vertices()[node][i])
    };
    let mut apart = Vec::with_capacity(fine.mesh.vertices().len());
    for node in 0..fine.mesh.vertices().len() {
        let at = places_of(&fine.mesh, node, fine.cells);
        let low = displacement(coarse, *there.get(&at.map(|i| i.div_euclid(2)))?);
        let high = displacement(coarse, *there.get(&at.map(|i| (i + 1).div_euclid(2)))?);
        let found = displacement(fine, node);
        apart.push(std::array::from_fn(|i| found[i] - 0.5 * (low[i] + high[i])));
    }
    Some(gradient_norm(&fine.mesh, &apart))
}

fn slope_norm(level: &Level) -> f64 {
    let u: Vec<[f64; 3]> = (0..level.mesh.vertices().len())
        .map(|node| std::array::from_fn(|i| level.q[3 * node + i] - level.mesh.vertices()[node][i]))
        .collect();
    gradient_norm(&level.mesh, &u)
}

/// √∫ |∇u|²
fn gradient_norm(mesh: &BodyMesh, u: &[[f64; 3]]) -> f64 {
    let square = |element: usize| mesh.displacement_gradient(element, |node| u[node].into()).norm_squared();
    mesh.volumes().into_iter().enumerate().map(|(element, volume)| volume * square(element)).sum::<f64>().sqrt()
}
