//! The straight-sided quadratic triangle of a flat body: six nodes, three quadrature points.
//!
//! Its displacement gradients are linear and the stiffness of a linear law is quadratic in the position, so a rule of degree 2
//! integrates it exactly. Of the two rules of three points, the inner one is taken: every point belongs to one triangle alone, where
//! stress is continuous, while points at mid-sides lie where the stresses of two triangles meet. Three points with three strains each
//! leave the three rigid motions of twelve degrees of freedom without energy, and no other motion.
//!
//! Strang and Fix, An Analysis of the Finite Element Method (1973), table 4.1; Zienkiewicz and Taylor, The Finite Element Method 1,
//! sections 8.8 and 9.10.

use super::{Element, ShapeFunction};

/// Nodes 0 to 2 are the corners, 3 to 5 the middles of the sides: VTK's type 22, Gmsh's type 9. Corners have L (2 L − 1), middles 4 L_a L_b.
pub(super) const QUADRATIC_TRIANGLE: Element = Element {
    name: "quadratic triangles",
    dimension: 2,
    order: 2,
    shape_functions: &[
        ShapeFunction(&[(2.0, &[0, 0]), (-1.0, &[0])]),
        ShapeFunction(&[(2.0, &[1, 1]), (-1.0, &[1])]),
        ShapeFunction(&[(2.0, &[2, 2]), (-1.0, &[2])]),
        ShapeFunction(&[(4.0, &[0, 1])]),
        ShapeFunction(&[(4.0, &[1, 2])]),
        ShapeFunction(&[(4.0, &[2, 0])]),
    ],
    points: &[
        &[2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
        &[1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
        &[1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
    ],
    edges: &[[0, 1], [1, 2], [2, 0]],
    faces: &[&[0, 1, 3], &[1, 2, 4], &[2, 0, 5]],
    triangles: &[[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
    vtk_cell: 22,
    locking: None,
};
