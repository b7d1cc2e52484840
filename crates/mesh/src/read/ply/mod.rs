//! Polygon files, text and binary. Source: G. Turk, The PLY Polygon File Format (1994).

mod header;
mod number;
mod reader;

use std::path::Path;

use nalgebra::Vector3;

use self::header::{Element, Property, header};
use self::reader::Reader;
use super::content::Content;
use super::words::from_zero;
use crate::{MeshError, Problem};

/// Properties of a face that hold the indices of its corners.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Reads `x`, `y` and `z` of each `vertex`, and the indices of each `face` and of each strip of `tristrips`. Polygons become fans.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<Content, MeshError> {
    let mut reader = Reader::new(file, bytes);
    let elements = header(&mut reader)?;
    let mut content = Content { is_surface: true, ..Content::default() };
    let mut corners: Vec<[f64; 3]> = Vec::new();
    for element in &elements {
        tell_unread(&mut content, element);
        // Entries without properties would take no bytes, and any number of them no time to announce.
        for _ in 0..if element.properties.is_empty() { 0 } else { element.count } {
            match &element.name[..] {
                "vertex" => content.vertices.push(vertex(&mut reader, element)?),
                "face" => {
                    let polygon = indices(&mut reader, element)?;
                    content.short_faces += usize::from(polygon.len() < 3);
                    add_fan(&polygon, &mut corners);
                }
                "tristrips" => add_strips(&indices(&mut reader, element)?, &mut corners),
                _ => entry(&mut reader, element, |_, _| ())?,
            }
        }
        if let Some(line) = reader.longer_rows() {
            let (name, last) = (&element.name, element.properties.last().map_or("", |last| &last.name));
            content.notes.tell(format!(
                "the rows of `{name}` are longer than the header says, the first in line {line}; what stands after `{last}` is not read"
            ));
        }
    }
    reader.end()?;
    // Indices are checked at the end: faces may stand before the vertices.
    content.triangles.reserve_exact(corners.len());
    for corners in corners {
        let corner = |index: f64| match index.fract() == 0.0 {
            true => from_zero(index as i64, 0, content.vertices.len()),
            false => Err(Problem::NotA { word: index.to_string(), expected: "the index of a vertex" }),
        };
        let [a, b, c] = corners.map(|index| corner(index).map_err(|problem| MeshError::in_file(file, problem)));
        content.triangles.push([a?, b?, c?]);
    }
    Ok(content)
}

/// Names the properties and elements that are not read.
fn tell_unread(content: &mut Content, element: &Element) {
    let known: &[&str] = match &element.name[..] {
        "vertex" => &["x", "y", "z"],
        "face" | "tristrips" => &CORNERS,
        other => return content.notes.unread(format!("the element `{other}`")),
    };
    for Property { name, .. } in element.properties.iter().filter(|property| !known.contains(&&property.name[..])) {
        content.notes.unread(format!("`{name}` of {}", element.name));
    }
}

/// Adds a polygon as triangles around its first corner; one of fewer than three corners has none.
fn add_fan(corners: &[f64], triangles: &mut Vec<[f64; 3]>) {
    if let [first, rest @ ..] = corners {
        triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
    }
}

/// Adds strips of triangles, which a negative number ends. Every second triangle of a strip is turned.
fn add_strips(corners: &[f64], triangles: &mut Vec<[f64; 3]>) {
    for strip in corners.split(|&index| index < 0.0) {
        let turned = |(i, corners): (usize, &[f64])| match i % 2 {
            0 => [corners[0], corners[1], corners[2]],
            _ => [corners[1], corners[0], corners[2]],
        };
        triangles.extend(strip.windows(3).enumerate().map(turned));
    }
}

fn vertex(reader: &mut Reader, element: &Element) -> Result<Vector3<f64>, MeshError> {
    let mut place = Vector3::repeat(f64::NAN);
    entry(reader, element, |property, numbers| {
        if let (Some(i), Some(number)) = (["x", "y", "z"].iter().position(|name| *name == property), numbers.first()) {
            place[i] = *number;
        }
    })?;
    if place.iter().all(|x| x.is_finite()) {
        return Ok(place);
    }
    Err(reader.error(Problem::NotFinite { word: format!("{:?}", <[f64; 3]>::from(place)) }))
}

/// The indices of a face or of strips.
fn indices(reader: &mut Reader, element: &Element) -> Result<Vec<f64>, MeshError> {
    let mut corners = Vec::new();
    entry(reader, element, |property, numbers| {
        if CORNERS.contains(&property) {
            corners = numbers.to_vec();
        }
    })?;
    Ok(corners)
}

/// Reads one entry, and hands over the numbers of each of its properties.
fn entry(reader: &mut Reader, element: &Element, mut take: impl FnMut(&str, &[f64])) -> Result<(), MeshError> {
    reader.begin_row();
    let mut numbers = Vec::new();
    for Property { name, length, kind } in &element.properties {
        let length = match length {
            None => 1,
            Some(kind) => {
                let length = reader.number(*kind)?;
                if !(length >= 0.0 && length.fract() == 0.0) {
                    let word = length.to_string();
                    return Err(reader.error(Problem::NotA { word, expected: "the length of a list" }));
                }
                length as usize
            }
        };
        numbers.clear();
        for _ in 0..length {
            numbers.push(reader.number(*kind)?);
        }
        take(name, &numbers);
    }
    reader.end_row(element.count)
}
