//! Pulling bodies with the left mouse button.

use bevy::prelude::*;
use fem_bevy::{SoftBodyHit, SoftBodyPull, SoftBodyState};

/// Stiffness of each spring of a pull, N/m.
const STIFFNESS: f64 = 1e3;

/// Takes hold of the body under the cursor, pulls it along, and lets it go.
pub fn pull(
    mut commands: Commands,
    buttons: Res<ButtonInput<MouseButton>>,
    window: Single<&Window>,
    camera: Single<(&Camera, &GlobalTransform)>,
    bodies: Query<(Entity, &SoftBodyState, &GlobalTransform)>,
    mut pulls: Query<(Entity, &mut SoftBodyPull, &GlobalTransform)>,
) {
    if buttons.just_released(MouseButton::Left) {
        for (body, ..) in &pulls {
            commands.entity(body).remove::<SoftBodyPull>();
        }
        return;
    }
    let (camera, view) = *camera;
    let cursor = window.cursor_position();
    let Some(ray) = cursor.and_then(|cursor| camera.viewport_to_world(view, cursor).ok()) else { return };
    if buttons.just_pressed(MouseButton::Left) {
        let hits = bodies.iter().filter_map(|(body, state, place)| Some((body, state, state.pick(ray, place)?)));
        let distance = |(_, _, hit): &(Entity, &SoftBodyState, SoftBodyHit)| hit.distance;
        if let Some((body, state, hit)) = hits.min_by(|a, b| distance(a).total_cmp(&distance(b))) {
            commands.entity(body).insert(SoftBodyPull::new(state, &hit, STIFFNESS));
        }
        return;
    }
    for (_, mut pull, place) in &mut pulls {
        // The grabbed point stays at its depth.
        let grabbed = place.transform_point(pull.grabbed);
        if let Some(target) = ray.plane_intersection_point(grabbed, InfinitePlane3d::new(view.forward())) {
            let target = place.affine().inverse().transform_point3(target);
            pull.pull_to(target);
        }
    }
}
