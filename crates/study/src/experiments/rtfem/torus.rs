//! The thesis' torus as tetrahedra: a closed surface filled by isosurface stuffing and improved, with a wanted number of elements.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::{Mutex, PoisonError};

use fem_mesh::generate::odt::improve_inside;
use fem_mesh::generate::{Solid, stuff};
use fem_mesh::{MeshSet, SurfaceMesh, TetrahedralMesh, boundary, parts};
use nalgebra::{Rotation3, Vector3};

use crate::study::Result;

/// Radius of the circle in the middle of the tube, and of the tube, m. The thesis gives their ratio, 1.92.
pub const RING: f64 = 0.96;
pub const TUBE: f64 = 0.5;

/// Numbers of elements that the thesis times on its graphics card, and on its processor.
pub const GPU_SIZES: [usize; 5] = [660, 1119, 2000, 3252, 5392];
pub const CPU_SIZES: [usize; 3] = [182, 245, 572];

/// All of them, ascending.
pub fn sizes() -> Vec<usize> {
    let mut sizes = [&CPU_SIZES[..], &GPU_SIZES[..]].concat();
    sizes.sort_unstable();
    sizes
}

/// Quadrilaterals around the ring and around the tube of the surface.
const AROUND: [usize; 2] = [96, 48];

/// Passes of improvement.
const IMPROVE: usize = 5;

/// Deviation from the wanted number of elements at which the search ends, and the largest that is accepted.
const GOOD: f64 = 0.02;
pub const ACCEPTED: f64 = 0.05;

/// A torus around the z axis.
#[derive(Clone, Debug)]
pub struct Torus {
    /// Tetrahedra, with the sets `left` and `right`: triangles whose centroid is farther than the ring's radius from the plane x = 0.
    pub mesh: TetrahedralMesh,
    /// Requested mean edge, m.
    pub edge: f64,
}

impl Torus {
    /// A torus with this number of elements within 5 %; several parts need the same, which is searched for once.
    pub fn of_size(wanted: usize) -> Result<Self> {
        static FOUND: Mutex<BTreeMap<usize, Torus>> = Mutex::new(BTreeMap::new());
        let mut found = FOUND.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(torus) = found.get(&wanted) {
            return Ok(torus.clone());
        }
        let torus = Self::search(wanted)?;
        found.insert(wanted, torus.clone());
        Ok(torus)
    }

    /// A lattice of edges that fit gives few different numbers of elements on a body as symmetric as a torus, so the lattice is also turned about
    /// the axis x.
    fn search(wanted: usize) -> Result<Self> {
        let mut best: Option<(f64, Self)> = None;
        let parts = (0..=16).map(|i| if i % 2 == 0 { 1.0 + 0.01 * i as f64 } else { 1.0 - 0.01 * i as f64 });
        'turns: for turn in [0.0, 0.3, 0.6, 0.9, 1.2, 1.5] {
            let first = edge_for(wanted, turn)?;
            for edge in parts.clone().map(|part| first * part) {
                let raw = filled(edge, turn)?;
                if deviation(&raw, wanted) > 2.0 * ACCEPTED {
                    continue;
                }
                let mesh = finished(raw, turn);
                let off = deviation(&mesh, wanted);
                if is_torus(&mesh) && best.as_ref().is_none_or(|(least, _)| off < *least) {
                    best = Some((off, Self { mesh: with_caps(mesh), edge }));
                }
                if best.as_ref().is_some_and(|(least, _)| *least <= GOOD) {
                    break 'turns;
                }
            }
        }
        match best {
            Some((off, torus)) if off <= ACCEPTED => Ok(torus),
            _ => Err(format!("no edge gives a torus of {wanted} elements within {:.0} %", 100.0 * ACCEPTED).into()),
        }
    }

    /// A torus of edges of this length (m), without improvement.
    pub fn of_edge(edge: f64) -> Result<Self> {
        let mesh = filled(edge, 0.0)?;
        match is_torus(&mesh) {
            true => Ok(Self { mesh: with_caps(mesh), edge }),
            false => Err(format!("edges of {edge} m are too long for a torus").into()),
        }
    }
}

/// Part by which the number of elements differs from the wanted one.
pub fn deviation(mesh: &TetrahedralMesh, wanted: usize) -> f64 {
    (mesh.elements.len() as f64 / wanted as f64 - 1.0).abs()
}

