//! The measures of shape whose distributions describe the quality of a mesh.

use super::Distribution;
use super::tetrahedra::shape;
use super::triangles::measure;
use crate::boundary::neighbours;
use crate::{SurfaceMesh, TetrahedralMesh, volumes};

/// Distributions of the shapes of tetrahedra that have passed [`check`](crate::check):
///
/// - *dihedral angle*: the six angles between faces, °. Small ones make the stiffness ill-conditioned, large ones spoil the gradients of
///   the solution (Shewchuk, What Is a Good Linear Finite Element?, 2002).
/// - *radius ratio*: `3 r / R` of the inscribed and circumscribed spheres, 1 for a regular tetrahedron and 0 for a flat one.
/// - *aspect ratio*: longest edge over `2 √6 r`, 1 for a regular tetrahedron (Stimpson et al., The Verdict Geometric Quality
///   Library, 2007).
/// - *circumradius / shortest edge*: √6/4 ≈ 0.61 for a regular tetrahedron; it does not see slivers.
/// - *volume ratio of neighbours*: the larger volume over the smaller one of two tetrahedra with a common face.
pub fn tetrahedron_distributions(mesh: &TetrahedralMesh) -> Vec<Distribution> {
    let shapes: Vec<_> = mesh.elements.iter().map(|element| shape(element.map(|i| mesh.vertices[i]))).collect();
    let volumes = volumes(mesh);
    let ratio = |[a, b]: [usize; 2]| (volumes[a] / volumes[b]).max(volumes[b] / volumes[a]);
    vec![
        angles("dihedral angle", shapes.iter().flat_map(|shape| shape.angles)),
        Distribution::new("radius ratio", "", tenths(), 1.0, shapes.iter().map(|shape| shape.radius_ratio)),
        open("aspect ratio", &[1.0, 1.25, 1.5, 2.0, 3.0, 5.0, 10.0, 100.0], shapes.iter().map(|s| s.aspect_ratio)),
        open(
            "circumradius / shortest edge",
            &[0.6, 0.7, 0.8, 0.9, 1.0, 1.25, 1.5, 2.0, 5.0],
            shapes.iter().map(|s| s.radius_to_edge),
        ),
        open(
            "volume ratio of neighbours",
            &[1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0],
            neighbours(mesh).into_iter().map(ratio),
        ),
    ]
}

/// Distributions of the shapes of triangles: *smallest angle* and *largest angle* of each, °, and *circumradius / shortest edge*, which
/// is 1/√3 ≈ 0.58 for an equilateral triangle and `1 / (2 sin α)` for a smallest angle α. Triangles without area are left out.
pub fn triangle_distributions(mesh: &SurfaceMesh) -> Vec<Distribution> {
    let shapes = mesh.elements.iter().map(|element| measure(element.map(|i| mesh.vertices[i])));
    let shapes: Vec<_> = shapes.filter(|shape| !shape.is_flat).collect();
    vec![
        angles("smallest angle", shapes.iter().map(|shape| shape.angles[0])),
        angles("largest angle", shapes.iter().map(|shape| shape.angles[1])),
        open(
            "circumradius / shortest edge",
            &[0.57, 0.6, 0.65, 0.7, 0.75, 0.8, 0.9, 1.0, 1.5, 2.0, 5.0],
            shapes.iter().map(|shape| shape.radius_to_edge),
        ),
    ]
}

fn angles(name: &'static str, values: impl Iterator<Item = f64>) -> Distribution {
    Distribution::new(name, "°", (0..18).map(|bin| f64::from(10 * bin)).collect(), 180.0, values)
}

fn tenths() -> Vec<f64> {
    (0..10).map(|bin| f64::from(bin) / 10.0).collect()
}

fn open(name: &'static str, bins: &[f64], values: impl Iterator<Item = f64>) -> Distribution {
    Distribution::new(name, "", bins.to_vec(), f64::INFINITY, values)
}
