//! Sections of versions 4.0 (text) and 4.1, which list nodes and elements by entity.

use std::collections::HashMap;

use super::builder::{Builder, Group};
use super::kinds::kind;
use super::numbers::Numbers;
use crate::{MeshError, Problem};

/// The two layouts, which differ in the order of a few numbers.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Layout {
    V40,
    V41,
}

/// Physical groups of each entity, by dimension and tag.
pub(super) type Entities = HashMap<(usize, i64), Vec<Group>>;

/// Counts of the entities of each dimension, then the entities.
pub(super) fn read_entities(numbers: &mut Numbers, layout: Layout, entities: &mut Entities) -> Result<(), MeshError> {
    let count = read_list(numbers, layout, entities, |_| Ok(()))?;
    numbers.end("Entities", "entities", count, count)
}

/// The number of partitions, then that of ghost entities and `<tag> <partition>` of each, then entities that have their parent's
/// dimension and tag and their partitions after their own tag.
pub(super) fn read_partitioned(
    numbers: &mut Numbers,
    layout: Layout,
    entities: &mut Entities,
) -> Result<(), MeshError> {
    numbers.row("numbers of partitions", 1, 0)?;
    numbers.count("the number of partitions")?;
    numbers.row("numbers of ghost entities", 1, 0)?;
    let ghosts = numbers.count("the number of ghost entities")?;
    for row in 0..ghosts {
        numbers.row("ghost entities", ghosts, row)?;
        numbers.int("the tag of a ghost entity")?;
        numbers.int("the partition of a ghost entity")?;
    }
    let count = read_list(numbers, layout, entities, |numbers| {
        numbers.int("the dimension of a parent")?;
        numbers.int("the tag of a parent")?;
        for _ in 0..numbers.count("the number of partitions of an entity")? {
            numbers.int("a partition of an entity")?;
        }
        Ok(())
    })?;
    numbers.end("PartitionedEntities", "entities", count, count)
}

/// Counts of the entities of each dimension, then for each: tag, what `middle` reads, bounding box (4.1: points have a position),
/// physical groups, and for curves to volumes the entities of its boundary. Returns their number.
fn read_list(
    numbers: &mut Numbers,
    layout: Layout,
    entities: &mut Entities,
    middle: impl Fn(&mut Numbers) -> Result<(), MeshError>,
) -> Result<usize, MeshError> {
    numbers.row("numbers of entities", 1, 0)?;
    let mut counts = [0; 4];
    for count in &mut counts {
        *count = numbers.count("the number of entities")?;
    }
    numbers.end_row("the numbers of entities")?;
    for (dimension, &count) in counts.iter().enumerate() {
        for row in 0..count {
            numbers.row("entities", count, row)?;
            let tag = numbers.int("the tag of an entity")?;
            middle(numbers)?;
            let extent = if dimension == 0 && layout == Layout::V41 { 3 } else { 6 };
            for _ in 0..extent {
                numbers.real("a coordinate of an entity")?;
            }
            let mut groups = Vec::new();
            for _ in 0..numbers.count("the number of physical groups")? {
                // The sign tells the orientation of the entity in its group.
                groups.push((dimension, numbers.int("the tag of a physical group")?.saturating_abs()));
            }
            if dimension > 0 {
                for _ in 0..numbers.count("the number of bounding entities")? {
                    numbers.int("the tag of a bounding entity")?;
                }
            }
            numbers.end_row("the last entry of the entity")?;
            entities.insert((dimension, tag), groups);
        }
    }
    Ok(counts.iter().sum())
}

