//! Young's modulus of a stretched strip.

use std::path::Path;

use fem_mesh::{Pattern, rectangle_mesh};
use fem_model::simulation::Diagnostics;
use fem_model::{Axis, Body, BodyMesh, Integrator, Method, Selector};

use crate::scenes::{displaced, material, simulator, step};
use crate::study::{Mark, Part, Result, Table};

/// Young's modulus, Pa.
pub const YOUNG: f64 = 1e5;
/// Strain along the strip.
pub const STRAIN: f64 = 1e-3;
/// Share of the force that is left where the force of a triangle is divided by 3 in place of 2.
const THEIRS: f64 = 2.0 / 3.0;

/// A strip of 2 × 1 m and 1 m thickness, ν = 0, stretched by its ends.
pub fn run(_: &Path, _: bool) -> Result<Part> {
    let (mut rows, mut marks) = (Vec::new(), Vec::new());
    for model in ["linear", "corotated"] {
        let found = modulus(model)? / YOUNG;
        rows.push(vec![
            model.to_owned(),
            format!("{:.4}", THEIRS),
            format!("{found:.12}"),
            format!("{:.1e}", (found - 1.0).abs()),
        ]);
        // At finite strain the corotated law has P = E ε along the strip too.
        let statement = format!("{model}: force over area and strain is E within 1e-10");
        let mark = Mark::new(statement, format!("{found:.12} E"), (found - 1.0).abs() <= 1e-10);
        marks.push(mark.beside("0.6667 E"));
    }
    let text = format!(
        "A strip of 2 × 1 m with ν = 0 is stretched by {STRAIN:e}; its modulus is the reaction over area and strain. The thesis divides the forces of a \
         triangle among its nodes by 3 in place of 2, so that its bodies are a third too soft."
    );
    let head = "law | >thesis, over E | >here, over E | >error";
    Ok(Part::new(text).marks(marks).tables([Table::new("flat-modulus", head, rows)]))
}

/// The modulus of a strip of a law, Pa.
pub fn modulus(model: &str) -> Result<f64> {
    let strip = BodyMesh::flat(rectangle_mesh([2.0, 1.0], 3, Pattern::Kuhn)?, 1.0);
    let body = Body::new(strip, material(model, YOUNG, 0.0, 1000.0)?)?;
    let body = displaced(body, &Selector::least(Axis::X), Axis::X, 0.0)?;
    let body = displaced(body, &Selector::most(Axis::X), Axis::X, 2.0 * STRAIN)?;
    let body = displaced(body, &Selector::least(Axis::Y), Axis::Y, 0.0)?;
    let mut simulation = simulator(body, &Method::new(Integrator::Static, 1.0))?;
    step(&mut simulation)?;
    // The strip is 1 m high and 1 m thick.
    Ok(simulation.reactions()[1].force[0] / STRAIN)
}
