//! Families of fibres in the elements: Holzapfel, Gasser, Ogden, A New Constitutive Framework for Arterial Wall Mechanics (2000), with the
//! dispersion of Gasser, Ogden, Holzapfel, Hyperelastic Modelling of Arterial Layers with Distributed Collagen Fibre Orientations (2006).
//!
//! ψ = k1/(2 k2) (exp(k2 E²) − 1) where E = κ (I1 − 3) + (1 − 3κ) (I4 − 1) > 0, else zero. I1 and I4 are those of F: with those of J^(−1/3) F a
//! pressure stretches no fibre, and J drifts (Sansour 2008). E is a convex quadratic function of F, tr(F M Fᵀ) − 1 with M = κ 1 + (1 − 3κ) a⊗a, and ψ is convex
//! and increasing where E > 0. So the Hessian ψ' ∂²E + ψ'' ∂E⊗∂E is positive semi-definite, and no projection is needed. It jumps at E = 0, where the
//! one of stretched fibres is taken: a line search and the rate of convergence decide whether a kept factor still serves.

use fem_model::{Body, FibreLaw};
use nalgebra::{Matrix3, Vector3};

use super::points::Points;
use super::{AddBlock, Energy, HessianKind, InElements, Moment, Potential};
use fem_elements::number::is_positive;
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// Key in the statistics.
pub const NAME: &str = "fibres";

/// The fibres of a body, in double precision.
struct Fibres {
    points: Points,
    families: Vec<Family>,
    elements: usize,
    /// Largest k2 E² whose exponential is in range of the number type.
    largest_power: f64,
}

struct Family {
    law: FibreLaw,
    /// The points in which the family is.
    places: Vec<Place>,
}

struct Place {
    /// Number of the point.
    point: usize,
    /// a, of unit length.
    direction: Vector3<f64>,
    /// Factor on the modulus.
    factor: f64,
}

/// Fibres at a deformation.
struct State {
    /// ψ, J/m³.
    energy: f64,
    /// ∂ψ/∂E, Pa.
    slope: f64,
    /// ∂²ψ/∂E², Pa.
    curvature: f64,
    F: Matrix3<f64>,
    /// M
    structure: Matrix3<f64>,
}

/// The fibres of `[[fibres]]`; `None` where a body has none.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    if body.fibres.is_empty() {
        return None;
    }
    let mesh = &body.shape.mesh;
    let per_element = mesh.element().points.len();
    let factor = |element: usize| body.stiffness_factors.get(element).copied().unwrap_or(1.0);
    let places = |directions: &[(usize, Vector3<f64>)]| {
        let of_element = |&(element, direction): &(usize, Vector3<f64>)| {
            let points = element * per_element..(element + 1) * per_element;
            points.map(move |point| Place { point, direction, factor: factor(element) })
        };
        directions.iter().flat_map(of_element).collect()
    };
    let families = body.fibres.iter().map(|family| Family { law: family.law, places: places(&family.directions) });
    Some(Box::new(Fibres {
        points: Points::new(mesh, numbering),
        families: families.collect(),
        elements: mesh.elements(),
        // Half of the exponents are left for moduli.
        largest_power: 0.5 * f64::from(T::MAX_EXPONENT) * std::f64::consts::LN_2,
    }))
}

impl Fibres {
    /// Calls `pass` with each place where fibres are stretched, its weight in m³ and its state.
    fn for_each<T: Real>(&self, u: &[[T; 3]], mut pass: impl FnMut(&Place, f64, State)) {
        for Family { law, places } in &self.families {
            for place in places {
                let G = self.points.gradient_of(place.point, u);
                if let Some(state) = State::new(law, &place.direction, &G, self.largest_power) {
                    pass(place, place.factor * self.points.volume(place.point), state);
                }
            }
        }
    }
}

