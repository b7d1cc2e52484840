//! What pulls and pushes a body, as forces on its nodes.

use nalgebra::Vector3;

use crate::model::mass::Mass;
use crate::model::numbering::Numbering;
use crate::number::Real;
use fem_scene::{Body, Scene};

/// Forces that stay as they are, N, in the engine's order: weight, body force, dead traction. `None` where the scene names
/// none of them.
pub fn dead<T: Real>(
    scene: &Scene,
    body: &Body,
    order: &Numbering,
    mass: &Mass<T>,
    corners: &[[u32; 4]],
    volumes: &[f64],
) -> Option<Vec<[T; 3]>> {
    let tractions: Vec<_> = scene
        .traction
        .iter()
        .zip(&body.loaded_faces)
        .filter_map(|(t, faces)| Some((t.force_per_area?, faces)))
        .collect();
    if scene.gravity.is_none() && scene.body_force.is_none() && tractions.is_empty() {
        return None;
    }
    let mut load = vec![[T::default(); 3]; order.mesh_node.len()];
    if let Some(gravity) = &scene.gravity {
        let acceleration = vec![gravity.acceleration.map(T::of); load.len()];
        mass.add_times(T::of(1.0), &acceleration, &mut load);
    }
    if let Some(force) = &scene.body_force {
        for (element, volume) in corners.iter().zip(volumes) {
            for &node in element {
                add(&mut load[node as usize], volume / 4.0, force.density);
            }
        }
    }
    for (force, faces) in tractions {
        for face in faces {
            let [a, b, c] = face.map(|node| body.shape.mesh.vertices[node]);
            let area = 0.5 * (b - a).cross(&(c - a)).norm();
            for &node in face {
                add(&mut load[order.engine_node[node] as usize], area / 3.0, force);
            }
        }
    }
    Some(load)
}

fn add<T: Real>(sum: &mut [T; 3], share: f64, force: [f64; 3]) {
    let force = share * Vector3::from(force);
    for i in 0..3 {
        sum[i] += T::of(force[i]);
    }
}
