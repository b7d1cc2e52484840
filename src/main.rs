//! The program: `cargo run -- arma`. Hands the course's pipeline to the commands.

use std::path::Path;
use std::process::ExitCode;

use fem_cli::Course;
use finite_elements_3d::assignment_setup::AssignmentSetup;

fn main() -> ExitCode {
    fem_cli::run(&Course {
        build: |scene, body| Ok(Box::new(AssignmentSetup::new(scene, body)?)),
        folder: Path::new(env!("CARGO_MANIFEST_DIR")),
        first_page: include_str!("../include-docs/course.md"),
    })
}
