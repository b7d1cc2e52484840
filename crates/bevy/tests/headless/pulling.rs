//! Picking and pulling.

use std::thread::sleep;
use std::time::Duration;

use bevy::math::DVec3;
use bevy::prelude::*;
use fem_bevy::{SoftBody, SoftBodyHit, SoftBodyMaterial, SoftBodyPinnedParticles, SoftBodyPull};

use crate::app::{BAR, DATA, app, state, wait_for_bodies, wait_until};

/// A bar from x = 0 to 7 without gravity.
fn bar() -> SoftBody {
    SoftBody::text(BAR, DATA).with_gravity(DVec3::ZERO)
}

#[test]
fn a_ray_hits_the_body_where_its_entity_stands() {
    let mut app = app(Duration::from_millis(10), 1);
    let body = app.world_mut().spawn(bar()).id();
    wait_for_bodies(&mut app, &[body]);
    let placement = GlobalTransform::from(
        Transform::from_xyz(10.0, 0.0, 0.0).with_rotation(Quat::from_rotation_z(std::f32::consts::FRAC_PI_2)),
    );
    // The bar now points upwards from (10, 0, 0), and lies between x = 9 and x = 10.
    let ray = Ray3d::new(Vec3::new(20.0, 6.9, 0.4), Dir3::NEG_X);
    let SoftBodyHit { point, distance, nodes } = state(&app, body).pick(ray, &placement).expect("a hit");
    assert!((point - Vec3::new(6.9, 0.0, 0.4)).length() < 1e-4, "{point}");
    assert!((distance - 10.0).abs() < 1e-4);
    assert!(!nodes.is_empty() && nodes.iter().all(|&node| state(&app, body).positions()[node].x > 5.5), "{nodes:?}");
    assert_eq!(state(&app, body).pick(Ray3d::new(Vec3::new(20.0, 8.0, 0.4), Dir3::NEG_X), &placement), None);
}

/// Mean height of the free end, m.
fn height(app: &App, body: Entity) -> f64 {
    let free_end: Vec<_> = state(app, body).positions().iter().filter(|x| x.x > 6.5).map(|x| x.y).collect();
    free_end.iter().sum::<f64>() / free_end.len() as f64
}

#[test]
fn a_pulled_end_follows_and_goes_back_when_it_is_let_go() {
    let mut app = app(Duration::from_millis(10), 1);
    let material = SoftBodyMaterial { young: 1e7, density: 100.0, damping: Some([8.0, 0.0]), ..default() };
    let clamped = SoftBodyPinnedParticles(vec![0, 8, 16, 24]);
    let body = app.world_mut().spawn((bar(), material, clamped)).id();
    wait_for_bodies(&mut app, &[body]);
    let start = height(&app, body);
    let ray = Ray3d::new(Vec3::new(6.9, 0.5, 9.0), Dir3::NEG_Z);
    let hit = state(&app, body).pick(ray, &GlobalTransform::IDENTITY).unwrap();
    let mut pull = SoftBodyPull::new(state(&app, body), &hit, 1e5);
    pull.pull_to(hit.point + Vec3::Y);
    app.world_mut().entity_mut(body).insert(pull);
    (0..100).for_each(|_| app.update());
    wait_until(&mut app, |app| state(app, body).steps() >= 100);
    let pulled = height(&app, body);
    assert!(pulled > start + 0.5, "{start} m, then {pulled} m");
    app.world_mut().entity_mut(body).remove::<SoftBodyPull>();
    (0..300).for_each(|_| app.update());
    wait_until(&mut app, |app| state(app, body).steps() >= 400);
    let end = height(&app, body);
    assert!((end - start).abs() < 0.1, "{start} m, {pulled} m, then {end} m");
}

#[test]
fn a_pull_gives_the_same_motion_however_fast_the_worker_is() {
    let run = |pause: Duration| {
        let mut app = app(Duration::from_millis(16), 1);
        let body = app.world_mut().spawn(bar()).id();
        wait_for_bodies(&mut app, &[body]);
        let pull = |height| SoftBodyPull {
            anchors: vec![(7, DVec3::new(7.0, 0.0, 0.0))],
            offset: Vec3::Y * height,
            stiffness: 1e3,
            grabbed: Vec3::ZERO,
        };
        for frame in 0..20 {
            match frame {
                5 | 9 => _ = app.world_mut().entity_mut(body).insert(pull(frame as f32 * 0.1)),
                14 => _ = app.world_mut().entity_mut(body).remove::<SoftBodyPull>(),
                _ => {}
            }
            app.update();
            sleep(pause);
        }
        wait_until(&mut app, |app| state(app, body).steps() == 33);
        state(&app, body).positions().to_vec()
    };
    assert_eq!(run(Duration::ZERO), run(Duration::from_millis(7)));
}
