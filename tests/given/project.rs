//! A given function, `given::project`: no exercise; read include-docs/given_project.md.

use finite_elements_3d::{d2V_linear_tetrahedron_dq2, given};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use proptest::prelude::*;

use crate::for_all;
use grader::properties::meshes::Tetrahedron;
use grader::properties::outcome::{Outcome, holds, near};
use grader::properties::random::{deformation, tetrahedron};

type Hessian = SMatrix<f64, 12, 12>;
type Spectrum = SVector<f64, 12>;

/// Any orthogonal matrix, from the entries of any other.
fn frame() -> impl Strategy<Value = Hessian> {
    prop::collection::vec(-1.0..1.0, 144).prop_map(|entries| Hessian::from_column_slice(&entries).qr().q())
}

fn with_spectrum(frame: &Hessian, spectrum: &Spectrum) -> Hessian {
    let H = frame * Hessian::from_diagonal(spectrum) * frame.transpose();
    (H + H.transpose()) / 2.0
}

/// Eigenvalues of every kind: negative, zero, positive, repeated, clustered, all of one sign.
fn spectrum() -> impl Strategy<Value = Spectrum> {
    let one_of = prop_oneof![Just(0.0), Just(1.0), Just(-1.0), -1.0..1.0, 0.999999..1.000001, -1e-3..0.0];
    let mixed = prop::collection::vec(one_of, 12).prop_map(Spectrum::from_vec);
    let uniform = prop::collection::vec(-1.0..1.0, 12).prop_map(Spectrum::from_vec);
    prop_oneof![mixed.clone(), uniform, mixed.prop_map(|values| -values.abs())]
}

#[test]
fn negative_eigenvalues_become_zero_and_the_others_stay() -> Outcome {
    for_all((frame(), spectrum()), |(frame, spectrum)| {
        let expected = with_spectrum(&frame, &spectrum.map(|value| value.max(0.0)));
        near(
            "the nearest matrix without negative eigenvalues",
            &given::project(&with_spectrum(&frame, &spectrum)),
            &expected,
            1e-11,
        )
    })
}

#[test]
fn the_unit_does_not_matter() -> Outcome {
    for_all((frame(), spectrum()), |(frame, spectrum)| {
        let H = with_spectrum(&frame, &spectrum);
        for scale in [1e-20, 1e-6, 1e6, 1e20] {
            let expected = with_spectrum(&frame, &spectrum.map(|value| value.max(0.0) * scale));
            near("no threshold has a unit", &given::project(&(H * scale)), &expected, 1e-11 * scale)?;
        }
        Ok(())
    })
}

#[test]
fn the_result_is_symmetric_and_agrees_with_nalgebra() -> Outcome {
    for_all((frame(), spectrum()), |(frame, spectrum)| {
        let H = with_spectrum(&frame, &spectrum);
        let eigen = H.symmetric_eigen();
        let kept = Hessian::from_diagonal(&eigen.eigenvalues.map(|value| value.max(0.0)));
        let expected = eigen.eigenvectors * kept * eigen.eigenvectors.transpose();
        let projected = given::project(&H);
        near("the eigenvalues of nalgebra", &projected, &expected, 1e-11)?;
        near("symmetric", &projected, &projected.transpose(), 1e-14)?;
        holds("positive semi-definite", projected.symmetric_eigenvalues().min() >= -1e-12)
    })
}

#[test]
fn a_matrix_without_negative_eigenvalues_is_returned_unchanged() -> Outcome {
    for_all((frame(), spectrum()), |(frame, spectrum)| {
        let H = with_spectrum(&frame, &spectrum.abs());
        near("unchanged", &given::project(&H), &H, 1e-12)
    })?;
    near("zero", &given::project(&Hessian::zeros()), &Hessian::zeros(), 0.0)
}

#[test]
fn rigid_motions_of_an_element_stay_free() -> Outcome {
    for_all((tetrahedron(), deformation()), |(t, F)| {
        let (C, D) = (2e5, 7e5);
        // At rest all six motions, in a deformed state the three translations.
        let states = [(Matrix3::identity(), 6), (F, 3)];
        for (F, free) in states {
            let q = t.moved(&F, &Vector3::zeros());
            let H = given::project(&d2V_linear_tetrahedron_dq2(&q, &t.V, &t.element, t.volume, C, D));
            let arms = |axis: usize| t.X().map(|X| Vector3::ith(axis, 1.0).cross(&(X - t.X()[0])) / t.size());
            let translations = (0..3).map(|axis| [Vector3::ith(axis, 1.0); 4]);
            for motion in translations.chain((0..3).map(arms)).take(free) {
                let motion = SVector::<f64, 12>::from_fn(|row, _| motion[row / 3][row % 3]).normalize();
                near("a rigid motion meets no resistance", &(H * motion), &Spectrum::zeros(), 1e-11 * H.norm())?;
            }
        }
        Ok(())
    })
}

#[test]
fn a_squeezed_element_loses_its_negative_curvature() -> Outcome {
    let t = Tetrahedron::unit();
    let q = t.moved(&(Matrix3::identity() * 0.5), &Vector3::zeros());
    let H = d2V_linear_tetrahedron_dq2(&q, &t.V, &t.element, t.volume, 1.0, 8.0);
    holds("it has some", H.symmetric_eigenvalues().min() < -0.1)?;
    holds("none is left", given::project(&H).symmetric_eigenvalues().min() > -1e-12 * H.norm())
}
