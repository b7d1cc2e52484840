//! The area with which each node bears on each plane: its shares of the faces around it, each times the cosine of its angle to the plane.
//!
//! A uniform pressure on the touching face then loads its nodes in proportion to their shares of it, also at its edges: a face at right
//! angles to the plane does not count. Faces turn with a rolling body, so their normals are those at the start of the step, and stay fixed
//! within it, as the normal forces of friction do: the barrier remains a potential of the distances alone. The energy that a change of the
//! areas adds from step to step is of the order of the load times d̂ times the angle turned through.

use fem_model::Body;
use fem_model::element::Element;
use fem_model::element::shares::face_shares;
use nalgebra::Vector3;

use fem_elements::vector::triple;
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// Least area of a node, in areas of the faces around it: a node whose faces look away from the plane must not pass through it.
const LEAST: f64 = 0.01;

/// Component of a plane's normal that is a rounding error.
const ROUNDING: f64 = 1e-9;

/// The areas of the nodes of a body for each of its planes. Nodes have the engine's numbers.
#[derive(Clone, Debug)]
pub struct Areas {
    element: &'static Element,
    faces: Vec<Face>,
    /// The nodes of the first face, corners first, then those of the next.
    nodes: Vec<usize>,
    /// The parts of a face that its nodes have.
    shares: Vec<f64>,
    /// Unit normals of the planes.
    normals: Vec<Vector3<f64>>,
    /// Least area of each node, m²: zero for a node that cannot move away from the plane. Those of the first plane come first.
    least: Vec<f64>,
    /// Area of each node, m²; in the same order.
    areas: Vec<f64>,
}

/// A face of the boundary: a triangle of a solid body, an edge of a flat one.
#[derive(Clone, Debug)]
struct Face {
    /// Undeformed positions of its corners, m; an edge has two.
    rest: [Vector3<f64>; 3],
    /// Undeformed area, m².
    area: f64,
}

impl Areas {
    /// The areas of a body for planes with these unit normals, undeformed.
    pub fn new(body: &Body, numbering: &Numbering, normals: Vec<Vector3<f64>>) -> Self {
        let mesh = &body.shape.mesh;
        let (element, shares) = (mesh.element(), face_shares(mesh.element()));
        let (faces, nodes) = faces(body, numbering);
        let mut around = vec![0.0; mesh.vertices().len()];
        for (face, nodes) in faces.iter().zip(nodes.chunks_exact(shares.len())) {
            // A uniform pressure does not load the corners of a quadratic triangle; they must not pass through the plane either.
            let part = |share: f64| if share > 0.0 { share } else { 1.0 / element.dimension as f64 };
            nodes.iter().zip(&shares).for_each(|(&node, &share)| around[node] += part(share) * face.area);
        }
        let (sections, constrained) = (sections(body), constrained_directions(body));
        let least = |normal: &Vector3<f64>, node: usize| {
            let mesh_node = numbering.mesh_node[node] as usize;
            let gives_way = (0..3).any(|i| !constrained[mesh_node][i] && normal[i].abs() > ROUNDING);
            match around[node] {
                _ if !gives_way => 0.0,
                0.0 => sections[mesh_node],
                area => LEAST * area,
            }
        };
        let least: Vec<f64> =
            normals.iter().flat_map(|normal| (0..around.len()).map(move |node| least(normal, node))).collect();
        let mut areas = Self { element, faces, nodes, shares, areas: least.clone(), least, normals };
        areas.update(&vec![[0.0f64; 3]; around.len()]);
        areas
    }

    /// Takes the directions of the faces at displacements, m.
    pub fn update<T: Real>(&mut self, u: &[[T; 3]]) {
        let Self { element, faces, nodes, shares, normals, least, areas } = self;
        areas.fill(0.0);
        for (face, nodes) in faces.iter().zip(nodes.chunks_exact(shares.len())) {
            let now = |k: usize| face.rest[k] + Vector3::from(u[nodes[k]].map(|u| u.as_f64()));
            let normal = element.area_vector(now).try_normalize(0.0).unwrap_or_default();
            for (plane, areas) in normals.iter().zip(areas.chunks_exact_mut(u.len().max(1))) {
                let facing = face.area * f64::max(0.0, -normal.dot(plane));
                nodes.iter().zip(&*shares).for_each(|(&node, share)| areas[node] += share * facing);
            }
        }
        for (area, &least) in areas.iter_mut().zip(&*least) {
            *area = if least > 0.0 { area.max(least) } else { 0.0 };
        }
    }

    /// Area of a node, m²; zero if it cannot move away from the plane.
    pub fn of(&self, plane: usize, node: usize) -> f64 {
        self.areas[plane * (self.areas.len() / self.normals.len()) + node]
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.areas[..])
            + size_of_val(&self.least[..])
            + size_of_val(&self.faces[..])
            + size_of_val(&self.nodes[..])
    }
}

/// The faces of the boundary, outward by their orientation, and their nodes.
fn faces(body: &Body, numbering: &Numbering) -> (Vec<Face>, Vec<usize>) {
    let mesh = &body.shape.mesh;
    let faces = body.shape.faces();
    let face = |nodes: &Vec<usize>| {
        let corner = |k: usize| mesh.vertices()[nodes[k.min(mesh.dimension() - 1)]];
        Face { rest: [0, 1, 2].map(corner), area: mesh.area(nodes) }
    };
    let nodes = faces.iter().flatten().map(|&node| numbering.engine_node[node] as usize).collect();
    (faces.iter().map(face).collect(), nodes)
}

/// A section through the elements around each node of the mesh, m²: with a law that allows inversion, inner nodes can reach a plane.
fn sections(body: &Body) -> Vec<f64> {
    let mesh = &body.shape.mesh;
    let mut volumes = vec![0.0; mesh.vertices().len()];
    for (corners, volume) in mesh.corners().zip(mesh.volumes()) {
        corners.iter().for_each(|&node| volumes[node] += volume / corners.len() as f64);
    }
    volumes.into_iter().map(|volume| f64::cbrt(volume).powi(2)).collect()
}

/// The directions in which each node of the mesh is constrained at all times.
fn constrained_directions(body: &Body) -> Vec<[bool; 3]> {
    let mut constrained = vec![body.shape.mesh.fixed_directions(); body.shape.mesh.vertices().len()];
    for condition in body.dirichlet.iter().filter(|condition| condition.until.is_none()) {
        for &node in &condition.nodes {
            let before = constrained[node];
            constrained[node] = triple(|i| before[i] || condition.components[i]);
        }
    }
    constrained
}
