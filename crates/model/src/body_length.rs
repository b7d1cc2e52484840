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

#[cfg(test)]
mod tests {
    use fem_mesh::{SurfaceMesh, TetrahedralMesh};
    use nalgebra::{Rotation3, Vector3};

    use crate::BodyMesh;

    fn bar() -> TetrahedralMesh {
        fem_mesh::box_mesh([3.0, 1.0, 0.5], 2, fem_mesh::Pattern::Alternating).unwrap()
    }

    #[test]
    fn a_box_is_as_long_as_its_longest_edge_wherever_it_points() {
        let length = BodyMesh::solid(bar()).length();
        assert!((length - 3.0).abs() < 1e-14, "{length}");
        let mut turned = bar();
        let turn = Rotation3::from_euler_angles(0.3, -0.7, 1.9);
        turned.vertices.iter_mut().for_each(|x| *x = turn * *x + Vector3::new(5.0, -2.0, 1.0));
        assert!((BodyMesh::solid(turned).length() - length).abs() < 1e-13);
    }

    #[test]
    fn lengths_far_from_one_metre_keep_their_digits() {
        for scale in [1e-100, 1e100] {
            let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
            let vertices = corners.map(|[x, y]| scale * Vector3::new(x, y, 0.0)).to_vec();
            let length = BodyMesh::flat(SurfaceMesh::new(vertices, vec![[0, 1, 2], [0, 2, 3]]), 1.0).length();
            assert!((length / scale - 2.0).abs() < 1e-14, "{scale:e}: {length:e}");
        }
    }
}
