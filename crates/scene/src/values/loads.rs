//! External forces: tractions, pressures, nodal forces, springs, the scripted drag.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::selection::{self, chosen, listed};
use crate::tables::{CurveTable, DragTable, DragVertex, ForceTable, SpringTable, TractionTable};
use crate::{BodyMesh, LoadCurve, Scene, SceneError};

/// Dead load on a part of the surface: it keeps its direction and its sum.
#[derive(Clone, Debug, PartialEq)]
pub struct Traction {
    /// Nodes of each part of the boundary: triangles of a solid body, edges of a flat one, as in [`BodyMesh::outline`].
    pub faces: Vec<Vec<usize>>,
    /// Force per undeformed area, Pa.
    pub force_per_area: Vector3<f64>,
    /// Factor of time on it.
    pub curve: Option<LoadCurve>,
}

/// Follower load on a part of the surface: it acts along the normal of the deformed triangles or edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Pressure {
    /// Nodes of each part of the boundary: triangles of a solid body, counter-clockwise from outside; edges of a flat one, as in
    /// [`BodyMesh::outline`].
    pub faces: Vec<Vec<usize>>,
    /// Force per deformed area, Pa; positive pushes inward.
    pub pressure: f64,
    /// Factor of time on it.
    pub curve: Option<LoadCurve>,
}

/// Dead load on single nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct NodalForce {
    /// Nodes, ascending and without repeats.
    pub nodes: Vec<usize>,
    /// Force on each of them, N.
    pub force: Vector3<f64>,
    /// Factor of time on it.
    pub curve: Option<LoadCurve>,
}

/// A spring between two nodes, ½ k (|x_b − x_a| − l)², with a damper beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// The nodes a and b at its ends.
    pub nodes: [usize; 2],
    /// k, N/m.
    pub stiffness: f64,
    /// l, m.
    pub rest_length: f64,
    /// True if l is by definition the undeformed distance of the nodes: any difference is round-off and no strain.
    pub is_initially_relaxed: bool,
    /// c, N s/m.
    pub damping: f64,
}

/// A spring of zero rest length from a node to a target that oscillates about the node's undeformed position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// The node that the spring pulls.
    pub node: usize,
    /// N/m
    pub stiffness: f64,
    /// Used as given, not normalised.
    pub direction: Vector3<f64>,
    /// m
    pub amplitude: f64,
    /// Hz
    pub frequency: f64,
}

impl Drag {
    /// Displacement of the target from the node's undeformed position at a time (s), m: direction · amplitude · sin 2π f t.
    pub fn displacement(&self, time: f64) -> Vector3<f64> {
        self.direction * (self.amplitude * (TAU * self.frequency * time).sin())
    }
}

/// Tractions and pressures.
type SurfaceLoads = (Vec<Traction>, Vec<Pressure>);

/// The loads of every `[[traction]]`. Refuses a table without triangles.
pub(crate) fn surface_loads(
    scene: &Scene,
    mesh: &BodyMesh,
    boundary: &[[usize; 3]],
) -> Result<SurfaceLoads, SceneError> {
    let (mut tractions, mut pressures) = (Vec::new(), Vec::new());
    for (table, faces) in scene.traction.iter().zip(loaded_faces(scene, mesh, boundary)?) {
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
pub(crate) fn loaded_faces(
    scene: &Scene,
    mesh: &BodyMesh,
    boundary: &[[usize; 3]],
) -> Result<Vec<Vec<Vec<usize>>>, SceneError> {
    let faces = |(number, table): (usize, &TractionTable)| {
        let (name, selector) = (format!("traction[{number}]"), chosen(table.selectors()));
        if mesh.is_flat() {
            return selection::edges(scene, &name, &selector, mesh);
        }
        let triangles = selection::faces(scene, &name, &selector, mesh, boundary)?;
        Ok(triangles.into_iter().map(Vec::from).collect())
    };
    scene.traction.iter().enumerate().map(faces).collect()
}

/// The load of every `[[force]]`. Refuses a table without nodes.
pub(crate) fn nodal_forces(scene: &Scene, mesh: &BodyMesh) -> Result<Vec<NodalForce>, SceneError> {
    let load = |(number, table): (usize, &ForceTable)| {
        let nodes = selection::nodes(scene, &format!("force[{number}]"), &chosen(table.selectors()), mesh)?;
        Ok(NodalForce { nodes, force: table.value.into(), curve: curve(&table.curve) })
    };
    scene.force.iter().enumerate().map(load).collect()
}

/// The factor of time of a load.
pub(crate) fn curve(table: &Option<CurveTable>) -> Option<LoadCurve> {
    table.as_ref().map(CurveTable::curve)
}

/// The spring of every `[[springs]]`.
pub(crate) fn springs(scene: &Scene, mesh: &BodyMesh) -> Result<Vec<Spring>, SceneError> {
    let spring = |(number, table): (usize, &SpringTable)| {
        let SpringTable { nodes, stiffness, rest_length, damping } = *table;
        listed(scene, &format!("springs[{number}].nodes"), &nodes, mesh)?;
        let [a, b] = nodes.map(|node| mesh.vertices()[node]);
        let is_initially_relaxed = rest_length.is_none();
        let rest_length = rest_length.unwrap_or((b - a).norm());
        Ok(Spring { nodes, stiffness, rest_length, is_initially_relaxed, damping })
    };
    scene.springs.iter().enumerate().map(spring).collect()
}

/// The spring of `[drag]`.
pub(crate) fn drag(scene: &Scene, mesh: &BodyMesh) -> Result<Option<Drag>, SceneError> {
    let Some(DragTable { vertex, stiffness, direction, amplitude, frequency, .. }) = scene.drag else {
        return Ok(None);
    };
    let node = match vertex {
        DragVertex::Index(node) => listed(scene, "drag.vertex", &[node], mesh).map(|_| node)?,
        DragVertex::Highest => highest_node(mesh),
    };
    Ok(Some(Drag { node, stiffness, direction: direction.into(), amplitude, frequency }))
}

/// The first node of largest y in the undeformed mesh.
pub fn highest_node(mesh: &BodyMesh) -> usize {
    let heights = mesh.vertices().iter().map(|vertex| vertex.y).enumerate();
    let higher = |best: (usize, f64), next: (usize, f64)| if next.1 > best.1 { next } else { best };
    heights.fold((0, f64::NEG_INFINITY), higher).0
}