/// `<blocks> <nodes> …`, then blocks of `<dim> <tag> <parametric> <nodes>`; all tags stand before all positions (4.1),
/// or each tag beside its position (4.0).
pub(super) fn read_nodes(numbers: &mut Numbers, layout: Layout, mesh: &mut Builder) -> Result<(), MeshError> {
    let (blocks, announced) = header(numbers, layout)?;
    for block in 0..blocks {
        numbers.row("blocks of nodes", blocks, block)?;
        let dimension = entity(numbers, layout)?.0;
        let is_parametric = numbers.int("whether the nodes are parametric")? != 0;
        let count = numbers.count("the number of nodes of the block")?;
        numbers.end_row("the number of nodes of the block")?;
        if layout == Layout::V41 {
            read_tags(numbers, count, mesh)?;
        }
        for row in 0..count {
            numbers.row("nodes", count, row)?;
            if layout == Layout::V40 {
                add_tag(numbers, mesh, 0)?;
            }
            mesh.add_place(numbers.place()?);
            for _ in 0..if is_parametric { dimension } else { 0 } {
                numbers.real("a parametric coordinate")?;
            }
            numbers.end_row("the coordinates of the node")?;
        }
    }
    numbers.end("Nodes", "nodes", announced, mesh.nodes())
}

fn read_tags(numbers: &mut Numbers, count: usize, mesh: &mut Builder) -> Result<(), MeshError> {
    for row in 0..count {
        numbers.row("nodes", count, row)?;
        add_tag(numbers, mesh, row)?;
        // A line with more numbers is a position.
        let fewer = |_| numbers.error(Problem::WrongCount { what: "node tags", announced: count, found: row });
        numbers.end_row("the tag of a node").map_err(fewer)?;
    }
    Ok(())
}

fn add_tag(numbers: &mut Numbers, mesh: &mut Builder, ahead: usize) -> Result<(), MeshError> {
    let tag = numbers.long("the tag of a node")?;
    mesh.add_tag(tag, ahead).map_err(|problem| numbers.error(problem))
}

/// `<blocks> <elements> …`, then blocks of `<dim> <tag> <type> <elements>` (4.0: tag first), then `<tag> <nodes …>` each.
pub(super) fn read_elements(
    numbers: &mut Numbers,
    layout: Layout,
    entities: &Entities,
    mesh: &mut Builder,
) -> Result<(), MeshError> {
    let (blocks, announced) = header(numbers, layout)?;
    let mut found = 0;
    for block in 0..blocks {
        numbers.row("blocks of elements", blocks, block)?;
        let (dimension, tag) = entity(numbers, layout)?;
        let number = numbers.int("the type of the block's elements")?;
        let count = numbers.count("the number of elements of the block")?;
        numbers.end_row("the number of elements of the block")?;
        if count == 0 {
            continue;
        }
        let kind = kind(number).map_err(|problem| numbers.error(problem))?;
        let groups = entities.get(&(dimension, tag)).map_or(&[][..], |groups| groups);
        let mut tags = vec![0; kind.nodes];
        for row in 0..count {
            numbers.row("elements", count, row)?;
            numbers.long("the tag of an element")?;
            for tag in &mut tags {
                *tag = numbers.long("the tag of a node")?;
            }
            numbers.end_row("the nodes of the element")?;
            mesh.add_element(kind, &tags, groups).map_err(|problem| numbers.error(problem))?;
        }
        found += count;
    }
    numbers.end("Elements", "elements", announced, found)
}

/// Numbers of blocks and of entries; 4.1 adds the smallest and the largest tag.
fn header(numbers: &mut Numbers, layout: Layout) -> Result<(usize, usize), MeshError> {
    numbers.row("counts of a section", 1, 0)?;
    let counts = (numbers.count("the number of blocks")?, numbers.count("the number of entries")?);
    if layout == Layout::V41 {
        numbers.long("the smallest tag")?;
        numbers.long("the largest tag")?;
    }
    numbers.end_row("the counts of the section")?;
    Ok(counts)
}

/// Dimension and tag of the entity of a block.
fn entity(numbers: &mut Numbers, layout: Layout) -> Result<(usize, i64), MeshError> {
    let (first, second) = (numbers.int("an integer of the block")?, numbers.int("an integer of the block")?);
    let (dimension, tag) = if layout == Layout::V41 { (first, second) } else { (second, first) };
    match usize::try_from(dimension) {
        Ok(dimension @ 0..=3) => Ok((dimension, tag)),
        _ => Err(numbers.error(Problem::NotA { word: dimension.to_string(), expected: "a dimension from 0 to 3" })),
    }
}
