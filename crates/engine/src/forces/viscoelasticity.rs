//! Viscoelasticity by a Prony series over the laws of the elements, with the convolution of Simo, On a Fully Three-Dimensional Finite-Strain
//! Viscoelastic Damage Model (1987); Simo and Hughes, Computational Inelasticity (1998), section 10.3.
//!
//! The second Piola–Kirchhoff stress of a term relaxes, h' = g S' − h/τ, with the stress S of the law at rest. Where S is linear in a step of Δt,
//! h₁ = e^(−a) h₀ + g ĝ (S₁ − S₀) with a = Δt/τ, ĝ = (1 − e^(−a))/a: exact under constant strain, whatever the step. So the forces of a step have the
//! potential c ψ(F) + ½ A:(FᵀF − 1) per volume, with c = Σ g ĝ and A = Σ (e^(−a) h₀ − g ĝ S₀), which are fixed in the step. For the law `linear`, the
//! strain is the small one. A jump of the strain at one time is a sudden one, h₁ = h₀ + g (S₁ − S₀), as is that of a deformed initial state.

use fem_model::simulation::History;
use fem_model::{Body, Material, PronyTerm, Volumetric};
use nalgebra::Matrix3;

use super::points::Points;
use super::{AddBlock, Energy, HessianKind, InElements, Moment, Potential, Remembering};
use fem_elements::history::{put, take};
use fem_elements::materials::{AnyLaw, Law, cauchy_stress};
use fem_elements::tensor::{Tensor, Tensor4, inverse, symmetric_eigen};
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// Key in the statistics.
pub const NAME: &str = "viscosity";

/// The stresses of a body that relax, in double precision.
struct Viscoelasticity {
    terms: Vec<PronyTerm>,
    points: Points,
    /// The law of each material, and the number of the material of each point.
    laws: Vec<AnyLaw<f64>>,
    law_of: Vec<usize>,
    /// Factor on the moduli of each point.
    factors: Vec<f64>,
    /// Time at the start of the step, s.
    time: f64,
    /// S of each point at that time, Pa.
    elastic: Vec<Matrix3<f64>>,
    /// h of each term of each point at that time, Pa.
    stresses: Vec<Matrix3<f64>>,
}

/// The factors of a step up to a moment.
struct Step {
    /// c
    elastic: f64,
    /// e^(−a) and g ĝ of each term.
    terms: Vec<[f64; 2]>,
}

/// The viscosity of `[viscosity]`; `None` where a body has none.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    let terms: Vec<PronyTerm> = body.fields.viscosity.iter().flat_map(|viscosity| viscosity.terms.clone()).collect();
    if terms.is_empty() {
        return None;
    }
    let points = Points::new(&body.shape.mesh, numbering);
    let count = points.count();
    let per_element = count / body.shape.mesh.elements();
    let mut law_of = vec![0; count];
    for (number, region) in body.regions.iter().enumerate() {
        for &element in &region.elements {
            law_of[element * per_element..][..per_element].fill(number + 1);
        }
    }
    let materials = std::iter::once(&body.material).chain(body.regions.iter().map(|region| &region.material));
    let laws: Option<Vec<_>> = materials.map(law).collect();
    let factor = |point: usize| body.stiffness_factors.get(point / per_element).copied().unwrap_or(1.0);
    Some(Box::new(Viscoelasticity {
        laws: laws?,
        law_of,
        factors: (0..count).map(factor).collect(),
        time: f64::NEG_INFINITY,
        elastic: vec![Matrix3::zeros(); count],
        stresses: vec![Matrix3::zeros(); count * terms.len()],
        terms,
        points,
    }))
}

/// The law at the points; where the volume is averaged, its λ has no viscosity.
fn law(material: &Material) -> Option<AnyLaw<f64>> {
    let law = AnyLaw::new(material)?;
    if material.volumetric != Volumetric::Standard { law.without_lambda() } else { Some(law) }
}

impl Viscoelasticity {
    fn law(&self, point: usize) -> &AnyLaw<f64> {
        &self.laws[self.law_of[point]]
    }

