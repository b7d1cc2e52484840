//! Cages: tetrahedra that contain a surface wholly.

use fem_mesh::generate::cage;
use fem_mesh::{
    Pattern, SurfaceMesh, TetrahedralMesh, boundary, box_mesh, check, quality, read_surface, self_intersections,
    surface_quality, volumes,
};
use nalgebra::{Matrix3, Vector3};

use crate::shipped::data;
use crate::stuffing::{joined, sphere, torus};

/// The first vertex of each element, and the matrix that makes barycentric coordinates of the way from there.
fn coordinates(mesh: &TetrahedralMesh) -> Vec<(Vector3<f64>, Matrix3<f64>)> {
    let of_element = |element: &[usize; 4]| {
        let [a, b, c, d] = element.map(|i| mesh.vertices[i]);
        (a, Matrix3::from_columns(&[b - a, c - a, d - a]).try_inverse().unwrap())
    };
    mesh.elements.iter().map(of_element).collect()
}

/// Returns true if a point has no negative barycentric coordinate in one of the elements.
fn is_inside(elements: &[(Vector3<f64>, Matrix3<f64>)], point: &Vector3<f64>) -> bool {
    elements.iter().any(|(a, inverse)| {
        let weights = inverse * (point - a);
        weights.min().min(1.0 - weights.sum()) >= -1e-12
    })
}

/// Panics unless the mesh is valid, has its bounds, and contains the surface.
fn encloses(mesh: &TetrahedralMesh, surface: &SurfaceMesh) {
    check(mesh, "cage".as_ref()).unwrap();
    let [smallest, largest] = quality(mesh).dihedral_angles.map(|angle| angle.value);
    assert!(smallest >= 10.7 && largest <= 164.8, "{smallest} {largest}");
    let outer = SurfaceMesh::new(mesh.vertices.clone(), boundary(mesh));
    let found = surface_quality(&outer);
    assert!(found.is_closed() && found.is_manifold(), "{found}");
    // Skinning weights of every vertex, and of the centre of every triangle.
    let elements = coordinates(mesh);
    let centre = |element: &[usize; 3]| element.iter().map(|&i| surface.vertices[i]).sum::<Vector3<f64>>() / 3.0;
    for point in surface
        .vertices
        .iter()
        .copied()
        .chain(surface.elements.iter().map(centre))
        .step_by(1 + surface.vertices.len() / 200)
    {
        assert!(is_inside(&elements, &point), "{point} is not inside");
    }
    // No triangle crosses the boundary: together they cross no more often than each alone.
    let both = joined(outer.clone(), surface.clone());
    let count = |surface: &SurfaceMesh| self_intersections(surface).count;
    assert_eq!(count(&both), count(&outer) + count(surface));
}

#[test]
fn every_vertex_and_every_triangle_lies_in_the_cage() {
    for edge in [0.7, 0.3] {
        encloses(
            &cage(&sphere(3, Vector3::new(0.3, -0.2, 0.1)), edge).unwrap(),
            &sphere(3, Vector3::new(0.3, -0.2, 0.1)),
        );
        encloses(&cage(&torus(40, 20), edge).unwrap(), &torus(40, 20));
    }
}

#[test]
fn spikes_sheets_and_long_triangles_are_enclosed() {
    let mut spike = sphere(3, Vector3::zeros());
    spike.vertices[0] *= 3.0;
    encloses(&cage(&spike, 0.5).unwrap(), &spike);
    let long = box_mesh([4.0, 0.03, 1.0], 1, Pattern::Alternating)
        .or_else(|_| box_mesh([4.0, 1.0, 1.0], 1, Pattern::Alternating))
        .unwrap();
    let mut thin = SurfaceMesh::new(long.vertices.clone(), boundary(&long));
    thin.vertices.iter_mut().for_each(|x| *x = Vector3::new(x.x, 0.01 * x.y + 0.2 * x.x, x.z));
    encloses(&cage(&thin, 0.5).unwrap(), &thin);
    let sheet = SurfaceMesh::new(
        vec![Vector3::zeros(), 2.0 * Vector3::x(), 2.0 * Vector3::y(), Vector3::new(1.0, 1.0, 2.0)],
        vec![[0, 1, 2], [1, 3, 2]],
    );
    encloses(&cage(&sheet, 0.4).unwrap(), &sheet);
}

#[test]
fn the_armadillo_lies_in_its_cage() {
    let surface = read_surface(&data("own/armadillo_own_37k.obj")).unwrap();
    let mesh = cage(&surface, 0.15).unwrap();
    encloses(&mesh, &surface);
    // The shipped cage has 602 tetrahedra and 0.108 m³.
    let volume: f64 = volumes(&mesh).iter().sum();
    assert!(mesh.elements.len() < 602 && volume < 0.108, "{} {volume}", mesh.elements.len());
}
