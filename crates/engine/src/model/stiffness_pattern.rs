//! Bodies with and without a stiffness matrix: its sparsity pattern is found only for methods that solve with it.

use std::sync::Arc;

use fem_model::{Body, with_elements};

use super::system::{OwnForces, System};
use fem_elements::materials::AnyLaw;
use fem_elements::sparse::Pattern;
use fem_solvers::numbering::Ordering;
use fem_solvers::{Real, Solver, SolverChoice};

impl<T: Real> System<T> {
    /// Builds the parts that the scene names, with rows and blocks in the form of the solver.
    /// `law` is that of the body's material, `None` for a mass-spring body.
    pub fn new(body: Body, law: impl Into<Option<AnyLaw<T::Single>>>, choice: SolverChoice) -> Self {
        Self::with_forces(body, law, choice, &|_| Vec::new())
    }

    /// The same with forces of one's own beside those that the scene names.
    pub fn with_forces(
        body: Body,
        law: impl Into<Option<AnyLaw<T::Single>>>,
        choice: SolverChoice,
        own: OwnForces<T>,
    ) -> Self {
        let mut system = Self::of_body(&body, law.into(), choice.ordering(), own);
        system.prepare_matrix(choice);
        system
    }

    /// The same for a method that needs no matrix: neighbours in the body have near numbers, and no pattern is found.
    pub fn without_matrix(body: &Body, law: impl Into<Option<AnyLaw<T::Single>>>, own: OwnForces<T>) -> Self {
        Self::of_body(body, law.into(), Ordering::Parts, own)
    }

    /// Finds the pattern of the stiffness matrix, with the blocks that a solver needs, and the places to which each element adds. The
    /// numbering stays: that of a body without matrix suits sweeps, and a factor of it has more fill-in.
    pub fn prepare_matrix(&mut self, choice: SolverChoice) {
        let couplings = self.forces.couplings(self.nodes());
        let (numbering, stored) = (&self.numbering, choice.stored());
        let pattern = with_elements!(&self.shape.mesh, elements => {
            Pattern::joined(numbering.free, &numbering.elements(elements), &couplings, stored)
        });
        self.elements.set_pattern(&pattern);
        self.forces.set_pattern(&pattern);
        self.pattern = Arc::new(pattern);
    }

    /// Returns true if the pattern of the stiffness matrix is known, or no node has a row in it.
    pub fn has_pattern(&self) -> bool {
        self.pattern.rows() == self.free()
    }

    /// A solver for the body's matrices.
    pub fn solver(&self, choice: SolverChoice) -> Solver<T> {
        Solver::new(choice, &self.pattern, &self.rest_of_rows())
    }

    /// The same for [directions](Solver::for_directions).
    pub fn solver_for_directions(&self, choice: SolverChoice) -> Solver<T> {
        Solver::for_directions(choice, &self.pattern, &self.rest_of_rows())
    }

    /// Undeformed positions of the nodes that have rows in matrices, m.
    fn rest_of_rows(&self) -> Vec<[f64; 3]> {
        self.rest[..self.free()].iter().map(|x| (*x).into()).collect()
    }
}
