//! Mistakes of one function, each with its own formula.

use finite_elements_3d as solved;
use finite_elements_3d::given;
use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3};

use super::Candidate;
use crate::reference::trial::{Elastic, Input, Mesh, Observed, Trial};

type Formula = fn(&Trial, &Observed) -> Option<Observed>;

/// Function, name, sentence and what the mistake answers. Each function's simplest first.
const FORMULAS: &[(&str, &str, &str, Formula)] = &[
    (
        "dphi_linear_tetrahedron_dX",
        "transposed",
        "The gradients are those of the transposed matrix of edges. Are its edges columns or rows, and which of its inverse are the gradients?",
        transposed_edges,
    ),
    (
        "dV_linear_tetrahedron_dq",
        "transposed",
        "The stress is multiplied from the wrong side. Which of its indices does the gradient of a shape function meet?",
        transposed_stress,
    ),
    ("dpsi_neo_hookean_dF", "Cauchy stress", STRESS, |trial, answer| {
        other_stress(trial, answer, |P, F| P * F.transpose() / F.determinant())
    }),
    ("dpsi_neo_hookean_dF", "Kirchhoff stress", STRESS, |trial, answer| {
        other_stress(trial, answer, |P, F| P * F.transpose())
    }),
    ("dpsi_neo_hookean_dF", "second Piola–Kirchhoff stress", STRESS, |trial, answer| {
        other_stress(trial, answer, |P, F| F.try_inverse().unwrap_or_default() * P)
    }),
    ("dpsi_neo_hookean_dF", "symmetric part of the stress", STRESS, |trial, answer| {
        other_stress(trial, answer, |P, _| (P + P.transpose()) * 0.5)
    }),
    (
        "d2V_linear_tetrahedron_dq2",
        "projected",
        "The negative eigenvalues are gone. Is this function asked for the exact Hessian?",
        projected,
    ),
    (
        "assemble_stiffness",
        "not projected",
        "The elements' Hessians are added as they are. What must be done to them first, so that the matrix can be factorised?",
        not_projected,
    ),
    ("T_linear_tetrahedron", "lumped", LUMPED, lumped),
    ("mass_matrix_linear_tetrahedron", "lumped", LUMPED, lumped),
    ("mass_matrix_mesh", "lumped", LUMPED, lumped),
    ("mass_matrix_mesh", "overwritten instead of added", OVERWRITTEN, overwritten),
    ("assemble_forces", "overwritten instead of added", OVERWRITTEN, overwritten),
    ("assemble_stiffness", "overwritten instead of added", OVERWRITTEN, overwritten),
    (
        "fixed_point_constraints",
        "fixed instead of free",
        "The matrix keeps what is fixed. Which coordinates does the solver have to find?",
        fixed_instead_of_free,
    ),
    (
        "fixed_point_constraints",
        "rows of zeros kept",
        "Fixed coordinates have rows of zeros. How many rows does the matrix have?",
        rows_of_zeros,
    ),
    ("linearly_implicit_euler", "positions not moved", NOT_MOVED, positions_not_moved),
    ("implicit_euler", "positions not moved", NOT_MOVED, positions_not_moved),
    ("linearly_implicit_euler", "old velocity", OLD_VELOCITY, old_velocity),
    ("implicit_euler", "old velocity", OLD_VELOCITY, old_velocity),
    (
        "newtons_method",
        "start not moved",
        "The starting point is left as it was. Where is the solution to be written?",
        start_not_moved,
    ),
];

const STRESS: &str =
    "The stress is another one: force on which area, the undeformed or the deformed one, and measured in which frame?";
const LUMPED: &str = "The mass is concentrated at the vertices. Which integral of two shape functions does a consistent mass matrix hold?";
const OVERWRITTEN: &str =
    "A vertex keeps the contribution of its last element alone. What happens to those of the elements before it?";
const NOT_MOVED: &str = "The positions are those at the start of the step. What else does a step change?";
const OLD_VELOCITY: &str =
    "The positions move with the velocity at the start of the step. Which velocity does the method ask for?";

/// The mistakes of one function.
pub fn candidates<'a>(function: &str) -> Vec<Candidate<'a>> {
    let own = FORMULAS.iter().filter(|(whose, ..)| *whose == function);
    own.map(|&(_, name, sentence, formula)| Candidate::new(name, sentence, formula)).collect()
}

fn transposed_edges(trial: &Trial, _: &Observed) -> Option<Observed> {
    let Input::Shape { V, element, .. } = &trial.input else { return None };
    let [a, b, c, d] = element.map(|vertex| V[vertex]);
    let inverse = Matrix3::from_rows(&[(b - a).transpose(), (c - a).transpose(), (d - a).transpose()]).try_inverse()?;
    Some(Observed::matrix(4, 3, |i, j| if i == 0 { -inverse.column(j).sum() } else { inverse[(i - 1, j)] }))
}

fn transposed_stress(trial: &Trial, _: &Observed) -> Option<Observed> {
    let Input::Elastic(Elastic { q, V, element, volume, C, D }) = &trial.input else { return None };
    let dphi = solved::dphi_linear_tetrahedron_dX(V, element, &Vector3::zeros());
    let P = solved::dpsi_neo_hookean_dF(&given::deformation_gradient(q, element, &dphi), *C, *D);
    let gradient = Matrix3::from_column_slice(P.as_slice()) * dphi.transpose() * *volume;
    Some(Observed::vector(gradient.as_slice().to_vec()))
}

