//! The nodes and elements of a body, solid or flat.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use fem_mesh::{
    CoincidentNodes, MeshSet, QuadraticMesh, SurfaceMesh, TetrahedralMesh, area_vector, quarters_of, sides,
};
use nalgebra::{Matrix3, Vector3};

use crate::body_length;

/// The mesh of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyMesh {
    /// Tetrahedra.
    Solid(TetrahedralMesh),
    /// Triangles in the plane z = 0.
    Flat {
        /// Counter-clockwise seen from positive z.
        triangles: SurfaceMesh,
        /// m
        thickness: f64,
    },
    /// Straight-sided quadratic triangles in the plane z = 0.
    Quadratic {
        /// Counter-clockwise seen from positive z.
        triangles: QuadraticMesh,
        /// m
        thickness: f64,
    },
}

/// Evaluates an expression for the mesh, whatever its elements.
macro_rules! with_mesh {
    ($mesh:expr, $name:ident => $value:expr) => {
        match $mesh {
            BodyMesh::Solid($name) => $value,
            BodyMesh::Flat { triangles: $name, .. } => $value,
            BodyMesh::Quadratic { triangles: $name, .. } => $value,
        }
    };
}

impl BodyMesh {
    /// Undeformed positions of the nodes, m.
    pub fn vertices(&self) -> &[Vector3<f64>] {
        with_mesh!(self, mesh => &mesh.vertices)
    }

    /// Length of the undeformed body, m, whatever its direction: √12 times its largest radius of gyration, for a box its longest edge.
    pub fn length(&self) -> f64 {
        let corners = if self.is_flat() { 3 } else { 4 };
        body_length::length(self.vertices(), || self.corners(), corners, &self.volumes())
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        with_mesh!(self, mesh => mesh.elements.len())
    }

    /// The nodes of an element, its corners first.
    pub fn nodes_of(&self, element: usize) -> &[usize] {
        with_mesh!(self, mesh => &mesh.elements[element])
    }

    /// The nodes of each element, its corners first.
    pub fn corners(&self) -> impl Iterator<Item = &[usize]> {
        (0..self.elements()).map(|element| self.nodes_of(element))
    }

    /// The first node of each node's connected part.
    pub fn parts(&self) -> Vec<usize> {
        with_mesh!(self, mesh => fem_mesh::parts(mesh))
    }

    /// Nodes that coincide without being merged.
    pub fn coincident_nodes(&self) -> Option<CoincidentNodes> {
        with_mesh!(self, mesh => fem_mesh::coincident_nodes(mesh))
    }

    /// Triangles of the surface: the boundary of a solid body, counter-clockwise from outside, or all triangles of a flat one,
    /// of which a quadratic one gives the four between its nodes.
    pub fn surface(&self) -> Vec<[usize; 3]> {
        match self {
            Self::Solid(mesh) => fem_mesh::boundary(mesh),
            Self::Flat { triangles, .. } => triangles.elements.clone(),
            Self::Quadratic { triangles, .. } => quarters_of(&triangles.elements),
        }
    }

    /// Edges of the outline of a flat body, each with the body on its left: its two ends, then the node in its middle if the triangles are
    /// quadratic. None for a solid body.
    pub fn outline(&self) -> Vec<Vec<usize>> {
        let edges: Vec<Vec<usize>> = match self {
            Self::Solid(_) => Vec::new(),
            Self::Flat { triangles, .. } => {
                triangles.elements.iter().flat_map(|&[a, b, c]| [vec![a, b], vec![b, c], vec![c, a]]).collect()
            }
            Self::Quadratic { triangles, .. } => sides(&triangles.elements).map(Vec::from).collect(),
        };
        let directed: HashSet<[usize; 2]> = edges.iter().map(|edge| [edge[0], edge[1]]).collect();
        edges.into_iter().filter(|edge| !directed.contains(&[edge[1], edge[0]])).collect()
    }

    /// Undeformed area of a part of the surface, m²: a triangle of a solid body, an edge of a flat one.
    pub fn area(&self, nodes: &[usize]) -> f64 {
        let x = |i: usize| self.vertices()[nodes[i]];
        match self {
            Self::Solid(_) => area_vector([x(0), x(1), x(2)]).norm(),
            Self::Flat { thickness, .. } | Self::Quadratic { thickness, .. } => thickness * (x(1) - x(0)).norm(),
        }
    }

    /// The part of a uniform load on an element that each of its nodes carries: the mean of its shape function. The load of a quadratic
    /// triangle acts at the middles of its sides.
    pub fn load_shares(&self) -> &'static [f64] {
        match self {
            Self::Solid(_) => &[0.25; 4],
            Self::Flat { .. } => &[1.0 / 3.0; 3],
            Self::Quadratic { .. } => &[0.0, 0.0, 0.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
        }
    }

