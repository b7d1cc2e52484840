//! Bodies that come and go.

use std::alloc::System;
use std::thread::sleep;
use std::time::Duration;

use bevy::prelude::*;
use fem_bevy::{SoftBody, SoftBodyMeshSync, SoftBodyState};
use stats_alloc::{INSTRUMENTED_SYSTEM, Stats, StatsAlloc};

use crate::app::{DATA, app, state, wait_for_bodies, wait_until};

/// Counts the bytes that are allocated and not freed.
#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Memory that is in use, MiB.
fn in_use() -> f64 {
    let Stats { bytes_allocated, bytes_deallocated, .. } = ALLOCATOR.stats();
    (bytes_allocated as f64 - bytes_deallocated as f64) / (1 << 20) as f64
}

/// Spawns 100 bodies, lets them move, and despawns them.
fn round(app: &mut App) {
    let spawn =
        |world: &mut World| world.spawn((SoftBody::scene("arma-engine", DATA), SoftBodyMeshSync::default())).id();
    let bodies: Vec<Entity> = (0..100).map(|_| spawn(app.world_mut())).collect();
    app.update();
    wait_for_bodies(app, &bodies);
    app.update();
    wait_until(app, |app| bodies.iter().all(|&body| state(app, body).steps() >= 1));
    assert_eq!(app.world().resource::<Assets<Mesh>>().len(), 100);
    bodies.iter().for_each(|&body| assert!(app.world_mut().despawn(body)));
    wait_until(app, |app| app.world().resource::<Assets<Mesh>>().is_empty());
    assert_eq!(app.world_mut().query::<&SoftBodyState>().iter(app.world()).count(), 0);
}

#[test]
#[ignore = "long, and needs a process of its own; test.sh runs it"]
fn a_hundred_bodies_leave_no_memory() {
    let mut app = app(Duration::from_millis(10), 1);
    app.update();
    let mut after = vec![in_use()];
    for _ in 0..10 {
        round(&mut app);
        // The worker frees its bodies in its own time, and frames free its last states.
        for _ in 0..100 {
            app.update();
            sleep(Duration::from_millis(3));
        }
        after.push(in_use());
    }
    println!("memory in use before, and after each 100 bodies, MiB: {after:.3?}");
    // A hundred bodies take 260 MiB.
    assert!(after[10] - after[1] < 0.1, "{after:?} MiB");
}

#[test]
fn a_body_that_is_despawned_while_it_is_built_is_forgotten() {
    let mut app = app(Duration::from_millis(10), 1);
    let body = app.world_mut().spawn(SoftBody::scene("arma-engine", DATA)).id();
    app.update();
    app.world_mut().despawn(body);
    let other = app.world_mut().spawn((SoftBody::scene("arma-engine", DATA), SoftBodyMeshSync::Newest)).id();
    app.update();
    wait_for_bodies(&mut app, &[other]);
    (0..3).for_each(|_| app.update());
    wait_until(&mut app, |app| state(app, other).steps() >= 3);
}

#[test]
fn a_body_whose_component_is_removed_stays_where_it_was_drawn() {
    let mut app = app(Duration::from_millis(10), 1);
    let body = app.world_mut().spawn((SoftBody::scene("arma-engine", DATA), SoftBodyMeshSync::Newest)).id();
    app.update();
    wait_for_bodies(&mut app, &[body]);
    app.world_mut().entity_mut(body).remove::<SoftBody>();
    (0..3).for_each(|_| app.update());
    assert!(state(&app, body).positions().is_empty());
    assert!(app.world().get::<Mesh3d>(body).is_some());
}
