//! The nodes and elements of a body, solid or flat.

use std::collections::{BTreeMap, HashSet};

use fem_mesh::{CoincidentNodes, MeshSet, SurfaceMesh, TetrahedralMesh, area_vector};
use nalgebra::{Matrix3, Vector3};

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
}

impl BodyMesh {
    /// Undeformed positions of the nodes, m.
    pub fn vertices(&self) -> &[Vector3<f64>] {
        match self {
            Self::Solid(mesh) => &mesh.vertices,
            Self::Flat { triangles, .. } => &triangles.vertices,
        }
    }

    /// Longest edge of the undeformed body's bounding box, m.
    pub fn length(&self) -> f64 {
        let x = self.vertices();
        let (least, most) = x.iter().fold((x[0], x[0]), |(least, most), x| (least.inf(x), most.sup(x)));
        (most - least).max()
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        match self {
            Self::Solid(mesh) => mesh.elements.len(),
            Self::Flat { triangles, .. } => triangles.elements.len(),
        }
    }

    /// The nodes of an element.
    pub fn nodes_of(&self, element: usize) -> &[usize] {
        match self {
            Self::Solid(mesh) => &mesh.elements[element],
            Self::Flat { triangles, .. } => &triangles.elements[element],
        }
    }

    /// The nodes of each element.
    pub fn corners(&self) -> impl Iterator<Item = &[usize]> {
        (0..self.elements()).map(|element| self.nodes_of(element))
    }

    /// The first node of each node's connected part.
    pub fn parts(&self) -> Vec<usize> {
        match self {
            Self::Solid(mesh) => fem_mesh::parts(mesh),
            Self::Flat { triangles, .. } => fem_mesh::parts(triangles),
        }
    }

    /// Nodes that coincide without being merged.
    pub fn coincident_nodes(&self) -> Option<CoincidentNodes> {
        match self {
            Self::Solid(mesh) => fem_mesh::coincident_nodes(mesh),
            Self::Flat { triangles, .. } => fem_mesh::coincident_nodes(triangles),
        }
    }

    /// Triangles of the surface: the boundary of a solid body, counter-clockwise from outside, or all triangles of a flat one.
    pub fn surface(&self) -> Vec<[usize; 3]> {
        match self {
            Self::Solid(mesh) => fem_mesh::boundary(mesh),
            Self::Flat { triangles, .. } => triangles.elements.clone(),
        }
    }

    /// Edges of the outline of a flat body, each with the body on its left; none for a solid one.
    pub fn outline(&self) -> Vec<[usize; 2]> {
        let Self::Flat { triangles, .. } = self else { return Vec::new() };
        let edges = || triangles.elements.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let directed: HashSet<[usize; 2]> = edges().collect();
        edges().filter(|&[a, b]| !directed.contains(&[b, a])).collect()
    }

    /// Undeformed area of a part of the surface, m²: a triangle of a solid body, an edge of a flat one.
    pub fn area(&self, nodes: &[usize]) -> f64 {
        let x = |i: usize| self.vertices()[nodes[i]];
        match self {
            Self::Solid(_) => area_vector([x(0), x(1), x(2)]).norm(),
            Self::Flat { thickness, .. } => thickness * (x(1) - x(0)).norm(),
        }
    }

    /// Named parts.
    pub fn sets(&self) -> &BTreeMap<String, MeshSet> {
        match self {
            Self::Solid(mesh) => &mesh.sets,
            Self::Flat { triangles, .. } => &triangles.sets,
        }
    }

    /// The nodes of a named part.
    pub fn nodes_of_set(&self, set: &MeshSet) -> Vec<usize> {
        match self {
            Self::Solid(mesh) => set.nodes(&mesh.elements),
            Self::Flat { triangles, .. } => set.nodes(&triangles.elements),
        }
    }

    /// Undeformed volume of each element, m³.
    pub fn volumes(&self) -> Vec<f64> {
        match self {
            Self::Solid(mesh) => fem_mesh::volumes(mesh),
            Self::Flat { triangles, thickness } => {
                let volume = |element: &[usize; 3]| thickness * area_vector(element.map(|i| triangles.vertices[i])).z;
                triangles.elements.iter().map(volume).collect()
            }
        }
    }

    /// Edge vectors of an element from its first node, m, as columns, for nodes at `x`. Flat elements have the unit vector of z as third.
    pub fn edges(&self, element: usize, x: impl Fn(usize) -> Vector3<f64>) -> Matrix3<f64> {
        let nodes = self.nodes_of(element);
        let edge = |k: usize| nodes.get(k).map_or(Vector3::z(), |&node| x(node) - x(nodes[0]));
        Matrix3::from_columns(&[edge(1), edge(2), edge(3)])
    }

    /// The tetrahedra of a solid body; empty for a flat one.
    pub fn tetrahedra(&self) -> &[[usize; 4]] {
        self.solid().map_or(&[], |mesh| &mesh.elements)
    }

    /// The mesh of a solid body.
    pub fn solid(&self) -> Option<&TetrahedralMesh> {
        match self {
            Self::Solid(mesh) => Some(mesh),
            Self::Flat { .. } => None,
        }
    }

    /// The elements in the plural, for messages.
    pub fn kind(&self) -> &'static str {
        if self.is_flat() { "triangles" } else { "tetrahedra" }
    }

    /// Whether the body is flat.
    pub fn is_flat(&self) -> bool {
        matches!(self, Self::Flat { .. })
    }
}

impl From<TetrahedralMesh> for BodyMesh {
    fn from(mesh: TetrahedralMesh) -> Self {
        Self::Solid(mesh)
    }
}
