//! The bodies on which methods are compared: beams of 4 × 1 × 1 m and strips of 4 × 1 m whose inner nodes lie on lattices that are isotropic
//! for springs, clamped at one end and bent by their weight.

use fem_mesh::{SurfaceMesh, TetrahedralMesh};
use fem_model::BodyMesh;
use nalgebra::Vector3;

/// Length and height of a body, m.
pub const LENGTH: usize = 4;

/// Thickness of a strip, m.
const THICKNESS: f64 = 0.2;

/// Dimensions of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A beam of tetrahedra on a body-centred cubic lattice.
    Beam,
    /// A strip of equilateral triangles in plane stress.
    Strip,
}

impl Shape {
    /// The word in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Beam => "beam",
            Self::Strip => "strip",
        }
    }

    /// The mesh with this many cells across, and the x (m) up to which its nodes are fixed.
    pub fn mesh(self, cells: usize) -> (BodyMesh, f64) {
        match self {
            Self::Beam => (BodyMesh::solid(block([LENGTH * cells, cells, cells], 1.0 / cells as f64)), 1e-9),
            Self::Strip => (strip(LENGTH * 3 * cells, 3 * cells, 1.0 / (3 * cells) as f64), 0.51 / (3 * cells) as f64),
        }
    }
}

/// A box of cubes with edges of `edge` m. Every cube has a node at its centre: tetrahedra join the centres of two cubes to each edge of their
/// common face, and a centre to two triangles of a face of the boundary.
pub fn block(cells: [usize; 3], edge: f64) -> TetrahedralMesh {
    let [nx, ny, nz] = cells;
    let corner = |x: [usize; 3]| x[0] + (nx + 1) * (x[1] + (ny + 1) * x[2]);
    let corners = (nx + 1) * (ny + 1) * (nz + 1);
    let center = |x: [usize; 3]| corners + x[0] + nx * (x[1] + ny * x[2]);
    let grid = |[nx, ny, nz]: [usize; 3]| {
        (0..nz).flat_map(move |k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])))
    };
    let at = |x: [usize; 3]| Vector3::from(x.map(|x| x as f64));
    let mut vertices: Vec<_> = grid([nx + 1, ny + 1, nz + 1]).map(at).collect();
    vertices.extend(grid(cells).map(|x| at(x) + Vector3::repeat(0.5)));
    vertices.iter_mut().for_each(|x| *x *= edge);
    let mut elements = Vec::new();
    for x in grid(cells) {
        for axis in 0..3 {
            for side in 0..2 {
                let face = face_of(x, axis, side).map(corner);
                if side == 0 && x[axis] > 0 {
                    let mut before = x;
                    before[axis] -= 1;
                    elements.extend((0..4).map(|i| [face[i], face[(i + 1) % 4], center(x), center(before)]));
                } else if [0, cells[axis] - 1][side] == x[axis] {
                    elements.extend([[face[0], face[1], face[2], center(x)], [face[0], face[2], face[3], center(x)]]);
                }
            }
        }
    }
    oriented(vertices, elements)
}

/// The corners of a face of a cube, one after the other around it.
fn face_of(mut x: [usize; 3], axis: usize, side: usize) -> [[usize; 3]; 4] {
    let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
    x[axis] += side;
    [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[s, t]| {
        let mut place = x;
        (place[b], place[c]) = (x[b] + s, x[c] + t);
        place
    })
}

/// The mesh with every tetrahedron of positive volume.
fn oriented(vertices: Vec<Vector3<f64>>, mut elements: Vec<[usize; 4]>) -> TetrahedralMesh {
    for element in &mut elements {
        let [a, b, c, d] = element.map(|node| vertices[node]);
        if (b - a).cross(&(c - a)).dot(&(d - a)) < 0.0 {
            element.swap(2, 3);
        }
    }
    TetrahedralMesh::new(vertices, elements)
}

/// Equilateral triangles in rows, every other of which begins half an edge further right.
fn strip(columns: usize, rows: usize, edge: f64) -> BodyMesh {
    let place =
        |i: usize, j: usize| Vector3::new(i as f64 + 0.5 * (j % 2) as f64, 0.75f64.sqrt() * j as f64, 0.0) * edge;
    let node = |i: usize, j: usize| i + (columns + 1) * j;
    let vertices = (0..=rows).flat_map(|j| (0..=columns).map(move |i| place(i, j))).collect();
    let pair = |(i, j): (usize, usize)| {
        let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
        if j % 2 == 0 { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] }
    };
    let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    BodyMesh::flat(SurfaceMesh::new(vertices, cells.flat_map(pair).collect()), THICKNESS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_beam_and_a_strip_fill_their_shape_with_elements_of_one_size() {
        let beam = Shape::Beam.mesh(3).0;
        let volumes = beam.volumes();
        assert!((volumes.iter().sum::<f64>() - 4.0).abs() < 1e-12, "{volumes:?}");
        assert!(volumes.iter().all(|volume| (volume * 12.0 * 27.0 - 1.0).abs() < 1e-12), "{volumes:?}");
        let strip = Shape::Strip.mesh(2).0;
        let area = 0.75f64.sqrt() * 4.0 * 0.2;
        assert!((strip.volumes().iter().sum::<f64>() - area).abs() < 1e-12);
    }
}
