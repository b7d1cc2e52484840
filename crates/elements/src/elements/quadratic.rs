//! The straight-sided quadratic triangle: six nodes, three quadrature points.
//!
//! Its displacement gradients are linear and the stiffness of a linear law is quadratic in the position, so a rule of degree 2
//! integrates it exactly. Of the two rules of three points, the inner one is taken: every point belongs to one triangle alone, where
//! stress is continuous, while points at mid-sides lie where the stresses of two triangles meet. Three points with three strains each
//! leave the three rigid motions of twelve degrees of freedom without energy, and no other motion.
//!
//! Strang and Fix, An Analysis of the Finite Element Method (1973), table 4.1; Zienkiewicz and Taylor, The Finite Element Method 1,
//! sections 8.8 and 9.10.

use nalgebra::SMatrix;

/// Number of quadrature points, each of a third of the area.
pub const POINTS: usize = 3;

/// Barycentric coordinates of each quadrature point.
pub const BARYCENTRIC: [[f64; 3]; POINTS] =
    [[2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0], [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0], [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0]];

/// Corners of each side, in the order of the nodes at their middles: nodes 0 to 2 are the corners, 3 to 5 these middles. So number
/// VTK (type 22) and Gmsh (type 9).
pub const SIDES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// The six shape functions at barycentric coordinates: corners have L (2 L − 1), middles 4 L_a L_b.
pub fn shape_functions(L: &[f64; 3]) -> [f64; 6] {
    let corner = |i: usize| L[i] * (2.0 * L[i] - 1.0);
    let middle = |side: usize| 4.0 * L[SIDES[side][0]] * L[SIDES[side][1]];
    [corner(0), corner(1), corner(2), middle(0), middle(1), middle(2)]
}

/// Gradients of the six shape functions at barycentric coordinates, 1/m. `corners` has the gradients of the linear shape functions of the
/// second and third corner in its rows.
pub fn gradients(corners: &SMatrix<f64, 2, 2>, L: &[f64; 3]) -> [[f64; 2]; 6] {
    let [b, c] = [0, 1].map(|e| [corners[(e, 0)], corners[(e, 1)]]);
    let g = [[-b[0] - c[0], -b[1] - c[1]], b, c];
    let corner = |i: usize| g[i].map(|x| (4.0 * L[i] - 1.0) * x);
    let middle = |side: usize| {
        let [a, b] = SIDES[side];
        std::array::from_fn(|j| 4.0 * (L[a] * g[b][j] + L[b] * g[a][j]))
    };
    [corner(0), corner(1), corner(2), middle(0), middle(1), middle(2)]
}
