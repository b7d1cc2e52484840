//! The fibres of a scene.

use std::path::{Path, PathBuf};

use fem_model::{BodyMesh, FibreDirections, FibreFamily, Refusal, elements};
use nalgebra::Vector3;

use super::chosen;
use super::vectors::{Rows, vectors};
use crate::Scene;
use crate::tables::FibresTable;

const PER_ELEMENT: Rows = Rows { each: "elements", form: "x,y,z, the direction of the fibres" };

/// The family of each `[[fibres]]`. `find` turns the path of a file in the scene into the path to open.
pub(crate) fn fibres(
    scene: &Scene,
    mesh: &BodyMesh,
    find: impl Fn(&Path) -> PathBuf,
) -> Result<Vec<FibreFamily>, Refusal> {
    scene.fibres.iter().enumerate().map(|(number, table)| family(number, table, mesh, &find)).collect()
}

fn family(
    number: usize,
    table: &FibresTable,
    mesh: &BodyMesh,
    find: impl Fn(&Path) -> PathBuf,
) -> Result<FibreFamily, Refusal> {
    let name = format!("fibres[{number}]");
    let elements = match table.selectors() {
        selectors if selectors.is_empty() => (0..mesh.elements()).collect(),
        selectors => elements(&name, &chosen(selectors), mesh)?,
    };
    let own = table.directions();
    let directions = match (own, &table.per_element) {
        (None, Some(file)) => per_element(&name, &find(file), &elements, mesh.elements())?,
        (own, _) => own.unwrap_or(FibreDirections::PerElement(Vec::new())),
    };
    let directions = directions.of(&name, &elements, mesh)?;
    Ok(FibreFamily { name, law: table.law(), directions })
}

/// The directions of a file, of which those of `elements` are used.
fn per_element(name: &str, path: &Path, elements: &[usize], count: usize) -> Result<FibreDirections, Refusal> {
    let field = format!("{name}.per_element");
    let rows = vectors(path, count, &PER_ELEMENT).map_err(|reason| Refusal::new(&field, reason))?;
    if let Some(&element) = elements.iter().find(|&&element| rows[element].vector == Vector3::zeros()) {
        let (file, line) = (path.display(), rows[element].line);
        let text =
            format!("is {file}, whose line {line}, of element {element}, is zero; give the direction of its fibres");
        return Err(Refusal::new(&field, text));
    }
    Ok(FibreDirections::PerElement(rows.into_iter().map(|row| row.vector).collect()))
}
