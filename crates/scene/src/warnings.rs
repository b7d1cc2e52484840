//! Warnings: properties of a body that are allowed and seldom meant.

use std::collections::BTreeMap;

use crate::Scene;
use crate::meshes::name_of;
use fem_model::{Body, Material};

/// The warnings before a run, each with its remedy: nodes that coincide without being merged, parts that nothing constrains, bodies that
/// overlap, forces on constrained nodes, and materials in which linear tetrahedra lock.
pub fn warnings(scene: &Scene, body: &Body) -> Vec<String> {
    let file = scene.path.display();
    [coincident_nodes(body), unconstrained_parts(body), loaded_constraints(body)]
        .into_iter()
        .flatten()
        .chain(overlaps(scene, body))
        .chain(locking(body))
        .map(|text| format!("{file}: {text}"))
        .collect()
}

/// Materials whose Poisson's ratio is so close to ½ that linear elements, which change their shape only with their volume, are far
/// too stiff.
fn locking(body: &Body) -> impl Iterator<Item = String> {
    let regions = body.regions.iter().map(|region| (&region.name[..], &region.material));
    let materials = std::iter::once(("material", &body.material)).chain(regions);
    let warning = |(table, material): (&str, &Material)| {
        let poisson = material.law.poissons_ratio().filter(|_| material.locks())?;
        let [kind, figures] = body.shape.mesh.element().locking?;
        Some(format!(
            "{table}: Poisson's ratio is {poisson:.4}, and linear {kind} lock near ½{figures}; take quadratic ones \
             (mesh.order = 2) or average the volume ({table}.volumetric = \"averaged\", or \"mixed\"), both of which the engine has, refine the mesh until the result stays, or take a ratio of 0.45 or less"
        ))
    };
    materials.filter_map(warning)
}

/// Bodies of `mesh.files` that lie in one another.
fn overlaps(scene: &Scene, body: &Body) -> Vec<String> {
    let (Some(files), mesh) = (&scene.mesh.files, &body.shape.mesh) else { return Vec::new() };
    let corners: Vec<[usize; 4]> = mesh.corners().filter_map(|nodes| nodes.first_chunk().copied()).collect();
    let mut names: Vec<String> = files.iter().map(|file| name_of(file)).collect();
    names.dedup();
    let pairs = (0..names.len()).flat_map(|j| (0..j).map(move |i| [i, j])).map(|pair| pair.map(|i| &names[i]));
    let warning = |[a, b]: [&String; 2]| {
        let [of_a, of_b] = [a, b].map(|name| mesh.sets().get(name).map_or(&[][..], |set| &set.elements));
        let [least, largest] = fem_mesh::overlap(mesh.vertices(), &corners, of_a, of_b)?
            .map(|x| format!("({:.4}, {:.4}, {:.4})", x.x, x.y, x.z));
        Some(format!(
            "mesh.files: the bodies {a:?} and {b:?} overlap, from {least} to {largest} m, and nothing keeps them apart; move one of them, or \
             mesh them as one body"
        ))
    };
    pairs.filter_map(warning).collect()
}

fn coincident_nodes(body: &Body) -> Option<String> {
    let found = body.shape.mesh.coincident_nodes()?;
    let [a, b] = found.first;
    Some(format!(
        "mesh: {} nodes lie at the place of another one, the first are {a} and {b}; the body is not connected there unless they are \
         merged (in Gmsh: Coherence Mesh)",
        found.count
    ))
}

/// Nodal forces along coordinates that are constrained for good: they go into the reaction and move nothing.
fn loaded_constraints(body: &Body) -> Option<String> {
    let mut is_constrained = vec![[false; 3]; body.shape.mesh.vertices().len()];
    for condition in body.dirichlet.iter().filter(|condition| condition.until.is_none()) {
        for &node in &condition.nodes {
            (0..3).for_each(|i| is_constrained[node][i] |= condition.components[i]);
        }
    }
    body.nodal_forces.iter().enumerate().find_map(|(number, load)| {
        let is_lost = |node: &&usize| (0..3).any(|i| load.force[i] != 0.0 && is_constrained[**node][i]);
        let count = load.nodes.iter().filter(is_lost).count();
        let first = load.nodes.iter().find(is_lost)?;
        Some(format!(
            "force[{number}]: {count} of its {} nodes are constrained along the force, the first is {first}; the reaction takes that part \
             of the force and the body does not feel it; name other nodes, unless that is meant",
            load.nodes.len()
        ))
    })
}

/// Parts without any Dirichlet condition while others have one. Springs connect parts, and the spring of a drag holds its own.
fn unconstrained_parts(body: &Body) -> Option<String> {
    if body.dirichlet.is_empty() {
        return None;
    }
    let mut part = body.shape.mesh.parts();
    for spring in &body.springs {
        let [a, b] = spring.nodes.map(|node| part[node]);
        part.iter_mut().filter(|part| **part == a.max(b)).for_each(|part| *part = a.min(b));
    }
    let mut is_constrained: BTreeMap<usize, bool> = part.iter().map(|&part| (part, false)).collect();
    let conditions = body.dirichlet.iter().flat_map(|condition| &condition.nodes);
    for &node in conditions.chain(body.drag.as_ref().map(|drag| &drag.node)) {
        is_constrained.insert(part[node], true);
    }
    let mut free = is_constrained.iter().filter(|(_, is_constrained)| !**is_constrained).map(|(part, _)| part);
    let count = free.clone().count();
    let first = free.next()?;
    Some(format!(
        "mesh: {count} of {} connected parts have no Dirichlet condition and move freely, the first with node {first}; constrain them \
         by [fixed] or [[prescribed]], or connect them, unless that is meant",
        is_constrained.len()
    ))
}
