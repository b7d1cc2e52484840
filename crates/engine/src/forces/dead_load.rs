//! What pulls and pushes a body, as forces on its nodes.

use nalgebra::Vector3;

use crate::model::mass::Mass;
use crate::model::numbering::Numbering;
use crate::number::Real;
use fem_scene::Body;

/// Forces that stay as they are, N, in the engine's order: weight, body force, dead traction. `None` where the scene names
/// none of them.
pub fn dead<T: Real>(
    body: &Body,
    order: &Numbering,
    mass: &Mass<T>,
    corners: &[[u32; 4]],
    volumes: &[f64],
) -> Option<Vec<[T; 3]>> {
    if body.gravity.is_none() && body.body_force.is_none() && body.tractions.is_empty() {
        return None;
    }
    let mut load = vec![[T::default(); 3]; order.mesh_node.len()];
    if let Some(gravity) = body.gravity {
        let acceleration = vec![<[f64; 3]>::from(gravity).map(T::of); load.len()];
        mass.add_times(T::of(1.0), &acceleration, &mut load);
    }
    if let Some(force) = body.body_force {
        for (element, volume) in corners.iter().zip(volumes) {
            for &node in element {
                add(&mut load[node as usize], volume / 4.0, force);
            }
        }
    }
    for traction in &body.tractions {
        for face in &traction.faces {
            let [a, b, c] = face.map(|node| body.shape.mesh.vertices[node]);
            let area = 0.5 * (b - a).cross(&(c - a)).norm();
            for &node in face {
                add(&mut load[order.engine_node[node] as usize], area / 3.0, traction.force_per_area);
            }
        }
    }
    Some(load)
}

fn add<T: Real>(sum: &mut [T; 3], share: f64, force: Vector3<f64>) {
    let force = share * force;
    for i in 0..3 {
        sum[i] += T::of(force[i]);
    }
}
