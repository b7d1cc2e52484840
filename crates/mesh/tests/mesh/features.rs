//! Sharp edges and corners of bodies that are not aligned with the lattice.

use std::f64::consts::{PI, TAU};

use fem_mesh::generate::{Featured, keep_features, stuff};
use fem_mesh::{Pattern, SurfaceMesh, TetrahedralMesh, boundary, box_mesh, check, quality, surface_quality, volumes};
use nalgebra::{Rotation3, Vector3};

fn turned(mut surface: SurfaceMesh) -> SurfaceMesh {
    let rotation = Rotation3::from_euler_angles(0.3, 0.5, 0.7);
    surface.vertices.iter_mut().for_each(|x| *x = rotation * *x);
    surface
}

fn cube() -> SurfaceMesh {
    let mesh = box_mesh([1.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap();
    turned(SurfaceMesh::new(mesh.vertices.clone(), boundary(&mesh)))
}

/// A cylinder of radius ½ and height 1.
fn cylinder(n: usize) -> SurfaceMesh {
    let rim = |i: usize, z: f64| {
        let (sin, cos) = (TAU * i as f64 / n as f64).sin_cos();
        Vector3::new(0.5 * cos, 0.5 * sin, z)
    };
    let mut vertices: Vec<Vector3<f64>> = [0.0, 1.0].into_iter().flat_map(|z| (0..n).map(move |i| rim(i, z))).collect();
    vertices.extend([Vector3::zeros(), Vector3::z()]);
    let sector = |i: usize| {
        let j = (i + 1) % n;
        [[i, j, n + j], [i, n + j, n + i], [j, i, 2 * n], [n + i, n + j, 2 * n + 1]]
    };
    turned(SurfaceMesh::new(vertices, (0..n).flat_map(sector).collect()))
}

fn volume(mesh: &TetrahedralMesh) -> f64 {
    volumes(mesh).iter().sum()
}

/// Panics unless the mesh is valid, closed, and as well shaped as promised.
fn is_sound(found: &Featured) {
    check(&found.mesh, "features".as_ref()).unwrap();
    let surface = surface_quality(&SurfaceMesh::new(found.mesh.vertices.clone(), boundary(&found.mesh)));
    assert!(surface.is_closed() && surface.euler_characteristic == 2, "{surface:?}");
    let angles = quality(&found.mesh).dihedral_angles.map(|angle| angle.value);
    assert!(angles[0] > 15.0 && angles[1] < 160.0, "{angles:?}");
}

#[test]
fn a_turned_cube_keeps_its_edges_and_corners_and_so_its_volume() {
    let surface = cube();
    for edge in [0.2, 0.12] {
        let mesh = stuff(&surface, edge).unwrap();
        assert!(volume(&mesh) < 0.98);
        let found = keep_features(&mesh, &surface, 40.0);
        is_sound(&found);
        assert!((found.length - 12.0).abs() < 1e-12 && found.kept > 11.99, "{} of {}", found.kept, found.length);
        assert!((volume(&found.mesh) - 1.0).abs() < 1e-6, "{}", volume(&found.mesh));
        for corner in surface.vertices.iter().filter(|x| (x.norm() - 3.0_f64.sqrt()).abs() < 1e-9) {
            assert!(found.mesh.vertices.iter().any(|x| (x - corner).norm() < 1e-9), "{corner:?}");
        }
    }
}

#[test]
fn a_turned_cylinder_keeps_its_rims() {
    let surface = cylinder(96);
    let enclosed = surface_quality(&surface).volume;
    let mesh = stuff(&surface, 0.1).unwrap();
    let found = keep_features(&mesh, &surface, 40.0);
    is_sound(&found);
    assert!((found.kept / TAU - 1.0).abs() < 0.02, "{} {}", found.kept, found.length);
    // The curved side is a polyhedron inside the cylinder, which takes a part of h²/R² of the volume.
    let [before, after] = [&mesh, &found.mesh].map(|mesh| 1.0 - volume(mesh) / enclosed);
    assert!(after.abs() < 0.4 * before, "{before} {after}");
}

#[test]
fn a_smooth_body_has_no_features_and_keeps_its_volume() {
    let surface = cylinder(96);
    let mesh = stuff(&surface, 0.15).unwrap();
    let found = keep_features(&mesh, &surface, 120.0);
    is_sound(&found);
    assert_eq!((found.length, found.kept), (0.0, 0.0));
    assert!((volume(&found.mesh) / volume(&mesh) - 1.0).abs() < 0.01);
    assert!(volume(&mesh) < 0.25 * PI);
}

#[test]
fn a_closed_curve_without_corners_is_parted() {
    // Two cones with one rim.
    let n = 24;
    let rim = |i: usize| (TAU * i as f64 / n as f64).sin_cos();
    let mut vertices: Vec<Vector3<f64>> = (0..n).map(|i| Vector3::new(rim(i).1, rim(i).0, 0.0)).collect();
    vertices.extend([Vector3::z(), -Vector3::z()]);
    let sides = |i: usize| [[i, (i + 1) % n, n], [(i + 1) % n, i, n + 1]];
    let surface = SurfaceMesh::new(vertices, (0..n).flat_map(sides).collect());
    let found = keep_features(&stuff(&surface, 0.2).unwrap(), &surface, 60.0);
    check(&found.mesh, "cones".as_ref()).unwrap();
    assert!((found.length - 48.0 * (PI / 24.0).sin()).abs() < 1e-12, "{}", found.length);
    // A path from a point to itself would be none.
    assert!(found.kept > 0.95 * found.length, "{} of {}", found.kept, found.length);
}
