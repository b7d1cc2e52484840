//! Half-spaces that the body does not enter: the distances of its nodes.

use fem_model::{Body, ContactPlane};

use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// The obstacles of a body, with data for the distances of its nodes. Nodes have the engine's numbers.
#[derive(Clone, Debug)]
pub struct Planes {
    /// The planes, in the scene's order.
    pub planes: Vec<ContactPlane>,
    /// Undeformed distance of each node from each plane at time zero, m: those of all nodes from the first plane come first.
    rest_gaps: Vec<f64>,
    /// Number of nodes.
    nodes: usize,
}

/// A node near a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Number of the plane.
    pub plane: usize,
    /// The engine's number of the node.
    pub node: usize,
    /// Its distance from the plane, m; negative behind it.
    pub gap: f64,
}

impl Planes {
    /// The obstacles of a body; `None` if the scene has none.
    pub fn new(body: &Body, numbering: &Numbering) -> Option<Self> {
        let planes = body.contact.as_ref()?.planes.clone();
        let vertices = body.shape.mesh.vertices();
        let gap = |plane: &ContactPlane, node: &u32| plane.normal.dot(&(vertices[*node as usize] - plane.point));
        let of_plane = |plane| numbering.mesh_node.iter().map(move |node| gap(plane, node));
        Some(Self { rest_gaps: planes.iter().flat_map(of_plane).collect(), nodes: vertices.len(), planes })
    }

    /// Moves a plane back along its normal, m.
    pub(super) fn stand_back(&mut self, plane: usize, distance: f64) {
        let obstacle = &mut self.planes[plane];
        obstacle.point -= obstacle.normal * distance;
        let gaps = &mut self.rest_gaps[plane * self.nodes..(plane + 1) * self.nodes];
        gaps.iter_mut().for_each(|gap| *gap += distance);
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// The nodes nearer to a plane than `distance` (m) at a time (s), with displacements `u`; plane by plane.
    pub fn near<T: Real>(&self, u: &[[T; 3]], time: f64, distance: f64) -> impl Iterator<Item = Near> {
        let of_plane = move |plane: usize| {
            let gaps = self.gaps(plane, u, time).enumerate();
            gaps.filter_map(move |(node, gap)| (gap < distance).then_some(Near { plane, node, gap }))
        };
        (0..self.planes.len()).flat_map(of_plane)
    }

    /// Distance of each node from a plane at a time (s), with displacements `u`, m.
    pub fn gaps<T: Real>(&self, plane: usize, u: &[[T; 3]], time: f64) -> impl Iterator<Item = f64> {
        let n: [f64; 3] = self.planes[plane].normal.into();
        let travel = self.planes[plane].normal.dot(&self.planes[plane].displacement(time));
        let rest = &self.rest_gaps[plane * self.nodes..(plane + 1) * self.nodes];
        rest.iter().zip(u).map(move |(rest, u)| rest - travel + along(n, u))
    }

    /// Distance of one node, m.
    pub fn gap<T: Real>(&self, plane: usize, node: usize, u: &[T; 3], time: f64) -> f64 {
        let ContactPlane { normal, .. } = &self.planes[plane];
        let travel = normal.dot(&self.planes[plane].displacement(time));
        self.rest_gaps[plane * self.nodes + node] - travel + along((*normal).into(), u)
    }

    /// The node of smallest distance from a plane.
    pub fn nearest<T: Real>(&self, plane: usize, u: &[[T; 3]], time: f64) -> Near {
        let start = Near { plane, node: 0, gap: f64::INFINITY };
        let gaps = self.gaps(plane, u, time).enumerate();
        // NaN counts as near.
        gaps.fold(start, |least, (node, gap)| if !(gap >= least.gap) { Near { plane, node, gap } } else { least })
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.rest_gaps[..])
    }
}

/// n · u
pub(super) fn along<T: Real>(n: [f64; 3], u: &[T; 3]) -> f64 {
    n[0] * u[0].as_f64() + n[1] * u[1].as_f64() + n[2] * u[2].as_f64()
}