    /// The factors of a step that lasts until a moment.
    fn step(&self, moment: Moment) -> Step {
        let dt = f64::max(0.0, moment.time - self.time);
        // Before the first step the time is −∞, and nothing has relaxed.
        let dt = if dt.is_finite() { dt } else { 0.0 };
        let of_term = |term: &PronyTerm| {
            let a = dt / term.time;
            let mean = if a > 0.0 { -(-a).exp_m1() / a } else { 1.0 };
            [(-a).exp(), term.modulus_ratio * mean]
        };
        let terms: Vec<_> = self.terms.iter().map(of_term).collect();
        Step { elastic: terms.iter().map(|term| term[1]).sum(), terms }
    }

    /// A of a point, Pa.
    fn relaxing(&self, step: &Step, point: usize) -> Matrix3<f64> {
        let of_point = &self.stresses[point * self.terms.len()..][..self.terms.len()];
        let terms = step.terms.iter().zip(of_point);
        terms.map(|([decay, elastic], h)| *decay * h - *elastic * self.elastic[point]).sum()
    }

    /// First Piola–Kirchhoff stress of a point, Pa.
    fn stress(&self, step: &Step, point: usize, G: &Matrix3<f64>) -> Matrix3<f64> {
        let (law, A) = (self.law(point), self.relaxing(step, point));
        let of_relaxing = if law.is_linear() { A } else { (Matrix3::identity() + G) * A };
        step.elastic * matrix(&Law::stress(law, &tensor(G))) + of_relaxing
    }

    /// ∂P/∂F of a point, Pa.
    fn derivative(&self, step: &Step, point: usize, G: &Matrix3<f64>, kind: HessianKind) -> Tensor4<f64> {
        let (law, mut A) = (self.law(point), self.relaxing(step, point));
        let mut H = match kind {
            HessianKind::Exact => law.derivative(&tensor(G)),
            HessianKind::Projected => {
                let mut eigen = symmetric_eigen(A);
                eigen.eigenvalues.iter_mut().for_each(|value| *value = value.max(0.0));
                A = eigen.recompose();
                law.projected_derivative(&tensor(G))
            }
        };
        H.as_flattened_mut().iter_mut().for_each(|entry| *entry *= step.elastic);
        if !law.is_linear() {
            for i in 0..3 {
                for j in 0..3 {
                    (0..3).for_each(|l| H[3 * i + j][3 * i + l] += A[(j, l)]);
                }
            }
        }
        H
    }

    /// The second Piola–Kirchhoff stress of the law, Pa, which is the stress itself if the law is linear; `None` where the element is flat.
    fn elastic_stress(&self, point: usize, G: &Matrix3<f64>) -> Option<Matrix3<f64>> {
        let (law, F) = (self.law(point), Matrix3::identity() + G);
        let P = matrix(&Law::stress(law, &tensor(G)));
        let S = match law.is_linear() {
            true => P,
            false if F.determinant() == 0.0 => return None,
            false => inverse(&F) * P,
        };
        S.iter().all(|entry| entry.is_finite()).then(|| 0.5 * (S + S.transpose()))
    }

    /// Goes on to the state at the start of a step.
    fn go_on<T: Real>(&mut self, u: &[[T; 3]], start: Moment) {
        if start.time < self.time || self.time == f64::NEG_INFINITY {
            self.elastic.fill(Matrix3::zeros());
            self.stresses.fill(Matrix3::zeros());
            self.time = start.time;
        }
        let (step, count) = (self.step(start), self.terms.len());
        for point in 0..self.points.count() {
            // A flat element keeps the stress that it had.
            let now = self.elastic_stress(point, &self.points.gradient_of(point, u)).unwrap_or(self.elastic[point]);
            let change = now - self.elastic[point];
            for (h, [decay, elastic]) in self.stresses[point * count..][..count].iter_mut().zip(&step.terms) {
                *h = *decay * *h + *elastic * change;
            }
            self.elastic[point] = now;
        }
        self.time = start.time;
    }
}

