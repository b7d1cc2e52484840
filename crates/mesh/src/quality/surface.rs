//! Measures and faults of a surface: whether it is closed, a manifold, and turned outwards.

use std::collections::HashSet;
use std::fmt;

use super::triangles::{TriangleShape, measure};
use crate::SurfaceMesh;
use crate::connectivity::{connect, parts, root, sides_by_edge};

/// Measures of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceQuality {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Number of parts that share no vertex.
    pub parts: usize,
    /// Vertices − edges + triangles: 2 for a sphere, 0 for a torus.
    pub euler_characteristic: i64,
    /// Area, m².
    pub area: f64,
    /// Enclosed volume, m³; negative if the triangles are clockwise seen from outside. It has no meaning for an open surface.
    pub volume: f64,
    /// Edges of one triangle alone. A closed surface has none.
    pub open_edges: usize,
    /// Edges of more than two triangles. A manifold has none.
    pub branching_edges: usize,
    /// Edges of two triangles that run through them in one direction. An oriented surface has none.
    pub flipped_edges: usize,
    /// Vertices whose triangles do not form one fan, such as the point in which two cones touch. A manifold has none.
    pub branching_vertices: usize,
    /// Triangles without area within rounding.
    pub flat_triangles: usize,
    /// Smallest and largest angle of the others, degrees.
    pub angles: [f64; 2],
    /// Largest circumradius over shortest edge; 1/√3 for an equilateral triangle.
    pub worst_radius_to_edge: f64,
    /// Shortest and longest edge, m.
    pub edges: [f64; 2],
}

impl SurfaceQuality {
    /// Returns true if every edge has one or two triangles and every vertex one fan of them.
    pub fn is_manifold(&self) -> bool {
        self.branching_edges == 0 && self.branching_vertices == 0
    }

    /// Returns true if the surface encloses a volume: no open, branching or flipped edge.
    pub fn is_closed(&self) -> bool {
        self.triangles > 0
            && [self.open_edges, self.branching_edges, self.flipped_edges].iter().all(|&edges| edges == 0)
    }
}

/// Measures a surface. Indices have to be in range, as those of a surface from a file are.
pub fn surface_quality(mesh: &SurfaceMesh) -> SurfaceQuality {
    let shapes: Vec<TriangleShape> =
        mesh.elements.iter().map(|element| measure(element.map(|i| mesh.vertices[i]))).collect();
    let solid = || shapes.iter().filter(|shape| !shape.is_flat);
    let sides = sides_by_edge(&mesh.elements);
    let edges = || sides.chunk_by(|a, b| a.0 == b.0);
    let is_forward = |side: usize| mesh.elements[side / 3][side % 3] < mesh.elements[side / 3][(side % 3 + 1) % 3];
    let is_flipped = |edge: &&[Side]| matches!(**edge, [(_, a), (_, b)] if is_forward(a) == is_forward(b));
    let lengths = edges().map(|edge| edge[0].0).map(|[a, b]| (mesh.vertices[a] - mesh.vertices[b]).norm());
    let part = parts(mesh.vertices.len(), &mesh.elements);
    // Relative to a vertex, volumes keep their digits far from the origin.
    let origin = mesh.vertices.first().copied().unwrap_or_default();
    let volume = |element: &[usize; 3]| {
        let [a, b, c] = element.map(|i| mesh.vertices[i] - origin);
        a.dot(&b.cross(&c)) / 6.0
    };
    let used = mesh.elements.iter().flatten().collect::<HashSet<_>>().len();
    SurfaceQuality {
        vertices: mesh.vertices.len(),
        triangles: mesh.elements.len(),
        parts: mesh.elements.iter().map(|element| part[element[0]]).collect::<HashSet<_>>().len(),
        euler_characteristic: used as i64 - edges().count() as i64 + mesh.elements.len() as i64,
        area: shapes.iter().map(|shape| shape.area).sum(),
        volume: mesh.elements.iter().map(volume).sum(),
        open_edges: edges().filter(|edge| edge.len() == 1).count(),
        branching_edges: edges().filter(|edge| edge.len() > 2).count(),
        flipped_edges: edges().filter(is_flipped).count(),
        branching_vertices: branching_vertices(mesh, &sides).len(),
        flat_triangles: shapes.iter().filter(|shape| shape.is_flat).count(),
        angles: [
            solid().map(|shape| shape.angles[0]).fold(f64::INFINITY, f64::min),
            solid().map(|shape| shape.angles[1]).fold(0.0, f64::max),
        ],
        worst_radius_to_edge: solid().map(|shape| shape.radius_to_edge).fold(0.0, f64::max),
        edges: lengths.fold([f64::INFINITY, 0.0], |[least, largest], x| [least.min(x), largest.max(x)]),
    }
}

/// Vertices at which a surface is no manifold: ends of edges of more than two triangles, and vertices of more than one fan.
pub(crate) fn branching_places(mesh: &SurfaceMesh) -> Vec<usize> {
    let sides = sides_by_edge(&mesh.elements);
    let mut vertices = branching_vertices(mesh, &sides);
    vertices.extend(sides.chunk_by(|a, b| a.0 == b.0).filter(|edge| edge.len() > 2).flat_map(|edge| edge[0].0));
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}

/// A side of a triangle by its edge, as [`sides_by_edge`] lists it.
type Side = ([usize; 2], usize);

/// Vertices with more than one fan. Corners of triangles at one vertex belong together if the triangles share an edge there.
fn branching_vertices(mesh: &SurfaceMesh, sides: &[Side]) -> Vec<usize> {
    let corner = |triangle: usize, vertex: usize| {
        3 * triangle + mesh.elements[triangle].iter().position(|&i| i == vertex).unwrap_or(0)
    };
    let mut parent: Vec<usize> = (0..3 * mesh.elements.len()).collect();
    for pair in sides.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        for end in pair[0].0 {
            connect(&mut parent, corner(pair[0].1 / 3, end), corner(pair[1].1 / 3, end));
        }
    }
    let mut fans = vec![0_usize; mesh.vertices.len()];
    for at in 0..parent.len() {
        if root(&mut parent, at) == at {
            fans[mesh.elements[at / 3][at % 3]] += 1;
        }
    }
    (0..fans.len()).filter(|&vertex| fans[vertex] > 1).collect()
}

impl fmt::Display for SurfaceQuality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts = [
            ("vertices", self.vertices),
            ("triangles", self.triangles),
            ("connected parts", self.parts),
            ("open edges", self.open_edges),
            ("edges of over 2 triangles", self.branching_edges),
            ("vertices of over 1 fan", self.branching_vertices),
            ("edges of flipped triangles", self.flipped_edges),
            ("triangles without area", self.flat_triangles),
        ];
        let figures = [
            ("area, m²", format!("{:.6e}", self.area)),
            (
                "enclosed volume, m³",
                if self.is_closed() { format!("{:.6e}", self.volume) } else { "not closed".to_owned() },
            ),
            ("Euler characteristic", self.euler_characteristic.to_string()),
            ("shortest edge, m", format!("{:.4e}", self.edges[0])),
            ("longest edge, m", format!("{:.4e}", self.edges[1])),
            ("smallest angle, °", format!("{:.4}", self.angles[0])),
            ("largest angle, °", format!("{:.4}", self.angles[1])),
            ("worst circumradius / edge", format!("{:.4}", self.worst_radius_to_edge)),
        ];
        counts.iter().try_for_each(|(name, count)| writeln!(f, "{name:<26}{count:>12}"))?;
        figures.iter().try_for_each(|(name, figure)| writeln!(f, "{name:<26}{figure:>12}"))
    }
}
