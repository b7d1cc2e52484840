//! Uniform states of a whole body, on a mesh that is anything but uniform: the patch test, rotations, and closed forms.

use std::path::Path;

use fem_engine::forces::Moment;
use fem_engine::materials::AnyLaw;
use fem_engine::model::system::System;
use fem_engine::solvers::SolverChoice;
use fem_model::Law;
use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::{block, scene};

/// A body of 1 m³ whose inner nodes are where chance has put them.
struct Patch {
    system: System<f64>,
    /// True for each of the engine's nodes that lies inside.
    inner: Vec<bool>,
}

/// Evenly spread numbers in [−1, 1], the same in every run: Knuth's linear congruential generator MMIX.
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.number())
    }
}

/// Cells of ¼ m, with the inner nodes moved by up to 7 cm along each axis.
fn patch(model: &str) -> Patch {
    let text = block(model, "").replace("[2, 1, 1], cells_per_unit = 1", "[1, 1, 1], cells_per_unit = 4");
    let scene = scene(&text);
    let mut mesh = fem_mesh::box_mesh([1.0; 3], 4, fem_mesh::Pattern::Alternating).unwrap();
    let is_inner = |X: &Vector3<f64>| X.iter().all(|&x| x > 0.0 && x < 1.0);
    let mut random = Random(7);
    for X in mesh.vertices.iter_mut().filter(|X| is_inner(X)) {
        *X += 0.07 * random.vector();
    }
    let body = fem_scene::body_of(&scene, mesh, Path::new("no data")).unwrap();
    let law = AnyLaw::new(&scene.material.value()).unwrap();
    let system = System::new(body, law, SolverChoice::Cholesky);
    let inner = system.rest.iter().map(is_inner).collect();
    Patch { system, inner }
}

impl Patch {
    /// Displacements (F − 1) X + t.
    fn displacements(&self, F: &Matrix3<f64>, t: &Vector3<f64>) -> Vec<[f64; 3]> {
        self.system.rest.iter().map(|X| ((F - Matrix3::identity()) * X + t).into()).collect()
    }

    /// Gradient of the energy by the nodes, N.
    fn gradient(&self, F: &Matrix3<f64>, t: &Vector3<f64>) -> Vec<[f64; 3]> {
        let mut gradient = vec![[0.0; 3]; self.system.nodes()];
        self.system.gradient(&self.displacements(F, t), Moment::at(0.0), &mut gradient);
        gradient
    }

    fn energy(&self, F: &Matrix3<f64>) -> f64 {
        self.system.potential(&self.displacements(F, &Vector3::zeros()), Moment::at(0.0)).value
    }
}

fn largest<'a>(forces: impl Iterator<Item = &'a [f64; 3]>) -> f64 {
    forces.flatten().fold(0.0, |largest: f64, force| largest.max(force.abs()))
}

/// C = μ/2 of E = 1e5 Pa and ν = 0.3, times 1 m².
const C_AREA: f64 = 1e5 / (4.0 * 1.3);

#[test]
fn an_affine_state_of_an_irregular_mesh_leaves_no_force_inside() {
    let mut random = Random(1);
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        let patch = patch(model);
        assert_eq!(patch.inner.iter().filter(|&&inner| inner).count(), 27);
        for _ in 0..20 {
            let F = Matrix3::identity() + 0.3 * Matrix3::from_columns(&[(); 3].map(|()| random.vector()));
            assert!(F.determinant() > 0.1);
            let gradient = patch.gradient(&F, &random.vector());
            let inside = gradient.iter().zip(&patch.inner).filter(|(_, inner)| **inner).map(|(force, _)| force);
            let residual = largest(inside);
            assert!(residual <= 1e-12 * C_AREA, "{model}: {residual:e} N inside at F = {F}");
            assert!(largest(gradient.iter()) > 1e-3 * C_AREA, "{model}: the surface is loaded");
        }
    }
}

#[test]
fn a_state_that_is_not_affine_does_leave_a_force_inside() {
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        let patch = patch(model);
        let mut u = patch.displacements(&Matrix3::identity(), &Vector3::zeros());
        let moved = patch.inner.iter().position(|&inner| inner).unwrap();
        u[moved][0] += 1e-9;
        let mut gradient = vec![[0.0; 3]; u.len()];
        patch.system.gradient(&u, Moment::at(0.0), &mut gradient);
        assert!(gradient[moved][0] > 1e-11 * C_AREA, "{model}: {:e}", gradient[moved][0]);
    }
}

#[test]
fn a_rotation_of_the_body_causes_no_force_unless_the_law_is_linear() {
    let mut random = Random(2);
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        let patch = patch(model);
        for _ in 0..20 {
            let R = Rotation3::new(3.0 * random.vector()).into_inner();
            let force = largest(patch.gradient(&R, &random.vector()).iter());
            if *model == "linear" {
                assert!(force > 1e-3 * C_AREA, "{force:e}");
            } else {
                assert!(force <= 1e-12 * C_AREA, "{model}: {force:e} N");
                assert!(patch.energy(&R).abs() <= 1e-12 * C_AREA, "{model}: {:e} J", patch.energy(&R));
            }
        }
    }
}

/// The mean of P over the body, Pa: Σ ∇V ⊗ X over all nodes, because the body has 1 m³.
fn mean_stress(patch: &Patch, F: &Matrix3<f64>) -> Matrix3<f64> {
    let gradient = patch.gradient(F, &Vector3::zeros());
    gradient.iter().zip(&patch.system.rest).map(|(force, X)| Vector3::from(*force) * X.transpose()).sum()
}

#[test]
fn a_body_that_is_sheared_or_blown_up_has_the_energy_and_stress_of_the_closed_forms() {
    let patch = patch("neo_hookean");
    let (C, D) = (C_AREA, 1e5 / (6.0 * 0.4));
    for gamma in [-1.5, 1e-3, 0.4, 2.0] {
        let mut F = Matrix3::identity();
        F[(0, 1)] = gamma;
        assert!((patch.energy(&F) / (C * gamma * gamma) - 1.0).abs() < 1e-12, "γ = {gamma}");
        // J = 1, so Cauchy's stress is P Fᵀ.
        let stress = mean_stress(&patch, &F) * F.transpose();
        let mut expected = Matrix3::from_diagonal(&Vector3::new(4.0, -2.0, -2.0)) * (C * gamma * gamma / 3.0);
        (expected[(0, 1)], expected[(1, 0)]) = (2.0 * C * gamma, 2.0 * C * gamma);
        assert!((stress - expected).amax() < 1e-12 * C, "γ = {gamma}: {}", stress - expected);
    }
    for s in [0.3f64, 0.999, 1.001, 3.0] {
        let F = Matrix3::identity() * s;
        let excess = s.powi(3) - 1.0;
        let expected = Matrix3::identity() * (2.0 * D * excess * s * s);
        let error = (mean_stress(&patch, &F) - expected).amax();
        assert!(error < 1e-12 * (D * s.powi(5) + C), "s = {s}: {error:e} of {}", expected[0]);
        let error = (patch.energy(&F) - D * excess * excess).abs();
        assert!(error < 1e-12 * (D * excess * excess + C * (s - 1.0).powi(2)), "s = {s}: {error:e}");
    }
}
