//! Scene files: their values, the line and remedy of their errors, and the bodies that they describe.

#![allow(non_snake_case)] // C, D and E are the names that the mathematics and the course use

mod batch;
mod bodies;
mod curves;
mod errors;
mod examples;
mod fibres;
mod initial;
mod lookup;
mod materials;
mod moduli;
mod motions;
mod overrides;
mod plasticity;
mod saved;
mod selectors;
mod tables;
mod values;

use std::path::{Path, PathBuf};

use fem_model::Body;
use fem_scene::{Scene, SceneError, parse};

/// The smallest scene, of mandatory keys only.
const LEAST: &str = r#"pipeline = "course"
[mesh]
box = { size = [2, 1, 1], cells_per_unit = 1 }
[material]
model = "neo_hookean"
C = 1e5
D = 4e5
density = 1000.0
[time]
dt = 0.01
integrator = "implicit_euler"
"#;

fn read(text: &str) -> Scene {
    parse(text, Path::new("folder/name.toml")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The text with one passage replaced, which must occur once.
fn edit(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "`{from}` is not there once:\n{text}");
    text.replacen(from, to, 1)
}

/// The body of a scene that needs no data but its own.
fn body(text: &str) -> Result<Body, SceneError> {
    fem_scene::body(&read(text), Path::new("no data"))
}

/// The repository's `data`.
fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data")
}
