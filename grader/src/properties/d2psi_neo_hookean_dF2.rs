//! To do: the derivative of the stress, ∂²ψ/∂F². Read include-docs/d2psi_neo_hookean_dF2.md.

use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, SVector, Vector3};

use super::finite_differences::jacobian;
use super::outcome::{Outcome, eigenvalues_of, holds, near, near_number, slack, waits};
use super::random::{constants, deformation, for_all, for_some, rotation, stretches};
use super::scales::{smallest_stretch, stiffness_terms};
use super::{Check, Course};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    column_by_column_it_is_the_derivative_of_the_stress,
    it_is_symmetric,
    at_rest_the_moduli_are_those_of_hookes_law,
    at_rest_infinitesimal_rotations_meet_no_resistance,
    rotating_the_body_rotates_rows_and_columns,
    the_eigenvalues_are_those_of_the_theory,
    negative_curvature_is_returned_as_it_is,
    each_constant_has_its_own_term,
];

fn rows_of(F: &Matrix3<f64>) -> SVector<f64, 9> {
    SVector::from_fn(|entry, _| F[(entry / 3, entry % 3)])
}

/// The 9×9 matrix of F → A F B.
fn product(A: &Matrix3<f64>, B: &Matrix3<f64>) -> SMatrix<f64, 9, 9> {
    SMatrix::from_fn(|row, column| A[(row / 3, column / 3)] * B[(column % 3, row % 3)])
}

fn column_by_column_it_is_the_derivative_of_the_stress(course: &Course) -> Outcome {
    for_some(course.seed, (deformation(), constants()), |(F, (C, D))| {
        for (C, D, rule) in [(C, 0.0, "C's term: differences of dpsi"), (0.0, D, "D's term: differences of dpsi")] {
            let stress = |f: &DVector<f64>| {
                let F = Matrix3::from_row_slice(f.as_slice());
                let P = course.trusted.dpsi_neo_hookean_dF(&F, C, D).map_err(waits("dpsi_neo_hookean_dF"))?;
                Ok(DVector::from_column_slice(P.as_slice()))
            };
            let f = DVector::from_column_slice(rows_of(&F).as_slice());
            let expected = jacobian(stress, &f, 0.05 * smallest_stretch(&F))?;
            near(rule, &course.subject.d2psi_neo_hookean_dF2(&F, C, D)?, &expected, 1e-10 * stiffness_terms(&F, C, D))?;
        }
        Ok(())
    })
}

fn it_is_symmetric(course: &Course) -> Outcome {
    for_all(course.seed, (deformation(), constants()), |(F, (C, D))| {
        let H = course.subject.d2psi_neo_hookean_dF2(&F, C, D)?;
        near("a second derivative is symmetric", &H, &H.transpose(), 1e-13 * stiffness_terms(&F, C, D))
    })
}

fn at_rest_the_moduli_are_those_of_hookes_law(course: &Course) -> Outcome {
    for_all(course.seed, constants(), |(C, D)| {
        let H = course.subject.d2psi_neo_hookean_dF2(&Matrix3::identity(), C, D)?;
        let (shear, lambda) = (2.0 * C, 2.0 * D - 4.0 / 3.0 * C);
        let expected = SMatrix::<f64, 9, 9>::from_fn(|row, column| {
            let delta = |a: usize, b: usize| if a == b { 1.0 } else { 0.0 };
            let (i, j, k, l) = (row / 3, row % 3, column / 3, column % 3);
            lambda * delta(i, j) * delta(k, l) + shear * (delta(i, k) * delta(j, l) + delta(i, l) * delta(j, k))
        });
        near("at rest, with μ = 2C and λ = 2D − 4C/3", &H, &expected, 1e-12 * (C + D))?;

        let young = 18.0 * C * D / (3.0 * D + C);
        let poisson = (3.0 * D - 2.0 * C) / (6.0 * D + 2.0 * C);
        let sides_free = rows_of(&Matrix3::from_diagonal(&Vector3::new(1.0, -poisson, -poisson)));
        let pull = rows_of(&Matrix3::from_diagonal(&Vector3::new(young, 0.0, 0.0)));
        near("a bar under tension: Young's modulus and Poisson's ratio", &(H * sides_free), &pull, 1e-12 * (C + D))
    })
}

fn at_rest_infinitesimal_rotations_meet_no_resistance(course: &Course) -> Outcome {
    let H = course.subject.d2psi_neo_hookean_dF2(&Matrix3::identity(), 2e5, 7e5)?;
    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
        let spin = rows_of(&axis.cross_matrix());
        near("H times an infinitesimal rotation at rest", &(H * spin), &SVector::<f64, 9>::zeros(), 1e-12 * 9e5)?;
    }
    let eigenvalues = eigenvalues_of(&H)?;
    let zeros = eigenvalues.iter().filter(|value| value.abs() < slack(1e-9) * eigenvalues.max()).count();
    holds("at rest exactly three eigenvalues are zero", zeros == 3)
}

