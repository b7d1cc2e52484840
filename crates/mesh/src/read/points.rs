//! Points without elements: tables of coordinates (.csv) and TetGen's and Triangle's .node files.

use std::path::Path;

use nalgebra::{Vector2, Vector3};

use super::content::Content;
use super::tetgen::{self, Nodes};
use super::words::Words;
use super::{extension, text, unknown_extension};
use crate::{MeshError, Problem};

/// Extensions of the files of points.
const KNOWN: &str = ".csv (x,y or x,y,z in each line) or .node (Triangle, TetGen), each also as .gz";

/// Points in the plane or in space, m.
#[derive(Clone, Debug, PartialEq)]
pub enum Points {
    /// x and y of each.
    InPlane(Vec<Vector2<f64>>),
    /// x, y and z of each.
    InSpace(Vec<Vector3<f64>>),
}

/// Reads points: `.csv` with two or three numbers in each line, after an optional line of names, or `.node` in two or three dimensions;
/// each also compressed, with `.gz` after its extension.
pub fn read_points(path: &Path) -> Result<Points, MeshError> {
    match extension(path).as_str() {
        "csv" => table(path, &text(path)?),
        "node" => nodes(path, &text(path)?),
        _ => Err(unknown_extension(path, KNOWN)),
    }
}

fn table(file: &Path, text: &str) -> Result<Points, MeshError> {
    // Spreadsheets separate by commas, semicolons or tabs.
    let text = text.replace([',', ';'], " ");
    let is_name = |word: &str| word.parse::<f64>().is_err();
    let mut lines = Words::of_lines(file, &text).peekable();
    lines.next_if(|first| first.clone().all(is_name));
    let Some(first) = lines.peek() else { return Err(MeshError::in_file(file, Problem::Empty { what: "points" })) };
    let dimension = first.clone().count();
    let rows = lines.map(|mut line| {
        let place = coordinates(&mut line, dimension)?;
        line.end("as many numbers as the first line has").map(|()| place)
    });
    points(file, dimension, rows.collect::<Result<_, _>>()?)
}

/// The nodes of Triangle or TetGen.
fn nodes(file: &Path, text: &str) -> Result<Points, MeshError> {
    let Nodes { places, dimension, .. } = tetgen::nodes(file, text, &mut Content::default())?;
    Ok(if dimension == 2 { Points::InPlane(places.iter().map(Vector3::xy).collect()) } else { Points::InSpace(places) })
}

fn coordinates(line: &mut Words, dimension: usize) -> Result<Vec<f64>, MeshError> {
    (0..dimension.min(4)).map(|_| line.coordinate()).collect()
}

fn points(file: &Path, dimension: usize, places: Vec<Vec<f64>>) -> Result<Points, MeshError> {
    match dimension {
        2 => Ok(Points::InPlane(places.iter().map(|x| Vector2::new(x[0], x[1])).collect())),
        3 => Ok(Points::InSpace(places.iter().map(|x| Vector3::new(x[0], x[1], x[2])).collect())),
        _ => {
            let found = format!("a file with {dimension} coordinates for each point");
            Err(MeshError::in_file(file, Problem::Unsupported { found, instead: "give two or three" }))
        }
    }
}
