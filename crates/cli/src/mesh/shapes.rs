//! Distributions of the shapes of a mesh's elements, as text and as a picture.

use std::path::Path;

use fem_chart::Picture;
use fem_mesh::{Distribution, MeshError, Problem, SurfaceMesh};

/// Prints quantiles, then a histogram of each measure.
pub fn print(distributions: &[Distribution]) {
    say!();
    let titles = ["least", "1 %", "median", "99 %", "largest"].map(|title| format!("{title:>10}"));
    say!("{:<28}{}", "", titles.concat());
    for distribution in distributions.iter().filter(|distribution| distribution.count() > 0) {
        let values = [0.0, 0.01, 0.5, 0.99, 1.0].map(|share| format!("{:>10.4}", distribution.quantile(share)));
        say!("{:<28}{}", distribution.title(), values.concat());
    }
    for distribution in distributions.iter().filter(|distribution| distribution.count() > 0) {
        say!();
        say!("{}", distribution.to_string().trim_end());
    }
}

/// Refuses a picture that is no SVG file.
pub fn check(file: &Path) -> Result<(), MeshError> {
    let found = file.extension().unwrap_or_default().to_string_lossy();
    if found == "svg" {
        return Ok(());
    }
    Err(MeshError::in_file(file, Problem::UnknownExtension { found: format!(".{found}"), known: ".svg" }))
}

/// Writes the histograms and a drawing of a surface as an SVG file, which appears complete or not at all.
pub fn draw(file: &Path, name: &str, surface: &SurfaceMesh, distributions: &[Distribution]) -> Result<(), MeshError> {
    let corners = |element: &[usize; 3]| element.map(|i| surface.vertices[i].into());
    let triangles: Vec<[[f64; 3]; 3]> = surface.elements.iter().map(corners).collect();
    let histograms: Vec<Picture> = distributions.iter().filter(|all| all.count() > 0).map(histogram).collect();
    let mut pictures = vec![fem_chart::grid("", 2, &histograms)];
    match fem_chart::triangles("", &triangles) {
        Some(picture) => pictures.insert(0, picture),
        None => eprintln!("warning: {}: too many triangles are seen to draw them; histograms alone", file.display()),
    }
    let text = fem_chart::grid(name, 1, &pictures).standalone();
    fem_mesh::write::save_bytes(file, text.as_bytes())
}

fn histogram(distribution: &Distribution) -> Picture {
    let counts = distribution.counts();
    let mut ends: Vec<String> = (0..counts.len()).map(|bin| distribution.ends(bin)[0].clone()).collect();
    ends.extend(counts.len().checked_sub(1).map(|last| distribution.ends(last)[1].clone()));
    fem_chart::distribution(&distribution.title(), &ends, &counts)
}
