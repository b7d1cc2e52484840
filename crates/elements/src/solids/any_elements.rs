//! Elements of either shape.

use fem_model::BodyMesh;
use nalgebra::Vector3;

use crate::elements::Elements;
use crate::number::Float;
use crate::sparse::Pattern;

/// Elements of one shape. The loops over linear tetrahedra are compiled for each law; those over all others call it by reference, once per
/// batch.
pub(super) enum AnyElements<T: Float> {
    Tetrahedra(Elements<T, 3, 3, 4>),
    Triangles(Elements<T, 2, 2, 3>),
    QuadraticTriangles(Elements<T, 2, 5, 6>),
    QuadraticTetrahedra(Elements<T, 3, 9, 10>),
}

/// Evaluates an expression for the elements, whatever their shape.
macro_rules! with_elements {
    ($elements:expr, $name:ident => $value:expr) => {
        match $elements {
            AnyElements::Tetrahedra($name) => $value,
            AnyElements::Triangles($name) => $value,
            AnyElements::QuadraticTriangles($name) => $value,
            AnyElements::QuadraticTetrahedra($name) => $value,
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
        let factors: Vec<f64> = match mesh.thickness() {
            None if factors.is_empty() => Vec::new(),
            thickness => numbers.iter().map(|element| thickness.unwrap_or(1.0) * factor(element)).collect(),
        };
        if let Some(elements) = mesh.arrays::<4>() {
            let corners = renumbered(numbers, elements, node_numbers);
            Self::Tetrahedra(Elements::stiffened(rest, &corners, &factors, pattern))
        } else if let Some(elements) = mesh.arrays::<3>() {
            let corners = renumbered(numbers, elements, node_numbers);
            Self::Triangles(Elements::stiffened(rest, &corners, &factors, pattern))
        } else if let Some(elements) = mesh.arrays::<6>() {
            let nodes = renumbered(numbers, elements, node_numbers);
            Self::QuadraticTriangles(Elements::at_points(mesh.element(), rest, &nodes, &factors, pattern))
        } else if let Some(elements) = mesh.arrays::<10>() {
            let nodes = renumbered(numbers, elements, node_numbers);
            Self::QuadraticTetrahedra(Elements::at_points(mesh.element(), rest, &nodes, &factors, pattern))
        } else {
            unreachable!("the loops are not compiled for {}", mesh.element().name)
        }
    }
}

/// Those elements of a mesh that are listed by number, with the numbers of their nodes.
fn renumbered<const N: usize>(numbers: &[usize], elements: &[[usize; N]], node_numbers: &[u32]) -> Vec<[u32; N]> {
    numbers.iter().map(|&element| elements[element].map(|node| node_numbers[node])).collect()
}