fn other_stress(
    trial: &Trial,
    answer: &Observed,
    of: fn(Matrix3<f64>, &Matrix3<f64>) -> Matrix3<f64>,
) -> Option<Observed> {
    let Input::Density { F, .. } = &trial.input else { return None };
    let stress = of(Matrix3::from_row_slice(&answer.numbers), F);
    Some(Observed::vector(stress.transpose().as_slice().to_vec()))
}

fn projected(trial: &Trial, answer: &Observed) -> Option<Observed> {
    let Input::Elastic(_) = &trial.input else { return None };
    let H = given::project(&SMatrix::<f64, 12, 12>::from_fn(|i, j| answer.entry(i, j)));
    Some(Observed::matrix(12, 12, |i, j| H[(i, j)]))
}

fn element_of(mesh: &Mesh, index: usize) -> Elastic {
    let Mesh { q, V, T, v0, C, D } = mesh.clone();
    Elastic { q, V, element: T[index], volume: v0[index], C, D }
}

fn hessian(Elastic { q, V, element, volume, C, D }: &Elastic) -> SMatrix<f64, 12, 12> {
    solved::d2V_linear_tetrahedron_dq2(q, V, element, *volume, *C, *D)
}

/// Puts elements' matrices into the mesh's, by `put(place, value)`.
fn gathered(
    size: usize,
    T: &[[usize; 4]],
    matrix: impl Fn(usize) -> SMatrix<f64, 12, 12>,
    put: impl Fn(&mut f64, f64),
) -> Observed {
    let mut whole = DMatrix::zeros(size, size);
    for (index, element) in T.iter().enumerate() {
        let own = matrix(index);
        for i in 0..12 {
            for j in 0..12 {
                put(&mut whole[(3 * element[i / 3] + i % 3, 3 * element[j / 3] + j % 3)], own[(i, j)]);
            }
        }
    }
    Observed::matrix(size, size, |i, j| whole[(i, j)])
}

fn not_projected(trial: &Trial, _: &Observed) -> Option<Observed> {
    let Input::Mesh(mesh) = &trial.input else { return None };
    Some(gathered(mesh.q.len(), &mesh.T, |index| -hessian(&element_of(mesh, index)), |sum, value| *sum += value))
}

fn lumped(trial: &Trial, answer: &Observed) -> Option<Observed> {
    match &trial.input {
        Input::Kinetic { qdot, element, density, volume } => {
            let squares = element.iter().map(|&vertex| qdot.fixed_rows::<3>(3 * vertex).norm_squared());
            Some(Observed::vector(vec![0.5 * density * volume / 4.0 * squares.sum::<f64>()]))
        }
        Input::ElementMass { .. } | Input::MeshMass { .. } => {
            let [rows, columns] = answer.shape;
            let sum = |i| (0..columns).map(|j| answer.entry(i, j)).sum();
            Some(Observed::matrix(rows, columns, |i, j| if i == j { sum(i) } else { 0.0 }))
        }
        _ => None,
    }
}

fn overwritten(trial: &Trial, _: &Observed) -> Option<Observed> {
    let put = |place: &mut f64, value: f64| *place = value;
    match &trial.input {
        Input::MeshMass { q_size, T, density, v0 } => {
            let own = |index: usize| solved::mass_matrix_linear_tetrahedron(*density, v0[index]);
            Some(gathered(*q_size, T, own, put))
        }
        Input::Mesh(mesh) if trial.function == "assemble_stiffness" => {
            let own = |index| -given::project(&hessian(&element_of(mesh, index)));
            Some(gathered(mesh.q.len(), &mesh.T, own, put))
        }
        Input::Mesh(mesh) => {
            let mut f = vec![0.0; mesh.q.len()];
            for (index, element) in mesh.T.iter().enumerate() {
                let Elastic { q, V, volume, C, D, .. } = &element_of(mesh, index);
                let gradient = solved::dV_linear_tetrahedron_dq(q, V, element, *volume, *C, *D);
                (0..12).for_each(|i| f[3 * element[i / 3] + i % 3] = -gradient[i]);
            }
            Some(Observed::vector(f))
        }
        _ => None,
    }
}

fn fixed_instead_of_free(trial: &Trial, _: &Observed) -> Option<Observed> {
    let Input::Fixed { q_size, indices } = &trial.input else { return None };
    let kept: Vec<_> = (0..*q_size).filter(|k| indices.contains(&(k / 3))).collect();
    Some(Observed::matrix(kept.len(), *q_size, |i, j| f64::from(kept[i] == j)))
}

fn rows_of_zeros(trial: &Trial, _: &Observed) -> Option<Observed> {
    let Input::Fixed { q_size, indices } = &trial.input else { return None };
    Some(Observed::matrix(*q_size, *q_size, |i, j| f64::from(i == j && !indices.contains(&(i / 3)))))
}

fn positions_not_moved(trial: &Trial, answer: &Observed) -> Option<Observed> {
    let Input::Step(step) = &trial.input else { return None };
    let velocities = &answer.numbers[step.q.len()..];
    Some(Observed::vector(step.q.iter().chain(velocities).copied().collect()))
}

fn old_velocity(trial: &Trial, answer: &Observed) -> Option<Observed> {
    let Input::Step(step) = &trial.input else { return None };
    let moved = &step.q + &step.qdot * step.dt;
    Some(Observed::vector(moved.iter().chain(&answer.numbers[step.q.len()..]).copied().collect()))
}

fn start_not_moved(trial: &Trial, answer: &Observed) -> Option<Observed> {
    let Input::Minimum { start, .. } = &trial.input else { return None };
    let value = answer.numbers.first()?;
    Some(Observed::vector(std::iter::once(value).chain(start).copied().collect()))
}
