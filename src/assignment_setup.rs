#![doc = include_str!("../include-docs/assignment_setup.md")]
#![cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]

mod build;
mod constraints;
mod explain;
mod profile;
mod simulation;

use std::cell::RefCell;
use std::sync::Arc;

use fem_model::simulation::Shape;
use fem_model::{Integrator, Interaction};
use nalgebra::{DVector, Matrix3, Vector3};
use nalgebra_sparse::CsrMatrix;

use crate::given::{Solver, add_block};
use crate::*;
use constraints::Constraints;
use profile::Profile;

/// The course's simulation of one scene: its matrices and its current state.
pub struct AssignmentSetup {
    name: String,
    shape: Arc<Shape>,
    /// Undeformed volume of each element, m³.
    v0: Vec<f64>,
    C: f64,
    D: f64,
    density: f64,
    /// Direction of gravity, and its size in m/s².
    gravity: Option<(Vector3<f64>, f64)>,
    /// Mass matrix of the free coordinates, kg.
    M: CsrMatrix<f64>,
    /// M without the entries that are zero, two thirds of those it stores: for products with vectors.
    M_nonzero: CsrMatrix<f64>,
    /// Weight of every coordinate, N.
    weight: DVector<f64>,
    constraints: Constraints,
    skinning: Option<CsrMatrix<f64>>,
    /// The scene's drag, or the pull of the mouse.
    interaction: Interaction,
    /// True if the stiffness contains the springs of the drag or of the mouse.
    has_springs_in_stiffness: bool,
    /// Largest displacement of a coordinate up to which an assembled stiffness is used again, m.
    reuse_distance: f64,
    integrator: Integrator,
    dt: f64,
    time: f64,
    steps_since_reset: usize,
    /// Free coordinates, m, and their velocities, m/s.
    q: DVector<f64>,
    qdot: DVector<f64>,
    solver: RefCell<Solver>,
    profile: Profile,
}

/// An assembled stiffness, and the free coordinates that it belongs to.
struct Assembled {
    q: DVector<f64>,
    K: CsrMatrix<f64>,
}

/// A spring of zero rest length from a node to a fixed point, `target` (m).
struct AnchorSpring {
    node: usize,
    target: Vector3<f64>,
}

impl AssignmentSetup {
    /// One step of the chosen integrator from (q, qdot). `springs` are those at the end of the step.
    fn advance(&self, q: &mut DVector<f64>, qdot: &mut DVector<f64>, springs: &[AnchorSpring]) {
        let (dt, M) = (self.dt, &self.M);
        let (q_before, qdot_before) = (q.clone(), qdot.clone());
        let energy = |v: &DVector<f64>| {
            self.profile.count_energy_evaluation();
            let dv = v - &qdot_before;
            0.5 * dv.dot(&(&self.M_nonzero * &dv))
                + self.profile.energy.time(|| self.potential(&(&q_before + v * dt), springs))
        };
        let force = |q: &DVector<f64>, _: &DVector<f64>| self.profile.forces.time(|| self.force(q, springs));
        let last = RefCell::new(None);
        let stiffness = |q: &DVector<f64>, _: &DVector<f64>| {
            self.profile.stiffness.time(|| self.recent_stiffness(q, springs, &last))
        };
        let solve = |A: &CsrMatrix<f64>, b: &DVector<f64>| {
            self.profile.count_solve(self.integrator == Integrator::ImplicitEuler);
            self.profile.solve.time(|| self.solve(A, b, springs))
        };

        match self.integrator {
            Integrator::LinearlyImplicitEuler => linearly_implicit_euler(q, qdot, dt, M, force, stiffness, solve),
            Integrator::ImplicitEuler => implicit_euler(q, qdot, dt, M, energy, force, stiffness, solve),
            other => unreachable!("the course has no integrator {}", other.name()),
        }
    }

    /// Solves A x = b, A = M − dt² K.
    ///
    /// In A of a small stiff body, M is far below dt² K and loses its last digits, and x with it. But inner forces add up to
    /// zero, 1ᵀ K = 0. So 1ᵀ M x = 1ᵀ b for a body without constraints and springs, which corrects the mean of x and with it
    /// the last digits of the momentum.
    fn solve(&self, A: &CsrMatrix<f64>, b: &DVector<f64>, springs: &[AnchorSpring]) -> DVector<f64> {
        let mut x = self.solver.borrow_mut().solve(A, b);
        if self.constraints.is_free() && springs.is_empty() {
            let missing = sum_of_nodes(&(b - &self.M_nonzero * &x)) / (self.density * self.v0.iter().sum::<f64>());
            for i in 0..x.len() {
                x[i] += missing[i % 3];
            }
        }
        x
    }

