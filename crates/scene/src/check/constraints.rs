//! Checks of `[fixed]` and `[[prescribed]]`.

use super::selector::check_one;
use crate::Scene;
use crate::tables::{FixedTable, PrescribedTable, RotationTable};
use fem_model::numbers::{check_finite, check_positive, check_vector, problem};
use fem_model::{Axis, Integrator, Refusal};

/// Largest number of turns: an angle of this size still has ten digits.
const MOST_TURNS: f64 = 1e6;

pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    scene.fixed.as_ref().map_or(Ok(()), |fixed| {
        check_until(scene, "fixed", fixed.until)?;
        check_fixed(fixed)
    })?;
    let tables = scene.prescribed.iter().enumerate();
    tables.into_iter().try_for_each(|(number, motion)| {
        let table = format!("prescribed[{number}]");
        check_until(scene, &table, motion.until)?;
        check_velocity(scene, &table, motion)?;
        check_prescribed(&table, motion)
    })
}

/// Checks the time from which nodes are free.
fn check_until(scene: &Scene, table: &str, until: Option<f64>) -> Result<(), Refusal> {
    let Some(until) = until else { return Ok(()) };
    let field = format!("{table}.until");
    if scene.time.integrator == Integrator::Static {
        return problem(&field, "is a time, and static has none; remove it or choose a method that moves");
    }
    check_positive(&field, until, " of seconds")
}

fn check_fixed(fixed: &FixedTable) -> Result<(), Refusal> {
    check_one("fixed", &fixed.selectors(), "plane, on, box, sphere, set and nodes")
}

fn check_prescribed(table: &str, motion: &PrescribedTable) -> Result<(), Refusal> {
    check_one(table, &motion.selectors(), "on, box, sphere, set and nodes")?;
    if motion.displacement.is_none() && motion.rotation.is_none() && motion.velocity.is_none() {
        return problem(table, "has no motion; give displacement, rotation or velocity, or use [fixed]");
    }
    motion.displacement.map_or(Ok(()), |vector| check_vector(&format!("{table}.displacement"), &vector))?;
    motion.over.map_or(Ok(()), |over| check_positive(&format!("{table}.over"), over, " of seconds"))?;
    motion.curve.as_ref().map_or(Ok(()), |curve| curve.check(&format!("{table}.curve")))?;
    if motion.over.is_some() && motion.curve.is_some() {
        return problem(&format!("{table}.curve"), "stands beside over, which is a curve too; remove one of the two");
    }
    motion.rotation.as_ref().map_or(Ok(()), |rotation| check_rotation(table, rotation))?;
    motion.components.as_ref().map_or(Ok(()), |components| check_components(table, motion, components))
}

/// Checks a velocity, which is a motion of its own and needs a time.
fn check_velocity(scene: &Scene, table: &str, motion: &PrescribedTable) -> Result<(), Refusal> {
    let Some(velocity) = &motion.velocity else { return Ok(()) };
    let field = format!("{table}.velocity");
    check_vector(&field, velocity)?;
    if scene.time.integrator == Integrator::Static {
        let text = "is a motion in time, and time.integrator = \"static\" has none; give displacement, or an integrator that moves";
        return problem(&field, text);
    }
    let others = [
        ("displacement", motion.displacement.is_some()),
        ("rotation", motion.rotation.is_some()),
        ("over", motion.over.is_some()),
    ];
    match others.iter().find(|(_, is_given)| *is_given) {
        Some(("over", _)) => problem(
            &format!("{table}.over"),
            "is the duration of a displacement, and stands beside velocity; give curve = { on = 0, off = … } for its end",
        ),
        Some((other, _)) => {
            problem(&field, format!("stands beside {other}, which is a motion too; remove one of the two"))
        }
        None => Ok(()),
    }
}

fn check_rotation(table: &str, rotation: &RotationTable) -> Result<(), Refusal> {
    check_vector(&format!("{table}.rotation.center"), &rotation.center)?;
    let (field, turns) = (format!("{table}.rotation.turns"), rotation.turns);
    check_finite(&field, &[turns])?;
    if turns.abs() <= MOST_TURNS {
        return Ok(());
    }
    problem(&field, format!("is {turns:e}; give at most {MOST_TURNS:e}, beyond which an angle has few digits left"))
}

fn check_components(table: &str, motion: &PrescribedTable, components: &[Axis]) -> Result<(), Refusal> {
    let field = format!("{table}.components");
    if components.is_empty() {
        return problem(&field, "is empty; name at least one of \"x\", \"y\" and \"z\", or leave it out for all");
    }
    if motion.rotation.is_some() {
        return problem(&field, "stands beside rotation, which moves all three; remove one of the two");
    }
    let (key, vector) = match motion.velocity {
        Some(_) => ("velocity", motion.velocity),
        None => ("displacement", motion.displacement),
    };
    let along = |axis: &Axis| vector.is_none_or(|vector| vector[*axis as usize] == 0.0);
    let free = [Axis::X, Axis::Y, Axis::Z].into_iter().filter(|axis| !components.contains(axis));
    match free.into_iter().find(|axis| !along(axis)) {
        Some(axis) => {
            let name = ["x", "y", "z"][axis as usize];
            problem(&field, format!("leaves {name} free, and {key} moves it; name {name} or write 0 there"))
        }
        None => Ok(()),
    }
}
