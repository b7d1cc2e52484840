//! The nodes and elements of a body, solid or flat.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use fem_mesh::write::Grid;
use fem_mesh::{
    CoincidentNodes, Mesh, MeshError, MeshSet, TetrahedralMesh, area_vector, distinct_edges, outer_faces, signed_volume,
};
use nalgebra::{Matrix3, Vector3};

use crate::body_length;
use crate::element::{Element, ShapeFunction};

/// The mesh of a body: elements of one kind. A flat body lies in the plane z = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyMesh {
    element: &'static Element,
    vertices: Vec<Vector3<f64>>,
    /// The nodes of the first element, its corners first, then those of the next.
    nodes: Vec<usize>,
    /// m
    thickness: Option<f64>,
    sets: BTreeMap<String, MeshSet>,
}

impl BodyMesh {
    /// A solid body.
    pub fn solid<const N: usize>(mesh: Mesh<3, N>) -> Self {
        Self::new(const { Element::with_nodes(3, N) }, mesh, None)
    }

    /// A flat body of a thickness, m. Its elements are counter-clockwise seen from positive z.
    pub fn flat<const N: usize>(mesh: Mesh<3, N>, thickness: f64) -> Self {
        Self::new(const { Element::with_nodes(2, N) }, mesh, Some(thickness))
    }

    fn new<const N: usize>(element: &'static Element, mesh: Mesh<3, N>, thickness: Option<f64>) -> Self {
        Self { element, vertices: mesh.vertices, nodes: mesh.elements.into_flattened(), thickness, sets: mesh.sets }
    }

