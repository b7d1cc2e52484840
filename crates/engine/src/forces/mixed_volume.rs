//! The force of pressures that are unknowns beside the displacements.

use fem_model::{Body, VolumeEnergy};
use nalgebra::Matrix3;

use super::corner_pressures::CornerPressures;
use super::volume_change::{change, cofactor, contracted, of_matrix, projected, second_derivative};
use super::{AddBlock, Energy, HessianKind, InElements, Moment, Potential};
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// Key in the statistics.
pub const NAME: &str = "mixed_volume";

/// The energy of the volume of a body; `None` if no material has pressures.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    CornerPressures::new(body, numbering).map(|volume| Box::new(volume) as Box<dyn Potential<T>>)
}

impl<T: Real> Potential<T> for CornerPressures {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        let (elements, pressures) = (self.elements(), self.count());
        format!("[material] with volumetric = \"mixed\": {pressures} pressures in {elements} elements")
    }

    fn bytes(&self) -> usize {
        self.allocated()
    }

    fn energy(&self, u: &[[T; 3]], _: Moment) -> Energy {
        self.energy_at(u)
    }

    fn add_gradient(&self, u: &[[T; 3]], _: Moment, gradient: &mut [[T; 3]]) {
        self.for_each_point(&self.pressures_at(u), |element, point, pressure| {
            let P = pressure * element.slope(&self.points().gradient_of(point, u));
            self.points().add_divergence(point, &P, gradient);
        });
    }

    /// The Hessian at constant pressures. Those of a force whose volume changes follow from the [coupling](Self::coupling).
    fn hessian(&self, u: &[[T; 3]], _: Moment, kind: HessianKind, add: &mut AddBlock<T>) {
        self.for_each_point(&self.pressures_at(u), |element, point, pressure| {
            let factor = pressure * self.points().volume(point);
            if element.energy == VolumeEnergy::Trace || factor == 0.0 {
                return;
            }
            let F = Matrix3::identity() + self.points().gradient_of(point, u);
            let times = |direction: &Matrix3<f64>| element.second_derivative_times(factor, &F, direction);
            let projected = (kind == HessianKind::Projected).then(|| projected(times));
            let (J, slope) = (F.determinant(), cofactor(&F));
            for (row, a) in self.points().nodes(point) {
                for (column, b) in self.points().nodes(point) {
                    let block = match &projected {
                        Some(H) => contracted(H, a, b),
                        None if element.energy == VolumeEnergy::Change => factor * second_derivative(&F, a, b),
                        None => {
                            let of_slopes = (slope * a) * (slope * b).transpose() / J;
                            factor / J * (second_derivative(&F, a, b) - of_slopes)
                        }
                    };
                    add(row, column, of_matrix(&block));
                }
            }
        });
    }

    fn resultant(&self, _: Moment) -> Option<[f64; 3]> {
        Some([0.0; 3])
    }

    fn in_elements(&self) -> Option<&dyn InElements<T>> {
        Some(self)
    }

    fn mixed(&self) -> Option<&CornerPressures> {
        Some(self)
    }
}

impl<T: Real> InElements<T> for CornerPressures {
    fn is_elastic(&self) -> bool {
        true
    }

    fn add_stresses(&self, u: &[[T; 3]], _: Moment, stresses: &mut [Matrix3<f64>]) {
        self.for_each_point(&self.pressures_at(u), |element, point, pressure| {
            let J = match element.energy {
                VolumeEnergy::Trace | VolumeEnergy::Change => 1.0,
                VolumeEnergy::Logarithm => 1.0 + change(&self.points().gradient_of(point, u)),
            };
            stresses[point] += Matrix3::from_diagonal_element(pressure / J);
        });
    }
}
