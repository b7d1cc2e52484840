//! Bodies as pictures to one scale, for grids of pictures.

use fem_chart::{Picture, triangles_in_frame};
use fem_engine::simulator::Simulator;
use fem_model::simulation::Simulation;
use nalgebra::Vector2;

use crate::study::Result;

/// Width of a picture in a grid of them, pixels: two are legible side by side on a phone.
pub const CELL: f64 = 240.0;

/// A triangle in space, m.
pub type Triangle = [[f64; 3]; 3];

/// Triangles of linear elements of a flat body as they are now.
pub fn elements(simulation: &Simulator<f64>) -> Vec<Triangle> {
    let (shape, q) = (simulation.shape(), simulation.positions());
    let at = |node: usize| [q[3 * node], q[3 * node + 1], 0.0];
    shape.mesh.corners().map(|nodes| [at(nodes[0]), at(nodes[1]), at(nodes[2])]).collect()
}

/// A plane from `a` to `b`, seen from its edge: a band of a width, m, to the right of that way.
pub fn band(a: Vector2<f64>, b: Vector2<f64>, width: f64) -> [Triangle; 2] {
    let along = b - a;
    let across = width * Vector2::new(along.y, -along.x).normalize();
    let at = |x: Vector2<f64>| [x.x, x.y, 0.0];
    [[at(a), at(b), at(b + across)], [at(a), at(b + across), at(a + across)]]
}

/// A picture of a grid. `frame` has two opposite corners of what every picture of the grid shows, m.
pub fn drawn(label: &str, triangles: &[Triangle], frame: [[f64; 3]; 2]) -> Result<Picture> {
    let picture =
        triangles_in_frame(label, triangles, &frame).ok_or_else(|| format!("{label}: no triangle is seen"))?;
    Ok(picture.scaled(CELL))
}
