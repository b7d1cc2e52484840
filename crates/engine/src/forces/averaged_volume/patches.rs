//! Patches of neighbouring elements.

use std::collections::HashMap;

use fem_model::BodyMesh;

/// Linear elements in a patch: fewer lock, more are too soft. Cook's membrane and a cantilever, κ/μ = 5000, decide.
const SIZE: usize = 8;

/// Groups elements of a mesh: quadratic ones alone, linear ones by about [`SIZE`]. A patch grows by the neighbour that shares most nodes with it, so
/// that it is compact; what is left over joins the smallest patch beside it.
pub fn patches(mesh: &BodyMesh, elements: &[usize]) -> Vec<Vec<usize>> {
    if mesh.element().order != 1 {
        return elements.iter().map(|&element| vec![element]).collect();
    }
    let neighbours = neighbours(mesh, elements);
    let mut patch_of: Vec<Option<usize>> = vec![None; elements.len()];
    let mut patches: Vec<Vec<usize>> = Vec::new();
    for seed in 0..elements.len() {
        if patch_of[seed].is_some() {
            continue;
        }
        let patch = grown(mesh, elements, &neighbours, &patch_of, seed);
        let beside = || patch.iter().flat_map(|&place| &neighbours[place]).filter_map(|&place| patch_of[place]);
        let number = match beside().min_by_key(|&other| (patches[other].len(), other)) {
            Some(smallest) if patch.len() <= SIZE / 2 => smallest,
            _ => {
                patches.push(Vec::new());
                patches.len() - 1
            }
        };
        patch.iter().for_each(|&place| patch_of[place] = Some(number));
        patches[number].extend(patch);
    }
    patches.into_iter().map(|patch| patch.into_iter().map(|place| elements[place]).collect()).collect()
}

/// A patch of elements without one, from a seed; places in the list of elements.
fn grown(
    mesh: &BodyMesh,
    elements: &[usize],
    neighbours: &[Vec<usize>],
    patch_of: &[Option<usize>],
    seed: usize,
) -> Vec<usize> {
    let mut patch = vec![seed];
    let mut nodes = mesh.corners_of(elements[seed]).to_vec();
    while patch.len() < SIZE {
        let beside = patch.iter().flat_map(|&place| &neighbours[place]).copied();
        let free = beside.filter(|place| patch_of[*place].is_none() && !patch.contains(place));
        let shared =
            |place: &usize| mesh.corners_of(elements[*place]).iter().filter(|node| nodes.contains(node)).count();
        let Some(next) = free.max_by_key(|place| (shared(place), std::cmp::Reverse(*place))) else { break };
        nodes.extend(mesh.corners_of(elements[next]));
        patch.push(next);
    }
    patch
}

/// The elements that share a face with each, as places in the list, ascending.
fn neighbours(mesh: &BodyMesh, elements: &[usize]) -> Vec<Vec<usize>> {
    let mut at_face: HashMap<Vec<usize>, usize> = HashMap::new();
    let mut neighbours = vec![Vec::new(); elements.len()];
    for (place, &element) in elements.iter().enumerate() {
        let corners = mesh.corners_of(element);
        for opposite in corners {
            let mut face: Vec<usize> = corners.iter().copied().filter(|corner| corner != opposite).collect();
            face.sort_unstable();
            if let Some(other) = at_face.insert(face, place) {
                neighbours[place].push(other);
                neighbours[other].push(place);
            }
        }
    }
    neighbours.iter_mut().for_each(|of| of.sort_unstable());
    neighbours
}
