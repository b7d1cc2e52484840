//! The nodes, boundary triangles and elements that a selector names. An empty selection is refused.

use std::collections::HashSet;

use nalgebra::Vector3;

use crate::tables::{BoxTable, Plane, Region, Selector, SidePlane, SphereTable};
use crate::{BodyMesh, Scene, SceneError};
use fem_mesh::{MeshSet, Side};

/// The one selector of a checked table.
pub(crate) fn chosen(mut selectors: Vec<Selector>) -> Selector {
    match (selectors.pop(), selectors.pop()) {
        (Some(selector), None) => selector,
        _ => unreachable!("a table without exactly one selector is refused when the scene is read"),
    }
}

/// The nodes that a selector of `table` names, such as `fixed` or `prescribed[0]`: ascending, without repeats, at least one. A
/// set of the mesh gives the nodes of its triangles, edges and points, or of its elements if it has nothing else.
pub(crate) fn nodes(
    scene: &Scene,
    table: &str,
    selector: &Selector,
    mesh: &BodyMesh,
) -> Result<Vec<usize>, SceneError> {
    let nodes = match selector {
        Selector::Set(name) => mesh.nodes_of_set(set(scene, table, name, mesh)?),
        Selector::Nodes(nodes) => listed(scene, &format!("{table}.nodes"), nodes, mesh)?,
        Selector::Faces(faces) => listed(scene, &format!("{table}.faces"), faces.as_flattened(), mesh)?,
        Selector::Edges(edges) => listed(scene, &format!("{table}.edges"), edges.as_flattened(), mesh)?,
        Selector::Region(region) => {
            let is_inside = inside(region, mesh);
            (0..mesh.vertices().len()).filter(|&node| is_inside(&mesh.vertices()[node])).collect()
        }
    };
    not_empty(scene, table, selector, mesh, nodes, "node")
}

/// The boundary triangles that a selector of `table` names: those with all corners inside, or those of a set. They are as in
/// `boundary`, counter-clockwise from outside, at least one.
pub(crate) fn faces(
    scene: &Scene,
    table: &str,
    selector: &Selector,
    mesh: &BodyMesh,
    boundary: &[[usize; 3]],
) -> Result<Vec<[usize; 3]>, SceneError> {
    let faces = match selector {
        Selector::Set(name) => {
            let set = set(scene, table, name, mesh)?;
            if set.faces.is_empty() {
                let text = format!("is {name:?}, which has {} and no triangles; name a set of triangles", set.counts());
                return Err(scene.refuse(&format!("{table}.set"), &text));
            }
            of_boundary(scene, &format!("{table}.set"), &set.faces, boundary)?
        }
        Selector::Faces(faces) => of_boundary(scene, &format!("{table}.faces"), faces, boundary)?,
        Selector::Edges(_) => {
            let text = "names edges of an outline, and a solid body has triangles; name them by faces";
            return Err(scene.refuse(&format!("{table}.edges"), text));
        }
        Selector::Region(_) | Selector::Nodes(_) => {
            let mut is_selected = vec![false; mesh.vertices().len()];
            nodes(scene, table, selector, mesh)?.into_iter().for_each(|node| is_selected[node] = true);
            boundary.iter().filter(|face| face.iter().all(|&node| is_selected[node])).copied().collect()
        }
    };
    not_empty(scene, table, selector, mesh, faces, "triangle of the boundary")
}

/// The edges of a flat body's outline that a selector of `table` names, as in [`BodyMesh::outline`]: those with both ends inside, or those
/// of a set. At least one.
pub(crate) fn edges(
    scene: &Scene,
    table: &str,
    selector: &Selector,
    mesh: &BodyMesh,
) -> Result<Vec<Vec<usize>>, SceneError> {
    let mut outline = mesh.outline();
    match selector {
        Selector::Set(name) => {
            let set = set(scene, table, name, mesh)?;
            if set.edges.is_empty() {
                let text = format!("is {name:?}, which has {} and no edges; name a set of edges", set.counts());
                return Err(scene.refuse(&format!("{table}.set"), &text));
            }
            outline.retain(|edge| set.edges.contains(&[edge[0].min(edge[1]), edge[0].max(edge[1])]));
        }
        Selector::Faces(_) => {
            let text = "names triangles of the boundary, and a flat body has edges; name them by edges";
            return Err(scene.refuse(&format!("{table}.faces"), text));
        }
        Selector::Edges(wanted) => {
            outline = of_outline(scene, &format!("{table}.edges"), wanted, outline)?;
        }
        Selector::Region(_) | Selector::Nodes(_) => {
            let selected: HashSet<usize> = nodes(scene, table, selector, mesh)?.into_iter().collect();
            outline.retain(|edge| edge[..2].iter().all(|node| selected.contains(node)));
        }
    }
    not_empty(scene, table, selector, mesh, outline, "edge of the outline")
}

