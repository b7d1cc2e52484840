//! Apps without a window, and scenes for them.

use std::thread::sleep;
use std::time::{Duration, Instant};

use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use fem_bevy::{SoftBodyFailed, SoftBodyPhase, SoftBodyPlugin, SoftBodyState};

/// The folder of scenes and meshes.
pub const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data");

/// A clamped bar of 32 nodes, all of them on its boundary, that sinks under its weight.
pub const BAR: &str = r#"
pipeline = "engine"
[mesh]
box = { size = [7, 1, 1], cells_per_unit = 1 }
[material]
model = "stable_neo_hookean"
young = 1e5
poisson = 0.3
density = 100
[gravity]
acceleration = [0, -9.81, 0]
[fixed]
plane = { axis = "x", below = 1e-9 }
[time]
dt = 0.01
integrator = "implicit_euler"
"#;

/// Longest time that a test waits for a worker.
const PATIENCE: Duration = Duration::from_secs(120);

/// The failures that have arrived.
#[derive(Default, Resource)]
pub struct Failures(pub Vec<SoftBodyFailed>);

/// An app whose clock advances by `frame` in each update, and whose bodies never drop time.
pub fn app(frame: Duration, workers: usize) -> App {
    app_with(frame, SoftBodyPlugin { workers, most_lag: Duration::from_secs(3600) })
}

/// The same with a plugin of the test's own.
pub fn app_with(frame: Duration, plugin: SoftBodyPlugin) -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, AssetPlugin::default(), plugin))
        .insert_resource(TimeUpdateStrategy::ManualDuration(frame))
        .init_resource::<Failures>()
        .add_systems(Update, |mut arrived: MessageReader<SoftBodyFailed>, mut failures: ResMut<Failures>| {
            failures.0.extend(arrived.read().cloned());
        });
    app.finish();
    app.cleanup();
    app
}

/// The state of a body.
pub fn state(app: &App, body: Entity) -> &SoftBodyState {
    app.world().get(body).expect("a body has a state")
}

/// Updates with the clock at rest until `is_reached`.
pub fn wait_until(app: &mut App, is_reached: impl Fn(&App) -> bool) {
    let strategy = app.world().resource::<TimeUpdateStrategy>();
    let TimeUpdateStrategy::ManualDuration(frame) = *strategy else { panic!("the clock is set by the test") };
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::ZERO));
    let start = Instant::now();
    loop {
        app.update();
        if is_reached(app) {
            break;
        }
        assert!(start.elapsed() < PATIENCE, "the worker has not come so far");
        sleep(Duration::from_millis(1));
    }
    app.insert_resource(TimeUpdateStrategy::ManualDuration(frame));
}

/// Waits until the bodies are built, or refused.
pub fn wait_for_bodies(app: &mut App, bodies: &[Entity]) {
    wait_until(app, |app| bodies.iter().all(|&body| state(app, body).phase() != SoftBodyPhase::Building));
}

/// Waits for the failure of a single body, and returns its message.
pub fn wait_for_failure(app: &mut App) -> String {
    wait_until(app, |app| !app.world().resource::<Failures>().0.is_empty());
    let failures = &app.world().resource::<Failures>().0;
    assert_eq!(failures.len(), 1, "{failures:?}");
    failures[0].error.to_string()
}
