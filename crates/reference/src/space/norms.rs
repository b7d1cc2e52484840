//! Distances between two states of a body. The state files contain all their data.

use fem_model::BodyMesh;
use fem_model::element::shares::{load_shares, lumped_mass_shares};

/// Weights of the nodes, m³: their shares of the volume of every adjacent element, which are the row sums of its consistent mass over the
/// density. Those of corners of quadratic triangles are zero: sums over the nodes are integrals by the rule of mid-sides. Those of quadratic
/// tetrahedra would be negative and make no norm; theirs are the shares of the lumped mass.
pub fn weights(mesh: &BodyMesh) -> Vec<f64> {
    let mut weights = vec![0.0; mesh.vertices().len()];
    let mut shares = load_shares(mesh.element());
    if shares.iter().any(|share| *share < 0.0) {
        shares = lumped_mass_shares(mesh.element());
    }
    for (nodes, volume) in mesh.corners().zip(mesh.volumes()) {
        for (&node, share) in nodes.iter().zip(&shares) {
            weights[node] += volume * share;
        }
    }
    weights
}

/// Longest edge of the bounding box of the undeformed body, m; errors are relative to it.
pub fn length(mesh: &BodyMesh) -> f64 {
    let Some(&first) = mesh.vertices().first() else { return 1.0 };
    let (least, most) = mesh.vertices().iter().fold((first, first), |(least, most), x| (least.inf(x), most.sup(x)));
    (most - least).max()
}

/// √(Σ wᵢ |aᵢ − bᵢ|² / Σ wᵢ), for values stacked `[x0 y0 z0 x1 …]`.
pub fn l2(weights: &[f64], a: &[f64], b: &[f64]) -> f64 {
    let distance = |i: usize| (0..3).map(|c| (a[3 * i + c] - b[3 * i + c]).powi(2)).sum::<f64>();
    let sum: f64 = weights.iter().enumerate().map(|(i, weight)| weight * distance(i)).sum();
    (sum / weights.iter().sum::<f64>()).sqrt()
}

/// The largest distance of a node, max |aᵢ − bᵢ|.
pub fn largest(a: &[f64], b: &[f64]) -> f64 {
    let distance = |(a, b): (&[f64], &[f64])| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    // A NaN must not be lost.
    a.chunks(3).zip(b.chunks(3)).map(distance).fold(0.0, |most: f64, d| if d > most || d.is_nan() { d } else { most })
}

/// Momentum Σ mᵢ vᵢ (kg m/s) and angular momentum Σ mᵢ (xᵢ − c) × vᵢ (kg m²/s) about the undeformed body's centre c, with
/// mᵢ = ρ wᵢ. Rows of the consistent mass add up to the same mᵢ, so the momentum is exact.
pub fn momenta(mesh: &BodyMesh, weights: &[f64], density: f64, q: &[f64], v: &[f64]) -> ([f64; 3], [f64; 3]) {
    let total: f64 = weights.iter().sum();
    let mut centre = nalgebra::Vector3::zeros();
    for (x, &weight) in mesh.vertices().iter().zip(weights) {
        centre += x * (weight / total);
    }
    let (mut linear, mut angular) = (nalgebra::Vector3::zeros(), nalgebra::Vector3::zeros());
    for (i, &weight) in weights.iter().enumerate() {
        let at = nalgebra::Vector3::new(q[3 * i], q[3 * i + 1], q[3 * i + 2]);
        let momentum = density * weight * nalgebra::Vector3::new(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
        linear += momentum;
        angular += (at - centre).cross(&momentum);
    }
    (linear.into(), angular.into())
}

/// |a − b|
pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// Hash of a mesh: FNV-1a over the bits of its coordinates and the indices of its elements (Fowler, Noll, Vo, 1991).
pub fn mesh_hash(mesh: &BodyMesh) -> String {
    let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
    let mut add = |word: u64| {
        for byte in word.to_le_bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    mesh.vertices().iter().flat_map(|x| x.iter()).for_each(|x| add(x.to_bits()));
    mesh.corners().flatten().for_each(|&node| add(node as u64));
    format!("{hash:016x}")
}
