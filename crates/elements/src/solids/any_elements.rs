//! Elements of either shape.

use fem_model::BodyMesh;
use nalgebra::Vector3;

use crate::elements::Elements;
use crate::number::Float;
use crate::sparse::Pattern;

/// Elements of one shape. The loops over tetrahedra are compiled for each law; those over triangles call it by reference, once per batch.
pub(super) enum AnyElements<T: Float> {
    Tetrahedra(Elements<T, 3, 3, 4>),
    Triangles(Elements<T, 2, 2, 3>),
    QuadraticTriangles(Elements<T, 2, 5, 6>),
}

/// Evaluates an expression for the elements, whatever their shape.
macro_rules! with_elements {
    ($elements:expr, $name:ident => $value:expr) => {
        match $elements {
            AnyElements::Tetrahedra($name) => $value,
            AnyElements::Triangles($name) => $value,
            AnyElements::QuadraticTriangles($name) => $value,
        }
    };
}
pub(super) use with_elements;

impl<T: Float> AnyElements<T> {
    /// The elements of these numbers, with forces alone; `factors` on their energies is empty where all are 1.
    pub(super) fn new(
        mesh: &BodyMesh,
        factors: &[f64],
        numbers: &[usize],
        rest: &[Vector3<f64>],
        node_numbers: &[u32],
    ) -> Self {
        let pattern = &Pattern::none();
        let factor = |&element: &usize| factors.get(element).copied().unwrap_or(1.0);
        match mesh {
            BodyMesh::Solid(mesh) => {
                let corners = renumbered(numbers, &mesh.elements, node_numbers);
                let factors: Vec<f64> =
                    if factors.is_empty() { Vec::new() } else { numbers.iter().map(factor).collect() };
                Self::Tetrahedra(Elements::stiffened(rest, &corners, &factors, pattern))
            }
            BodyMesh::Flat { triangles, thickness } => {
                let corners = renumbered(numbers, &triangles.elements, node_numbers);
                let factors: Vec<f64> = numbers.iter().map(|element| thickness * factor(element)).collect();
                Self::Triangles(Elements::stiffened(rest, &corners, &factors, pattern))
            }
            BodyMesh::Quadratic { triangles, thickness } => {
                let nodes = renumbered(numbers, &triangles.elements, node_numbers);
                let factors: Vec<f64> = numbers.iter().map(|element| thickness * factor(element)).collect();
                Self::QuadraticTriangles(Elements::quadratic(rest, &nodes, &factors, pattern))
            }
        }
    }
}

/// Those elements of a mesh that are listed by number, with the numbers of their nodes.
fn renumbered<const N: usize>(numbers: &[usize], elements: &[[usize; N]], node_numbers: &[u32]) -> Vec<[u32; N]> {
    numbers.iter().map(|&element| elements[element].map(|node| node_numbers[node])).collect()
}
