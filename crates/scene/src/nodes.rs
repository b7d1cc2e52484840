//! Which nodes and faces of its mesh a scene means.

use std::collections::HashSet;

use super::{Drag, DragVertex, Fixed, Prescribed, Scene, SceneError, SidePlane, Spring, Traction};
use fem_mesh::{Side, TetrahedralMesh, faces_on_side, nodes_on_side};

/// The nodes of `[fixed]`, ascending, each once.
pub(super) fn fixed(scene: &Scene, fixed: &Fixed, mesh: &TetrahedralMesh) -> Result<Vec<usize>, SceneError> {
    if let Some(plane) = &fixed.plane {
        return Ok(nodes_on_side(&mesh.vertices, plane.axis as usize, Side::Min, plane.below));
    }
    listed(scene, "fixed.nodes", fixed.nodes.as_deref().unwrap_or_default(), mesh)
}

/// The nodes of every `[[prescribed]]`, ascending. A coordinate that is prescribed twice, or fixed as well, is refused.
pub(super) fn prescribed(
    scene: &Scene,
    fixed: Option<&[usize]>,
    mesh: &TetrahedralMesh,
) -> Result<Vec<Vec<usize>>, SceneError> {
    let tables = scene.prescribed.iter().enumerate();
    let lists = tables.map(|(number, motion)| prescribed_nodes(scene, number, motion, mesh));
    let lists = lists.collect::<Result<Vec<_>, _>>()?;
    let fixed: HashSet<usize> = fixed.unwrap_or_default().iter().copied().collect();
    let mut holder = vec![[None; 3]; mesh.vertices.len()];
    for (number, nodes) in lists.iter().enumerate() {
        let field = format!("prescribed[{number}]");
        for &node in nodes {
            if fixed.contains(&node) {
                let text = format!("moves node {node}, which [fixed] holds; name each node in one of the two");
                return Err(scene.refuse(&field, &text));
            }
            for axis in (0..3).filter(|&axis| scene.prescribed[number].holds()[axis]) {
                if let Some(other) = holder[node][axis].replace(number) {
                    let name = ["x", "y", "z"][axis];
                    let text = format!(
                        "moves {name} of node {node}, and so does prescribed[{other}]; name each coordinate once"
                    );
                    return Err(scene.refuse(&field, &text));
                }
            }
        }
    }
    Ok(lists)
}

fn prescribed_nodes(
    scene: &Scene,
    number: usize,
    motion: &Prescribed,
    mesh: &TetrahedralMesh,
) -> Result<Vec<usize>, SceneError> {
    match &motion.on {
        Some(SidePlane { axis, side, within }) => Ok(nodes_on_side(&mesh.vertices, *axis as usize, *side, *within)),
        None => {
            listed(scene, &format!("prescribed[{number}].nodes"), motion.nodes.as_deref().unwrap_or_default(), mesh)
        }
    }
}

/// The boundary triangles of every `[[traction]]`, outward; a traction on none is refused.
pub(super) fn loaded_faces(
    scene: &Scene,
    mesh: &TetrahedralMesh,
    boundary: &[[usize; 3]],
) -> Result<Vec<Vec<[usize; 3]>>, SceneError> {
    let tables = scene.traction.iter().enumerate();
    tables.map(|(number, traction)| faces_of(scene, number, traction, mesh, boundary)).collect()
}

fn faces_of(
    scene: &Scene,
    number: usize,
    traction: &Traction,
    mesh: &TetrahedralMesh,
    boundary: &[[usize; 3]],
) -> Result<Vec<[usize; 3]>, SceneError> {
    if let Some(SidePlane { axis, side, within }) = &traction.on {
        let faces = faces_on_side(&mesh.vertices, boundary, *axis as usize, *side, *within);
        if faces.is_empty() {
            return Err(scene.refuse(&format!("traction[{number}].on"), "meets no boundary triangle; enlarge within"));
        }
        return Ok(faces);
    }
    let wanted: HashSet<_> = traction.faces.iter().flatten().map(sorted).collect();
    let faces: Vec<_> = boundary.iter().filter(|face| wanted.contains(&sorted(face))).copied().collect();
    let known: HashSet<_> = faces.iter().map(sorted).collect();
    let field = format!("traction[{number}].faces");
    match traction.faces.iter().flatten().find(|face| !known.contains(&sorted(face))) {
        Some(face) => {
            Err(scene.refuse(&field, &format!("names {face:?}, which is no triangle of the boundary; correct it")))
        }
        None if faces.is_empty() => Err(scene.refuse(&field, "is empty; name a triangle of the boundary or use on")),
        None => Ok(faces),
    }
}

fn sorted(face: &[usize; 3]) -> [usize; 3] {
    let mut key = *face;
    key.sort_unstable();
    key
}

/// The rest length of every spring, m.
pub(super) fn rest_lengths(scene: &Scene, mesh: &TetrahedralMesh) -> Result<Vec<f64>, SceneError> {
    let tables = scene.springs.iter().enumerate();
    let length = |(number, spring): (usize, &Spring)| {
        listed(scene, &format!("springs[{number}].nodes"), &spring.nodes, mesh)?;
        let [a, b] = spring.nodes.map(|node| mesh.vertices[node]);
        Ok(spring.rest_length.unwrap_or_else(|| (b - a).norm()))
    };
    tables.map(length).collect()
}

/// The vertex of `[drag]`.
pub(super) fn dragged(scene: &Scene, drag: &Drag, mesh: &TetrahedralMesh) -> Result<usize, SceneError> {
    match drag.vertex {
        DragVertex::Index(node) => listed(scene, "drag.vertex", &[node], mesh).map(|_| node),
        DragVertex::Highest => {
            let heights = mesh.vertices.iter().map(|vertex| vertex.y).enumerate();
            let higher = |best: (usize, f64), next: (usize, f64)| if next.1 > best.1 { next } else { best };
            Ok(heights.fold((0, f64::NEG_INFINITY), higher).0)
        }
    }
}

/// Ascending, each once; all of them there.
fn listed(scene: &Scene, field: &str, nodes: &[usize], mesh: &TetrahedralMesh) -> Result<Vec<usize>, SceneError> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes.dedup();
    match nodes.last() {
        Some(&node) if node >= mesh.vertices.len() => {
            let last = mesh.vertices.len() - 1;
            Err(scene.refuse(field, &format!("names node {node}; the mesh has nodes 0 to {last}")))
        }
        _ => Ok(nodes),
    }
}
