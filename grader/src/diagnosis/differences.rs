//! Derivatives by finite differences of the function below.

use grader::implementation::Local;
use nalgebra::Vector3;

use super::Candidate;
use crate::reference::REFERENCE;
use crate::reference::trial::{Input, Observed, Trial};

/// Steps that people take.
const STEPS: [f64; 8] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// The points of a difference quotient, in steps.
const POINTS: [[f64; 2]; 3] = [[1.0, 0.0], [1.0, -1.0], [0.0, -1.0]];

/// Difference quotients with these steps; empty if the function is no derivative.
pub fn candidates<'a>(function: &str) -> Vec<Candidate<'a>> {
    let below = match function {
        "dpsi_neo_hookean_dF" => "psi_neo_hookean",
        "d2psi_neo_hookean_dF2" => "dpsi_neo_hookean_dF",
        "dV_linear_tetrahedron_dq" => "V_linear_tetrahedron",
        "d2V_linear_tetrahedron_dq2" => "dV_linear_tetrahedron_dq",
        "dV_spring_particle_particle_dq" => "V_spring_particle_particle",
        "dphi_linear_tetrahedron_dX" => "phi_linear_tetrahedron",
        _ => return Vec::new(),
    };
    let all = STEPS.into_iter().flat_map(|step| POINTS.map(|points| (step, points)));
    let sentence = "Finite differences are right to a few digits only, and to none for large numbers. The page asks for the exact derivative.";
    all.map(|(step, points)| {
        Candidate::new("finite differences", sentence, move |trial, answer| {
            quotient(below, step, points, trial, answer)
        })
    })
    .collect()
}

fn quotient(below: &'static str, step: f64, points: [f64; 2], trial: &Trial, answer: &Observed) -> Option<Observed> {
    let variables = match &trial.input {
        Input::Density { .. } => 9,
        Input::Elastic(_) => 12,
        Input::Spring { .. } => 6,
        Input::Shape { .. } => 3,
        _ => return None,
    };
    let mut columns = Vec::new();
    for variable in 0..variables {
        let at = |steps: f64| {
            let input = moved(&trial.input, variable, steps * step)?;
            Trial { input, function: below, ..trial.clone() }.run(&Local(REFERENCE)).ok()
        };
        let (ahead, behind) = (at(points[0])?, at(points[1])?);
        let length = step * (points[0] - points[1]);
        let column = ahead.numbers.iter().zip(&behind.numbers).map(|(a, b)| (a - b) / length);
        columns.push(column.collect::<Vec<f64>>());
    }
    let entry = |k: usize| match answer.shape[1] {
        1 => columns[k][0],
        width => columns[k % width][k / width],
    };
    Some(Observed { numbers: (0..answer.numbers.len()).map(entry).collect(), ..answer.clone() })
}

fn moved(input: &Input, variable: usize, by: f64) -> Option<Input> {
    let mut input = input.clone();
    let axis = |k: usize| Vector3::from_fn(|i, _| if i == k { by } else { 0.0 });
    match &mut input {
        Input::Density { F, .. } => F[(variable / 3, variable % 3)] += by,
        Input::Elastic(of) => of.q[3 * of.element[variable / 3] + variable % 3] += by,
        Input::Spring { q0, .. } if variable < 3 => *q0 += axis(variable),
        Input::Spring { q1, .. } => *q1 += axis(variable - 3),
        Input::Shape { x, .. } => *x += axis(variable),
        _ => return None,
    }
    Some(input)
}