impl State {
    /// The state at a displacement gradient; `None` where the fibres are compressed.
    fn new(law: &FibreLaw, a: &Vector3<f64>, G: &Matrix3<f64>, largest_power: f64) -> Option<Self> {
        let FibreLaw { modulus, exponent, dispersion } = *law;
        let along = 1.0 - 3.0 * dispersion;
        let Ga = G * a;
        // E of G, in which nothing cancels near rest.
        let strain = dispersion * (2.0 * G.trace() + G.norm_squared()) + along * (2.0 * a.dot(&Ga) + Ga.norm_squared());
        if !(strain >= 0.0) {
            return None;
        }
        let power = exponent * strain * strain;
        let (growth, mean) = (power.exp(), if power > 0.0 { power.exp_m1() / power } else { 1.0 });
        let energy = if power > largest_power { f64::INFINITY } else { 0.5 * modulus * strain * strain * mean };
        Some(Self {
            energy,
            slope: modulus * strain * growth,
            curvature: modulus * (1.0 + 2.0 * power) * growth,
            F: Matrix3::identity() + G,
            structure: Matrix3::from_diagonal_element(dispersion) + along * a * a.transpose(),
        })
    }

    /// First Piola–Kirchhoff stress ψ' ∂E/∂F, Pa.
    fn stress(&self) -> Matrix3<f64> {
        2.0 * self.slope * self.F * self.structure
    }
}

impl<T: Real> Potential<T> for Fibres {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        let family = |Family { law: FibreLaw { modulus, exponent, dispersion }, places }: &Family| {
            let elements = places.len() * self.elements / self.points.count();
            format!("{modulus} Pa, exponent {exponent}, dispersion {dispersion} in {elements} elements")
        };
        format!("[[fibres]]: {}", self.families.iter().map(family).collect::<Vec<_>>().join("; "))
    }

    fn bytes(&self) -> usize {
        self.points.bytes() + self.families.iter().map(|family| size_of_val(&family.places[..])).sum::<usize>()
    }

    fn energy(&self, u: &[[T; 3]], _: Moment) -> Energy {
        let mut sum = Energy::default();
        self.for_each(u, |_, weight, state| sum = sum + Energy::of(weight * state.energy));
        sum
    }

    fn add_gradient(&self, u: &[[T; 3]], _: Moment, gradient: &mut [[T; 3]]) {
        self.for_each(u, |place, _, state| {
            self.points.add_divergence(place.point, &(place.factor * state.stress()), gradient);
        });
    }

    fn hessian(&self, u: &[[T; 3]], _: Moment, _: HessianKind, add: &mut AddBlock<T>) {
        self.for_each(u, |place, weight, state| {
            let FM = state.F * state.structure;
            for (row, a) in self.points.nodes(place.point) {
                let (Ma, FMa) = (state.structure * a, FM * a);
                for (column, b) in self.points.nodes(place.point) {
                    let of_slope = 2.0 * weight * state.slope * Ma.dot(b);
                    let H = 4.0 * weight * state.curvature * FMa * (FM * b).transpose();
                    let H = H + Matrix3::from_diagonal_element(of_slope);
                    add(row, column, std::array::from_fn(|i| std::array::from_fn(|k| T::of(H[(i, k)]))));
                }
            }
        });
    }

    fn resultant(&self, _: Moment) -> Option<[f64; 3]> {
        Some([0.0; 3])
    }

    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        let is_in_range = |family: &Family| is_positive(T::of(family.law.modulus));
        (!self.families.iter().all(is_in_range)).then_some(("fibres", "a modulus of fibres"))
    }

    fn in_elements(&self) -> Option<&dyn InElements<T>> {
        Some(self)
    }
}

impl<T: Real> InElements<T> for Fibres {
    fn is_elastic(&self) -> bool {
        true
    }

    fn add_stresses(&self, u: &[[T; 3]], _: Moment, stresses: &mut [Matrix3<f64>]) {
        self.for_each(u, |place, _, state| {
            let kirchhoff = state.stress() * state.F.transpose();
            stresses[place.point] += place.factor / state.F.determinant() * kirchhoff;
        });
    }
}
