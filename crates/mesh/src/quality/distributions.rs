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

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    use super::*;
    use crate::{Pattern, box_mesh};

    #[test]
    fn a_regular_tetrahedron_has_the_best_values() {
        let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]].map(Vector3::from);
        let found = tetrahedron_distributions(&TetrahedralMesh::new(vertices.to_vec(), vec![[0, 1, 2, 3]]));
        let best = [(1.0_f64 / 3.0).acos().to_degrees(), 1.0, 1.0, 6.0_f64.sqrt() / 4.0];
        for (distribution, best) in found.iter().zip(best) {
            assert_relative_eq!(distribution.quantile(0.0), best, max_relative = 1e-13);
            assert_relative_eq!(distribution.quantile(1.0), best, max_relative = 1e-13);
        }
        assert_eq!(found.iter().map(Distribution::count).collect::<Vec<_>>(), [6, 1, 1, 1, 0]);
    }

    #[test]
    fn the_corner_of_a_cube_has_the_values_of_its_inscribed_and_circumscribed_spheres() {
        let vertices = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
        let found = tetrahedron_distributions(&TetrahedralMesh::new(vertices, vec![[0, 1, 2, 3]]));
        let r = 1.0 / (3.0 + 3.0_f64.sqrt());
        assert_relative_eq!(found[2].quantile(0.5), 2.0_f64.sqrt() / (2.0 * 6.0_f64.sqrt() * r), max_relative = 1e-13);
        assert_relative_eq!(found[3].quantile(0.5), 3.0_f64.sqrt() / 2.0, max_relative = 1e-13);
    }

    #[test]
    fn neighbours_of_different_size_have_the_ratio_of_their_heights() {
        let mut vertices = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z(), -4.0 * Vector3::z()];
        vertices[4].x = 0.3;
        let mesh = TetrahedralMesh::new(vertices, vec![[0, 1, 2, 3], [0, 2, 1, 4]]);
        let ratios = &tetrahedron_distributions(&mesh)[4];
        assert_eq!(ratios.count(), 1);
        assert_relative_eq!(ratios.quantile(0.5), 4.0, max_relative = 1e-14);
        // 48 tetrahedra have 192 faces, 48 of them on the boundary.
        assert_eq!(tetrahedron_distributions(&box_mesh([1.0; 3], 2, Pattern::Alternating).unwrap())[4].count(), 72);
    }

    #[test]
    fn the_radius_of_a_triangle_belongs_to_its_smallest_angle() {
        let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.2, 0.4, 0.0], [0.5, 0.0, 0.0]].map(Vector3::from);
        let found = triangle_distributions(&SurfaceMesh::new(vertices.to_vec(), vec![[0, 1, 2], [0, 3, 1]]));
        assert_eq!(found[0].count(), 1, "the second triangle is flat");
        let angle = found[0].quantile(0.5).to_radians();
        assert_relative_eq!(found[2].quantile(0.5), 0.5 / angle.sin(), max_relative = 1e-13);
    }
}
