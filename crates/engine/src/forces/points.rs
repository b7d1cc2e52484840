//! The quadrature points of a body, for forces that act within its elements.

use fem_model::BodyMesh;
use nalgebra::{Matrix3, Vector3};

use fem_elements::tensor::inverse;
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// The quadrature points of all elements, in the order of the mesh, with the engine's numbers of the nodes.
pub struct Points {
    per_point: usize,
    /// The nodes of each point, as many for all.
    nodes: Vec<(usize, Vector3<f64>)>,
    /// m³
    volumes: Vec<f64>,
}

impl Points {
    /// The points of a body.
    pub fn new(mesh: &BodyMesh, numbering: &Numbering) -> Self {
        let points = mesh.element().points.len();
        let (mut nodes, mut volumes) = (Vec::new(), Vec::new());
        for (element, volume) in mesh.volumes().into_iter().enumerate() {
            for gradients in shape_gradients(mesh, element) {
                let engine_nodes = mesh.nodes_of(element).iter().map(|&node| numbering.engine_node[node] as usize);
                nodes.extend(engine_nodes.zip(gradients));
                volumes.push(volume / points as f64);
            }
        }
        Self { per_point: mesh.element().nodes(), nodes, volumes }
    }

    /// Number of points.
    pub fn count(&self) -> usize {
        self.volumes.len()
    }

    /// Undeformed volume of a point, m³.
    pub fn volume(&self, point: usize) -> f64 {
        self.volumes[point]
    }

    /// The nodes of a point, each with the gradient of its shape function there, 1/m.
    pub fn nodes(&self, point: usize) -> impl Iterator<Item = (usize, &Vector3<f64>)> {
        self.nodes[point * self.per_point..][..self.per_point].iter().map(|(node, gradient)| (*node, gradient))
    }

    /// The gradient of a field of nodal values at a point.
    pub fn gradient_of<T: Real>(&self, point: usize, x: &[[T; 3]]) -> Matrix3<f64> {
        let term = |(node, gradient): (usize, &Vector3<f64>)| {
            Vector3::from(x[node].map(|x| x.as_f64())) * gradient.transpose()
        };
        self.nodes(point).map(term).sum()
    }

    /// Adds the nodal forces of a stress P (Pa) at a point against it, N.
    pub fn add_divergence<T: Real>(&self, point: usize, P: &Matrix3<f64>, gradient: &mut [[T; 3]]) {
        let P = self.volumes[point] * P;
        for (node, of_node) in self.nodes(point) {
            let force = P * of_node;
            (0..3).for_each(|i| gradient[node][i] += T::of(force[i]));
        }
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.volumes[..])
    }
}

/// Gradients of the shape functions of an element at each of its points, 1/m; those of a triangle lie in the plane.
pub fn shape_gradients(mesh: &BodyMesh, element: usize) -> impl Iterator<Item = Vec<Vector3<f64>>> {
    let (corners, x) = (mesh.corners_of(element), mesh.vertices());
    let edge = |k: usize| corners.get(k).map_or(Vector3::z(), |&corner| x[corner] - x[corners[0]]);
    // A checked mesh has no element without volume.
    let inverse = inverse(&Matrix3::from_columns(&[edge(1), edge(2), edge(3)]));
    let mut rows = [0, 1, 2].map(|k| inverse.row(k).transpose());
    rows[corners.len() - 1..].fill(Vector3::zeros());
    let of_corners = [-(rows[0] + rows[1] + rows[2]), rows[0], rows[1], rows[2]].map(<[f64; 3]>::from);
    let at = move |L: &&[f64]| mesh.element().gradients(&of_corners, L).into_iter().map(Vector3::from).collect();
    mesh.element().points.iter().map(at)
}
