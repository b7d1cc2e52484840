//! Values of fixed length, read with messages that name the expected length.

use serde::de::{Deserialize, Deserializer, Error};

/// Reads a vector. Serde's own arrays would accept further numbers silently.
pub(super) fn three_numbers<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; 3], D::Error> {
    exactly(Vec::deserialize(deserializer)?, "three numbers")
}

/// Reads a vector that a table may leave out.
pub(super) fn three_numbers_if_any<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<[f64; 3]>, D::Error> {
    three_numbers(deserializer).map(Some)
}

/// Reads the two ends of a spring.
pub(super) fn two_nodes<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[usize; 2], D::Error> {
    exactly(Vec::deserialize(deserializer)?, "two nodes")
}

/// Reads triangles that a table may leave out.
pub(super) fn triangles_if_any<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Vec<[usize; 3]>>, D::Error> {
    let faces = Vec::<Vec<usize>>::deserialize(deserializer)?;
    faces.into_iter().map(|nodes| exactly(nodes, "three nodes")).collect::<Result<_, _>>().map(Some)
}

/// Reads edges that a table may leave out.
pub(super) fn edges_if_any<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Vec<[usize; 2]>>, D::Error> {
    let edges = Vec::<Vec<usize>>::deserialize(deserializer)?;
    edges.into_iter().map(|nodes| exactly(nodes, "two nodes")).collect::<Result<_, _>>().map(Some)
}

fn exactly<T, const N: usize, E: Error>(list: Vec<T>, expected: &str) -> Result<[T; N], E> {
    <[T; N]>::try_from(list).map_err(|list| E::invalid_length(list.len(), &expected))
}
