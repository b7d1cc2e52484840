//! Checks of `[fixed]` and `[[prescribed]]`.

use super::numbers::{Problem, check_finite, check_positive, check_vector, problem};
use super::selector::check_one;
use crate::tables::{FixedTable, PrescribedTable, RotationTable};
use crate::{Axis, Integrator, Scene};

/// Largest number of turns: an angle of this size still has ten digits.
const MOST_TURNS: f64 = 1e6;

pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    scene.fixed.as_ref().map_or(Ok(()), |fixed| {
        check_until(scene, "fixed", fixed.until)?;
        check_fixed(fixed)
    })?;
    let tables = scene.prescribed.iter().enumerate();
    tables.into_iter().try_for_each(|(number, motion)| {
        let table = format!("prescribed[{number}]");
        check_until(scene, &table, motion.until)?;
        check_prescribed(&table, motion)
    })
}

/// Checks the time from which nodes are free.
fn check_until(scene: &Scene, table: &str, until: Option<f64>) -> Result<(), Problem> {
    let Some(until) = until else { return Ok(()) };
    let field = format!("{table}.until");
    if scene.time.integrator == Integrator::Static {
        return problem(&field, "is a time, and static has none; remove it or choose a method that moves");
    }
    check_positive(&field, until, " of seconds")
}

fn check_fixed(fixed: &FixedTable) -> Result<(), Problem> {
    check_one("fixed", &fixed.selectors(), "plane, on, box, sphere, set and nodes")
}

fn check_prescribed(table: &str, motion: &PrescribedTable) -> Result<(), Problem> {
    check_one(table, &motion.selectors(), "on, box, sphere, set and nodes")?;
    if motion.displacement.is_none() && motion.rotation.is_none() {
        return problem(table, "has no motion; give displacement or rotation, or use [fixed]");
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

fn check_rotation(table: &str, rotation: &RotationTable) -> Result<(), Problem> {
    check_vector(&format!("{table}.rotation.center"), &rotation.center)?;
    let (field, turns) = (format!("{table}.rotation.turns"), rotation.turns);
    check_finite(&field, &[turns])?;
    if turns.abs() <= MOST_TURNS {
        return Ok(());
    }
    problem(&field, format!("is {turns:e}; give at most {MOST_TURNS:e}, beyond which an angle has few digits left"))
}

fn check_components(table: &str, motion: &PrescribedTable, components: &[Axis]) -> Result<(), Problem> {
    let field = format!("{table}.components");
    if components.is_empty() {
        return problem(&field, "is empty; name at least one of \"x\", \"y\" and \"z\", or leave it out for all");
    }
    if motion.rotation.is_some() {
        return problem(&field, "stands beside rotation, which moves all three; remove one of the two");
    }
    let along = |axis: &Axis| motion.displacement.is_none_or(|vector| vector[*axis as usize] == 0.0);
    let free = [Axis::X, Axis::Y, Axis::Z].into_iter().filter(|axis| !components.contains(axis));
    match free.into_iter().find(|axis| !along(axis)) {
        Some(axis) => {
            let name = ["x", "y", "z"][axis as usize];
            problem(&field, format!("leaves {name} free, and displacement moves it; name {name} or write 0 there"))
        }
        None => Ok(()),
    }
}
