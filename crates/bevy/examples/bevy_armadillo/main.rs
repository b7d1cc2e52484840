//! An armadillo that is pulled by one ear, and a donut that is dropped on a plane. Drag either with the left mouse button.
//!
//! ```sh
//! cargo run --features window --example bevy_armadillo
//! cargo run --features window --example bevy_armadillo -- --picture armadillo.png   # without a window
//! ```

mod bodies;
mod mouse;
mod picture;
mod stage;

use bevy::prelude::*;
use fem_bevy::{SoftBodyFailed, SoftBodyPlugin};

fn main() -> AppExit {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut app = App::new();
    match &arguments[..] {
        [] => {
            app.add_plugins((DefaultPlugins, SoftBodyPlugin::default()))
                .add_systems(Startup, stage::open_window)
                .add_systems(Update, mouse::pull);
        }
        [option, path] if option == "--picture" => picture::prepare(&mut app, path.into()),
        _ => {
            eprintln!("unknown arguments {arguments:?}; give none, or --picture FILE.png");
            return AppExit::from_code(2);
        }
    }
    app.add_systems(Startup, (stage::light, bodies::spawn)).add_systems(Update, report).run()
}

/// Prints why a body was refused or has stopped.
fn report(mut failures: MessageReader<SoftBodyFailed>) {
    for SoftBodyFailed { entity, error } in failures.read() {
        eprintln!("body {entity}: {error}");
    }
}
