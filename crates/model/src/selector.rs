//! Selectors: parts of a mesh by a region of space, a named set or numbers. An empty selection is refused.

use std::collections::HashSet;

use fem_mesh::{MeshSet, Side};
use nalgebra::Vector3;

use crate::simulation::Shape;
use crate::{Axis, BodyMesh, Refusal};

/// Distance from a side of the mesh within which a point lies on it, m.
const ON_SIDE: f64 = 1e-9;

/// A part of the mesh, by the one key that a table gives. A selection without a node, an element or a triangle is an error.
///
/// A triangle is selected if all of its corners are, an element if its centroid is, an edge of a flat body's outline if its two ends are.
#[derive(Clone, Debug, PartialEq)]
pub enum Selector {
    /// `on`, `plane`, `box` or `sphere`: a region of space.
    Region(Region),
    /// `set`: a named set of the mesh: a physical group of a Gmsh file by its name, or by its number if it has no name (`"7"`); a file of
    /// `[mesh] files` by its name without extension. A set gives the nodes of its triangles, lines and points, or those of its tetrahedra
    /// if it has nothing else; a traction takes its triangles. `mesh info FILE` lists the sets of a file;
    /// `scale` and `refine` keep them.
    Set(String),
    /// `nodes`: nodes by their index from 0, such as `[0, 4, 7]`.
    Nodes(Vec<usize>),
    /// `faces`: triangles of the boundary by their nodes, such as `[[4, 0, 1], [4, 1, 5]]`.
    Faces(Vec<[usize; 3]>),
    /// `edges`: edges of a flat body's outline by their two ends, such as `[[0, 1], [1, 2]]`.
    Edges(Vec<[usize; 2]>),
}

/// A region of space.
#[derive(Clone, Debug, PartialEq)]
pub enum Region {
    /// `on = "all"`: the whole mesh, or its whole boundary.
    All,
    /// `on = { axis, side, within }`: near a side of the mesh's bounding box.
    Side {
        /// The coordinate that is constant on the side.
        axis: Axis,
        /// The side of the smallest or of the largest value of this coordinate.
        side: Side,
        /// Largest distance from that value, m; at least 0.
        within: f64,
    },
    /// `plane`: near the side of the smallest coordinate.
    Plane {
        /// The coordinate that is constant on the plane.
        axis: Axis,
        /// Largest distance from the smallest coordinate of the mesh, m; at least 0.
        below: f64,
    },
    /// `box`: inside a box parallel to the axes, its surface included.
    Box {
        /// Smallest coordinates, m.
        min: [f64; 3],
        /// Largest coordinates, m.
        max: [f64; 3],
    },
    /// `sphere`: inside a ball, its surface included.
    Sphere {
        /// Centre, m.
        center: [f64; 3],
        /// Radius, m; positive.
        radius: f64,
    },
}

impl Selector {
    /// Everything that lies on the side of the smallest coordinate along an axis, up to rounding errors.
    pub fn least(axis: Axis) -> Self {
        Self::Region(Region::Side { axis, side: Side::Min, within: ON_SIDE })
    }

    /// Everything that lies on the side of the largest coordinate along an axis, up to rounding errors.
    pub fn most(axis: Axis) -> Self {
        Self::Region(Region::Side { axis, side: Side::Max, within: ON_SIDE })
    }

    /// The key that names it in a scene file.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Region(Region::All | Region::Side { .. }) => "on",
            Self::Region(Region::Plane { .. }) => "plane",
            Self::Region(Region::Box { .. }) => "box",
            Self::Region(Region::Sphere { .. }) => "sphere",
            Self::Set(_) => "set",
            Self::Nodes(_) => "nodes",
            Self::Faces(_) => "faces",
            Self::Edges(_) => "edges",
        }
    }
}

