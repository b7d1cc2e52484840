//! Checks of `[plasticity]`.

use crate::tables::{PlasticModel, PlasticityTable};
use crate::{Pipeline, Scene};
use fem_model::numbers::{check_not_negative, check_positive, problem};
use fem_model::{Integrator, Refusal};

pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    let Some(table) = &scene.plasticity else { return Ok(()) };
    check_keys(table)?;
    check_numbers(table)?;
    // The course's pipeline refuses the table itself.
    if scene.pipeline == Pipeline::Course {
        return Ok(());
    }
    check_laws(scene, table.model)?;
    if table.model == PlasticModel::Additive && scene.time.integrator == Integrator::Static {
        let text = "is \"additive\", which flows with the time, and time.integrator = \"static\" has none; write model = \
                    \"j2\", or an integrator that moves";
        return problem("plasticity.model", text);
    }
    Ok(())
}

/// A key with its value, the model that it belongs to, and whether that model needs it.
type Key = (&'static str, Option<f64>, PlasticModel, bool);

fn keys(table: &PlasticityTable) -> [Key; 5] {
    use PlasticModel::{Additive, J2};
    [
        ("yield_strain", table.yield_strain, Additive, true),
        ("creep", table.creep, Additive, true),
        ("maximum", table.maximum, Additive, false),
        ("yield_stress", table.yield_stress, J2, true),
        ("hardening", table.hardening, J2, false),
    ]
}

/// Checks that the table has the keys of its model and no others.
fn check_keys(table: &PlasticityTable) -> Result<(), Refusal> {
    let own = table.model;
    let names = keys(table).into_iter().filter(|(_, _, model, _)| *model == own).map(|(name, ..)| name);
    let names = names.collect::<Vec<_>>().join(", ");
    for (name, value, model, is_needed) in keys(table) {
        if value.is_some() && model != own {
            let text = format!(
                "belongs to plasticity.model = \"{}\", and this one is \"{}\"; give {names}",
                model.name(),
                own.name()
            );
            return problem(&format!("plasticity.{name}"), text);
        }
        if value.is_none() && model == own && is_needed {
            let text = format!("is missing, and plasticity.model = \"{}\" needs it; give {names}", own.name());
            return problem(&format!("plasticity.{name}"), text);
        }
    }
    Ok(())
}

fn check_numbers(table: &PlasticityTable) -> Result<(), Refusal> {
    let positive = |name: &str, value: Option<f64>, unit: &str| {
        value.map_or(Ok(()), |value| check_positive(&format!("plasticity.{name}"), value, unit))
    };
    positive("yield_strain", table.yield_strain, "")?;
    positive("creep", table.creep, " of 1/s")?;
    positive("maximum", table.maximum, "")?;
    positive("yield_stress", table.yield_stress, " of Pa")?;
    table.hardening.map_or(Ok(()), |hardening| check_not_negative("plasticity.hardening", hardening, "Pa"))
}

/// Checks that every material has the law of the model.
fn check_laws(scene: &Scene, model: PlasticModel) -> Result<(), Refusal> {
    let tables = scene.materials.iter().enumerate();
    let others = tables.map(|(number, material)| (format!("materials[{number}]"), &material.model));
    let mut all = std::iter::once(("material".to_owned(), &scene.material.model)).chain(others);
    match all.find(|(_, law)| *law != model.law()) {
        Some((table, law)) => {
            let text = format!(
                "is \"{law}\", and plasticity.model = \"{}\" is a flow of the law \"{}\" alone; write that law with young \
                 and poisson, or remove [plasticity]",
                model.name(),
                model.law()
            );
            problem(&format!("{table}.model"), text)
        }
        None => Ok(()),
    }
}
