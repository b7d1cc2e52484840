//! The shapes of bad tetrahedra, and the measures that see them.

use std::path::Path;

use fem_chart::grid;
use fem_mesh::{TetrahedralMesh, boundary, tetrahedron_distributions};
use nalgebra::Vector3;

use super::torus::Torus;
use crate::experiments::drawing::drawn;
use crate::study::{Figure, Mark, Part, Result, Table};

/// A regular tetrahedron and bad ones, by their usual names (Cheng, Dey, Edelsbrunner, Facello and Teng, Sliver Exudation, 2000).
const SHAPES: [(&str, [[f64; 3]; 4]); 6] = [
    ("regular", [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]]),
    ("needle", [[-0.12, -1.0, -0.1], [0.12, -1.0, -0.1], [0.0, -1.0, 0.12], [0.0, 1.0, 0.0]]),
    ("wedge", [[-1.0, -0.5, 0.0], [1.0, -0.5, 0.0], [-0.08, 0.9, 0.0], [0.08, 0.9, 0.1]]),
    ("spindle", [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [0.15, -0.08, 0.1], [-0.12, 0.1, 0.14]]),
    ("cap", [[-1.0, -0.6, 0.6], [1.0, -0.6, 0.6], [0.0, -0.6, -1.1], [0.0, -0.45, 0.03]]),
    ("sliver", [[-1.0, 0.0, 0.06], [0.0, 1.0, -0.06], [1.0, 0.0, 0.06], [0.0, -1.0, -0.06]]),
];

/// Dihedral angles between which those of the torus lie, degrees.
const ANGLES: [f64; 2] = [10.0, 165.0];

/// Circumradius over shortest edge that generators by Delaunay refinement promise.
const PROMISED: f64 = 2.0;

/// Extreme values of the measures of a mesh.
struct Measures {
    /// Smallest and largest dihedral angle, degrees.
    angles: [f64; 2],
    /// Smallest radius ratio, and largest circumradius over shortest edge.
    radius_ratio: f64,
    radius_to_edge: f64,
}

/// Draws and measures each shape, and measures the torus.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let mut rows: Vec<(&str, Measures)> = Vec::new();
    let mut pictures = Vec::new();
    for (name, corners) in SHAPES {
        let mut mesh = TetrahedralMesh::new(corners.map(Vector3::from).to_vec(), vec![[0, 1, 2, 3]]);
        if fem_mesh::volumes(&mesh)[0] < 0.0 {
            mesh.elements = vec![[0, 1, 3, 2]];
        }
        let faces: Vec<_> = boundary(&mesh).into_iter().map(|face| face.map(|i| corners[i])).collect();
        pictures.push(drawn(name, &faces, [[-1.1; 3], [1.1; 3]])?);
        rows.push((name, measures(&mesh)));
    }
    rows.push(("torus", measures(&Torus::of_size(if quick { 182 } else { 5392 })?.mesh)));
    let is_thin = |of: &Measures| of.angles[0] < ANGLES[0] || of.angles[1] > ANGLES[1];
    let [sliver, torus] = ["sliver", "torus"].map(|name| rows.iter().find(|row| row.0 == name).map(|row| &row.1));
    let (Some(sliver), Some(torus)) = (sliver, torus) else { return Err("a shape is missing".into()) };
    let unseen: Vec<&str> =
        rows.iter().filter(|(_, of)| is_thin(of) && of.radius_to_edge < PROMISED).map(|row| row.0).collect();
    let (ratio, angle) = (sliver.radius_to_edge, sliver.angles[0]);
    let marks = [
        Mark::new(
            format!("of the bad shapes R/l < {PROMISED} admits the sliver alone"),
            format!("R/l {ratio:.2} with an angle of {angle:.1}°; {}", unseen.join(", ")),
            unseen == ["sliver"],
        ),
        Mark::new(
            format!("no dihedral angle of the torus is below {}° or above {}°", ANGLES[0], ANGLES[1]),
            format!("{:.1}° to {:.1}°", torus.angles[0], torus.angles[1]),
            !is_thin(torus),
        ),
    ];
    let table = Table::of(
        "rtfem-slivers",
        &rows,
        &[
            ("shape", &|(name, _)| (*name).to_owned()),
            (">smallest dihedral angle (°)", &|(_, of)| format!("{:.1}", of.angles[0])),
            (">largest (°)", &|(_, of)| format!("{:.1}", of.angles[1])),
            (">radius ratio", &|(_, of)| format!("{:.3}", of.radius_ratio)),
            (">R/l", &|(_, of)| format!("{:.2}", of.radius_to_edge)),
        ],
    );
    let text = "The thesis meshes with bounds on the volume and on the quality of tetrahedra. Delaunay refinement bounds the circumradius over the shortest edge, R/l, \
                and so leaves slivers: four corners near a circle, with edges that are all long. The mesher here places tetrahedra on a lattice, improves them and judges dihedral angles.";
    let caption = "Bad shapes beside the regular one; the row of the torus has the worst of all its tetrahedra.";
    let figure = Figure::new("rtfem-slivers", grid("shapes of tetrahedra", 2, &pictures), caption);
    Ok(Part::new(text).marks(marks).tables([table]).figures([figure]))
}

fn measures(mesh: &TetrahedralMesh) -> Measures {
    let [angles, ratio, _, to_edge, ..] = &tetrahedron_distributions(mesh)[..] else {
        return Measures { angles: [f64::NAN; 2], radius_ratio: f64::NAN, radius_to_edge: f64::NAN };
    };
    Measures {
        angles: [angles.quantile(0.0), angles.quantile(1.0)],
        radius_ratio: ratio.quantile(0.0),
        radius_to_edge: to_edge.quantile(1.0),
    }
}
