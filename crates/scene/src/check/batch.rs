//! Checks of `[batch]`.

use crate::tables::{RangeTable, Spacing};
use crate::{Pipeline, Scene};
use fem_model::numbers::{check_finite, problem};
use fem_model::{Integrator, Refusal};

/// Most environments.
const MOST: usize = 65_536;

pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    let Some(batch) = &scene.batch else { return Ok(()) };
    if scene.pipeline == Pipeline::Course {
        return problem("batch", "belongs to the engine; the course's pipeline does without, remove it");
    }
    if batch.count == 0 || batch.count > MOST {
        return problem("batch.count", format!("is {}; give 1 to {MOST} environments", batch.count));
    }
    if scene.time.integrator == Integrator::Static {
        let text = "has environments that move, and time.integrator = \"static\" finds one equilibrium; remove the table, or use another method";
        return problem("batch", text);
    }
    let vary = &batch.vary;
    let material = &scene.material;
    let ranges = [
        ("young", vary.young, material.young.is_some()),
        ("poisson", vary.poisson, material.poisson.is_some()),
        ("density", vary.density, true),
        ("gravity", vary.gravity, scene.gravity.is_some()),
    ];
    for (key, range, has_quantity) in ranges {
        let Some(range) = range else { continue };
        let field = format!("batch.vary.{key}");
        check_range(&field, range)?;
        match key {
            "gravity" if !has_quantity => return problem(&field, "varies a table that is not there; add [gravity]"),
            _ if !has_quantity => {
                return problem(&field, format!("varies a key that the material lacks; give it material.{key}"));
            }
            "density" if !scene.materials.is_empty() => {
                return problem(&field, "varies the density of one material of several; remove it, or [[materials]]");
            }
            _ => {}
        }
    }
    // Between the ends every value lies between theirs.
    check_end(scene, 0)?;
    check_end(scene, batch.count - 1)
}

fn check_range(field: &str, RangeTable { from, to, spacing }: RangeTable) -> Result<(), Refusal> {
    check_finite(&format!("{field}.from"), &[from])?;
    check_finite(&format!("{field}.to"), &[to])?;
    let smallest = from.min(to);
    if spacing == Spacing::Geometric && smallest <= 0.0 {
        let key = if from <= 0.0 { "from" } else { "to" };
        let text =
            format!("is {smallest}, and a geometric spacing has positive values; give one, or spacing = \"even\"");
        return problem(&format!("{field}.{key}"), text);
    }
    Ok(())
}

/// Checks the material of the first or the last environment.
fn check_end(scene: &Scene, number: usize) -> Result<(), Refusal> {
    let environment = scene.environment(number);
    environment.material.check("material").map_err(|Refusal { field, problem }| {
        let text = format!("leads to a value that the material cannot have in environment {number}: it {problem}");
        Refusal::new(field.replace("material.", "batch.vary."), text)
    })
}
