//! Optimal Delaunay triangulation in space: tetrahedra whose linear interpolant of |x|² has the least error.
//!
//! With energy `E = 1/(d + 1) Σ |Ωᵢ| |xᵢ|² − ∫ |x|²` of the vertices' stars Ωᵢ and d = 3, the best place of a vertex is the average of the
//! circumcentres of its star, and the best connection of given vertices is Delaunay: Chen and Xu, Optimal Delaunay Triangulations (2004);
//! Alliez, Cohen-Steiner, Yvinec and Desbrun, Variational Tetrahedral Meshing (2005). The energy does not see slivers, so that flips and moves
//! that raise the worst elements follow.

mod cells;
mod flips;
mod polish;
mod shape;
mod smooth;

use crate::generate::{Progress, Solid};
use crate::{TetrahedralMesh, boundary, quality};
pub(crate) use cells::{Cells, Freedom};
use polish::Project;
pub(crate) use polish::{move_towards, raise_the_worst};
pub(crate) use shape::Floor;
use smooth::{move_vertices, reconnect, total_energy};

/// Distance from a surface within which a vertex lies on it, over the mean edge.
const ON_SURFACE: f64 = 1e-6;

/// Relative fall of the energy in one iteration below which more of them are of no use.
const CONVERGED: f64 = 1e-7;

/// Measures of a mesh after an iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// Energy of optimal Delaunay triangulation, m⁵.
    pub energy: f64,
    /// Smallest, 1 % and 50 % quantile of the elements' smallest dihedral angles, degrees.
    pub angles: [f64; 3],
    /// Largest dihedral angle, degrees.
    pub largest_angle: f64,
    /// Worst `3 r / R`.
    pub radius_ratio: f64,
}

/// A mesh after improvement, and how it became so.
#[derive(Clone, Debug, PartialEq)]
pub struct Improved {
    /// The mesh. Vertices keep their numbers, elements do not.
    pub mesh: TetrahedralMesh,
    /// The state before the first iteration and after each iteration of optimal Delaunay triangulation; its energy never rises.
    pub smoothing: Vec<Iteration>,
    /// The state after each pass over the worst elements, which may raise the energy.
    pub polishing: Vec<Iteration>,
}

/// Improves a mesh that has passed the check by up to `iterations` of optimal Delaunay triangulation, and as many passes over the worst
/// elements. The boundary stays, as do the faces between different sets and the faces, edges and points that sets name. The worst element is
/// never worse than before: smallest and largest dihedral angle, `3 r / R` and shortest edge over circumradius. Tells how many of the iterations and passes are done.
///
/// ```
/// let mesh = fem_mesh::box_mesh([1.0, 1.0, 1.0], 4, fem_mesh::Pattern::Alternating)?;
/// let improved = fem_mesh::generate::odt::improve_tetrahedra(&mesh, 5, &|_| ());
/// let volume: f64 = fem_mesh::volumes(&improved.mesh).iter().sum();
/// assert!((volume - 1.0).abs() < 1e-12);
/// # Ok::<(), fem_mesh::MeshError>(())
/// ```
pub fn improve_tetrahedra(mesh: &TetrahedralMesh, iterations: usize, progress: Progress) -> Improved {
    improve_with(mesh, Cells::new(mesh), iterations, &|_, _| None, progress)
}

/// Improves a mesh as [`improve_tetrahedra`] does, and lets the vertices of its boundary that lie on a surface slide on it, while the worst
/// elements are improved. Volume and boundary change by as much as two meshes of the surface differ.
pub fn improve_inside(mesh: &TetrahedralMesh, iterations: usize, surface: &Solid, progress: Progress) -> Improved {
    if iterations == 0 {
        return improve_tetrahedra(mesh, 0, progress);
    }
    let mut cells = Cells::new(mesh);
    let near = ON_SURFACE * cells.mean_edge_of_all();
    for vertex in boundary(mesh).into_iter().flatten() {
        let x = mesh.vertices[vertex];
        let is_on = surface.closest(&x).is_some_and(|place| (place - x).norm() <= near);
        if is_on && !cells.is_kept(vertex as u32) {
            cells.freedom[vertex] = Freedom::OnSurface;
        }
    }
    improve_with(mesh, cells, iterations, &|_, x| surface.closest(x), progress)
}

fn improve_with(
    mesh: &TetrahedralMesh,
    mut cells: Cells,
    iterations: usize,
    project: Project,
    progress: Progress,
) -> Improved {
    // Iterations and passes take about the same time.
    let tell = |done: f64| progress(done / (2.0 * iterations as f64));
    let mut smoothing: Vec<Iteration> = vec![state(&cells)];
    let floor_of = |cells: &Cells| Floor::of(cells.cells().map(|cell| cells.shape(cell)));
    for iteration in 0..iterations {
        tell(iteration as f64);
        let floor = floor_of(&cells);
        reconnect(&mut cells, &floor);
        move_vertices(&mut cells, &floor);
        let [before, after] = [smoothing[smoothing.len() - 1].energy, total_energy(&cells)];
        smoothing.push(state(&cells));
        if after >= before * (1.0 - CONVERGED) {
            break;
        }
    }
    let mut polishing = Vec::new();
    for pass in 0..iterations {
        tell(iterations as f64 + pass as f64);
        let floor = floor_of(&cells);
        if raise_the_worst(&mut cells, &floor, project) == 0 {
            break;
        }
        polishing.push(state(&cells));
    }
    let improved = cells.mesh(&mesh.sets);
    // Cosines decide about each change; the angles themselves decide about the result, to the last digit.
    let mesh = if is_nowhere_worse(&improved, mesh) { improved } else { mesh.clone() };
    Improved { mesh, smoothing, polishing }
}

fn is_nowhere_worse(new: &TetrahedralMesh, old: &TetrahedralMesh) -> bool {
    let (new, old) = (quality(new), quality(old));
    new.dihedral_angles[0].value >= old.dihedral_angles[0].value
        && new.dihedral_angles[1].value <= old.dihedral_angles[1].value
        && new.radius_ratio.value >= old.radius_ratio.value
}

fn state(cells: &Cells) -> Iteration {
    let shapes: Vec<_> = cells.cells().map(|cell| cells.shape(cell)).collect();
    let mut cosines: Vec<f64> = shapes.iter().map(|shape| shape.cosines[0]).collect();
    cosines.sort_by(|a, b| b.total_cmp(a));
    let angle = |part: f64| {
        let place = (part * cosines.len() as f64) as usize;
        cosines.get(place).map_or(f64::NAN, |cosine| cosine.acos().to_degrees())
    };
    Iteration {
        energy: total_energy(cells),
        angles: [0.0, 0.01, 0.5].map(angle),
        largest_angle: shapes.iter().map(|shape| shape.cosines[1].acos().to_degrees()).fold(0.0, f64::max),
        radius_ratio: shapes.iter().map(|shape| shape.radius_ratio).fold(f64::INFINITY, f64::min),
    }
}