/// The nodes that a selector of `table` names, such as `fixed` or `prescribed[0]`: ascending, without repeats, at least one. A
/// set of the mesh gives the nodes of its triangles, edges and points, or of its elements if it has nothing else. Triangles and edges have the
/// nodes at the middles of their edges.
pub fn nodes(table: &str, selector: &Selector, mesh: &BodyMesh) -> Result<Vec<usize>, Refusal> {
    let nodes = match selector {
        Selector::Set(name) => mesh.nodes_of_set(set(table, name, mesh)?),
        Selector::Nodes(nodes) => listed(&format!("{table}.nodes"), nodes, mesh)?,
        Selector::Faces(faces) => {
            mesh.with_middles(listed(&format!("{table}.faces"), faces.as_flattened(), mesh)?, &[], faces)
        }
        Selector::Edges(edges) => {
            mesh.with_middles(listed(&format!("{table}.edges"), edges.as_flattened(), mesh)?, edges, &[])
        }
        Selector::Region(region) => {
            let is_inside = inside(region, mesh);
            (0..mesh.vertices().len()).filter(|&node| is_inside(&mesh.vertices()[node])).collect()
        }
    };
    not_empty(table, selector, mesh, nodes, "node")
}

/// The faces of the boundary that a selector of `table` names, corners first, as in [`BodyMesh::faces`]: those with all corners inside, or those
/// of a set. At least one.
pub fn loaded_faces(table: &str, selector: &Selector, shape: &Shape) -> Result<Vec<Vec<usize>>, Refusal> {
    let (mesh, mut faces) = (&shape.mesh, shape.faces());
    let corners = mesh.dimension();
    let [kind, one] =
        if corners == 3 { ["triangles", "triangle of the boundary"] } else { ["edges", "edge of the outline"] };
    let wanted = match selector {
        Selector::Set(name) => {
            let set = set(table, name, mesh)?;
            let wanted = if corners == 3 { set.faces.as_flattened() } else { set.edges.as_flattened() };
            if wanted.is_empty() {
                let text = format!("is {name:?}, which has {} and no {kind}; name a set of {kind}", set.counts());
                return Err(Refusal::new(format!("{table}.set"), text));
            }
            wanted
        }
        Selector::Faces(wanted) if corners == 3 => wanted.as_flattened(),
        Selector::Edges(wanted) if corners == 2 => wanted.as_flattened(),
        Selector::Faces(_) => {
            let text = "names triangles of the boundary, and a flat body has edges; name them by edges";
            return Err(Refusal::new(format!("{table}.faces"), text));
        }
        Selector::Edges(_) => {
            let text = "names edges of an outline, and a solid body has triangles; name them by faces";
            return Err(Refusal::new(format!("{table}.edges"), text));
        }
        Selector::Region(_) | Selector::Nodes(_) => {
            let mut is_selected = vec![false; mesh.vertices().len()];
            nodes(table, selector, mesh)?.into_iter().for_each(|node| is_selected[node] = true);
            faces.retain(|face| face[..corners].iter().all(|&node| is_selected[node]));
            return not_empty(table, selector, mesh, faces, one);
        }
    };
    let keys: HashSet<_> = wanted.chunks_exact(corners).map(sorted).collect();
    faces.retain(|face| keys.contains(&sorted(&face[..corners])));
    let known: HashSet<_> = faces.iter().map(|face| sorted(&face[..corners])).collect();
    let other = wanted.chunks_exact(corners).find(|face| !known.contains(&sorted(face)));
    // A set of edges of a flat body may have inner ones.
    if let Some(face) = other.filter(|_| corners == 3 || !matches!(selector, Selector::Set(_))) {
        let text = format!("names {face:?}, which is no {one}; correct it");
        return Err(Refusal::new(format!("{table}.{}", selector.key()), text));
    }
    not_empty(table, selector, mesh, faces, one)
}

