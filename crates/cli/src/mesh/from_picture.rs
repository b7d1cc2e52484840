//! `mesh from-picture`: triangles inside the region of a picture.

use std::path::PathBuf;

use fem_mesh::generate::picture::{FromPicture, mesh_picture, read_picture};
use fem_mesh::{SurfaceMesh, triangle_quality};

use super::write_surface;
use crate::end::End;
use crate::progress;

/// Part of the number of triangles that the edge asks for, beyond which a difference is told.
const TOLD: f64 = 0.05;

/// Arguments of the subcommand.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    picture: PathBuf,
    out: PathBuf,
    /// Mean length of an edge, m
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    edge: f64,
    /// Height of the region, m
    #[arg(long, value_name = "M", default_value_t = 1.0, allow_negative_numbers = true)]
    height: f64,
    /// Iterations of optimal Delaunay triangulation
    #[arg(long, value_name = "N", default_value_t = 5)]
    improve: usize,
}

/// Fills the region, writes the triangles and prints their quality.
pub fn run(arguments: &Arguments) -> Result<(), End> {
    let Arguments { picture: file, out, edge, height, improve } = arguments;
    fem_mesh::write::check_surface(out).map_err(End::unusable)?;
    let picture = read_picture(file).map_err(End::unusable)?;
    let options = FromPicture { edge: *edge, height: *height, improve: *improve };
    let found = progress::during("filling the region", || mesh_picture(&picture, options))
        .map_err(|error| End::unusable(format!("{}: {error}", file.display())))?;
    let vertices = found.mesh.vertices.iter().map(|x| x.push(0.0)).collect();
    write_surface(out, &SurfaceMesh::new(vertices, found.mesh.elements.clone())).map_err(End::unusable)?;
    say!("{}", triangle_quality(&found.mesh).to_string().trim_end());
    let count = found.mesh.elements.len() as f64;
    if (count / found.wish - 1.0).abs() > TOLD {
        eprintln!(
            "warning: {}: {count} triangles, and edges of {edge} m ask for {:.0}; the contour needs its own; shorter edges, or a smaller or \
             smoother picture, come closer",
            file.display(),
            found.wish
        );
    }
    if let Some(warning) = picture.warning() {
        eprintln!("warning: {}: {warning}", file.display());
    }
    if found.specks > 0 {
        eprintln!("warning: {}: {} specks of less than two pixels are left out", file.display(), found.specks);
    }
    Ok(())
}
