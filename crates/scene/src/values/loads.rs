//! External forces of a scene: tractions, pressures, nodal forces, springs, the scripted drag.

use fem_model::simulation::Shape;
use fem_model::{
    BodyMesh, Drag, LoadCurve, NodalForce, Pressure, Refusal, Spring, Traction, highest_node, listed, loaded_faces,
    nodes,
};

use super::chosen;
use crate::Scene;
use crate::tables::{CurveTable, DragTable, DragVertex, ForceTable, SpringTable};

/// Tractions and pressures.
type SurfaceLoads = (Vec<Traction>, Vec<Pressure>);

/// The loads of every `[[traction]]`. Refuses a table without triangles.
pub(crate) fn surface_loads(scene: &Scene, shape: &Shape) -> Result<SurfaceLoads, Refusal> {
    let (mut tractions, mut pressures) = (Vec::new(), Vec::new());
    for (table, faces) in scene.traction.iter().zip(faces_of_loads(scene, shape)?) {
        let curve = curve(&table.curve);
        match (table.force_per_area, table.pressure) {
            (Some(force), _) => tractions.push(Traction { faces, force_per_area: force.into(), curve }),
            (None, Some(pressure)) => pressures.push(Pressure { faces, pressure, curve }),
            (None, None) => unreachable!("a traction without a force is refused when the scene is read"),
        }
    }
    Ok((tractions, pressures))
}

/// The nodes of the loaded faces of every `[[traction]]`, in order: triangles of a solid body, edges of a flat one.
pub(crate) fn faces_of_loads(scene: &Scene, shape: &Shape) -> Result<Vec<Vec<Vec<usize>>>, Refusal> {
    let tables = scene.traction.iter().enumerate();
    tables
        .map(|(number, table)| loaded_faces(&format!("traction[{number}]"), &chosen(table.selectors()), shape))
        .collect()
}

/// The load of every `[[force]]`. Refuses a table without nodes.
pub(crate) fn nodal_forces(scene: &Scene, mesh: &BodyMesh) -> Result<Vec<NodalForce>, Refusal> {
    let load = |(number, table): (usize, &ForceTable)| {
        let nodes = nodes(&format!("force[{number}]"), &chosen(table.selectors()), mesh)?;
        Ok(NodalForce { nodes, force: table.value.into(), curve: curve(&table.curve) })
    };
    scene.force.iter().enumerate().map(load).collect()
}

/// The factor of time of a load.
pub(crate) fn curve(table: &Option<CurveTable>) -> Option<LoadCurve> {
    table.as_ref().map(CurveTable::curve)
}

/// The spring of every `[[springs]]`.
pub(crate) fn springs(scene: &Scene, mesh: &BodyMesh) -> Result<Vec<Spring>, Refusal> {
    let spring = |(number, table): (usize, &SpringTable)| {
        let SpringTable { nodes, stiffness, rest_length, damping } = *table;
        listed(&format!("springs[{number}].nodes"), &nodes, mesh)?;
        let [a, b] = nodes.map(|node| mesh.vertices()[node]);
        let is_initially_relaxed = rest_length.is_none();
        let rest_length = rest_length.unwrap_or((b - a).norm());
        Ok(Spring { nodes, stiffness, rest_length, is_initially_relaxed, damping })
    };
    scene.springs.iter().enumerate().map(spring).collect()
}

/// The spring of `[drag]`.
pub(crate) fn drag(scene: &Scene, mesh: &BodyMesh) -> Result<Option<Drag>, Refusal> {
    let Some(DragTable { vertex, stiffness, direction, amplitude, frequency, .. }) = scene.drag else {
        return Ok(None);
    };
    let node = match vertex {
        DragVertex::Index(node) => listed("drag.vertex", &[node], mesh).map(|_| node)?,
        DragVertex::Highest => highest_node(mesh),
    };
    Ok(Some(Drag { node, stiffness, direction: direction.into(), amplitude, frequency }))
}
