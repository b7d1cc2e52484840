//! A free elastic body for the integrators, and dense linear algebra that is independent of the course's library.

use std::cell::RefCell;

use grader_child::algebra;
use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector3};
use nalgebra_sparse::CsrMatrix;

use super::Course;
use super::meshes::Mesh;
use super::outcome::{Mistake, Outcome, dense_of, holds, waits};
use crate::implementation::Trouble;

/// The same matrix without its zeros.
pub fn sparse(dense: &DMatrix<f64>) -> CsrMatrix<f64> {
    CsrMatrix::from(dense)
}

/// Limit of the number of unknowns. Checks have fewer, and larger systems would take too long.
const MOST_UNKNOWNS: usize = 300;

/// Gaussian elimination with pivots; NaN where the matrix is singular, large, or does not fit b.
pub fn by_elimination(A: &CsrMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    if b.is_empty() {
        return b.clone();
    }
    let fits = b.len() <= MOST_UNKNOWNS && (A.nrows(), A.ncols()) == (b.len(), b.len());
    let solution = if fits { algebra::by_elimination(A, b) } else { None };
    solution.unwrap_or_else(|| DVector::from_element(b.len(), f64::NAN))
}

/// The nearest symmetric matrix without negative eigenvalues; NaN where H is not finite.
pub fn without_negative_eigenvalues(H: &SMatrix<f64, 12, 12>) -> SMatrix<f64, 12, 12> {
    if !H.iter().all(|entry| entry.is_finite()) {
        return SMatrix::repeat(f64::NAN); // the eigenvalue iteration would not end
    }
    let eigen = algebra::eigen(H);
    let kept = eigen.eigenvalues.map(|value| value.max(0.0));
    eigen.eigenvectors * SMatrix::<f64, 12, 12>::from_diagonal(&kept) * eigen.eigenvectors.transpose()
}

/// A soft box without constraints and gravity that translates, rotates and vibrates.
pub struct FreeBody<'a> {
    course: &'a Course<'a>,
    mesh: Mesh,
    C: f64,
    D: f64,
    mass: CsrMatrix<f64>,
    /// Positions, m.
    pub q: DVector<f64>,
    /// Velocities, m/s.
    pub qdot: DVector<f64>,
    /// The first trouble with a function that a step needs beside the one that is judged.
    trouble: RefCell<Option<Mistake>>,
}

const DENSITY: f64 = 1000.0;

impl<'a> FreeBody<'a> {
    /// A body of about this size, m.
    ///
    /// # Errors
    /// The trouble if the mass matrix is not available.
    pub fn new(course: &'a Course, size: f64) -> Result<Self, Mistake> {
        let mesh = Mesh::uneven_box([1, 1, 1], size);
        let q_size = 3 * mesh.V.len();
        let needs = waits("mass_matrix_mesh");
        let mass = course.trusted.mass_matrix_mesh(q_size, &mesh.T, DENSITY, &mesh.v0).map_err(&needs)?;
        dense_of((q_size, q_size), &mass).map_err(|_| needs(Trouble::Malformed))?;
        let stretched = Matrix3::new(1.01, 0.01, 0.0, 0.0, 0.99, 0.0, 0.005, 0.0, 1.0);
        let spin = Vector3::new(0.3, -0.2, 0.5);
        Ok(Self {
            course,
            q: mesh.placed(|X| stretched * X),
            qdot: mesh.placed(|X| Vector3::new(1.0, -0.5, 0.25) + spin.cross(X)),
            mesh,
            // The smaller the softer: in each step sound passes at most a few times through the body. In a stiffer one
            // dt² K outweighs M so much that its round-off shows in the momentum.
            C: 2e4 * size,
            D: 5e4 * size,
            mass,
            trouble: RefCell::new(None),
        })
    }

    /// Sum of mass times velocity, kg m/s.
    pub fn momentum(&self) -> Vector3<f64> {
        let momenta = &self.mass * &self.qdot;
        (0..self.mesh.V.len()).map(|vertex| momenta.fixed_rows::<3>(3 * vertex).into_owned()).sum()
    }

    fn size(&self) -> usize {
        3 * self.mesh.V.len()
    }

    fn note(&self, mistake: Mistake) {
        self.trouble.borrow_mut().get_or_insert(mistake);
    }

