//! A free elastic body for the integrators, and dense linear algebra that owes nothing to what the course gives.

use finite_elements_3d::{
    V_linear_tetrahedron, assemble_forces, assemble_stiffness, given, implicit_euler, linearly_implicit_euler,
    mass_matrix_mesh,
};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use nalgebra_sparse::CsrMatrix;

use crate::meshes::Mesh;

pub fn sparse(dense: &DMatrix<f64>) -> CsrMatrix<f64> {
    CsrMatrix::from(dense)
}

/// Gaussian elimination with pivots; NaN where the matrix is singular.
pub fn by_elimination(A: &CsrMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    DMatrix::from(A).lu().solve(b).unwrap_or_else(|| DVector::from_element(b.len(), f64::NAN))
}

/// A soft box that nothing holds, flying, turning and wobbling, without gravity.
pub struct FreeBody {
    mesh: Mesh,
    C: f64,
    D: f64,
    mass: CsrMatrix<f64>,
    pub q: DVector<f64>,
    pub qdot: DVector<f64>,
}

const DENSITY: f64 = 1000.0;

impl FreeBody {
    pub fn new(size: f64) -> Self {
        let mesh = Mesh::uneven_box([1, 1, 1], size);
        let mass = mass_matrix_mesh(3 * mesh.V.len(), &mesh.T, DENSITY, &mesh.v0);
        let stretched = Matrix3::new(1.01, 0.01, 0.0, 0.0, 0.99, 0.0, 0.005, 0.0, 1.0);
        let spin = Vector3::new(0.3, -0.2, 0.5);
        Self {
            q: mesh.placed(|X| stretched * X),
            qdot: mesh.placed(|X| Vector3::new(1.0, -0.5, 0.25) + spin.cross(X)),
            mesh,
            // The smaller the softer: in each step sound passes at most a few times through the body. In a stiffer one
            // dt² K outweighs M so much that its round-off shows in the momentum.
            C: 2e4 * size,
            D: 5e4 * size,
            mass,
        }
    }

    pub fn momentum(&self) -> Vector3<f64> {
        let momenta = &self.mass * &self.qdot;
        (0..self.mesh.V.len()).map(|vertex| momenta.fixed_rows::<3>(3 * vertex).into_owned()).sum()
    }

    fn force(&self, q: &DVector<f64>) -> DVector<f64> {
        assemble_forces(q, &self.mesh.V, &self.mesh.T, &self.mesh.v0, self.C, self.D)
    }

    fn stiffness(&self, q: &DVector<f64>) -> CsrMatrix<f64> {
        assemble_stiffness(q, &self.mesh.V, &self.mesh.T, &self.mesh.v0, self.C, self.D)
    }

    fn elastic_energy(&self, q: &DVector<f64>) -> f64 {
        let elements = self.mesh.T.iter().zip(&self.mesh.v0);
        elements.map(|(element, &volume)| V_linear_tetrahedron(q, &self.mesh.V, element, volume, self.C, self.D)).sum()
    }

    /// `energy(v)` of a step of implicit Euler from the present state.
    pub fn step_energy(&self, v: &DVector<f64>, dt: f64) -> f64 {
        let gained = v - &self.qdot;
        0.5 * gained.dot(&(&self.mass * &gained)) + self.elastic_energy(&(&self.q + v * dt))
    }

    pub fn linearly_implicit_step(&mut self, dt: f64) {
        let (mut q, mut qdot) = (self.q.clone(), self.qdot.clone());
        let (force, stiffness) = (|q: &DVector<f64>, _: &_| self.force(q), |q: &DVector<f64>, _: &_| self.stiffness(q));
        linearly_implicit_euler(&mut q, &mut qdot, dt, &self.mass, force, stiffness, given::solve);
        (self.q, self.qdot) = (q, qdot);
    }

    pub fn implicit_step(&mut self, dt: f64) {
        let (mut q, mut qdot) = (self.q.clone(), self.qdot.clone());
        let (force, stiffness) = (|q: &DVector<f64>, _: &_| self.force(q), |q: &DVector<f64>, _: &_| self.stiffness(q));
        let energy = |v: &DVector<f64>| self.step_energy(v, dt);
        implicit_euler(&mut q, &mut qdot, dt, &self.mass, energy, force, stiffness, given::solve);
        (self.q, self.qdot) = (q, qdot);
    }
}
