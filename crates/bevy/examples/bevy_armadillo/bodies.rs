//! The two bodies: one of a scene file, one of a mesh that is made here.

use std::f64::consts::TAU;

use bevy::math::DVec3;
use bevy::prelude::*;
use fem_bevy::{SoftBody, SoftBodyMaterial, SoftBodyMeshSync, SoftBodyPlane, SoftBodyPlanes};
use fem_mesh::SurfaceMesh;
use fem_mesh::generate::stuff;

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data");

/// Spawns the armadillo, the donut and the floor.
pub fn spawn(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) -> Result {
    let mut of_color = |color| {
        MeshMaterial3d(materials.add(StandardMaterial { perceptual_roughness: 0.6, ..Color::from(color).into() }))
    };
    commands.spawn((
        SoftBody::scene("arma-engine", DATA),
        // Softer than in the scene, so that it vibrates visibly.
        SoftBodyMaterial { model: "neo_hookean".to_owned(), young: 1.5e5, ..default() },
        SoftBodyMeshSync::default(),
        of_color(Srgba::rgb(0.45, 0.62, 0.35)),
    ));

    // 0.22 m from the axis to the middle of the tube, whose radius is 0.09 m.
    let surface = torus(0.22, 0.09, [96, 48]);
    let tetrahedra = stuff(&surface, 0.06)?;
    let floor = SoftBodyPlane { point: DVec3::NEG_Y * 0.65, normal: DVec3::Y, friction: 0.4 };
    commands.spawn((
        SoftBody::from_mesh(tetrahedra).with_display(surface).with_dt(0.01).with_gravity(DVec3::new(0.0, -9.81, 0.0)),
        SoftBodyMaterial { young: 4e4, density: 500.0, ..default() },
        SoftBodyPlanes(vec![floor]),
        SoftBodyMeshSync::default(),
        Transform::from_xyz(0.95, 0.65, 0.1),
        of_color(Srgba::rgb(0.85, 0.5, 0.3)),
    ));
    commands.spawn((Mesh3d(meshes.add(Plane3d::default().mesh().size(80.0, 80.0))), of_color(Srgba::gray(0.55))));
    Ok(())
}

/// A torus around the z axis, leaning back by 35°. Radii in m; number of vertices around the axis and around the tube.
fn torus(radius: f64, tube: f64, [around, across]: [usize; 2]) -> SurfaceMesh {
    let lean = DVec3::new(0.0, 35f64.to_radians().cos(), -35f64.to_radians().sin());
    let depth = DVec3::X.cross(lean);
    let vertex = |i: usize| {
        let [a, b] = [(i / across) as f64 / around as f64, (i % across) as f64 / across as f64].map(|part| TAU * part);
        let distance = radius + tube * b.cos();
        let x = distance * a.cos() * DVec3::X + distance * a.sin() * lean + tube * b.sin() * depth;
        x.to_array().into()
    };
    let number = |i: usize, j: usize| (i % around) * across + j % across;
    let triangles = (0..around * across).flat_map(|at| {
        let (i, j) = (at / across, at % across);
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    SurfaceMesh::new((0..around * across).map(vertex).collect(), triangles.collect())
}