/// The elements that a selector of `table` names: those whose centroid lies inside, those of a set, or those of which all nodes
/// are listed. Ascending, at least one.
pub(crate) fn elements(
    scene: &Scene,
    table: &str,
    selector: &Selector,
    mesh: &BodyMesh,
) -> Result<Vec<usize>, SceneError> {
    let matching = |is_selected: &dyn Fn(&[usize]) -> bool| -> Vec<usize> {
        (0..mesh.elements()).filter(|&element| is_selected(mesh.nodes_of(element))).collect()
    };
    let elements = match selector {
        Selector::Set(name) => {
            let set = set(scene, table, name, mesh)?;
            if set.elements.is_empty() {
                let kind = mesh.kind();
                let text = format!("is {name:?}, which has {} and no {kind}; name a set of {kind}", set.counts());
                return Err(scene.refuse(&format!("{table}.set"), &text));
            }
            set.elements.clone()
        }
        Selector::Nodes(_) | Selector::Faces(_) | Selector::Edges(_) => {
            let nodes: HashSet<usize> = nodes(scene, table, selector, mesh)?.into_iter().collect();
            matching(&|element| element.iter().all(|node| nodes.contains(node)))
        }
        Selector::Region(region) => {
            let is_inside = inside(region, mesh);
            let centroid = |nodes: &[usize]| {
                nodes.iter().map(|&node| mesh.vertices()[node]).sum::<Vector3<f64>>() / nodes.len() as f64
            };
            matching(&|nodes| is_inside(&centroid(nodes)))
        }
    };
    not_empty(scene, table, selector, mesh, elements, "element")
}

/// Points nearer than this part of the mesh's size to a box or sphere count as inside: coordinates are rounded.
const NEAR: f64 = 1e-9;

/// Returns true if a point (m) lies in a region; a side is that of the mesh's bounding box.
fn inside(region: &Region, mesh: &BodyMesh) -> impl Fn(&Vector3<f64>) -> bool {
    let (least, most) = span(mesh);
    let near = NEAR * (most - least).amax();
    move |x| match region {
        Region::All => true,
        Region::Side(SidePlane { axis, side: Side::Min, within }) | Region::Plane(Plane { axis, below: within }) => {
            x[*axis as usize] <= least[*axis as usize] + within
        }
        Region::Side(SidePlane { axis, side: Side::Max, within }) => x[*axis as usize] >= most[*axis as usize] - within,
        Region::Box(BoxTable { min, max }) => (0..3).all(|i| x[i] >= min[i] - near && x[i] <= max[i] + near),
        Region::Sphere(SphereTable { center, radius }) => (x - Vector3::from(*center)).norm() <= radius + near,
    }
}

/// Corners of the mesh's bounding box, m.
fn span(mesh: &BodyMesh) -> (Vector3<f64>, Vector3<f64>) {
    let start = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    mesh.vertices().iter().fold(start, |(least, most), x| (least.inf(x), most.sup(x)))
}

/// The set of this name. Refuses a name that the mesh does not have, with those that it has.
fn set<'a>(scene: &Scene, table: &str, name: &str, mesh: &'a BodyMesh) -> Result<&'a MeshSet, SceneError> {
    mesh.sets().get(name).ok_or_else(|| {
        let known: Vec<_> = mesh.sets().iter().map(|(name, set)| format!("{name:?} ({})", set.counts())).collect();
        let text = match &known[..] {
            [] => format!("is {name:?}, and the mesh has no sets; give a .msh file with physical groups, or use a box"),
            known => format!("is {name:?}, and the mesh has the sets {}; name one of them", known.join(", ")),
        };
        scene.refuse(&format!("{table}.set"), &text)
    })
}