fn rotating_the_body_rotates_rows_and_columns(course: &Course) -> Outcome {
    for_all(course.seed, (deformation(), rotation(), constants()), |(F, R, (C, D))| {
        let (H, allowed) = (course.subject.d2psi_neo_hookean_dF2(&F, C, D)?, 1e-11 * stiffness_terms(&F, C, D));
        let left = product(&R, &Matrix3::identity());
        let expected = left * H * left.transpose();
        near("H(R F)", &course.subject.d2psi_neo_hookean_dF2(&(R * F), C, D)?, &expected, allowed)?;
        let right = product(&Matrix3::identity(), &R);
        let expected = right * H * right.transpose();
        near("H(F R)", &course.subject.d2psi_neo_hookean_dF2(&(F * R), C, D)?, &expected, allowed)
    })
}

/// Eigenvalues of ∂²ψ/∂F² from the principal stretches: three twists, three flips, three stretchings.
fn eigenvalues(sigma: &Vector3<f64>, C: f64, D: f64) -> DVector<f64> {
    let (J, I) = (sigma.product(), sigma.norm_squared());
    let others = Vector3::new(sigma.y * sigma.z, sigma.z * sigma.x, sigma.x * sigma.y);
    let a = 2.0 * C * J.powf(-2.0 / 3.0);
    let b = -2.0 / 3.0 * C * I * J.powf(-5.0 / 3.0) + 2.0 * D * (J - 1.0);
    let stretching = Matrix3::from_fn(|i, j| {
        let cross = -4.0 / 3.0 * C * J.powf(-5.0 / 3.0) * (sigma[i] * others[j] + others[i] * sigma[j]);
        let volume = (10.0 / 9.0 * C * I * J.powf(-8.0 / 3.0) + 2.0 * D) * others[i] * others[j];
        cross + volume + if i == j { a } else { b * sigma[3 - i - j] }
    });
    let twists_and_flips = sigma.iter().flat_map(|stretch| [a + b * stretch, a - b * stretch]);
    let all = twists_and_flips.chain(stretching.symmetric_eigenvalues().iter().copied().collect::<Vec<_>>());
    sorted(all.collect())
}

fn sorted(mut numbers: Vec<f64>) -> DVector<f64> {
    numbers.sort_by(f64::total_cmp);
    DVector::from_vec(numbers)
}

fn the_eigenvalues_are_those_of_the_theory(course: &Course) -> Outcome {
    for_all(course.seed, (rotation(), stretches(), rotation(), constants()), |(U, sigma, W, (C, D))| {
        let F = U * Matrix3::from_diagonal(&sigma) * W.transpose();
        let H = course.subject.d2psi_neo_hookean_dF2(&F, C, D)?;
        let found = sorted(eigenvalues_of(&H)?.iter().copied().collect());
        let allowed = 1e-11 * stiffness_terms(&F, C, D);
        near("eigenvalues, ascending", &found, &eigenvalues(&sigma, C, D), allowed)
    })
}

fn negative_curvature_is_returned_as_it_is(course: &Course) -> Outcome {
    // ψ(s 1) = D (s³ − 1)² has the second derivative 6D (5s⁴ − 2s), spread over three equal stretches.
    let H = course.subject.d2psi_neo_hookean_dF2(&(Matrix3::identity() * 0.5), 0.0, 8.0)?;
    let lowest = eigenvalues_of(&H)?.min();
    near_number("the lowest eigenvalue; nothing is projected here", lowest, -11.0, 1e-12)
}

fn each_constant_has_its_own_term(course: &Course) -> Outcome {
    for_all(course.seed, (deformation(), constants()), |(F, (C, D))| {
        let sum =
            course.subject.d2psi_neo_hookean_dF2(&F, C, 0.0)? + course.subject.d2psi_neo_hookean_dF2(&F, 0.0, D)?;
        let allowed = 1e-13 * stiffness_terms(&F, C, D);
        near("H(C, D) = H(C, 0) + H(0, D)", &course.subject.d2psi_neo_hookean_dF2(&F, C, D)?, &sum, allowed)?;
        let twice: DMatrix<f64> = DMatrix::from_column_slice(9, 9, (sum * 2.0).as_slice());
        near(
            "H(2C, 2D) = 2 H(C, D)",
            &course.subject.d2psi_neo_hookean_dF2(&F, 2.0 * C, 2.0 * D)?,
            &twice,
            2.0 * allowed,
        )
    })
}
