//! The length of a body, in which tolerances and default distances are given.

use nalgebra::{Matrix3, Vector3};

/// √12 times the largest radius of gyration ρ of the undeformed volume about its centroid, m: for a box the longest edge, L² = 12 ρ².
/// Its elements are simplices of so many `corners`, which come first among their nodes.
///
/// A bounding box along the axes would change with the direction in which a body lies, and with it each quantity that is given in lengths.
pub fn length<'a, E: Iterator<Item = &'a [usize]>>(
    x: &[Vector3<f64>],
    elements: impl Fn() -> E,
    corners: usize,
    volumes: &[f64],
) -> f64 {
    // Numbers near 1, so that no square overflows or underflows.
    let x0 = x[0];
    let size = x.iter().map(|x| (x - x0).amax()).fold(0.0, f64::max);
    if !(size > 0.0) {
        return size;
    }
    let scaled = |node: usize| (x[node] - x0) / size;
    let total: f64 = volumes.iter().sum();
    let parts = || elements().zip(volumes.iter().map(|volume| volume / total));
    let sum = |nodes: &[usize]| nodes[..corners].iter().map(|&node| scaled(node)).sum::<Vector3<f64>>();
    let centroid: Vector3<f64> = parts().map(|(nodes, part)| sum(nodes) * (part / corners as f64)).sum();
    // ∫ x xᵀ over a simplex of k corners is V/(k (k + 1)) (Σ xₐ xₐᵀ + (Σ xₐ)(Σ xₐ)ᵀ).
    let moment = |(nodes, part): (&[usize], f64)| {
        let arm = |node: usize| scaled(node) - centroid;
        let total: Vector3<f64> = nodes[..corners].iter().map(|&node| arm(node)).sum();
        let squares: Matrix3<f64> = nodes[..corners].iter().map(|&node| arm(node) * arm(node).transpose()).sum();
        (squares + total * total.transpose()) * (part / (corners * (corners + 1)) as f64)
    };
    let moments: Matrix3<f64> = parts().map(moment).sum();
    size * (12.0 * moments.symmetric_eigenvalues().max()).sqrt()
}