/// The edge (m) of about this number of elements: their number is close to inversely proportional to the cube of the edge.
fn edge_for(wanted: usize, turn: f64) -> Result<f64> {
    let mut edge = 0.3;
    for _ in 0..4 {
        let ratio = filled(edge, turn)?.elements.len() as f64 / wanted as f64;
        edge *= ratio.cbrt().clamp(0.3, 2.0);
        edge = edge.min(1.2 * TUBE);
    }
    Ok(edge)
}

/// Tetrahedra inside the torus, turned about the axis x by an angle.
fn filled(edge: f64, turn: f64) -> Result<TetrahedralMesh> {
    Ok(stuff(&turned_surface(turn), edge)?)
}

/// The improved mesh, turned back.
fn finished(mesh: TetrahedralMesh, turn: f64) -> TetrahedralMesh {
    let mut mesh = improve_inside(&mesh, IMPROVE, &Solid::new(&turned_surface(turn)), &|_| ()).mesh;
    let back = Rotation3::from_axis_angle(&Vector3::x_axis(), -turn);
    mesh.vertices.iter_mut().for_each(|x| *x = back * *x);
    mesh
}

/// Triangles of the surface, turned about the axis x by an angle.
fn turned_surface(turn: f64) -> SurfaceMesh {
    let [n, m] = AROUND;
    let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), turn);
    let vertex = |i: usize| {
        let (a, b) = (TAU * (i / m) as f64 / n as f64, TAU * (i % m) as f64 / m as f64);
        let radius = RING + TUBE * b.cos();
        turn * Vector3::new(radius * a.cos(), radius * a.sin(), TUBE * b.sin())
    };
    let triangles = (0..n * m).flat_map(|i| {
        let (around, next) = (m * (i / m), (i + m) % (n * m));
        let (up, across) = (around + (i + 1) % m, m * (next / m) + (i + 1) % m);
        [[i, next, across], [i, across, up]]
    });
    SurfaceMesh::new((0..n * m).map(vertex).collect(), triangles.collect())
}

/// Returns true if the mesh is one piece whose boundary has the Euler characteristic of a torus, zero: edges are 3/2 of the triangles.
fn is_torus(mesh: &TetrahedralMesh) -> bool {
    let faces = boundary(mesh);
    let mut nodes: Vec<usize> = faces.iter().flatten().copied().collect();
    nodes.sort_unstable();
    nodes.dedup();
    2 * nodes.len() == faces.len() && parts(mesh.vertices.len(), &mesh.elements).iter().all(|part| *part == 0)
}

/// Adds the sets `left` and `right`.
fn with_caps(mut mesh: TetrahedralMesh) -> TetrahedralMesh {
    let faces = boundary(&mesh);
    for (name, side) in [("left", -1.0), ("right", 1.0)] {
        let is_inside = |face: &&[usize; 3]| face.iter().map(|&i| side * mesh.vertices[i].x).sum::<f64>() > 3.0 * RING;
        let mut chosen: Vec<[usize; 3]> = faces.iter().filter(is_inside).copied().collect();
        chosen.iter_mut().for_each(|face| face.sort_unstable());
        chosen.sort_unstable();
        mesh.sets.insert(name.to_owned(), MeshSet { faces: chosen, ..MeshSet::default() });
    }
    mesh
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use fem_mesh::{check, quality, surface_quality, volumes};

    use super::*;

    #[test]
    fn small_sizes_of_the_thesis_are_tori_within_five_percent_without_slivers() {
        for wanted in [182, 245, 660] {
            let torus = Torus::of_size(wanted).unwrap();
            check(&torus.mesh, "torus".as_ref()).unwrap();
            assert!(deviation(&torus.mesh, wanted) <= ACCEPTED, "{wanted}: {}", torus.mesh.elements.len());
            assert!(is_torus(&torus.mesh), "{wanted}");
            let angles = quality(&torus.mesh).dihedral_angles.map(|angle| angle.value);
            assert!(angles[0] > 10.0 && angles[1] < 165.0, "{wanted}: {angles:?}");
            let volume: f64 = volumes(&torus.mesh).iter().sum();
            let exact = 2.0 * PI * PI * RING * TUBE * TUBE;
            assert!(volume < exact && volume > 0.7 * exact, "{wanted}: {volume} m³ of {exact} m³");
        }
    }

    #[test]
    fn the_surface_is_closed_and_its_caps_are_opposite_and_alike() {
        let surface = turned_surface(0.4);
        let found = surface_quality(&surface);
        assert!(found.is_closed() && found.flipped_edges == 0);
        let torus = Torus::of_edge(0.2).unwrap();
        let [left, right] = ["left", "right"].map(|name| torus.mesh.sets[name].faces.len());
        assert!(left > 50 && left == right, "{left} {right}");
    }
}
