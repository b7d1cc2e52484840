//! Checks of `[[initial_velocity]]`.

use super::selector::check_one;
use crate::Scene;
use crate::tables::{AngularVelocityTable, InitialVelocityTable};
use fem_model::numbers::{check_direction, check_finite, check_vector, problem};
use fem_model::{Integrator, Refusal};

pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    for (number, velocity) in scene.initial_velocity.iter().enumerate() {
        let table = format!("initial_velocity[{number}]");
        if scene.time.integrator == Integrator::Static {
            return problem(&table, "is a motion, and static has none; remove it or choose a method that moves");
        }
        check_velocity(&table, velocity)?;
    }
    Ok(())
}

fn check_velocity(table: &str, velocity: &InitialVelocityTable) -> Result<(), Refusal> {
    let selectors = velocity.selectors();
    if !selectors.is_empty() {
        check_one(table, &selectors, "on, box, sphere, set and nodes")?;
    }
    if velocity.velocity.is_none() && velocity.angular.is_none() && velocity.per_node.is_none() {
        return problem(table, "has no velocity; give velocity, angular or per_node");
    }
    velocity.velocity.map_or(Ok(()), |vector| check_vector(&format!("{table}.velocity"), &vector))?;
    velocity.angular.as_ref().map_or(Ok(()), |angular| check_angular(&format!("{table}.angular"), angular))
}

fn check_angular(field: &str, angular: &AngularVelocityTable) -> Result<(), Refusal> {
    let axis = format!("{field}.axis");
    check_direction(&axis, &angular.axis)?;
    if angular.axis == [0.0; 3] {
        return problem(&axis, "is zero; give the direction of the axis");
    }
    angular.center.map_or(Ok(()), |center| check_vector(&format!("{field}.center"), &center))?;
    check_finite(&format!("{field}.rate"), &[angular.rate])
}
