//! Checks of `[[planes]]` and `[contact]`.

use crate::Scene;
use crate::tables::PlaneTable;
use fem_model::numbers::{check_direction, check_not_negative, check_positive, check_vector, problem};
use fem_model::{Integrator, Refusal};

/// Returns the first problem of contact, the combinations with the method included.
pub(crate) fn check(scene: &Scene) -> Result<(), Refusal> {
    for (number, plane) in scene.planes.iter().enumerate() {
        check_plane(&format!("planes[{number}]"), plane, scene.time.integrator)?;
    }
    let Some(contact) = &scene.contact else { return check_method(scene) };
    if scene.planes.is_empty() {
        return problem("contact", "stands without [[planes]]; add an obstacle, or remove the table");
    }
    let distance = contact.activation_distance;
    distance.map_or(Ok(()), |distance| check_positive("contact.activation_distance", distance, " of metres"))?;
    let speed = contact.transition_speed;
    speed.map_or(Ok(()), |speed| check_positive("contact.transition_speed", speed, " of m/s"))?;
    if speed.is_some() && scene.planes.iter().all(|plane| plane.friction == 0.0) {
        let text = "belongs to friction, and no plane has some; give planes a friction, or remove it";
        return problem("contact.transition_speed", text);
    }
    check_method(scene)
}

fn check_plane(table: &str, plane: &PlaneTable, method: Integrator) -> Result<(), Refusal> {
    check_vector(&format!("{table}.point"), &plane.point)?;
    let normal = format!("{table}.normal");
    check_direction(&normal, &plane.normal)?;
    if plane.normal == [0.0; 3] {
        return problem(&normal, "is zero; give the direction from the plane to the body");
    }
    // The length must not underflow.
    let largest = plane.normal.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    check_positive(&normal, largest, " for its largest component")?;
    check_not_negative(&format!("{table}.friction"), plane.friction, "(no friction)")?;
    check_motion(table, plane)?;
    if method != Integrator::Static {
        return Ok(());
    }
    if plane.velocity.is_some() {
        let text = "is a motion in time, and time.integrator = \"static\" counts load steps; give displacement and curve, or use \
                    implicit_euler";
        return problem(&format!("{table}.velocity"), text);
    }
    if plane.friction > 0.0 {
        let text = "depends on the motion, and time.integrator = \"static\" has none; remove it, or use implicit_euler";
        return problem(&format!("{table}.friction"), text);
    }
    Ok(())
}

/// Checks the motion of a plane: a velocity, or a displacement with its curve.
fn check_motion(table: &str, plane: &PlaneTable) -> Result<(), Refusal> {
    let field = |key: &str| format!("{table}.{key}");
    plane.velocity.map_or(Ok(()), |vector| check_vector(&field("velocity"), &vector))?;
    plane.displacement.map_or(Ok(()), |vector| check_vector(&field("displacement"), &vector))?;
    plane.until.map_or(Ok(()), |time| check_positive(&field("until"), time, " of seconds"))?;
    if plane.until.is_some() && plane.velocity.is_none() {
        let text = "ends the motion of a plane, and this one has no velocity; give it one or remove it";
        return problem(&field("until"), text);
    }
    if plane.velocity.is_some() && plane.displacement.is_some() {
        return problem(&field("displacement"), "stands beside velocity, which is a motion too; remove one of the two");
    }
    match (&plane.displacement, &plane.curve) {
        (None, None) => Ok(()),
        (Some(_), None) => problem(&field("displacement"), "needs a factor of time; give the plane a curve"),
        (None, Some(_)) => problem(&field("curve"), "is the factor of a displacement; give the plane one"),
        (Some(_), Some(curve)) => {
            curve.check(&field("curve"))?;
            if !curve.curve().has_jumps() {
                return Ok(());
            }
            problem(&field("curve"), "jumps, and a plane would go through the body; give a ramp, a table or a sine")
        }
    }
}

/// Refuses methods that cannot keep a body outside an obstacle.
fn check_method(scene: &Scene) -> Result<(), Refusal> {
    if scene.planes.is_empty() {
        return Ok(());
    }
    let method = scene.time.integrator;
    if method.facts().contact.is_none() {
        let text = format!(
            "stand beside time.integrator = \"{}\", whose steps cannot keep a body outside an obstacle; use implicit_euler, static, \
             or an explicit method",
            method.name()
        );
        return problem("planes", text);
    }
    if method.is_explicit() && scene.mass.lumped == Some(false) {
        let text = format!(
            "is false beside [[planes]] and time.integrator = \"{}\", whose impulses of contact need a mass for each node; remove it, or \
             use implicit_euler",
            method.name()
        );
        return problem("mass.lumped", text);
    }
    Ok(())
}
