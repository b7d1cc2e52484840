//! Sections of versions 1 and 2.0 to 2.2, in which every element names its physical group.

use std::collections::HashMap;

use super::builder::{Builder, Group};
use super::kinds::{Kind, TETRAHEDRON, TRIANGLE, kind};
use super::numbers::Numbers;
use crate::MeshError;
use crate::read::content::Entry;

/// A count, then `<tag> <x> <y> <z>` for each node.
pub(super) fn read_nodes(numbers: &mut Numbers, section: &str, mesh: &mut Builder) -> Result<(), MeshError> {
    let announced = numbers.text_count("the number of nodes")?;
    for row in 0..announced {
        numbers.row("nodes", announced, row)?;
        let tag = numbers.int("the tag of a node")?;
        mesh.add_tag(tag, 0).map_err(|problem| numbers.error(problem))?;
        mesh.add_place(numbers.place()?);
        numbers.end_row("the coordinates of the node")?;
    }
    numbers.end(section, "nodes", announced, mesh.nodes())
}

/// A count, then `<tag> <type> <tags> <tag …> <nodes …>` for each element, or in version 1 `<tag> <type> <group> <entity> <number of nodes>
/// <nodes …>`. In a binary file elements of one type and number of tags follow each other: `<type> <elements> <tags>`, then `<tag> <tag …>
/// <nodes …>` for each.
pub(super) fn read_elements(numbers: &mut Numbers, is_first: bool, mesh: &mut Builder) -> Result<(), MeshError> {
    let announced = numbers.text_count("the number of elements")?;
    let is_binary = numbers.is_binary;
    let (mut found, mut known) = (0, Known::new());
    while found < announced {
        numbers.row("elements", announced, found)?;
        if !is_binary {
            numbers.int("the tag of an element")?;
        }
        let number = numbers.int("the type of an element")?;
        let count = if is_binary { numbers.amount("the number of elements that follow")? } else { 1 };
        // Version 1 has the group, the entity and the number of nodes in place of the tags.
        let tags = if is_first { 3 } else { numbers.amount("the number of tags")? };
        let kind = kind(number).map_err(|problem| numbers.error(problem))?;
        for _ in 0..count {
            if is_binary {
                numbers.int("the tag of an element")?;
            }
            read_element(numbers, kind, tags, &mut known, mesh)?;
        }
        found += count;
    }
    numbers.end(if is_first { "ELM" } else { "Elements" }, "elements", announced, found)
}

/// Tetrahedra and triangles of physical groups so far: entry and groups by the type and the tags of the nodes, 0 for the fourth of a triangle.
type Known = HashMap<(i64, [i64; 4]), (Entry, Vec<Group>)>;

fn read_element(
    numbers: &mut Numbers,
    kind: Kind,
    tags: usize,
    known: &mut Known,
    mesh: &mut Builder,
) -> Result<(), MeshError> {
    let mut group = 0;
    for tag in 0..tags {
        let found = numbers.int("a tag of an element")?;
        group = if tag == 0 { found.saturating_abs() } else { group };
    }
    let mut nodes = Vec::with_capacity(kind.nodes);
    for _ in 0..kind.nodes {
        nodes.push(numbers.int("the tag of a node")?);
    }
    numbers.end_row("the nodes of the element")?;
    let groups: &[Group] = if group == 0 { &[] } else { &[(kind.dimension, group)] };
    let mut add = || mesh.add_element(kind, &nodes, groups).map_err(|problem| numbers.error(problem));
    if groups.is_empty() || ![TETRAHEDRON, TRIANGLE].contains(&kind.number) {
        return add().map(drop);
    }
    let mut key = [0; 4];
    key[..nodes.len()].copy_from_slice(&nodes);
    key[..nodes.len()].sort_unstable();
    match known.get_mut(&(kind.number, key)) {
        // An element of several groups stands in the file once for each.
        Some((entry, earlier)) if !earlier.contains(&groups[0]) => {
            earlier.push(groups[0]);
            mesh.add_to_group(*entry, groups[0]);
        }
        Some(_) => drop(add()?),
        None => drop(known.insert((kind.number, key), (add()?, groups.to_vec()))),
    }
    Ok(())
}