    /// The part of an element's mass that each of its nodes carries where the mass is lumped. Row sums of the consistent mass would leave
    /// the corners of a quadratic triangle without any, so there the diagonal is scaled instead: Hinton, Rock and Zienkiewicz, A Note on
    /// Mass Lumping and Related Processes in the Finite Element Method (1976).
    pub fn lumped_mass_shares(&self) -> &'static [f64] {
        match self {
            Self::Solid(_) | Self::Flat { .. } => self.load_shares(),
            Self::Quadratic { .. } => &[1.0 / 19.0, 1.0 / 19.0, 1.0 / 19.0, 16.0 / 57.0, 16.0 / 57.0, 16.0 / 57.0],
        }
    }

    /// The part of a uniform load on a face of the surface (an edge of a flat body) that each of its nodes carries: Simpson's rule on a
    /// quadratic edge.
    pub fn face_shares(&self) -> &'static [f64] {
        match self {
            Self::Solid(_) => &[1.0 / 3.0; 3],
            Self::Flat { .. } => &[0.5; 2],
            Self::Quadratic { .. } => &[1.0 / 6.0, 1.0 / 6.0, 4.0 / 6.0],
        }
    }

    /// Named parts.
    pub fn sets(&self) -> &BTreeMap<String, MeshSet> {
        with_mesh!(self, mesh => &mesh.sets)
    }

    /// The nodes of a named part.
    pub fn nodes_of_set(&self, set: &MeshSet) -> Vec<usize> {
        match self {
            Self::Solid(mesh) => set.nodes(&mesh.elements),
            Self::Flat { triangles, .. } => set.nodes(&triangles.elements),
            Self::Quadratic { triangles, .. } => {
                let edges: HashSet<[usize; 2]> = set.edges.iter().copied().collect();
                let is_named = |&[a, b, _]: &[usize; 3]| edges.contains(&[a.min(b), a.max(b)]);
                let middles = sides(&triangles.elements).filter(is_named).map(|[_, _, middle]| middle);
                let all: BTreeSet<usize> = set.nodes(&triangles.elements).into_iter().chain(middles).collect();
                all.into_iter().collect()
            }
        }
    }

    /// Undeformed volume of each element, m³.
    pub fn volumes(&self) -> Vec<f64> {
        match self {
            Self::Solid(mesh) => fem_mesh::volumes(mesh),
            Self::Flat { thickness, .. } | Self::Quadratic { thickness, .. } => {
                let x = self.vertices();
                self.corners().map(|nodes| thickness * area_vector([0, 1, 2].map(|i| x[nodes[i]])).z).collect()
            }
        }
    }

    /// G = F − 1 of an element for displacements `u` of its nodes, m: the mean over the element of the displacement gradient.
    pub fn displacement_gradient(&self, element: usize, u: impl Fn(usize) -> Vector3<f64>) -> Matrix3<f64> {
        let nodes = self.nodes_of(element);
        let edge = |x: &dyn Fn(usize) -> Vector3<f64>, k: usize| nodes.get(k).map(|&node| x(node) - x(nodes[0]));
        let x = |node: usize| self.vertices()[node];
        let mut undeformed = [1, 2, 3].map(|k| edge(&x, k).unwrap_or(Vector3::z()));
        let mut change = [1, 2, 3].map(|k| edge(&u, k).unwrap_or_default());
        if let Self::Quadratic { .. } = self {
            // The mean gradient of φ of a corner is a third of that of the linear shape function g; of a middle, 4/3 (g_a + g_b).
            let at = |k: usize| u(nodes[k]) - u(nodes[0]);
            change[0] = (change[0] + 4.0 * (at(4) - at(5))) / 3.0;
            change[1] = (change[1] + 4.0 * (at(4) - at(3))) / 3.0;
            (undeformed[2], change[2]) = (Vector3::z(), Vector3::zeros());
        }
        // A checked mesh has no element without volume.
        let inverse = Matrix3::from_columns(&undeformed).try_inverse();
        inverse.map_or(Matrix3::zeros(), |inverse| Matrix3::from_columns(&change) * inverse)
    }

    /// The tetrahedra of a solid body; empty for a flat one.
    pub fn tetrahedra(&self) -> &[[usize; 4]] {
        self.solid().map_or(&[], |mesh| &mesh.elements)
    }

    /// The mesh of a solid body.
    pub fn solid(&self) -> Option<&TetrahedralMesh> {
        match self {
            Self::Solid(mesh) => Some(mesh),
            Self::Flat { .. } | Self::Quadratic { .. } => None,
        }
    }

    /// The elements in the plural, for messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Solid(_) => "tetrahedra",
            Self::Flat { .. } => "triangles",
            Self::Quadratic { .. } => "quadratic triangles",
        }
    }

    /// Number of quadrature points of an element, at each of which the material has a state.
    pub fn points_per_element(&self) -> usize {
        match self {
            Self::Solid(_) | Self::Flat { .. } => 1,
            Self::Quadratic { .. } => 3,
        }
    }

    /// Undeformed positions of the quadrature points of an element, m, in the order of its states.
    pub fn points(&self, element: usize) -> Vec<Vector3<f64>> {
        let X = self.vertices();
        match (self, self.nodes_of(element)) {
            (Self::Quadratic { .. }, &[a, b, c, ..]) => {
                let near = |i: usize, j: usize, k: usize| X[i] * (2.0 / 3.0) + (X[j] + X[k]) / 6.0;
                vec![near(a, b, c), near(b, c, a), near(c, a, b)]
            }
            (_, nodes) => vec![nodes.iter().map(|&node| X[node]).sum::<Vector3<f64>>() / nodes.len() as f64],
        }
    }

    /// Thickness of a flat body, m.
    pub fn thickness(&self) -> Option<f64> {
        match self {
            Self::Solid(_) => None,
            Self::Flat { thickness, .. } | Self::Quadratic { thickness, .. } => Some(*thickness),
        }
    }

    /// Returns true if the body is flat.
    pub fn is_flat(&self) -> bool {
        matches!(self, Self::Flat { .. } | Self::Quadratic { .. })
    }
}

impl From<TetrahedralMesh> for BodyMesh {
    fn from(mesh: TetrahedralMesh) -> Self {
        Self::Solid(mesh)
    }
}
