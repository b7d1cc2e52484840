//! The error of the stresses, estimated: Zienkiewicz and Zhu, A Simple Error Estimator and Adaptive Procedure for Practical Engineering
//! Analysis (1987), with the stresses recovered by patches in place of the exact ones.
//!
//! η² = Σ ∫ (σ* − σ):C⁻¹:(σ* − σ) dV over the elements, with the compliance C⁻¹ of small strain and the undeformed volume. Recovered stresses σ* are
//! interpolated between the nodes, and those of the elements, σ, are constant or linear, so the integral is one of products of shape functions.
//! It is compared with ‖σ‖² + η², the estimated square of the exact stress.

use nalgebra::{DMatrix, Matrix3};

use super::recovery::stresses_of_materials;
use fem_model::element::{Element, shares::mass_share};
use fem_model::simulation::Simulation;

/// The estimated error of the stresses of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct StressError {
    /// η over the norm of the stress: 0.05 is an error of 5 %.
    pub relative: f64,
    /// The same of each element, as a part of the mean over the body: its mean square, weighted by volume, is `relative²`.
    pub of_elements: Vec<f64>,
}

impl StressError {
    /// The error now; `None` where there are no finite stresses, or no moduli of the elements.
    pub fn of(simulation: &dyn Simulation) -> Option<Self> {
        let (mesh, moduli) = (&simulation.shape().mesh, simulation.moduli_of_elements());
        if !simulation.has_stress() || moduli.is_empty() {
            return None;
        }
        let (element, volumes) = (mesh.element(), mesh.volumes());
        let stresses = simulation.stresses_at_points();
        let mut squares = vec![0.0; mesh.elements()];
        let mut size = 0.0;
        let (to_nodes, mass) = (extrapolation(element), mass(element));
        for (elements, recovered) in stresses_of_materials(mesh, &simulation.material_of_elements(), &stresses) {
            for e in elements {
                let own = &stresses[e * element.points.len()..][..element.points.len()];
                let at_node =
                    |i: usize| own.iter().enumerate().map(|(k, s)| to_nodes[(i, k)] * s).sum::<Matrix3<f64>>();
                let nodes = mesh.nodes_of(e).iter().enumerate();
                let errors: Vec<_> = nodes.map(|(i, &node)| recovered[node].unwrap_or_default() - at_node(i)).collect();
                let square = |(i, a): (usize, &Matrix3<f64>)| {
                    errors.iter().enumerate().map(|(j, b)| mass[(i, j)] * complementary(moduli[e], a, b)).sum::<f64>()
                };
                // Rounding errors may lie below zero.
                squares[e] = errors.iter().enumerate().map(square).sum::<f64>().max(0.0);
                let of_points: f64 = own.iter().map(|s| complementary(moduli[e], s, s)).sum();
                size += volumes[e] * of_points / own.len() as f64;
            }
        }
        let total: f64 = squares.iter().zip(&volumes).map(|(square, volume)| square * volume).sum();
        let volume: f64 = volumes.iter().sum();
        let all = size + total;
        let part = |square: f64| if all > 0.0 { (square / all).sqrt() } else { 0.0 };
        all.is_finite().then(|| Self {
            relative: part(total),
            of_elements: squares.iter().map(|square| part(square * volume)).collect(),
        })
    }
}

/// a:C⁻¹:b of an isotropic law with this shear modulus and bulk modulus (Pa), J/m³.
fn complementary([shear, bulk]: [f64; 2], a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    let traces = a.trace() * b.trace();
    (a.dot(b) - traces / 3.0) / (2.0 * shear) + traces / (9.0 * bulk)
}

/// Factors by which stresses at the points of an element give those at its nodes: constant with one point, else linear.
fn extrapolation(element: &Element) -> DMatrix<f64> {
    let (points, corners) = (element.points.len(), element.corners());
    if points == 1 {
        return DMatrix::repeat(element.nodes(), 1, 1.0);
    }
    let coordinates = DMatrix::from_fn(points, corners, |k, corner| element.points[k][corner]);
    let node = |i: usize, corner: usize| match i.checked_sub(corners) {
        None => f64::from(i == corner),
        Some(middle) => {
            if element.edges[middle].contains(&corner) {
                0.5
            } else {
                0.0
            }
        }
    };
    let nodes = DMatrix::from_fn(element.nodes(), corners, node);
    // The points of an element are the corners of a smaller one.
    coordinates.try_inverse().map_or_else(|| DMatrix::zeros(element.nodes(), points), |inverse| nodes * inverse)
}

/// The integrals of products of shape functions over an element of unit volume.
fn mass(element: &Element) -> DMatrix<f64> {
    DMatrix::from_fn(element.nodes(), element.nodes(), |i, j| mass_share(element, i, j))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_stresses_are_extrapolated_exactly_from_the_points_to_the_nodes() {
        for element in Element::ALL.into_iter().filter(|element| element.order == 2) {
            let field = |L: &[f64]| L.iter().enumerate().map(|(i, L)| (i + 1) as f64 * L).sum::<f64>();
            let at_points = DMatrix::from_fn(element.points.len(), 1, |k, _| field(element.points[k]));
            let at_nodes = extrapolation(element) * at_points;
            for corner in 0..element.corners() {
                assert!((at_nodes[corner] - (corner + 1) as f64).abs() < 1e-13, "{}", element.name);
            }
            for (k, [a, b]) in element.edges.iter().enumerate() {
                let mean = 1.0 + 0.5 * (a + b) as f64;
                assert!((at_nodes[element.corners() + k] - mean).abs() < 1e-13, "{}", element.name);
            }
        }
    }

    #[test]
    fn the_complementary_energy_is_that_of_a_bar_and_of_a_pressure() {
        let (young, poisson) = (2e5, 0.3);
        let moduli = [young / (2.0 * (1.0 + poisson)), young / (3.0 * (1.0 - 2.0 * poisson))];
        let bar = Matrix3::from_diagonal(&[7.0, 0.0, 0.0].into());
        assert!((complementary(moduli, &bar, &bar) * young / 49.0 - 1.0).abs() < 1e-14);
        let pressure = Matrix3::from_diagonal_element(-4.0);
        assert!((complementary(moduli, &pressure, &pressure) * moduli[1] / 16.0 - 1.0).abs() < 1e-14);
    }
}
