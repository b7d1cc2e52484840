//! Compares answers with those of the reference: values, shapes and numbers of calls, as far as the course specifies them. Storage and
//! iterates are not compared.

use nalgebra::Vector3;

use super::trial::{Input, Observed, Trial};

/// Result of a comparison with the reference.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// Worst |actual − expected| relative to the terms that were added; `None` if numbers are missing or not finite.
    pub error: Option<f64>,
    /// The rules that the answer breaks; empty if it is right.
    pub wrongs: Vec<Wrong>,
}

/// A rule that an answer breaks.
#[derive(Clone, Debug)]
pub struct Wrong {
    /// Which check this belongs to.
    pub check: Check,
    /// The rule, without figures.
    pub rule: &'static str,
    /// The observed and the expected figures.
    pub figures: String,
}

/// The checks that a comparison makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Check {
    /// Values and shapes.
    Agrees,
    /// The same on limiting cases.
    EdgeCases,
    /// Numbers of calls of closures.
    Calls,
}

impl Check {
    /// The check to which the values of a trial belong.
    pub fn of(trial: &Trial) -> Self {
        if trial.edge { Self::EdgeCases } else { Self::Agrees }
    }

    /// Name in the report.
    pub fn name(self) -> &'static str {
        match self {
            Self::Agrees => "agrees_with_the_reference",
            Self::EdgeCases => "edge_cases_agree_with_the_reference",
            Self::Calls => "closures_are_called_as_often_as_promised",
        }
    }
}

/// Compares an answer with the reference's.
pub fn compare(trial: &Trial, observed: &Observed, expected: &Observed, tolerance: f64) -> Verdict {
    let mut verdict = Verdict::default();
    let check = Check::of(trial);
    if observed.shape != expected.shape || observed.numbers.len() != expected.numbers.len() {
        let ([rows, columns], [wanted_rows, wanted_columns]) = (observed.shape, expected.shape);
        let figures = format!("{rows} × {columns}, expected {wanted_rows} × {wanted_columns}");
        verdict.wrongs.push(Wrong { check, rule: shape_rule(trial), figures });
        return verdict;
    }
    let (rule, error) = match &trial.input {
        Input::Skinning { V, T, V_skin } => {
            let rows =
                (0..V_skin.len()).map(|row| skinning_error(V, T, &V_skin[row], &observed.numbers[row * V.len()..]));
            ("a display vertex follows one tetrahedron that holds it, by its four weights", worst(rows))
        }
        _ => (
            value_rule(trial),
            worst(
                (0..expected.numbers.len())
                    .map(|i| number_error(observed.numbers[i], expected.numbers[i], trial.scale(i))),
            ),
        ),
    };
    verdict.error = error.is_finite().then_some(error);
    // NaN does not exceed a tolerance, so the condition is that the error is small.
    let small = error <= tolerance;
    if !small {
        verdict.wrongs.push(Wrong { check, rule, figures: figures(trial, observed, expected, error) });
    }
    verdict.wrongs.extend(residual(check, observed, expected));
    verdict.wrongs.extend(calls(trial, observed, expected));
    verdict
}

fn shape_rule(trial: &Trial) -> &'static str {
    match trial.function {
        "pick_nearest_vertices" => "as many vertices are found as lie within the radius of the hit point",
        "fixed_point_constraints" => {
            "the matrix has a row for each coordinate that is free, and a column for each coordinate"
        }
        _ => "the answer has the promised size",
    }
}

fn value_rule(trial: &Trial) -> &'static str {
    match trial.input {
        Input::Minimum { .. } => {
            "the value returned and the point left are those of Newton's method with this line search"
        }
        Input::Step(_) => "positions and velocities at the end of the step are those of the method",
        _ => "the answer is that of the formula",
    }
}

fn number_error(actual: f64, expected: f64, scale: f64) -> f64 {
    // The same infinity is right.
    if actual == expected { 0.0 } else { ((actual - expected) / scale).abs() }
}

/// The largest; infinite where one is not a number.
fn worst(errors: impl Iterator<Item = f64>) -> f64 {
    errors.fold(0.0, |worst, error| if error.is_nan() { f64::INFINITY } else { worst.max(error) })
}

