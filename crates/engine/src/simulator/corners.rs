//! det F at the corners of quadratic elements, where it may be negative though it is positive at all quadrature points.

use nalgebra::{Matrix3, Vector3};

use crate::model::system::System;
use fem_elements::threads::reduce;
use fem_solvers::Real;

/// The quadratic elements of a body whose law does not allow inversion; none in other bodies.
pub(super) struct Corners {
    elements: Vec<Quadratic>,
    /// Number of corners of an element.
    count: usize,
    /// The node of an element between corners i and k; corner i itself for k = i.
    between: [[usize; 4]; 4],
}

struct Quadratic {
    /// Number in the mesh.
    element: u32,
    /// The engine's numbers of its nodes; those of a triangle are the first six.
    nodes: [u32; 10],
    /// Determinant of the undeformed edges from the first corner.
    det: f64,
}

/// Elements that one thread takes at a time, at most.
const MOST: usize = 1024;

impl Corners {
    pub(super) fn new<T: Real>(system: &System<T>) -> Self {
        let (mesh, elements) = (&system.shape.mesh, &system.elements);
        let (of, count) = (mesh.element(), mesh.element().corners());
        let between = std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                let edge = of.edges.iter().position(|&[a, b]| [a, b] == [i, k] || [a, b] == [k, i]);
                edge.map_or(i, |edge| count + edge)
            })
        });
        let mut corners = Self { elements: Vec::new(), count, between };
        if of.order == 1 || elements.count() == 0 {
            return corners;
        }
        let has_barrier: Vec<bool> = elements.laws().map(|law| !law.allows_inversion()).collect();
        for (element, material) in elements.material_of_elements().into_iter().enumerate() {
            if has_barrier[material] {
                let mut nodes = [0; 10];
                for (number, &node) in nodes.iter_mut().zip(mesh.nodes_of(element)) {
                    *number = system.numbering.engine_node[node];
                }
                let mut one = Quadratic { element: element as u32, nodes, det: 1.0 };
                one.det = corners.least_of(&one, |node| system.rest[node]);
                corners.elements.push(one);
            }
        }
        corners
    }

    /// The smallest det F at a corner, and its element.
    pub(super) fn least<T: Real>(&self, system: &System<T>, u: &[[T; 3]]) -> (f64, usize) {
        let x = |node: usize| system.rest[node] + Vector3::from(u[node].map(T::as_f64));
        let smaller = |a: (f64, usize), b: (f64, usize)| if b.0 >= a.0 { a } else { b };
        let of = |elements: &[Quadratic]| {
            let each = elements.iter().map(|one| (self.least_of(one, x), one.element as usize));
            each.fold((f64::INFINITY, 0), smaller)
        };
        reduce(&self.elements, MOST, &of, smaller)
    }

    /// The smallest det F at a corner of an element whose nodes are at `x`, m. At corner i ∂x/∂L_k is 4 x_ik − x_k, where x_ik is the node
    /// between the two, and x_i itself for k = i.
    fn least_of(&self, one: &Quadratic, x: impl Fn(usize) -> Vector3<f64>) -> f64 {
        let x = one.nodes.map(|node| x(node as usize));
        let mut least = f64::INFINITY;
        for between in &self.between[..self.count] {
            let along = |k: usize| 4.0 * x[between[k]] - x[k];
            let first = along(0);
            let edges = [1, 2, 3].map(|k| if k < self.count { along(k) - first } else { Vector3::z() });
            least = f64::min(least, Matrix3::from_columns(&edges).determinant() / one.det);
        }
        least
    }
}
