//! Cages: coarse tetrahedra around a surface, for skinning.

mod coarsen;

use std::collections::HashSet;

use nalgebra::Vector3;

use super::solid::Solid;
use super::stuffing::lattice::{Lattice, Place};
use super::stuffing::octree::Octree;
use super::stuffing::{lattice_around, stencils};
use crate::boundary::FACES;
use crate::boxes::{Bounds, BoxTree};
use crate::error::StuffingError;
use crate::quality::{Triangle, branching_places, meet, segment_meets};
use crate::{SurfaceMesh, TetrahedralMesh, boundary, self_intersections, signed_volume};
use coarsen::coarsen;

/// Distance from the surface up to which the lattice is filled, over the wanted edge: room for the collapse of edges.
const OFFSET: f64 = 0.2;

/// Edge of the lattice over the wanted edge.
const PART: f64 = 0.5;

/// Part of the way to a node outside at which the boundary of a filled tetrahedron is cut. From 0.42 on, no node inside is moved to a cut.
const CUT: f64 = 0.5;

/// Levels of tetrahedra that become coarser towards the inside: more than a lattice of the largest size has.
const LEVELS: usize = 20;

/// Tetrahedra with edges of about `edge` m that contain a surface wholly: every vertex and every triangle lies in their inside. The surface may have
/// holes, cross itself and have flipped triangles; a part that encloses no volume lies in tetrahedra too.
///
/// A level of the distance from the surface is filled with shorter edges as by [`stuff`](super::stuff). Where a triangle crosses the boundary that
/// results, all tetrahedra of the lattice that it touches are filled instead, and the boundary is cut beyond them. Then edges collapse
/// as long as no boundary triangle comes to meet the surface, and angles stay good. Triangles are compared by exact predicates, so that
/// no triangle is left out. Dihedral angles lie between 10.7° and 164.8°.
///
/// # Errors
/// Those of [`stuff`](super::stuff).
///
/// ```
/// use fem_mesh::{Pattern, SurfaceMesh, boundary, box_mesh, generate::cage, volumes};
///
/// let solid = box_mesh([1.0, 1.0, 0.2], 5, Pattern::Alternating)?;
/// let surface = SurfaceMesh::new(solid.vertices.clone(), boundary(&solid));
/// let around = cage(&surface, 0.4).unwrap();
/// assert!(around.elements.len() < solid.elements.len());
/// assert!(volumes(&around).iter().sum::<f64>() > 0.2);
/// # Ok::<(), fem_mesh::MeshError>(())
/// ```
pub fn cage(surface: &SurfaceMesh, edge: f64) -> Result<TetrahedralMesh, StuffingError> {
    let fine = enclose(surface, PART * edge, OFFSET * edge)?;
    let coarse = coarsen(&fine, &Walls::new(surface), edge);
    let is_good = self_intersections(&outer(&coarse)).count == 0 && not_enclosed(surface, &coarse).is_empty();
    Ok(if is_good { coarse } else { fine })
}

/// Tetrahedra of a lattice with edges of about `edge` m, filled up to a distance (m) from a surface, and further where a triangle is not enclosed.
fn enclose(surface: &SurfaceMesh, edge: f64, offset: f64) -> Result<TetrahedralMesh, StuffingError> {
    let (solid, mut lattice) = lattice_around(surface, edge, offset + 2.0 * edge)?;
    let values: Vec<f64> =
        lattice.places().map(|place| offset - signed_distance(&solid, &lattice.undeformed(place))).collect();
    let mut filled = vec![false; values.len()];
    let corners = |i: usize| surface.elements[i].map(|vertex| surface.vertices[vertex]);
    loop {
        let mesh = fill(&mut lattice, &values, &filled);
        let outside = not_enclosed(surface, &mesh);
        if let Some(&triangle) = outside.first() {
            let outside: Vec<_> = outside.into_iter().map(corners).collect();
            if fill_around(&outside, &lattice, &mut filled) == 0 {
                // All tetrahedra that these triangles touch are filled already.
                return Err(StuffingError::NotEnclosed { triangle, edge });
            }
        } else if fill_around(&touching_itself(&mesh, edge), &lattice, &mut filled) == 0 {
            return Ok(mesh);
        }
    }
}

/// The boundary of a mesh as a surface.
fn outer(mesh: &TetrahedralMesh) -> SurfaceMesh {
    SurfaceMesh::new(mesh.vertices.clone(), boundary(mesh))
}

/// Small triangles around the vertices in which the boundary of a mesh touches itself.
fn touching_itself(mesh: &TetrahedralMesh, edge: f64) -> Vec<[Vector3<f64>; 3]> {
    let outer = outer(mesh);
    let around = |x: Vector3<f64>| [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| x + 1e-4 * edge * axis);
    branching_places(&outer).into_iter().map(|vertex| around(outer.vertices[vertex])).collect()
}

