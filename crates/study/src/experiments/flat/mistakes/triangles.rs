//! Shapes of triangles, and their smoothing.

use std::path::Path;

use fem_mesh::generate::delaunay::triangulate;
use fem_mesh::{Mesh, triangle_quality};
use nalgebra::Vector2;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use crate::experiments::flat::object::{meshed, picture};
use crate::experiments::mistake::Mistake;

/// Circumradius over shortest edge of the best triangle.
pub fn best() -> Mistake {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.75f64.sqrt()]].map(Vector2::from);
    Mistake {
        rule: "R/l of the best triangle is about 0.5",
        right: "R/l = 1/(2 sin θ) of the smallest angle θ",
        quantity: "R/l of an equilateral triangle".to_owned(),
        theirs: 0.5,
        ours: triangle_quality(&Mesh::new(corners.to_vec(), vec![[0, 1, 2]])).radius_to_edge.value,
        truth: 1.0 / 3f64.sqrt(),
        tolerance: 1e-14,
    }
}

/// Length of the edges of the square, m.
const EDGE: f64 = 0.1;

/// The error of the interpolant of |x|² that optimal Delaunay triangulation lowers, after smoothing and before.
pub fn energy_factor(data: &Path) -> Result<Mistake, String> {
    let square = picture(data, "square")?;
    let [before, after] = [meshed(&square, EDGE, 0)?, meshed(&square, EDGE, 20)?];
    let steps = &after.steps;
    let of_vertices = |factor: f64| interpolated(&after.mesh, factor) / interpolated(&before.mesh, factor);
    Ok(Mistake {
        rule: "factor 1/4 in the energy of optimal Delaunay triangulation",
        right: "1/(d + 1) = 1/3 in the plane",
        quantity: "energy of a square's mesh after smoothing over that before".to_owned(),
        theirs: of_vertices(0.25),
        ours: steps[steps.len() - 1].energy / steps[0].energy,
        truth: error(&after.mesh) / error(&before.mesh),
        tolerance: 1e-9,
    })
}

/// `factor` Σᵢ |xᵢ|² |Ωᵢ| − ∫ |x|², m⁴; the mid-edge rule is exact for the integral.
fn interpolated(mesh: &Mesh<2, 3>, factor: f64) -> f64 {
    let share = |triangle: &[usize; 3]| {
        let [a, b, c] = triangle.map(|i| mesh.vertices[i]);
        let area = 0.5 * (b - a).perp(&(c - a));
        let corners: f64 = [a, b, c].iter().map(Vector2::norm_squared).sum();
        let middles: f64 = [a + b, b + c, c + a].iter().map(|sum| (0.5 * sum).norm_squared()).sum();
        area * (factor * corners - middles / 3.0)
    };
    mesh.elements.iter().map(share).sum()
}

/// ∫ (u_I − u) of u = |x|² by the mid-edge rule, which is exact, m⁴.
fn error(mesh: &Mesh<2, 3>) -> f64 {
    let share = |triangle: &[usize; 3]| {
        let [a, b, c] = triangle.map(|i| mesh.vertices[i]);
        let at_middle = |a: Vector2<f64>, b: Vector2<f64>| {
            0.5 * (a.norm_squared() + b.norm_squared()) - (0.5 * (a + b)).norm_squared()
        };
        0.5 * (b - a).perp(&(c - a)) / 3.0 * (at_middle(a, b) + at_middle(b, c) + at_middle(c, a))
    };
    mesh.elements.iter().map(share).sum()
}

/// Largest R/l that the thesis keeps.
const KEPT: f64 = 3.0;

/// The area that is left of a square of 1 m².
pub fn slivers(data: &Path) -> Result<Mistake, String> {
    let mut random = ChaCha8Rng::seed_from_u64(0);
    let mut points: Vec<Vector2<f64>> = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vector2::from).into();
    points.extend((0..200).map(|_| Vector2::new(random.random(), random.random())));
    let mesh = triangulate(&points).map_err(|error| error.to_string())?.mesh;
    let area = |triangle: &[usize; 3]| {
        let quality = triangle_quality(&Mesh::new(mesh.vertices.clone(), vec![*triangle]));
        if quality.radius_to_edge.value > KEPT { 0.0 } else { quality.area }
    };
    let square = meshed(&picture(data, "square")?, EDGE, 20)?;
    Ok(Mistake {
        rule: "triangles with R/l > 3 deleted at the end",
        right: "nothing is deleted, the boundary stays",
        quantity: "area of a square's mesh over that of the square".to_owned(),
        theirs: mesh.elements.iter().map(area).sum(),
        ours: triangle_quality(&square.mesh).area / square.area,
        truth: 1.0,
        tolerance: 5e-3,
    })
}