/// The triangles of the boundary with these nodes, in the order of the boundary. Refuses a triangle that is not on the boundary.
fn of_boundary(
    scene: &Scene,
    field: &str,
    wanted: &[[usize; 3]],
    boundary: &[[usize; 3]],
) -> Result<Vec<[usize; 3]>, SceneError> {
    let keys: HashSet<_> = wanted.iter().map(sorted).collect();
    let faces: Vec<_> = boundary.iter().filter(|face| keys.contains(&sorted(face))).copied().collect();
    let known: HashSet<_> = faces.iter().map(sorted).collect();
    match wanted.iter().find(|face| !known.contains(&sorted(face))) {
        Some(face) => {
            Err(scene.refuse(field, &format!("names {face:?}, which is no triangle of the boundary; correct it")))
        }
        None => Ok(faces),
    }
}

/// The edges of an outline with these ends, in the order of the outline. Refuses an edge that is not on it.
fn of_outline(
    scene: &Scene,
    field: &str,
    wanted: &[[usize; 2]],
    outline: Vec<Vec<usize>>,
) -> Result<Vec<Vec<usize>>, SceneError> {
    let ends = |a: usize, b: usize| [a.min(b), a.max(b)];
    let keys: HashSet<_> = wanted.iter().map(|&[a, b]| ends(a, b)).collect();
    let known: HashSet<_> = outline.iter().map(|edge| ends(edge[0], edge[1])).collect();
    if let Some(edge) = wanted.iter().find(|&&[a, b]| !known.contains(&ends(a, b))) {
        return Err(scene.refuse(field, &format!("names {edge:?}, which is no edge of the outline; correct it")));
    }
    Ok(outline.into_iter().filter(|edge| keys.contains(&ends(edge[0], edge[1]))).collect())
}

fn sorted(face: &[usize; 3]) -> [usize; 3] {
    let mut key = *face;
    key.sort_unstable();
    key
}

/// Refuses an empty selection, with the selector and the extent of the mesh.
fn not_empty<T>(
    scene: &Scene,
    table: &str,
    selector: &Selector,
    mesh: &BodyMesh,
    found: Vec<T>,
    what: &str,
) -> Result<Vec<T>, SceneError> {
    if !found.is_empty() {
        return Ok(found);
    }
    let ([a, b, c], [d, e, f]) = (<[f64; 3]>::from(span(mesh).0), <[f64; 3]>::from(span(mesh).1));
    let text = format!(
        "{} names no {what}; the mesh spans [{a}, {b}, {c}] to [{d}, {e}, {f}] m, enlarge or correct it",
        description(selector)
    );
    Err(scene.refuse(&format!("{table}.{}", selector.key()), &text))
}

fn description(selector: &Selector) -> String {
    match selector {
        Selector::Region(Region::All) => "= \"all\"".to_owned(),
        Selector::Region(Region::Side(SidePlane { axis, side, within })) => {
            format!("(side {side:?} of {axis:?} within {within} m)").to_lowercase()
        }
        Selector::Region(Region::Plane(Plane { axis, below })) => format!("({axis:?} below {below} m)").to_lowercase(),
        Selector::Region(Region::Box(BoxTable { min, max })) => format!("(from {min:?} to {max:?} m)"),
        Selector::Region(Region::Sphere(SphereTable { center, radius })) => {
            format!("(radius {radius} m about {center:?} m)")
        }
        Selector::Set(name) => format!("({name:?})"),
        Selector::Nodes(nodes) => format!("({} nodes)", nodes.len()),
        Selector::Faces(faces) => format!("({} triangles)", faces.len()),
        Selector::Edges(edges) => format!("({} edges)", edges.len()),
    }
}

/// Listed nodes, ascending and without repeats. Refuses a node that the mesh does not have.
pub(super) fn listed(scene: &Scene, field: &str, nodes: &[usize], mesh: &BodyMesh) -> Result<Vec<usize>, SceneError> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes.dedup();
    match nodes.last() {
        Some(&node) if node >= mesh.vertices().len() => {
            let last = mesh.vertices().len() - 1;
            Err(scene.refuse(field, &format!("names node {node}; the mesh has nodes 0 to {last}")))
        }
        _ => Ok(nodes),
    }
}
