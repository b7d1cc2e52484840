//! The obstacles of a scene.

use fem_model::{Body, Contact, ContactPlane, PlaneMotion, Refusal};

use crate::Scene;
use crate::check::contact::check;
use crate::tables::PlaneTable;

/// The obstacles of `[[planes]]`, if there are some. Refuses a body that lies behind a plane at the start.
pub(crate) fn contact(scene: &Scene, body: &Body) -> Result<Option<Contact>, Refusal> {
    if scene.planes.is_empty() {
        return Ok(None);
    }
    // The integrator may be another one than that of the file.
    check(scene)?;
    let mut contact = body.contact_with(scene.planes.iter().map(plane).collect(), &scene.method())?;
    if let Some(table) = &scene.contact {
        contact.activation_distance = table.activation_distance.unwrap_or(contact.activation_distance);
        contact.transition_speed = table.transition_speed.unwrap_or(contact.transition_speed);
    }
    Ok(Some(contact))
}

fn plane(table: &PlaneTable) -> ContactPlane {
    let curve = table.curve.as_ref().map(|curve| curve.curve());
    let motion = match (table.velocity, table.displacement.zip(curve)) {
        (_, Some((displacement, curve))) => PlaneMotion::Curve { displacement: displacement.into(), curve },
        (Some(velocity), None) if velocity != [0.0; 3] => {
            PlaneMotion::Uniform { velocity: velocity.into(), until: table.until.unwrap_or(f64::INFINITY) }
        }
        _ => PlaneMotion::AtRest,
    };
    let plane = ContactPlane::new(table.point.into(), table.normal.into());
    ContactPlane { friction: table.friction, motion, ..plane }
}