/// Distance of a row of weights from the nearest row of weights of a tetrahedron that may be chosen.
fn skinning_error(V: &[Vector3<f64>], T: &[[usize; 4]], x: &Vector3<f64>, row: &[f64]) -> f64 {
    let phis: Vec<_> =
        T.iter().map(|element| (element, finite_elements_3d::phi_linear_tetrahedron(V, element, x))).collect();
    let best = phis.iter().map(|(_, phi)| phi.min()).fold(f64::NEG_INFINITY, f64::max);
    // Any element that contains the point is right. Outside the mesh it is the element whose smallest weight is largest, or an equal one.
    let least = if best >= -1e-6 { -1.0001e-6 } else { best - 1e-9 };
    let allowed = phis.iter().filter(|(_, phi)| phi.min() >= least);
    let distance = |element: &[usize; 4], phi: &nalgebra::Vector4<f64>| {
        worst((0..V.len()).map(|vertex| {
            let expected = element.iter().position(|&own| own == vertex).map_or(0.0, |i| phi[i]);
            number_error(row[vertex], expected, 1.0 + phi.amax())
        }))
    };
    allowed.map(|(element, phi)| distance(element, phi)).fold(f64::INFINITY, f64::min)
}

/// Relative to the gradient at the start. The line search may refuse the last step for the round-off of the energy.
const SMALL_GRADIENT: f64 = 1e-6;

/// Newton's method must have reached the accuracy of the reference, or the tolerance.
fn residual(check: Check, observed: &Observed, expected: &Observed) -> Option<Wrong> {
    let (left, wanted) = (observed.residual?, expected.residual?);
    let small = left <= (10.0 * wanted).max(SMALL_GRADIENT) || left == wanted || wanted.is_nan();
    (!small).then(|| Wrong {
        check,
        rule: "the gradient that is left is small",
        figures: format!("{left:e} of the gradient at the start is left, {wanted:e} by the reference"),
    })
}

/// Returns true if a number of calls is right. Arguments: the number, that of the reference, and the largest number of directions.
type Holds = fn(usize, usize, Option<usize>) -> bool;

fn calls(trial: &Trial, observed: &Observed, expected: &Observed) -> Vec<Wrong> {
    let most = if let Input::Minimum { max_steps, .. } = trial.input { Some(max_steps) } else { None };
    let (rule, holds): (_, Holds) = match trial.function {
        "linearly_implicit_euler" => {
            ("one force, one stiffness and one solve in each step", |n, wanted, _| n == wanted)
        }
        "implicit_euler" => ("at most five directions in each step", |n, _, _| n <= 5),
        // Round-off may require a few more directions. If the start is the solution, no direction is allowed.
        _ => ("at most max_steps directions, and none where the gradient at the start is zero", |n, wanted, most| {
            n == wanted || wanted != 0 && n <= (wanted + 3).min(most.unwrap_or(usize::MAX))
        }),
    };
    // A direction is a solve. The number of evaluations of its matrix is free, unless the start is the solution.
    let counts = |name: &str, wanted: usize| {
        let is_at_rest = wanted == 0 && most != Some(0);
        trial.function == "linearly_implicit_euler" || name == "solve" || name == "H" && is_at_rest
    };
    let pairs = observed.calls.iter().zip(&expected.calls);
    let wrong = |&(name, n): &(&str, usize), &(_, wanted): &(&str, usize)| {
        let figures = format!("{name}: {n} calls, {wanted} by the reference");
        let check = if trial.edge { Check::EdgeCases } else { Check::Calls };
        (counts(name, wanted) && !holds(n, wanted, most)).then_some(Wrong { check, rule, figures })
    };
    pairs.filter_map(|(observed, expected)| wrong(observed, expected)).collect()
}

fn figures(trial: &Trial, observed: &Observed, expected: &Observed, error: f64) -> String {
    let off = |&i: &usize| number_error(observed.numbers[i], expected.numbers[i], trial.scale(i));
    let not_small = |i: &usize| {
        let small = off(i) < error;
        !small
    };
    let at = (0..expected.numbers.len()).find(not_small).unwrap_or(0);
    let (actual, wanted) = (observed.numbers.get(at), expected.numbers.get(at));
    match (actual, wanted) {
        (Some(actual), Some(wanted)) => {
            let (row, column) = (at / expected.shape[1].max(1), at % expected.shape[1].max(1));
            format!("entry ({row}, {column}) is {actual:e}, expected {wanted:e}; relative error {error:.1e}")
        }
        _ => format!("relative error {error:.1e}"),
    }
}
