//! The elements that a body can be made of: one file each, and one line in [`Element::ALL`].
//!
//! All of them are simplices with straight sides. Their corners come first among their nodes, then the nodes at the middles of their edges.
//! What the loops over all elements are compiled for stands in [`with_elements`](crate::with_elements).

mod linear_tetrahedron;
mod linear_triangle;
mod quadratic_tetrahedron;
mod quadratic_triangle;
mod shape_function;
pub mod shares;

use nalgebra::Vector3;

pub use shape_function::ShapeFunction;

/// What is known about an element.
#[derive(Debug, PartialEq)]
pub struct Element {
    /// The elements in the plural, for messages.
    pub name: &'static str,
    /// Number of dimensions of the undeformed element: 2 in the plane z = 0, 3 in space.
    pub dimension: usize,
    /// Polynomial degree of the shape functions.
    pub order: usize,
    /// The shape function of each node.
    pub shape_functions: &'static [ShapeFunction],
    /// Barycentric coordinates of the quadrature points, which have equal parts of the volume. The rule is exact for the energy of a linear law:
    /// twice the degree of the gradients.
    pub points: &'static [&'static [f64]],
    /// The corners of each edge that has a node at its middle, in the order of these nodes.
    pub edges: &'static [[usize; 2]],
    /// The nodes of each face, corners first: triangles that are counter-clockwise seen from outside, or edges with the element on their left.
    pub faces: &'static [&'static [usize]],
    /// The linear triangles between the nodes of a face, or of an element in the plane, with the same orientation: what is drawn.
    pub triangles: &'static [[usize; 3]],
    /// VTK's number for the cell with these nodes.
    pub vtk_cell: u8,
    /// How the element is called that locks as Poisson's ratio approaches ½, and what is known of that; `None` if it does not lock.
    pub locking: Option<[&'static str; 2]>,
}

impl Element {
    /// All elements.
    pub const ALL: [&Self; 4] = [
        &linear_tetrahedron::LINEAR_TETRAHEDRON,
        &linear_triangle::LINEAR_TRIANGLE,
        &quadratic_triangle::QUADRATIC_TRIANGLE,
        &quadratic_tetrahedron::QUADRATIC_TETRAHEDRON,
    ];

    /// The element with so many nodes. Panics if there is none, when the program is compiled.
    pub(crate) const fn with_nodes(dimension: usize, nodes: usize) -> &'static Self {
        let mut i = 0;
        while !(Self::ALL[i].dimension == dimension && Self::ALL[i].shape_functions.len() == nodes) {
            i += 1;
        }
        Self::ALL[i]
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.shape_functions.len()
    }

    /// Number of corners.
    pub fn corners(&self) -> usize {
        self.dimension + 1
    }

    /// The shape functions at barycentric coordinates.
    pub fn values(&self, L: &[f64]) -> Vec<f64> {
        self.shape_functions.iter().map(|function| function.value(L)).collect()
    }

    /// The outward area vector of a face whose corners lie at `x`, m²; for an edge of a flat body, its length times its normal, m.
    pub fn area_vector(&self, x: impl Fn(usize) -> Vector3<f64>) -> Vector3<f64> {
        let along = x(1) - x(0);
        match self.dimension {
            2 => Vector3::new(along.y, -along.x, 0.0),
            _ => 0.5 * along.cross(&(x(2) - x(0))),
        }
    }

    /// Gradients of the shape functions at barycentric coordinates, 1/m. `corners` has the gradients of the barycentric coordinates, which are
    /// the linear shape functions of the corners.
    pub fn gradients<const D: usize>(&self, corners: &[[f64; D]], L: &[f64]) -> Vec<[f64; D]> {
        self.shape_functions.iter().map(|function| function.gradient(corners, L)).collect()
    }
}
