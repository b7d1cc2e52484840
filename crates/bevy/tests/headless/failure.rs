//! A step that fails.

use std::time::Duration;

use fem_bevy::{SoftBody, SoftBodyError, SoftBodyPhase};

use crate::app::{BAR, DATA, Failures, app, state, wait_for_bodies, wait_for_failure};

#[test]
fn a_failed_step_arrives_as_a_message_and_the_body_keeps_its_last_good_state() {
    let unstable = BAR.replace("implicit_euler", "verlet").replace("0.01", "0.1");
    let mut app = app(Duration::from_millis(100), 1);
    let failing = app.world_mut().spawn(SoftBody::text(unstable, DATA)).id();
    let other = app.world_mut().spawn(SoftBody::text(BAR, DATA)).id();
    wait_for_bodies(&mut app, &[failing, other]);
    (0..60).for_each(|_| app.update());
    let message = wait_for_failure(&mut app);
    assert!(
        message.contains("the simulation failed in step") && message.contains("use a time step of 5.00e-2 s or less"),
        "{message}"
    );

    let arrived = app.world().resource::<Failures>().0[0].clone();
    assert_eq!(arrived.entity, failing);
    let SoftBodyError::Step(failure) = &arrived.error else { panic!("{arrived:?}") };
    let last = state(&app, failing);
    assert_eq!((last.phase(), last.steps()), (SoftBodyPhase::Failed, failure.step - 1));
    assert_eq!(last.failure(), Some(&arrived.error));
    assert!(last.positions().iter().all(|x| x.is_finite()));

    let place = state(&app, failing).positions().to_vec();
    (0..20).for_each(|_| app.update());
    assert_eq!(state(&app, failing).positions(), place);
    assert_eq!(state(&app, other).phase(), SoftBodyPhase::Running);
}

#[test]
fn a_body_that_has_failed_starts_again_when_it_is_inserted_again() {
    let mut app = app(Duration::from_millis(10), 1);
    let body = app.world_mut().spawn(SoftBody::scene("no such scene", DATA)).id();
    wait_for_failure(&mut app);
    app.world_mut().entity_mut(body).insert(SoftBody::text(BAR, DATA));
    app.update();
    wait_for_bodies(&mut app, &[body]);
    assert_eq!(state(&app, body).phase(), SoftBodyPhase::Running);
}
