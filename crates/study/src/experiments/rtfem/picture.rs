//! Pictures of the torus, at rest and squashed.

use std::path::Path;

use fem_chart::triangles;
use fem_mesh::{TetrahedralMesh, boundary};
use nalgebra::{Rotation3, Vector3};

use super::setting::{DT, DURATION, LAWS, Setting, equilibrium, squash};
use super::torus::Torus;
use crate::scenes::{displacements, steps};
use crate::study::{Figure, Mark, Part, Result, Table};

/// Factor on the displacements of the thesis' material, whose deflection is three hundredths of the diameter.
const MAGNIFIED: f64 = 5.0;

/// Young's modulus of a body whose deflection shows as it is, Pa.
const SOFT: f64 = 2000.0;

/// Draws the torus at rest, after 15 s, and a soft one.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let torus = Torus::of_size(if quick { 182 } else { 5392 })?;
    let mesh = &torus.mesh;
    let mut simulation = Setting::default().torus(mesh)?;
    steps(&mut *simulation, if quick { 60 } else { (DURATION / DT).ceil() as usize })?;
    let moved = displacements(&*simulation);
    let still = vec![Vector3::zeros(); mesh.vertices.len()];
    let softened = |law| equilibrium(&Setting { young: SOFT, ..Setting::of_law(law) }, mesh);
    let soft = LAWS.into_iter().map(softened).collect::<Result<Vec<_>>>()?;
    let approaches: Vec<f64> = soft.iter().map(|state| squash(mesh, state).0).collect();
    let caption = format!("After {:.0} s, displacements × {MAGNIFIED}.", simulation.time());
    let mut figures = vec![
        figure("rtfem-rest", "The torus at rest.", mesh, &still, 1.0)?,
        figure("rtfem-squashed", &caption, mesh, &moved, MAGNIFIED)?,
    ];
    for (law, state) in LAWS.into_iter().zip(&soft) {
        let caption = format!("Equilibrium at E = {SOFT} Pa, {law}, displacements as they are.");
        figures.push(figure(&format!("rtfem-soft-{law}"), &caption, mesh, state, 1.0)?);
    }
    let narrower = approaches.iter().all(|approach| *approach > 0.0) && squash(mesh, &moved).0 > 0.0;
    let numbers =
        LAWS.iter().zip(&approaches).map(|(law, approach)| vec![(*law).to_owned(), format!("{approach:.5}")]).collect();
    let (elements, nodes) = (mesh.elements.len(), mesh.vertices.len());
    let text = format!("{elements} tetrahedra, {nodes} nodes. The thesis' editor shows the same body.");
    let mark = Mark::new("the loaded sides approach each other in every picture", "", narrower);
    let table = Table::new("rtfem-soft", "law | >approach at 2000 Pa (m)", numbers);
    Ok(Part::new(text).marks([mark]).tables([table]).figures(figures))
}

/// The boundary with displacements times a factor. The torus' axis is turned towards the reader.
fn figure(name: &str, caption: &str, mesh: &TetrahedralMesh, moved: &[Vector3<f64>], factor: f64) -> Result<Figure> {
    let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), -0.9);
    let place = |i: usize| <[f64; 3]>::from(turn * (mesh.vertices[i] + factor * moved[i]));
    let faces: Vec<[[f64; 3]; 3]> = boundary(mesh).into_iter().map(|face| face.map(place)).collect();
    let picture = triangles(caption, &faces).ok_or_else(|| format!("{name}: no triangle is seen"))?;
    Ok(Figure::new(name, picture, caption))
}
