//! Growth of the time of an assembly, of skinning and of picking with the mesh. A loop over the elements grows as n¹; a search
//! through all elements for each of them, or a full matrix, as n². Reports show the growth; the rubric decides if it costs points.

use grader::implementation::sandboxed::Sandboxed;
use grader::implementation::{Answer, Trouble};
use grader_child::Exercise;

use super::Grading;
use super::load::load_of;
use crate::grade::Growth;

/// The functions whose reference grows as n¹, each with its number of calls in a row, which makes the time of communication negligible.
const FUNCTIONS: [(&str, u64); 6] = [
    ("mass_matrix_mesh", 1),
    ("assemble_forces", 5),
    ("assemble_stiffness", 1),
    ("fixed_point_constraints", 20),
    ("build_skinning_matrix", 1),
    ("pick_nearest_vertices", 5),
];

/// Largest number of calls in a row.
const MOST_CALLS: f64 = 50_000.0;

/// Cells along a side of the cubes that are measured: 384, 3 072, 10 368 and 24 576 elements.
const CUBES: [usize; 4] = [4, 8, 12, 16];

/// A mesh is measured where n² growth would not take it longer than this, s.
const LONGEST: f64 = 0.5;

/// A measurement is repeated until it took so long in all, s.
const ENOUGH: f64 = 0.02;

/// Processor time of a series of calls that outweighs the start of a process, s.
const WORK: f64 = 0.05;

/// Smallest number of elements from which the growth for large meshes can be judged.
const LARGE: usize = 3000;

/// Exponent over all sizes above which the last two sizes are measured alone, because in small meshes the work per element dominates.
const STEEP: f64 = 1.3;

/// Time of a call on a mesh of so many elements.
struct Measured {
    elements: usize,
    seconds: f64,
}

impl Grading {
    /// The growth of a function that passes; `None` where it is not measured or meshes of a telling size take too long.
    pub(super) fn growth(&self, name: &str, subject: &Sandboxed) -> Option<Growth> {
        let &(_, times) = FUNCTIONS.iter().find(|(found, _)| *found == name)?;
        let by_the_clock = measured(name, 3, |function, body| subject.seconds(function, body, times));
        let (mut found, elements) = exponent(&by_the_clock)?;
        let mut reference = None;
        if found > Growth::CLEAR {
            // Other programs may have kept the machine busy, so processor time decides, for the reference too. If the reference does not
            // answer, the growth is left out, and grading continues.
            let again = exponent(&precise(name, subject)).map(|(exponent, _)| exponent);
            found = again.map_or(found, |again| again.min(found));
            if again.is_some() && found > Growth::CLEAR {
                self.reference.next_function();
                reference = exponent(&precise(name, &self.reference)).map(|(exponent, _)| exponent);
            }
        }
        Some(Growth { exponent: found, reference_exponent: reference, elements })
    }
}

/// Processor times, without that of the start of a process.
fn precise(name: &str, subject: &Sandboxed) -> Vec<Measured> {
    let Some((function, smallest, _)) = load_of(name, 1) else { return Vec::new() };
    let starts = (0..3).filter_map(|_| subject.processor_seconds(function, &smallest, 1).ok());
    let start = starts.fold(f64::INFINITY, f64::min);
    measured(name, 1, |function, body| {
        // The first call waits for the start of a process.
        let once = subject.seconds(function, body, 1)?.min(subject.seconds(function, body, 1)?);
        let mut times = (WORK / once).clamp(1.0, MOST_CALLS).ceil();
        // On a busy machine a single call can appear longer than it is.
        for _ in 0..5 {
            let work = subject.processor_seconds(function, body, times as u64)? - start;
            if work > WORK / 2.0 {
                return Ok(work / times);
            }
            times = (times * (WORK / work).clamp(2.0, 20.0)).min(MOST_CALLS).ceil();
        }
        Err(Trouble::GivenUp)
    })
}

/// Times on larger and larger meshes, for as long as they are answered and short.
fn measured(name: &str, turns: usize, seconds: impl Fn(Exercise, &[u8]) -> Answer<f64>) -> Vec<Measured> {
    let mut found: Vec<Measured> = Vec::new();
    for cells in CUBES {
        let elements = 6 * cells * cells * cells;
        let is_too_long = |last: &Measured| last.seconds * (elements as f64 / last.elements as f64).powi(2) > LONGEST;
        if found.last().is_some_and(is_too_long) {
            break;
        }
        let Some((function, body, _)) = load_of(name, cells) else { break };
        let (mut best, mut spent) = (f64::INFINITY, 0.0);
        for _ in 0..turns {
            let Ok(time) = seconds(function, &body) else { return found };
            (best, spent) = (best.min(time), spent + time);
            if spent > ENOUGH {
                break;
            }
        }
        found.push(Measured { elements, seconds: best });
    }
    found
}

/// The exponent, and the elements of the largest mesh.
fn exponent(times: &[Measured]) -> Option<(f64, usize)> {
    let (first, last) = (times.first()?, times.last()?);
    let before = times.len().checked_sub(2).map(|index| &times[index])?;
    let between =
        |a: &Measured, b: &Measured| (b.seconds / a.seconds).ln() / (b.elements as f64 / a.elements as f64).ln();
    let overall = between(first, last);
    let is_known = last.elements >= LARGE && overall.is_finite();
    is_known.then(|| (if overall > STEEP { overall.max(between(before, last)) } else { overall }, last.elements))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(of: impl Fn(f64) -> f64) -> Vec<Measured> {
        let elements = CUBES.map(|cells| 6 * cells * cells * cells);
        elements.map(|elements| Measured { elements, seconds: of(elements as f64) }).into()
    }

    #[test]
    fn one_pass_grows_as_n_and_a_search_for_each_element_as_n_squared() {
        let (linear, elements) = exponent(&times(|n| 1e-7 * n)).unwrap();
        assert!((linear - 1.0).abs() < 1e-9 && elements == 24_576);
        let (quadratic, _) = exponent(&times(|n| 1e-6 * n + 1e-9 * n * n)).unwrap();
        assert!((1.9..2.0).contains(&quadratic), "{quadratic}");
    }

    #[test]
    fn memory_that_grows_slower_than_the_caches_is_no_clear_growth() {
        let (exponent, _) = exponent(&times(|n| if n > 5000.0 { 3e-7 * n } else { 1e-7 * n })).unwrap();
        assert!(exponent < Growth::CLEAR, "{exponent}");
    }

    #[test]
    fn small_meshes_alone_say_nothing() {
        assert!(exponent(&times(|n| n * n)[..1]).is_none());
        assert!(exponent(&[]).is_none());
    }

    #[test]
    fn the_measurement_ends_before_a_mesh_that_would_take_too_long() {
        let slow = measured("mass_matrix_mesh", 3, |_, body| Ok(1e-6 * body.len() as f64));
        assert!(slow.len() < CUBES.len(), "{}", slow.len());
        assert!(measured("mass_matrix_mesh", 3, |_, _| Err(Trouble::Malformed)).is_empty());
    }
}