    /// The kind of its elements.
    pub fn element(&self) -> &'static Element {
        self.element
    }

    /// Number of dimensions of the undeformed body: 2 if it is flat, 3 if it is solid.
    pub fn dimension(&self) -> usize {
        self.element.dimension
    }

    /// The directions in which no node moves: a flat body stays in its plane.
    pub fn fixed_directions(&self) -> [bool; 3] {
        std::array::from_fn(|i| i >= self.dimension())
    }

    /// Thickness of a flat body, m.
    pub fn thickness(&self) -> Option<f64> {
        self.thickness
    }

    /// Undeformed positions of the nodes, m.
    pub fn vertices(&self) -> &[Vector3<f64>] {
        &self.vertices
    }

    /// Length of the undeformed body, m, whatever its direction: √12 times its largest radius of gyration, for a box its longest edge.
    pub fn length(&self) -> f64 {
        body_length::length(self.vertices(), || self.corners(), self.element.corners(), &self.volumes())
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        self.nodes.len() / self.element.nodes()
    }

    /// The nodes of an element, its corners first.
    pub fn nodes_of(&self, element: usize) -> &[usize] {
        let count = self.element.nodes();
        &self.nodes[count * element..count * (element + 1)]
    }

    /// The nodes at the corners of an element.
    pub fn corners_of(&self, element: usize) -> &[usize] {
        &self.nodes_of(element)[..self.element.corners()]
    }

    /// The nodes of each element, its corners first.
    pub fn corners(&self) -> impl Iterator<Item = &[usize]> {
        self.nodes.chunks_exact(self.element.nodes())
    }

    /// The nodes of each element as arrays; `None` if elements have another number of nodes.
    pub fn arrays<const N: usize>(&self) -> Option<&[[usize; N]]> {
        (N == self.element.nodes()).then(|| self.nodes.as_chunks().0)
    }

    /// The tetrahedra of a body of linear ones; empty for other bodies.
    pub fn tetrahedra(&self) -> &[[usize; 4]] {
        self.arrays().unwrap_or_default()
    }

    /// The mesh itself; `None` if elements have another number of nodes.
    pub fn mesh<const N: usize>(&self) -> Option<Mesh<3, N>> {
        (N == self.element.nodes()).then(|| self.clone().into_mesh())
    }

    /// The first node of each node's connected part.
    pub fn parts(&self) -> Vec<usize> {
        fem_mesh::parts(self.vertices.len(), self.corners())
    }

    /// Nodes that coincide without being merged.
    pub fn coincident_nodes(&self) -> Option<CoincidentNodes> {
        fem_mesh::coincident_nodes(&self.vertices)
    }

    /// Triangles of the surface: the boundary of a solid body, counter-clockwise from outside, or all triangles of a flat one. Faces with more
    /// nodes than corners give the triangles between their nodes.
    pub fn surface(&self) -> Vec<[usize; 3]> {
        self.triangles().map(|(_, triangle)| triangle).collect()
    }

    /// The element of each triangle of [`surface`](Self::surface).
    pub fn elements_of_surface(&self) -> Vec<usize> {
        self.triangles().map(|(element, _)| element).collect()
    }

    fn triangles(&self) -> impl Iterator<Item = (usize, [usize; 3])> {
        let Element { dimension, faces, triangles, .. } = *self.element;
        let pieces = match dimension {
            2 => (0..self.elements()).map(|element| [element, 0]).collect(),
            _ => self.outer_faces(),
        };
        pieces.into_iter().flat_map(move |[element, face]| {
            let (nodes, face) = (self.nodes_of(element), faces[face]);
            let node = move |i: usize| nodes[if dimension == 2 { i } else { face[i] }];
            triangles.iter().map(move |triangle| (element, triangle.map(node)))
        })
    }

    /// The faces of the boundary, corners first: triangles of a solid body, counter-clockwise from outside, or edges of a flat one with the body
    /// on their left.
    pub fn faces(&self) -> Vec<Vec<usize>> {
        let nodes = |[element, face]: [usize; 2]| {
            self.element.faces[face].iter().map(|&node| self.nodes_of(element)[node]).collect()
        };
        self.outer_faces().into_iter().map(nodes).collect()
    }

    /// The faces that belong to one element alone: its number, and that of the face in it.
    fn outer_faces(&self) -> Vec<[usize; 2]> {
        let faces = self.element.faces;
        let (count, nodes) = (self.elements(), |element| self.nodes_of(element));
        match self.dimension() {
            2 => outer_faces(count, nodes, &faces.iter().map(|face| [face[0], face[1]]).collect::<Vec<_>>()),
            _ => outer_faces(count, nodes, &faces.iter().map(|face| [face[0], face[1], face[2]]).collect::<Vec<_>>()),
        }
    }

    /// Undeformed area of a face, m².
    pub fn area(&self, face: &[usize]) -> f64 {
        self.thickness.unwrap_or(1.0) * self.element.area_vector(|i| self.vertices[face[i]]).norm()
    }

    /// Named parts.
    pub fn sets(&self) -> &BTreeMap<String, MeshSet> {
        &self.sets
    }

    /// The nodes of a named part, ascending: those at the middles of its edges and of the edges of its faces too.
    pub fn nodes_of_set(&self, set: &MeshSet) -> Vec<usize> {
        let nodes = set.nodes(|element| self.nodes_of(element));
        self.with_middles(nodes, &set.edges, &set.faces)
    }

    /// Nodes and those at the middles of edges and of the edges of triangles, ascending.
    pub fn with_middles(&self, nodes: Vec<usize>, edges: &[[usize; 2]], faces: &[[usize; 3]]) -> Vec<usize> {
        let mut all: BTreeSet<usize> = nodes.into_iter().collect();
        let sides = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let ascending = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
        let edges: BTreeSet<[usize; 2]> = edges.iter().copied().chain(sides).map(ascending).collect();
        let middles = (0..self.elements())
            .flat_map(|element| self.middles_of(element))
            .filter(|(ends, _)| edges.contains(&ascending(*ends)));
        all.extend(middles.map(|(_, middle)| middle));
        all.into_iter().collect()
    }

    /// The ends of each edge of an element that has a node at its middle, and that node.
    pub fn middles_of(&self, element: usize) -> impl Iterator<Item = ([usize; 2], usize)> {
        let nodes = self.nodes_of(element);
        let middles = &nodes[self.element.corners()..];
        self.element.edges.iter().zip(middles).map(|(edge, &middle)| (edge.map(|corner| nodes[corner]), middle))
    }

    /// Undeformed volume of each element, m³.
    pub fn volumes(&self) -> Vec<f64> {
        let x = |nodes: &[usize], i: usize| self.vertices[nodes[i]];
        match self.thickness {
            Some(thickness) => {
                self.corners().map(|nodes| thickness * area_vector([0, 1, 2].map(|i| x(nodes, i))).z).collect()
            }
            None => self.corners().map(|nodes| signed_volume([0, 1, 2, 3].map(|i| x(nodes, i)))).collect(),
        }
    }

    /// G = F − 1 of an element for displacements `u` of its nodes, m: the mean over the element of the displacement gradient, which is the
    /// gradient at its centroid.
    pub fn displacement_gradient(&self, element: usize, u: impl Fn(usize) -> Vector3<f64>) -> Matrix3<f64> {
        let corners = self.element.corners();
        self.displacement_gradient_at(element, &[1.0 / corners as f64; 4][..corners], u)
    }

    /// The same at barycentric coordinates.
    pub fn displacement_gradient_at(
        &self,
        element: usize,
        L: &[f64],
        u: impl Fn(usize) -> Vector3<f64>,
    ) -> Matrix3<f64> {
        let (nodes, corners) = (self.nodes_of(element), self.element.corners());
        let undeformed = [1, 2, 3].map(|k| match k < corners {
            true => self.vertices[nodes[k]] - self.vertices[nodes[0]],
            false => Vector3::z(),
        });
        let change = [1, 2, 3].map(|k| if k < corners { self.derivative(nodes, k, L, &u) } else { Vector3::zeros() });
        quotient(&Matrix3::from_columns(&change), &Matrix3::from_columns(&undeformed))
    }

    /// A lower bound of det F in a whole element for displacements `u` of its nodes, m: its value in a linear element. F is linear in a
    /// quadratic one, Σ L_i F_i with those at the corners, so det F is a sum of Bernstein polynomials whose factors are the means of
    /// det (F_i, F_j, F_k) over the columns that each of the three gives. If all are positive, det F is: A. Johnen, J.-F. Remacle and
    /// C. Geuzaine, Geometrical Validity of Curvilinear Finite Elements (2013).
    pub fn least_det_F(&self, element: usize, u: impl Fn(usize) -> Vector3<f64>) -> f64 {
        let count = self.element.corners();
        let at = |corner: usize| {
            let L: [f64; 4] = std::array::from_fn(|i| f64::from(i == corner));
            Matrix3::identity() + self.displacement_gradient_at(element, &L[..count], &u)
        };
        let F: Vec<Matrix3<f64>> = (0..count).map(at).collect();
        let det = |[i, j, k]: [usize; 3]| F[i].column(0).cross(&F[j].column(1)).dot(&F[k].column(2));
        let orders = |[i, j, k]: [usize; 3]| [[i, j, k], [j, k, i], [k, i, j], [i, k, j], [k, j, i], [j, i, k]];
        let triples = (0..count).flat_map(|i| (i..count).flat_map(move |j| (j..count).map(move |k| [i, j, k])));
        let factors = triples.map(|triple| orders(triple).map(det).iter().sum::<f64>() / 6.0);
        factors.fold(f64::INFINITY, |least, factor| if factor >= least { least } else { factor })
    }

    /// The derivative of displacements along the edge from the first corner of an element to another one, times the length of the edge, m.
    fn derivative(&self, nodes: &[usize], corner: usize, L: &[f64], u: impl Fn(usize) -> Vector3<f64>) -> Vector3<f64> {
        let first = u(nodes[0]);
        if self.element.order == 1 {
            return u(nodes[corner]) - first;
        }
        let term = |(&node, function): (&usize, &ShapeFunction)| {
            let [along, back] = [corner, 0].map(|by| function.derivative(by, L).unwrap_or(0.0));
            (along - back) * (u(node) - first)
        };
        nodes.iter().zip(self.element.shape_functions).map(term).sum()
    }

    /// Undeformed positions of the quadrature points of an element, m, in the order of its states.
    pub fn points(&self, element: usize) -> Vec<Vector3<f64>> {
        let corners = self.corners_of(element);
        let x = || corners.iter().map(|&node| self.vertices[node]);
        match self.element.points {
            [_] => vec![x().sum::<Vector3<f64>>() / corners.len() as f64],
            points => points.iter().map(|L| x().zip(*L).map(|(x, L)| x * *L).sum()).collect(),
        }
    }

    /// The mesh as cells to be written.
    pub fn grid(&self) -> Grid<'_> {
        let Element { vtk_cell: cell_type, .. } = *self.element;
        Grid { vertices: &self.vertices, nodes: &self.nodes, nodes_per_cell: self.element.nodes(), cell_type }
    }

    /// The mesh times a factor.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.vertices.iter_mut().for_each(|x| *x *= factor);
        self
    }

    /// Checks that linear elements can be simulated: [`fem_mesh::check`] and [`fem_mesh::check_plane`]. `source` is named in the error.
    pub fn checked(self, source: &Path) -> Result<Self, MeshError> {
        self.of_linear(
            |mesh| fem_mesh::check_plane(&mesh, source).map(|()| mesh),
            |mesh| fem_mesh::check(&mesh, source).map(|()| mesh),
        )
    }

    /// Cuts linear elements at the midpoints of their edges, so many times: [`fem_mesh::refine`].
    pub fn refined(self, times: u32, source: &Path) -> Result<Self, MeshError> {
        self.of_linear(
            |mesh| fem_mesh::refine_triangles(mesh, times, source),
            |mesh| fem_mesh::refine(mesh, times, source),
        )
    }

    /// The mesh that functions make of its linear triangles or tetrahedra; itself if it has others.
    fn of_linear(
        self,
        triangles: impl Fn(Mesh<3, 3>) -> Result<Mesh<3, 3>, MeshError>,
        tetrahedra: impl Fn(Mesh<3, 4>) -> Result<Mesh<3, 4>, MeshError>,
    ) -> Result<Self, MeshError> {
        match (self.element.order, self.thickness) {
            (1, Some(thickness)) => Ok(Self::flat(triangles(self.into_mesh())?, thickness)),
            (1, None) => Ok(Self::solid(tetrahedra(self.into_mesh())?)),
            _ => Ok(self),
        }
    }

    fn into_mesh<const N: usize>(self) -> Mesh<3, N> {
        Mesh { elements: self.nodes.as_chunks().0.to_vec(), vertices: self.vertices, sets: self.sets }
    }

    /// Puts the further nodes of elements of another order on the edges of linear ones; `None` if there is no such element. The first nodes
    /// are those of the mesh, the others follow in the order of their edges, which [`refined`](Self::refined) has too. Named sets keep their
    /// lists: their edges are named by their ends.
    pub fn of_order(self, order: usize) -> Option<Self> {
        let is_meant = |other: &&Element| other.dimension == self.dimension() && other.order == order;
        let element = Element::ALL.into_iter().find(is_meant)?;
        if element == self.element {
            return Some(self);
        }
        let ends =
            |nodes: &[usize]| element.edges.iter().map(|edge| edge.map(|corner| nodes[corner])).collect::<Vec<_>>();
        let edges = distinct_edges(self.corners().flat_map(ends));
        let (mut vertices, mut nodes, count) = (self.vertices.clone(), Vec::new(), self.vertices.len());
        vertices.extend(edges.iter().map(|&[a, b]| 0.5 * (self.vertices[a] + self.vertices[b])));
        for corners in self.corners() {
            nodes.extend(corners);
            let number =
                |[a, b]: [usize; 2]| edges.binary_search(&[a.min(b), a.max(b)]).expect("every edge is in the list");
            nodes.extend(ends(corners).into_iter().map(|edge| count + number(edge)));
        }
        Some(Self { element, vertices, nodes, ..self })
    }
}

impl From<TetrahedralMesh> for BodyMesh {
    fn from(mesh: TetrahedralMesh) -> Self {
        Self::solid(mesh)
    }
}

/// Evaluates an expression with the nodes of each element of a [`BodyMesh`] as arrays: code that is compiled for each number of nodes.
#[macro_export]
macro_rules! with_elements {
    ($mesh:expr, $elements:ident => $value:expr) => {{
        let mesh: &$crate::BodyMesh = $mesh;
        if let Some($elements) = mesh.arrays::<3>() {
            $value
        } else if let Some($elements) = mesh.arrays::<4>() {
            $value
        } else if let Some($elements) = mesh.arrays::<6>() {
            $value
        } else if let Some($elements) = mesh.arrays::<10>() {
            $value
        } else {
            unreachable!("no element has {} nodes", mesh.element().nodes())
        }
    }};
}

/// a b⁻¹; zero where b is singular, which no element of a checked mesh is. Not generic, so that the long code of the inverse is compiled once.
fn quotient(a: &Matrix3<f64>, b: &Matrix3<f64>) -> Matrix3<f64> {
    b.try_inverse().map_or(Matrix3::zeros(), |inverse| a * inverse)
}
