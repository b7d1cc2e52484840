//! The straight-sided quadratic tetrahedron of a solid body: ten nodes, four quadrature points.
//!
//! Its displacement gradients are linear and the stiffness of a linear law is quadratic in the position, so a rule of degree 2
//! integrates it exactly. Four points with six strains each have rank 24: the six rigid motions of thirty degrees of freedom are without
//! energy, and no other motion is.
//!
//! Hammer, Marlowe and Stroud, Numerical Integration over Simplexes and Cones (1956); Zienkiewicz and Taylor, The Finite Element Method 1,
//! sections 8.12 and 9.10.

use super::{Element, ShapeFunction};

/// Barycentric coordinates of a quadrature point: three times (5 − √5)/20, and the rest at one corner.
const FAR: f64 = 0.138_196_601_125_010_5;
const NEAR: f64 = 0.585_410_196_624_968_5;

/// Nodes 0 to 3 are the corners, 4 to 9 the middles of the edges: VTK's type 24, Abaqus's C3D10. Gmsh's type 11 has the last two in the other
/// order. Corners have L (2 L − 1), middles 4 L_a L_b.
pub(super) const QUADRATIC_TETRAHEDRON: Element = Element {
    name: "quadratic tetrahedra",
    dimension: 3,
    order: 2,
    shape_functions: &[
        ShapeFunction(&[(2.0, &[0, 0]), (-1.0, &[0])]),
        ShapeFunction(&[(2.0, &[1, 1]), (-1.0, &[1])]),
        ShapeFunction(&[(2.0, &[2, 2]), (-1.0, &[2])]),
        ShapeFunction(&[(2.0, &[3, 3]), (-1.0, &[3])]),
        ShapeFunction(&[(4.0, &[0, 1])]),
        ShapeFunction(&[(4.0, &[1, 2])]),
        ShapeFunction(&[(4.0, &[2, 0])]),
        ShapeFunction(&[(4.0, &[0, 3])]),
        ShapeFunction(&[(4.0, &[1, 3])]),
        ShapeFunction(&[(4.0, &[2, 3])]),
    ],
    points: &[&[NEAR, FAR, FAR, FAR], &[FAR, NEAR, FAR, FAR], &[FAR, FAR, NEAR, FAR], &[FAR, FAR, FAR, NEAR]],
    edges: &[[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]],
    faces: &[&[1, 2, 3, 5, 9, 8], &[0, 3, 2, 7, 9, 6], &[0, 1, 3, 4, 8, 7], &[0, 2, 1, 6, 5, 4]],
    triangles: &[[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
    vtk_cell: 24,
    locking: None,
};
