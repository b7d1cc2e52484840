//! To do: the consistent mass matrix of one element. Read include-docs/mass_matrix_linear_tetrahedron.md.

use nalgebra::{SMatrix, SVector};

use super::outcome::{Outcome, eigenvalues_of, holds, near, near_number};
use super::random::for_all;
use super::{Check, Course};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    it_is_the_integral_of_products_of_shape_functions,
    the_mass_along_each_axis_is_density_times_volume,
    the_axes_do_not_mix,
    its_eigenvalues_are_a_twentieth_and_a_quarter_of_the_mass,
];

type Mass = SMatrix<f64, 12, 12>;

fn it_is_the_integral_of_products_of_shape_functions(course: &Course) -> Outcome {
    // Four points, each with a quarter of the volume, integrate every quadratic exactly over a tetrahedron; at point k
    // shape function k has the larger value.
    let (own, other) = ((5.0 + 3.0 * 5f64.sqrt()) / 20.0, (5.0 - 5f64.sqrt()) / 20.0);
    let phi = |a: usize, point: usize| if a == point { own } else { other };
    let (density, volume) = (1200.0, 0.3);
    let expected = Mass::from_fn(|row, column| {
        let products = (0..4).map(|point| phi(row / 3, point) * phi(column / 3, point)).sum::<f64>();
        if row % 3 == column % 3 { density * volume / 4.0 * products } else { 0.0 }
    });
    near(
        "∫ ρ φ_a φ_b",
        &course.subject.mass_matrix_linear_tetrahedron(density, volume)?,
        &expected,
        1e-12 * density * volume,
    )
}

fn the_mass_along_each_axis_is_density_times_volume(course: &Course) -> Outcome {
    for_all(course.seed, (1.0..1e4, 1e-9..1e3), |(density, volume)| {
        let M = course.subject.mass_matrix_linear_tetrahedron(density, volume)?;
        for axis in 0..3 {
            let along = SVector::<f64, 12>::from_fn(|row, _| if row % 3 == axis { 1.0 } else { 0.0 });
            let mass = along.dot(&(M * along));
            near_number("mass of a translation", mass, density * volume, 1e-13 * density * volume)?;
        }
        near("a mass matrix is symmetric", &M, &M.transpose(), 1e-15 * M.amax())
    })
}

fn the_axes_do_not_mix(course: &Course) -> Outcome {
    let M = course.subject.mass_matrix_linear_tetrahedron(1000.0, 2.0)?;
    let mixes = (0..144).any(|k| (k / 12) % 3 != (k % 12) % 3 && M[(k / 12, k % 12)] != 0.0);
    holds("a velocity along x has no momentum along y", !mixes)
}

fn its_eigenvalues_are_a_twentieth_and_a_quarter_of_the_mass(course: &Course) -> Outcome {
    let M = course.subject.mass_matrix_linear_tetrahedron(50.0, 2.0)?;
    let mut eigenvalues: Vec<f64> = eigenvalues_of(&M)?.iter().copied().collect();
    eigenvalues.sort_by(f64::total_cmp);
    let expected = SVector::<f64, 12>::from_fn(|k, _| if k < 9 { 5.0 } else { 25.0 });
    near(
        "the eigenvalues are a twentieth and a quarter of the mass",
        &SVector::<f64, 12>::from_vec(eigenvalues),
        &expected,
        1e-11,
    )
}