    /// Elastic energy, potential of gravity (zero in the undeformed body) and energy of the springs, J.
    fn potential(&self, q: &DVector<f64>, springs: &[AnchorSpring]) -> f64 {
        let x = self.constraints.all_coordinates(q);
        let (V, T) = (self.shape.mesh.vertices(), self.shape.mesh.tetrahedra());
        let elastic: f64 =
            T.iter().zip(&self.v0).map(|(element, &v0)| V_linear_tetrahedron(&x, V, element, v0, self.C, self.D)).sum();
        let work_of_gravity: f64 = match self.gravity {
            Some(_) => (0..x.len()).map(|i| self.weight[i] * (x[i] - V[i / 3][i % 3])).sum(),
            None => 0.0,
        };
        let of_springs: f64 = springs
            .iter()
            .map(|spring| {
                V_spring_particle_particle(&node(&x, spring.node), &spring.target, 0.0, self.interaction.stiffness)
            })
            .sum();
        elastic - work_of_gravity + of_springs
    }

    /// −∂V/∂q of [`potential`](Self::potential), N.
    fn force(&self, q: &DVector<f64>, springs: &[AnchorSpring]) -> DVector<f64> {
        self.profile.count_force_assembly();
        let f = self.force_on_nodes(&self.constraints.all_coordinates(q), springs);
        self.constraints.free_coordinates(f)
    }

    /// Elastic forces, weight and springs on all coordinates at the positions `x  (3n)`, N.
    fn force_on_nodes(&self, x: &DVector<f64>, springs: &[AnchorSpring]) -> DVector<f64> {
        let (V, T) = (self.shape.mesh.vertices(), self.shape.mesh.tetrahedra());
        let mut f = assemble_forces(x, V, T, &self.v0, self.C, self.D);
        if self.gravity.is_some() {
            f += &self.weight;
        }
        for spring in springs {
            let gradient =
                dV_spring_particle_particle_dq(&node(x, spring.node), &spring.target, 0.0, self.interaction.stiffness);
            for i in 0..3 {
                f[3 * spring.node + i] -= gradient[i];
            }
        }
        f
    }

    /// [`stiffness`](Self::stiffness), or the last one of the same step if no coordinate has moved by more than
    /// `reuse_distance` since: Newton's directions stay as good, and most of the time of a step is saved.
    fn recent_stiffness(
        &self,
        q: &DVector<f64>,
        springs: &[AnchorSpring],
        last: &RefCell<Option<Assembled>>,
    ) -> CsrMatrix<f64> {
        let mut last = last.borrow_mut();
        match &*last {
            Some(last) if (q - &last.q).amax() <= self.reuse_distance => last.K.clone(),
            _ => {
                let K = self.stiffness(q, springs);
                *last = Some(Assembled { q: q.clone(), K: K.clone() });
                K
            }
        }
    }

    /// ∂f/∂q of [`force`](Self::force) with projected elements, N/m.
    ///
    /// A scene with `[drag]` leaves the springs of the drag and of the mouse out, as the assignment does, unless `drag.in_stiffness` is
    /// true. Linearly implicit Euler then treats them explicitly, and explodes if a spring is stiffer than the body around its node;
    /// Newton's line search shortens the step. A spring of zero rest length has the same stiffness in every direction.
    fn stiffness(&self, q: &DVector<f64>, springs: &[AnchorSpring]) -> CsrMatrix<f64> {
        self.profile.count_stiffness_assembly(self.shape.mesh.elements());
        let x = self.constraints.all_coordinates(q);
        let (V, T) = (self.shape.mesh.vertices(), self.shape.mesh.tetrahedra());
        let mut K = assemble_stiffness(&x, V, T, &self.v0, self.C, self.D);
        let springs_in_K = if self.has_springs_in_stiffness { springs } else { &[] };
        for spring in springs_in_K {
            let block = Matrix3::from_diagonal_element(-self.interaction.stiffness);
            add_block(&mut K, spring.node, spring.node, &block);
        }
        self.constraints.free_block(K)
    }

    /// The springs of the drag or of the mouse at a time, s.
    fn springs(&self, time: f64) -> Vec<AnchorSpring> {
        let V = self.shape.mesh.vertices();
        let anchors = self.interaction.anchors(V, time);
        anchors.map(|anchor| AnchorSpring { node: anchor.node, target: V[anchor.node] + anchor.displacement }).collect()
    }
}

/// Position of a node in stacked positions, m.
fn node(x: &DVector<f64>, node: usize) -> Vector3<f64> {
    Vector3::new(x[3 * node], x[3 * node + 1], x[3 * node + 2])
}

/// Sum over all nodes of a vector that is stacked like positions.
fn sum_of_nodes(x: &DVector<f64>) -> Vector3<f64> {
    (0..x.len() / 3).map(|i| node(x, i)).sum()
}
