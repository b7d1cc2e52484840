//! Rigid motions of nodes and aggregates. A motion is a displacement u and a rotation ω about a centre.

use super::blocks::Blocks;

/// Displacements and, on coarse levels, amplitudes of a node in the six rigid motions about its own position.
pub type Motion<const D: usize> = [[f64; 6]; D];

/// A rotation that keeps less than this part of the largest one after orthogonalization depends on the motions before it: the nodes of its
/// aggregate lie on a line or in a point. Far above round-off, far below the slenderness of any aggregate.
const DEPENDENT: f64 = 1e-6;

/// A node without rotations.
pub const DISPLACEMENTS: Motion<3> =
    [[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]];

/// The tentative prolongation and the motions of the aggregates about their centres.
///
/// The motions of each aggregate are orthonormalized, B = Q R, so that the coarse unknowns are well scaled whatever its size: Q is its part of
/// the prolongation, R the motion of the coarse node. A dependent motion leaves a zero column in Q.
pub fn orthonormal<const D: usize>(
    aggregates: &[u32],
    centres: &[[f64; 3]],
    (motions, positions): (&[Motion<D>], &[[f64; 3]]),
) -> (Blocks<D, 6>, Vec<Motion<6>>) {
    let mut members = vec![Vec::new(); centres.len()];
    aggregates.iter().enumerate().for_each(|(node, &aggregate)| members[aggregate as usize].push(node));
    let mut tentative = Blocks::zeros((0..=aggregates.len()).collect(), aggregates.to_vec());
    let coarse = members.iter().zip(centres).map(|(members, centre)| {
        let mut Q: Vec<_> = members
            .iter()
            .map(|&node| about(&motions[node], std::array::from_fn(|i| positions[node][i] - centre[i])))
            .collect();
        let R = orthonormalize(&mut Q);
        for (&node, Q) in members.iter().zip(&Q) {
            tentative.values[node] = Q.map(|row| row.map(|entry| entry as f32));
        }
        R
    });
    let coarse = coarse.collect();
    (tentative, coarse)
}

/// The same motions about a centre from which the node lies at d: there u + ω × d moves the node, and ω rotates it.
fn about<const D: usize>(motion: &Motion<D>, d: [f64; 3]) -> Motion<D> {
    let [x, y, z] = d;
    let cross = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]];
    motion.map(|row| {
        std::array::from_fn(
            |j| if j < 3 { row[j] } else { row[j] + (0..3).map(|i| row[i] * cross[i][j - 3]).sum::<f64>() },
        )
    })
}

/// Replaces B by Q and returns R by the modified Gram–Schmidt method, which is repeated for orthogonality to round-off: Giraud, Langou and
/// Rozložník, The Loss of Orthogonality in the Gram–Schmidt Orthogonalization Process (2005).
fn orthonormalize<const D: usize>(B: &mut [Motion<D>]) -> Motion<6> {
    let dot = |B: &[Motion<D>], i: usize, j: usize| B.iter().flatten().map(|row| row[i] * row[j]).sum::<f64>();
    let size_of =
        |columns: std::ops::Range<usize>, B: &[Motion<D>]| columns.map(|j| dot(B, j, j)).fold(0.0, f64::max).sqrt();
    let sizes = [size_of(0..3, B), size_of(3..6, B)];
    let mut R = [[0.0; 6]; 6];
    for j in 0..6 {
        for _ in 0..2 {
            for k in 0..j {
                let part = dot(B, k, j);
                R[k][j] += part;
                B.iter_mut().flatten().for_each(|row| row[j] -= part * row[k]);
            }
        }
        let size = dot(B, j, j).sqrt();
        let is_dependent = size <= DEPENDENT * sizes[j / 3];
        R[j][j] = if is_dependent { 0.0 } else { size };
        B.iter_mut().flatten().for_each(|row| row[j] = if is_dependent { 0.0 } else { row[j] / size });
    }
    R
}