/// The elements that a selector of `table` names: those whose centroid lies inside, those of a set, or those of which all nodes
/// are listed. Ascending, at least one.
pub fn elements(table: &str, selector: &Selector, mesh: &BodyMesh) -> Result<Vec<usize>, Refusal> {
    let matching = |is_selected: &dyn Fn(&[usize]) -> bool| -> Vec<usize> {
        (0..mesh.elements()).filter(|&element| is_selected(mesh.nodes_of(element))).collect()
    };
    let elements = match selector {
        Selector::Set(name) => {
            let set = set(table, name, mesh)?;
            if set.elements.is_empty() {
                let kind = mesh.element().name;
                let text = format!("is {name:?}, which has {} and no {kind}; name a set of {kind}", set.counts());
                return Err(Refusal::new(format!("{table}.set"), text));
            }
            set.elements.clone()
        }
        Selector::Nodes(_) | Selector::Faces(_) | Selector::Edges(_) => {
            let nodes: HashSet<usize> = nodes(table, selector, mesh)?.into_iter().collect();
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
    not_empty(table, selector, mesh, elements, "element")
}

/// Points nearer than this part of the mesh's size to a box or sphere count as inside: coordinates are rounded.
const NEAR: f64 = 1e-9;

/// Returns true if a point (m) lies in a region; a side is that of the mesh's bounding box.
fn inside(region: &Region, mesh: &BodyMesh) -> impl Fn(&Vector3<f64>) -> bool {
    let (least, most) = span(mesh);
    let near = NEAR * (most - least).amax();
    move |x| match region {
        Region::All => true,
        Region::Side { axis, side: Side::Min, within } | Region::Plane { axis, below: within } => {
            x[*axis as usize] <= least[*axis as usize] + within
        }
        Region::Side { axis, side: Side::Max, within } => x[*axis as usize] >= most[*axis as usize] - within,
        Region::Box { min, max } => (0..3).all(|i| x[i] >= min[i] - near && x[i] <= max[i] + near),
        Region::Sphere { center, radius } => (x - Vector3::from(*center)).norm() <= radius + near,
    }
}

/// Corners of the mesh's bounding box, m.
fn span(mesh: &BodyMesh) -> (Vector3<f64>, Vector3<f64>) {
    let start = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    mesh.vertices().iter().fold(start, |(least, most), x| (least.inf(x), most.sup(x)))
}

/// The set of this name. Refuses a name that the mesh does not have, with those that it has.
fn set<'a>(table: &str, name: &str, mesh: &'a BodyMesh) -> Result<&'a MeshSet, Refusal> {
    mesh.sets().get(name).ok_or_else(|| {
        let known: Vec<_> = mesh.sets().iter().map(|(name, set)| format!("{name:?} ({})", set.counts())).collect();
        let text = match &known[..] {
            [] => format!("is {name:?}, and the mesh has no sets; give a .msh file with physical groups, or use a box"),
            known => format!("is {name:?}, and the mesh has the sets {}; name one of them", known.join(", ")),
        };
        Refusal::new(format!("{table}.set"), text)
    })
}

fn sorted(nodes: &[usize]) -> Vec<usize> {
    let mut key = nodes.to_vec();
    key.sort_unstable();
    key
}

/// Refuses an empty selection, with the selector and the extent of the mesh.
fn not_empty<T>(
    table: &str,
    selector: &Selector,
    mesh: &BodyMesh,
    found: Vec<T>,
    what: &str,
) -> Result<Vec<T>, Refusal> {
    if !found.is_empty() {
        return Ok(found);
    }
    let ([a, b, c], [d, e, f]) = (<[f64; 3]>::from(span(mesh).0), <[f64; 3]>::from(span(mesh).1));
    let text = format!(
        "{} names no {what}; the mesh spans [{a}, {b}, {c}] to [{d}, {e}, {f}] m, enlarge or correct it",
        description(selector)
    );
    Err(Refusal::new(format!("{table}.{}", selector.key()), text))
}

fn description(selector: &Selector) -> String {
    match selector {
        Selector::Region(Region::All) => "= \"all\"".to_owned(),
        Selector::Region(Region::Side { axis, side, within }) => {
            format!("(side {side:?} of {axis:?} within {within} m)").to_lowercase()
        }
        Selector::Region(Region::Plane { axis, below }) => format!("({axis:?} below {below} m)").to_lowercase(),
        Selector::Region(Region::Box { min, max }) => format!("(from {min:?} to {max:?} m)"),
        Selector::Region(Region::Sphere { center, radius }) => {
            format!("(radius {radius} m about {center:?} m)")
        }
        Selector::Set(name) => format!("({name:?})"),
        Selector::Nodes(nodes) => format!("({} nodes)", nodes.len()),
        Selector::Faces(faces) => format!("({} triangles)", faces.len()),
        Selector::Edges(edges) => format!("({} edges)", edges.len()),
    }
}

/// Listed nodes, ascending and without repeats. Refuses a node that the mesh does not have.
pub fn listed(field: &str, nodes: &[usize], mesh: &BodyMesh) -> Result<Vec<usize>, Refusal> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes.dedup();
    match nodes.last() {
        Some(&node) if node >= mesh.vertices().len() => {
            let last = mesh.vertices().len() - 1;
            Err(Refusal::new(field, format!("names node {node}; the mesh has nodes 0 to {last}")))
        }
        _ => Ok(nodes),
    }
}
