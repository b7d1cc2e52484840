//! The Dirichlet conditions of a scene.

use fem_model::{
    BodyMesh, DirichletCondition, Integrator, LoadCurve, Motion, Refusal, Rotation, check_disjoint, nodes,
};
use nalgebra::Vector3;

use super::chosen;
use crate::Scene;
use crate::tables::{CurveTable, PrescribedTable, RotationTable};

/// The conditions of `[fixed]` and of every `[[prescribed]]`. Refuses a coordinate that two of them prescribe.
pub(crate) fn dirichlet_conditions(scene: &Scene, mesh: &BodyMesh) -> Result<Vec<DirichletCondition>, Refusal> {
    let fixed = scene.fixed.iter().map(|table| {
        let nodes = nodes("fixed", &chosen(table.selectors()), mesh)?;
        Ok(DirichletCondition {
            name: "fixed".to_owned(),
            nodes,
            components: [true; 3],
            motion: None,
            until: table.until,
        })
    });
    let prescribed = scene.prescribed.iter().enumerate().map(|(number, table)| {
        let name = format!("prescribed[{number}]");
        let nodes = nodes(&name, &chosen(table.selectors()), mesh)?;
        let (components, motion) = (table.is_prescribed(), Some(motion(table, scene.time.integrator)));
        Ok(DirichletCondition { name, nodes, components, motion, until: table.until })
    });
    let conditions = fixed.chain(prescribed).collect::<Result<Vec<_>, _>>()?;
    check_disjoint(&conditions, mesh.vertices().len())?;
    Ok(conditions)
}

/// The motion of a table.
fn motion(table: &PrescribedTable, method: Integrator) -> Motion {
    let rotation = |rotation: &RotationTable| Rotation {
        axis: [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()][rotation.axis as usize],
        center: rotation.center.into(),
        turns: rotation.turns,
    };
    // Under `static` a motion grows with the load steps.
    let over = table.over.filter(|_| method != Integrator::Static);
    let curve = over.map(LoadCurve::Ramp).or_else(|| table.curve.as_ref().map(CurveTable::curve));
    Motion {
        displacement: table.velocity.or(table.displacement).unwrap_or_default().into(),
        rotation: table.rotation.as_ref().map(rotation),
        // A velocity times the integral of its factor is the displacement.
        curve: if table.velocity.is_some() { Some(LoadCurve::Integral(curve.map(Box::new))) } else { curve },
    }
}
