//! Young's modulus of a stretched strip.

use std::path::Path;

use fem_model::simulation::Diagnostics;

use crate::scenes::{double, step};
use crate::study::{Mark, Part, Table};

/// Young's modulus, Pa.
pub const YOUNG: f64 = 1e5;
/// Strain along the strip.
pub const STRAIN: f64 = 1e-3;
/// Share of the force that is left where the force of a triangle is divided by 3 in place of 2.
const THEIRS: f64 = 2.0 / 3.0;

/// A strip of 2 × 1 m and 1 m thickness, ν = 0, stretched by its ends.
pub fn run(_: &Path, _: bool) -> Result<Part, String> {
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
    let head = ["law", ">thesis, over E", ">here, over E", ">error"];
    Ok(Part::new(text).marks(marks).tables([Table::new("flat-modulus", &head, rows)]))
}

/// The modulus of a strip of a law, Pa.
pub fn modulus(model: &str) -> Result<f64, String> {
    let end = |side: &str, u: f64| {
        format!(
            "[[prescribed]]\non = {{ axis = \"x\", side = \"{side}\", within = 1e-9 }}\ndisplacement = [{u:e}, 0, 0]\ncomponents = [\"x\"]\n"
        )
    };
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [2, 1], cells_per_unit = 3, pattern = \"kuhn\" }}\n[material]\nmodel = \"{model}\"\n\
         young = {YOUNG:e}\npoisson = 0\ndensity = 1000\n[time]\nintegrator = \"static\"\nsteps = 1\n{}{}\
         [[prescribed]]\non = {{ axis = \"y\", side = \"min\", within = 1e-9 }}\ndisplacement = [0, 0, 0]\ncomponents = [\"y\"]\n",
        end("min", 0.0),
        end("max", 2.0 * STRAIN)
    );
    let mut simulation = double(&text, None)?;
    step(&mut simulation)?;
    // The strip is 1 m high and 1 m thick.
    Ok(simulation.reactions()[1].force[0] / STRAIN)
}
