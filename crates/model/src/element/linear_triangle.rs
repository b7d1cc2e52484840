//! The linear triangle of a flat body: three nodes, counter-clockwise seen from positive z, one quadrature point.

use super::{Element, ShapeFunction};

pub(super) const LINEAR_TRIANGLE: Element = Element {
    name: "triangles",
    dimension: 2,
    order: 1,
    shape_functions: &[ShapeFunction(&[(1.0, &[0])]), ShapeFunction(&[(1.0, &[1])]), ShapeFunction(&[(1.0, &[2])])],
    points: &[&[1.0 / 3.0; 3]],
    edges: &[],
    faces: &[&[0, 1], &[1, 2], &[2, 0]],
    triangles: &[[0, 1, 2]],
    vtk_cell: 5,
    locking: Some(["triangles in plane strain", ""]),
};
