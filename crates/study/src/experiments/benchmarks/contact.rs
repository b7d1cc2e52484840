//! Contact with a rigid plane: a bar that hits it, and Hertz's ball. The computations are those of the [theses](super::super::flat).

use std::path::Path;
use std::time::Instant;

use fem_model::Integrator;

use super::case::{CLOSED_FORM, Level, Quantity, part};
use crate::experiments::flat::contact::{hertz, impact};
use crate::study::{Mark, Part, Result};

/// Duration of the contact and stress on the plane, of the finest bar.
pub fn bar(_: &Path, quick: bool) -> Result<Part> {
    let quantity = |name, reference| Quantity { name, reference, tolerance: 2e-2, source: CLOSED_FORM };
    let of = [quantity("duration 2 L/c (s)", impact::DURATION), quantity("stress ρ c v (Pa)", impact::STRESS)];
    let text = "A bar of 1 m, c = 10 m/s, ν = 0, in so many squares of two quadratic triangles, which meets a plane with 0.1 m/s, by BDF2 in steps of 0.4 squares over c. The force is the mean while the wave runs.";
    let mut error = f64::NAN;
    let found = part(("bar-impact", text), &of, (&[25, 50, 100], 2), quick, |cells| {
        let start = Instant::now();
        let impact::Impact { duration, stress, impulse_error } = impact::bar(Integrator::Bdf2, cells, 2)?;
        error = impulse_error;
        Ok(Level { nodes: 3 * (2 * cells + 1), values: vec![duration, stress], seconds: start.elapsed().as_secs_f64() })
    })?;
    let statement = "the impulse is the change of momentum within 1e-5";
    Ok(found.marks([Mark::new(statement, format!("{error:.1e}"), error < 1e-5)]))
}

/// The force of the finest ball over Hertz's.
pub fn hertz(_: &Path, quick: bool) -> Result<Part> {
    // The mark is for a/h = 8.
    let tolerance = if quick { 8e-2 } else { 3e-2 };
    let of = Quantity { name: "force over 4/3 E* √R d^1.5", reference: 1.0, tolerance, source: CLOSED_FORM };
    let text = "A ball of linear tetrahedra on a plane, ν = 0.3, with so many elements in the radius of the contact. A block of 25 radii is no half-space: the approach d is that \
                of a point 8 radii deep, with Boussinesq's displacement of that point added. Plane and support carry the same force within 1e-3. K. L. Johnson, Contact \
                Mechanics (1985), section 4.3.";
    let mut errors = Vec::new();
    let cells: &[usize] = if quick { &[2, 3] } else { &[2, 4, 8] };
    let found = part(("hertz", text), &[of], (cells, cells.len()), quick, |cells| {
        let start = Instant::now();
        let hertz::Hertz { force: [found, expected], nodes, .. } = hertz::contact(hertz::RADIUS / cells as f64)?;
        errors.push((found / expected - 1.0).abs());
        Ok(Level { nodes, values: vec![found / expected], seconds: start.elapsed().as_secs_f64() })
    })?;
    let told = errors.iter().map(|error| format!("{:.2} %", 100.0 * error)).collect::<Vec<_>>().join(", ");
    let is_falling = errors.windows(2).all(|pair| pair[1] < pair[0]);
    Ok(found.marks([Mark::new("the error falls with the elements", told, is_falling)]))
}
