//! Bad input is refused with a message that names the field and the remedy.

use std::time::Duration;

use bevy::math::DVec3;
use bevy::prelude::*;
use fem_bevy::{
    SoftBody, SoftBodyMaterial, SoftBodyPhase, SoftBodyPinnedParticles, SoftBodyPlane, SoftBodyPlanes, SoftBodyPull,
};

use crate::app::{BAR, DATA, app, state, wait_for_bodies, wait_for_failure, wait_until};

/// The message with which a body is refused.
fn refusal(body: impl Bundle) -> String {
    let mut app = app(Duration::from_millis(10), 1);
    let body = app.world_mut().spawn(body).id();
    let message = wait_for_failure(&mut app);
    assert_eq!(state(&app, body).phase(), SoftBodyPhase::Failed);
    message
}

fn bar() -> SoftBody {
    SoftBody::text(BAR, DATA)
}

#[test]
fn scenes() {
    let message = refusal(SoftBody::scene("armadilo", DATA));
    assert!(message.starts_with("there is no scene `armadilo`; choose one of arma, "), "{message}");
    let message = refusal(SoftBody::scene("missing/file.toml", DATA));
    assert!(message.contains("missing/file.toml: cannot be read") && message.contains("check the path"), "{message}");
    let message = refusal(SoftBody::text(BAR.replace("0.01", "nan"), DATA));
    assert!(message.contains("time.dt is NaN; give a positive number of seconds"), "{message}");
    let message = refusal(SoftBody::scene("arma", DATA));
    assert!(message.contains("pipeline is course") && message.contains("pipeline = \"engine\""), "{message}");
    let message = refusal(SoftBody::scene("cantilever", DATA));
    assert!(message.contains("time.integrator is static") && message.contains("implicit_euler"), "{message}");
}

#[test]
fn numbers_of_components() {
    let message = refusal((bar(), SoftBodyMaterial { young: f64::NAN, ..default() }));
    assert_eq!(message, "material.young is NaN; give a positive number of Pa");
    let message = refusal((bar(), SoftBodyMaterial { poisson: 0.5, ..default() }));
    assert!(message.starts_with("material.poisson is 0.5; "), "{message}");
    let message = refusal((bar(), SoftBodyMaterial { model: "jelly".to_owned(), ..default() }));
    assert!(message.contains("material.model is `jelly`") && message.contains("write one of"), "{message}");
    let message = refusal(bar().with_dt(-1.0));
    assert_eq!(message, "time.dt is -1; give a positive number of seconds");
    let message = refusal(bar().with_gravity(DVec3::splat(f64::INFINITY)));
    assert!(message.contains("gravity.acceleration"), "{message}");
    let plane = SoftBodyPlane { point: DVec3::ZERO, normal: DVec3::ZERO, friction: 0.0 };
    let message = refusal((bar(), SoftBodyPlanes(vec![plane])));
    assert!(message.contains("planes[0].normal"), "{message}");
}

#[test]
fn nodes_and_meshes() {
    let message = refusal((bar(), SoftBodyPinnedParticles(vec![3, 99])));
    assert!(message.starts_with("SoftBodyPinnedParticles: node 99 is not one of the 32 nodes"), "{message}");
    let mut mesh = fem_mesh::box_mesh([1.0, 1.0, 1.0], 1, fem_mesh::Pattern::Alternating).unwrap();
    mesh.vertices[2].y = f64::NAN;
    let message = refusal(SoftBody::from_mesh(mesh));
    assert!(message.contains("vertex 2"), "{message}");
    let mut display = fem_mesh::SurfaceMesh::new(Vec::new(), vec![[0, 1, 2]]);
    let message = refusal(bar().with_display(display.clone()));
    assert!(message.starts_with("SoftBody::with_display: a triangle names vertex 0 of 0"), "{message}");
    display.vertices = vec![[0.0, f64::NAN, 0.0].into(); 3];
    let message = refusal(bar().with_display(display));
    assert!(message.starts_with("SoftBody::with_display: vertex 0 is not finite"), "{message}");
}

#[test]
fn a_pull_that_is_refused_leaves_the_body_running() {
    let good =
        SoftBodyPull { anchors: vec![(31, DVec3::ZERO)], offset: Vec3::ZERO, stiffness: 1e3, grabbed: Vec3::ZERO };
    let bad = [
        (SoftBodyPull { anchors: vec![(32, DVec3::ZERO)], ..good.clone() }, "SoftBodyPull.anchors: node 32"),
        (SoftBodyPull { offset: Vec3::NAN, ..good.clone() }, "SoftBodyPull.offset"),
        (SoftBodyPull { stiffness: -5.0, ..good.clone() }, "SoftBodyPull.stiffness"),
    ];
    for (pull, field) in bad {
        let mut app = app(Duration::from_millis(10), 1);
        let body = app.world_mut().spawn(bar()).id();
        wait_for_bodies(&mut app, &[body]);
        app.world_mut().entity_mut(body).insert(pull);
        let message = wait_for_failure(&mut app);
        assert!(message.starts_with(field), "{message}");
        (0..5).for_each(|_| app.update());
        wait_until(&mut app, |app| state(app, body).steps() >= 3);
        assert_eq!(state(&app, body).phase(), SoftBodyPhase::Running);
    }
}