/// Distance from the surface, m; negative inside, and infinite without a surface.
fn signed_distance(solid: &Solid, point: &Vector3<f64>) -> f64 {
    let distance = solid.closest(point).map_or(f64::INFINITY, |closest| (closest - point).norm());
    if solid.contains(point) { -distance } else { distance }
}

/// Stuffs the part of the lattice whose nodes have positive values or are filled.
fn fill(lattice: &mut Lattice, values: &[f64], filled: &[bool]) -> TetrahedralMesh {
    lattice.reset();
    for (node, sign) in lattice.signs.iter_mut().enumerate() {
        *sign = if filled[node] || values[node] > 0.0 { 1 } else { -1 };
    }
    let octree = Octree::graded(lattice, LEVELS);
    lattice.cut(|[inside, outside], _| {
        let part = if values[inside] > 0.0 { values[inside] / (values[inside] - values[outside]) } else { 0.0 };
        if filled[inside] { part.max(CUT) } else { part }
    });
    lattice.warp();
    stencils::fill(lattice, &octree)
}

/// Triangles of a surface that are not wholly in the inside of a mesh.
fn not_enclosed(surface: &SurfaceMesh, mesh: &TetrahedralMesh) -> Vec<usize> {
    let faces = outer(mesh);
    let inside = Solid::new(&faces);
    let is_inside: Vec<bool> = surface.vertices.iter().map(|x| inside.contains(x)).collect();
    let walls = Walls::new(&faces);
    let is_out = |&i: &usize| {
        let element = surface.elements[i];
        element.iter().any(|&vertex| !is_inside[vertex]) || walls.meet(element.map(|i| surface.vertices[i]))
    };
    (0..surface.elements.len()).filter(is_out).collect()
}

/// Fills the tetrahedra of the lattice that some triangles touch; the number of nodes that this adds.
fn fill_around(triangles: &[[Vector3<f64>; 3]], lattice: &Lattice, filled: &mut [bool]) -> usize {
    let tree = BoxTree::new(triangles.iter().enumerate().map(|(i, corners)| (i, Bounds::of(corners))).collect());
    let mut added = HashSet::new();
    Octree::uniform(lattice.cubes()).tetrahedra(|places: [Place; 4]| {
        let nodes = places.map(|place| lattice.node(place).map_or(usize::MAX, |node| node as usize));
        if nodes.iter().all(|&node| filled.get(node).copied().unwrap_or(true)) {
            return;
        }
        let places = places.map(|place| lattice.undeformed(place));
        let mut is_touched = false;
        tree.touching(&Bounds::of(&places), |i| is_touched = is_touched || touches(places, &triangles[i]));
        if is_touched {
            added.extend(nodes.into_iter().filter(|&node| node < filled.len() && !filled[node]));
        }
    });
    added.iter().for_each(|&node| filled[node] = true);
    added.len()
}

/// Returns true if a triangle and a tetrahedron have a common point.
fn touches(tetrahedron: [Vector3<f64>; 4], triangle: &[Vector3<f64>; 3]) -> bool {
    let whole = signed_volume(tetrahedron);
    let is_inside = (0..4).all(|i| {
        let mut part = tetrahedron;
        part[i] = triangle[0];
        signed_volume(part) * whole >= 0.0
    });
    let own = Triangle::new(*triangle);
    let faces = FACES.map(|face| face.map(|i| tetrahedron[i]));
    is_inside || faces.into_iter().filter_map(Triangle::new).any(|face| meets(own.as_ref(), triangle, &face))
}

/// Triangles that a cage may not cross, in a tree.
struct Walls {
    tree: BoxTree,
    triangles: Vec<Triangle>,
}

impl Walls {
    /// Triangles without area are left out.
    fn new(surface: &SurfaceMesh) -> Self {
        let corners = surface.elements.iter().map(|face| face.map(|i| surface.vertices[i]));
        let solid = corners.filter_map(|corners| Some((Bounds::of(&corners), Triangle::new(corners)?)));
        let (bounds, triangles): (Vec<Bounds>, Vec<Triangle>) = solid.unzip();
        Self { tree: BoxTree::new(bounds.into_iter().enumerate().collect()), triangles }
    }

    /// Returns true if a triangle has a common point with one of the walls.
    fn meet(&self, corners: [Vector3<f64>; 3]) -> bool {
        let own = Triangle::new(corners);
        let mut is_met = false;
        self.tree.touching(&Bounds::of(&corners), |i| {
            is_met = is_met || meets(own.as_ref(), &corners, &self.triangles[i]);
        });
        is_met
    }
}

/// Returns true if a triangle, or its edges if it has no area, meets another triangle.
fn meets(own: Option<&Triangle>, [a, b, c]: &[Vector3<f64>; 3], other: &Triangle) -> bool {
    match own {
        Some(own) => meet(own, other),
        None => [[a, b], [b, c], [c, a]].into_iter().any(|ends| segment_meets(ends, other)),
    }
}
