//! Gmsh's text file, version 4.1, with a physical group for each named set. Source: Gmsh reference manual, «MSH file format».

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::place;
use crate::{Mesh, MeshSet};

/// Gmsh's number for the point, and for the line, triangle and tetrahedron with so many nodes.
const fn kind(nodes: usize) -> usize {
    match nodes {
        1 => 15,
        2 => 1,
        3 => 2,
        6 => 9,
        10 => 11,
        _ => 4,
    }
}

/// The dimension of elements with so many nodes.
const fn dimension(nodes: usize) -> usize {
    if matches!(nodes, 3 | 6) { 2 } else { 3 }
}

/// The sets of an element, by their numbers, which count from 1: an entity of the file for each such list.
type Groups = Vec<usize>;

/// Nodes of each element of one dimension, and its sets.
type Parts = Vec<(Vec<usize>, Groups)>;

pub(super) fn write<const N: usize>(out: &mut dyn Write, mesh: &Mesh<3, N>) -> io::Result<()> {
    let parts = parts(mesh);
    let entities = parts.each_ref().map(entities);
    writeln!(out, "$MeshFormat\n4.1 0 8\n$EndMeshFormat")?;
    if !mesh.sets.is_empty() {
        write_names(out, mesh)?;
        write_entities(out, mesh, &entities)?;
    }
    let nodes = mesh.vertices.len();
    writeln!(out, "$Nodes\n1 {nodes} 1 {nodes}\n{} 1 0 {nodes}", dimension(N))?;
    for tag in 1..=nodes {
        writeln!(out, "{tag}")?;
    }
    for x in &mesh.vertices {
        writeln!(out, "{}", place(x))?;
    }
    writeln!(out, "$EndNodes")?;
    write_elements(out, &parts, &entities)
}

/// The elements by dimension; those of a lower dimension than the mesh are those of the sets.
fn parts<const N: usize>(mesh: &Mesh<3, N>) -> [Parts; 4] {
    let groups_of = |list: fn(&MeshSet) -> Vec<Vec<usize>>| {
        let mut groups: BTreeMap<Vec<usize>, Groups> = BTreeMap::new();
        for (number, set) in mesh.sets.values().enumerate() {
            list(set).into_iter().for_each(|nodes| groups.entry(nodes).or_default().push(number + 1));
        }
        groups
    };
    let mut of_element = groups_of(|set| set.elements.iter().map(|&element| vec![element]).collect());
    let elements = mesh.elements.iter().enumerate().map(|(element, nodes)| {
        let groups = of_element.remove(&[element][..]).unwrap_or_default();
        (nodes.to_vec(), groups)
    });
    let mut parts = [
        groups_of(|set| set.points.iter().map(|&node| vec![node]).collect()).into_iter().collect(),
        groups_of(|set| set.edges.iter().map(|edge| edge.to_vec()).collect()).into_iter().collect(),
        groups_of(|set| set.faces.iter().map(|face| face.to_vec()).collect()).into_iter().collect(),
        Parts::new(),
    ];
    parts[dimension(N)] = elements.collect();
    parts
}

/// The lists of sets that occur, each with its tag, which counts from 1.
fn entities(parts: &Parts) -> BTreeMap<Groups, usize> {
    let mut entities: BTreeMap<Groups, usize> = parts.iter().map(|(_, groups)| (groups.clone(), 0)).collect();
    entities.values_mut().enumerate().for_each(|(i, tag)| *tag = i + 1);
    entities
}

fn write_names<const N: usize>(out: &mut dyn Write, mesh: &Mesh<3, N>) -> io::Result<()> {
    let dimensions = |set: &MeshSet| {
        let mut has_parts = [!set.points.is_empty(), !set.edges.is_empty(), !set.faces.is_empty(), false];
        has_parts[dimension(N)] = !set.elements.is_empty();
        (0..4).filter(move |&dimension| has_parts[dimension])
    };
    let count: usize = mesh.sets.values().map(|set| dimensions(set).count()).sum();
    writeln!(out, "$PhysicalNames\n{count}")?;
    for (number, (name, set)) in mesh.sets.iter().enumerate() {
        for dimension in dimensions(set) {
            writeln!(out, "{dimension} {} \"{name}\"", number + 1)?;
        }
    }
    writeln!(out, "$EndPhysicalNames")
}

/// Tag, extent, sets and, apart from points, the absence of bounding entities. The mesh's extent serves for each.
fn write_entities<const N: usize>(
    out: &mut dyn Write,
    mesh: &Mesh<3, N>,
    entities: &[BTreeMap<Groups, usize>; 4],
) -> io::Result<()> {
    let counts = entities.each_ref().map(|entities| entities.len().to_string());
    writeln!(out, "$Entities\n{}", counts.join(" "))?;
    let first = mesh.vertices.first().copied().unwrap_or_default();
    let least = mesh.vertices.iter().fold(first, |least, x| least.inf(x));
    let most = mesh.vertices.iter().fold(first, |most, x| most.sup(x));
    for (dimension, entities) in entities.iter().enumerate() {
        for (groups, tag) in entities {
            let extent = if dimension == 0 { place(&least) } else { format!("{} {}", place(&least), place(&most)) };
            let numbers: String = groups.iter().map(|group| format!(" {group}")).collect();
            let bounding = if dimension == 0 { "" } else { " 0" };
            writeln!(out, "{tag} {extent} {}{numbers}{bounding}", groups.len())?;
        }
    }
    writeln!(out, "$EndEntities")
}

/// Blocks of consecutive elements of one entity, so that those of the mesh keep their order.
fn write_elements(out: &mut dyn Write, parts: &[Parts; 4], entities: &[BTreeMap<Groups, usize>; 4]) -> io::Result<()> {
    let blocks = |parts: &Parts| parts.chunk_by(|a, b| a.1 == b.1).count();
    let count: usize = parts.iter().map(Vec::len).sum();
    writeln!(out, "$Elements\n{} {count} 1 {count}", parts.iter().map(blocks).sum::<usize>())?;
    let mut tag = 0;
    for (dimension, parts) in parts.iter().enumerate() {
        for block in parts.chunk_by(|a, b| a.1 == b.1) {
            let (nodes, groups) = &block[0];
            writeln!(out, "{dimension} {} {} {}", entities[dimension][groups], kind(nodes.len()), block.len())?;
            for (nodes, _) in block {
                tag += 1;
                let mut nodes = nodes.clone();
                if nodes.len() == 10 {
                    // The middles of the last two edges are in the other order.
                    nodes.swap(8, 9);
                }
                let nodes: String = nodes.iter().map(|node| format!(" {}", node + 1)).collect();
                writeln!(out, "{tag}{nodes}")?;
            }
        }
    }
    writeln!(out, "$EndElements")
}