impl<T: Real> Potential<T> for Viscoelasticity {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        let term =
            |PronyTerm { modulus_ratio, time }: &PronyTerm| format!("{modulus_ratio} of the moduli over {time} s");
        format!("[viscosity]: {}", self.terms.iter().map(term).collect::<Vec<_>>().join(", "))
    }

    fn bytes(&self) -> usize {
        self.points.bytes() + size_of_val(&self.elastic[..]) + size_of_val(&self.stresses[..])
    }

    fn begin_step(&mut self, u: &[[T; 3]], start: Moment, _: f64) {
        self.go_on(u, start);
    }

    fn energy(&self, u: &[[T; 3]], moment: Moment) -> Energy {
        let step = self.step(moment);
        let of_point = |point: usize| {
            let (G, law) = (self.points.gradient_of(point, u), self.law(point));
            let strain = 0.5 * (G + G.transpose());
            let strain = if law.is_linear() { strain } else { strain + 0.5 * G.transpose() * G };
            let density = step.elastic * Law::energy(law, &tensor(&G)) + self.relaxing(&step, point).dot(&strain);
            Energy::of(self.factors[point] * self.points.volume(point) * density)
        };
        (0..self.points.count()).map(of_point).sum()
    }

    fn add_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) {
        let step = self.step(moment);
        for point in 0..self.points.count() {
            let P = self.stress(&step, point, &self.points.gradient_of(point, u));
            self.points.add_divergence(point, &(self.factors[point] * P), gradient);
        }
    }

    fn hessian(&self, u: &[[T; 3]], moment: Moment, kind: HessianKind, add: &mut AddBlock<T>) {
        let step = self.step(moment);
        for point in 0..self.points.count() {
            let H = self.derivative(&step, point, &self.points.gradient_of(point, u), kind);
            let weight = self.factors[point] * self.points.volume(point);
            for (row, a) in self.points.nodes(point) {
                for (column, b) in self.points.nodes(point) {
                    let entry = |i: usize, k: usize| -> f64 {
                        (0..3).map(|j| (0..3).map(|l| a[j] * H[3 * i + j][3 * k + l] * b[l]).sum::<f64>()).sum()
                    };
                    add(row, column, std::array::from_fn(|i| std::array::from_fn(|k| T::of(weight * entry(i, k)))));
                }
            }
        }
    }

    fn resultant(&self, _: Moment) -> Option<[f64; 3]> {
        Some([0.0; 3])
    }

    fn in_elements(&self) -> Option<&dyn InElements<T>> {
        Some(self)
    }

    fn remembering(&self) -> Option<&dyn Remembering> {
        Some(self)
    }

    fn remembering_mut(&mut self) -> Option<&mut dyn Remembering> {
        Some(self)
    }
}

impl<T: Real> InElements<T> for Viscoelasticity {
    fn is_elastic(&self) -> bool {
        false
    }

    fn add_stresses(&self, u: &[[T; 3]], moment: Moment, stresses: &mut [Matrix3<f64>]) {
        let step = self.step(moment);
        for (point, sum) in stresses.iter_mut().enumerate() {
            let G = self.points.gradient_of(point, u);
            let P = self.stress(&step, point, &G);
            let is_linear = self.law(point).is_linear();
            *sum += self.factors[point] * if is_linear { P } else { matrix(&cauchy_stress(&tensor(&P), &tensor(&G))) };
        }
    }
}

impl Remembering for Viscoelasticity {
    fn save(&self, history: &mut History) {
        put(history, "viscosity.time", &[self.time]);
        put(history, "viscosity.elastic", &flat(&self.elastic));
        put(history, "viscosity.stresses", &flat(&self.stresses));
    }

    fn restore(&mut self, history: &History) -> Result<(), String> {
        take(history, "viscosity.time", std::slice::from_mut(&mut self.time))?;
        for (name, values) in [("elastic", &mut self.elastic), ("stresses", &mut self.stresses)] {
            let mut numbers = flat(values);
            take(history, &format!("viscosity.{name}"), &mut numbers)?;
            for (value, entries) in values.iter_mut().zip(numbers.chunks_exact(9)) {
                *value = Matrix3::from_column_slice(entries);
            }
        }
        Ok(())
    }
}

fn flat(matrices: &[Matrix3<f64>]) -> Vec<f64> {
    matrices.iter().flat_map(|matrix| matrix.iter().copied()).collect()
}

fn tensor(A: &Matrix3<f64>) -> Tensor<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| A[(i, j)]))
}

fn matrix(A: &Tensor<f64>) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| A[i][j])
}