    /// The force; NaN and a note of the reason if it is not available.
    fn force(&self, q: &DVector<f64>) -> DVector<f64> {
        let answer = self.checked(q).and_then(|()| {
            let Mesh { V, T, v0 } = &self.mesh;
            let needs = waits("assemble_forces");
            let f = self.course.trusted.assemble_forces(q, V, T, v0, self.C, self.D).map_err(&needs)?;
            if f.len() == self.size() { Ok(f) } else { Err(needs(Trouble::Malformed)) }
        });
        answer.unwrap_or_else(|mistake| {
            self.note(mistake);
            DVector::from_element(self.size(), f64::NAN)
        })
    }

    /// The stiffness; zero and a note of the reason if it is not available.
    fn stiffness(&self, q: &DVector<f64>) -> CsrMatrix<f64> {
        let answer = self.checked(q).and_then(|()| {
            let Mesh { V, T, v0 } = &self.mesh;
            let needs = waits("assemble_stiffness");
            let K = self.course.trusted.assemble_stiffness(q, V, T, v0, self.C, self.D).map_err(&needs)?;
            if (K.nrows(), K.ncols()) == (self.size(), self.size()) { Ok(K) } else { Err(needs(Trouble::Malformed)) }
        });
        answer.unwrap_or_else(|mistake| {
            self.note(mistake);
            CsrMatrix::zeros(self.size(), self.size())
        })
    }

    fn checked(&self, x: &DVector<f64>) -> Outcome {
        holds("energy, force and stiffness are called with vectors as long as q", x.len() == self.size())
    }

    /// `energy(v)` of a step of implicit Euler from the present state.
    ///
    /// # Errors
    /// The trouble if v has another length than q, or an element's energy is not available.
    pub fn step_energy(&self, v: &DVector<f64>, dt: f64) -> Result<f64, Mistake> {
        self.checked(v)?;
        let gained = v - &self.qdot;
        let mut energy = 0.5 * gained.dot(&(&self.mass * &gained));
        let (q, Mesh { V, T, v0 }) = (&self.q + v * dt, &self.mesh);
        for (element, &volume) in T.iter().zip(v0) {
            let of_element = self.course.trusted.V_linear_tetrahedron(&q, V, element, volume, self.C, self.D);
            energy += of_element.map_err(waits("V_linear_tetrahedron"))?;
        }
        Ok(energy)
    }

    /// One step of `linearly_implicit_euler`.
    ///
    /// # Errors
    /// The mistake if the step fails or returns vectors of another length.
    pub fn linearly_implicit_step(&mut self, dt: f64) -> Outcome {
        let (mut q, mut qdot) = (self.q.clone(), self.qdot.clone());
        let (force, stiffness) = (|q: &_, _: &_| self.force(q), |q: &_, _: &_| self.stiffness(q));
        let done = self.course.subject.linearly_implicit_euler(
            &mut q,
            &mut qdot,
            dt,
            &self.mass,
            &force,
            &stiffness,
            &by_elimination,
        );
        self.moved_to(done, q, qdot)
    }

    /// One step of `implicit_euler`.
    ///
    /// # Errors
    /// The mistake if the step fails or returns vectors of another length.
    pub fn implicit_step(&mut self, dt: f64) -> Outcome {
        let (mut q, mut qdot) = (self.q.clone(), self.qdot.clone());
        let (force, stiffness) = (|q: &_, _: &_| self.force(q), |q: &_, _: &_| self.stiffness(q));
        let energy = |v: &DVector<f64>| {
            self.step_energy(v, dt).unwrap_or_else(|mistake| {
                self.note(mistake);
                f64::NAN
            })
        };
        let done = self.course.subject.implicit_euler(
            &mut q,
            &mut qdot,
            dt,
            &self.mass,
            &energy,
            &force,
            &stiffness,
            &by_elimination,
        );
        self.moved_to(done, q, qdot)
    }

    fn moved_to(&mut self, done: Result<(), Trouble>, q: DVector<f64>, qdot: DVector<f64>) -> Outcome {
        // The recorded reason explains every result of the step.
        if let Some(mistake) = self.trouble.take() {
            return Err(mistake);
        }
        done?;
        holds("q and qdot keep their lengths", (q.len(), qdot.len()) == (self.size(), self.size()))?;
        (self.q, self.qdot) = (q, qdot);
        Ok(())
    }
}
