#![doc = include_str!("../include-docs/assignment_setup.md")]
#![cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]

mod build;
mod constraints;
mod explain;
mod simulation;
mod work;

use std::cell::RefCell;
use std::sync::Arc;

use fem_scene::simulation::{Pull, Shape};
use fem_scene::{Drag, Integrator};
use nalgebra::{DVector, Matrix3, Vector3};
use nalgebra_sparse::CsrMatrix;

use crate::given::{Solver, add_block};
use crate::*;
use constraints::Constraints;
use work::Work;

/// The course's simulation of one scene: what it is made of, and where it is now.
pub struct AssignmentSetup {
    name: String,
    shape: Arc<Shape>,
    /// Undeformed volume of each element, m³.
    v0: Vec<f64>,
    C: f64,
    D: f64,
    density: f64,
    /// Gravity's direction, and its size in m/s².
    gravity: Option<(Vector3<f64>, f64)>,
    /// Mass of the coordinates that are free, kg.
    M: CsrMatrix<f64>,
    /// Weight of every coordinate, N.
    weight: DVector<f64>,
    constraints: Constraints,
    skinning: Option<CsrMatrix<f64>>,
    /// The scene's drag, and the node that it pulls.
    drag: Option<(Drag, usize)>,
    /// Stiffness of every pull, N/m.
    drag_stiffness: f64,
    /// A person's pull, which takes the place of the scene's.
    pull: Option<Pull>,
    /// How far a coordinate may move before a stiffness is out of date, m.
    hardly_moved: f64,
    integrator: Integrator,
    dt: f64,
    time: f64,
    steps_since_reset: usize,
    /// Positions and velocities of the coordinates that are free.
    q: DVector<f64>,
    qdot: DVector<f64>,
    solver: RefCell<Solver>,
    work: Work,
}

/// A stiffness, and where the body was that has it.
struct Kept {
    q: DVector<f64>,
    K: CsrMatrix<f64>,
}

/// A spring of no rest length that pulls a node to a place.
struct Spring {
    node: usize,
    target: Vector3<f64>,
}

impl AssignmentSetup {
    /// One step of the chosen integrator from (q, qdot), with the springs as they are at its end.
    fn advance(&self, q: &mut DVector<f64>, qdot: &mut DVector<f64>, springs: &[Spring]) {
        let (dt, M) = (self.dt, &self.M);
        let (q_before, qdot_before) = (q.clone(), qdot.clone());
        let energy = |v: &DVector<f64>| {
            self.work.count_energy_evaluation();
            let dv = v - &qdot_before;
            0.5 * dv.dot(&(M * &dv)) + self.work.energy.time(|| self.potential(&(&q_before + v * dt), springs))
        };
        let force = |q: &DVector<f64>, _: &DVector<f64>| self.work.forces.time(|| self.force(q, springs));
        let kept = RefCell::new(None);
        let stiffness =
            |q: &DVector<f64>, _: &DVector<f64>| self.work.stiffness.time(|| self.kept_stiffness(q, springs, &kept));
        let solve = |A: &CsrMatrix<f64>, b: &DVector<f64>| {
            self.work.count_solve(self.integrator == Integrator::ImplicitEuler);
            self.work.solve.time(|| self.solve(A, b, springs))
        };

        match self.integrator {
            Integrator::LinearlyImplicitEuler => linearly_implicit_euler(q, qdot, dt, M, force, stiffness, solve),
            Integrator::ImplicitEuler => implicit_euler(q, qdot, dt, M, energy, force, stiffness, solve),
            other => unreachable!("the course has no integrator {}", other.name()),
        }
    }

    /// Solves A x = b, A = M − dt² K.
    ///
    /// In A of a small stiff body, M is far below dt² K and loses its last digits, and x with it. But forces inside a body
    /// add up to zero, 1ᵀ K = 0, so where nothing else acts 1ᵀ M x = 1ᵀ b, and this puts the mean of x right: the last digits
    /// of a free body's momentum.
    fn solve(&self, A: &CsrMatrix<f64>, b: &DVector<f64>, springs: &[Spring]) -> DVector<f64> {
        let mut x = self.solver.borrow_mut().solve(A, b);
        if self.constraints.is_free() && springs.is_empty() {
            let missing = sum_of_nodes(&(b - &self.M * &x)) / (self.density * self.v0.iter().sum::<f64>());
            for i in 0..x.len() {
                x[i] += missing[i % 3];
            }
        }
        x
    }

    /// Elastic energy, weight (nothing at rest) and springs, J.
    fn potential(&self, q: &DVector<f64>, springs: &[Spring]) -> f64 {
        let x = self.constraints.all_coordinates(q);
        let (V, T) = (&self.shape.mesh.vertices, &self.shape.mesh.elements);
        let elastic: f64 =
            T.iter().zip(&self.v0).map(|(element, &v0)| V_linear_tetrahedron(&x, V, element, v0, self.C, self.D)).sum();
        let lifted: f64 = match self.gravity {
            Some(_) => (0..x.len()).map(|i| self.weight[i] * (x[i] - V[i / 3][i % 3])).sum(),
            None => 0.0,
        };
        let pulled: f64 = springs
            .iter()
            .map(|spring| V_spring_particle_particle(&node(&x, spring.node), &spring.target, 0.0, self.drag_stiffness))
            .sum();
        elastic - lifted + pulled
    }

    /// −∂V/∂q of [`potential`](Self::potential), N.
    fn force(&self, q: &DVector<f64>, springs: &[Spring]) -> DVector<f64> {
        self.work.count_force_assembly();
        let x = self.constraints.all_coordinates(q);
        let (V, T) = (&self.shape.mesh.vertices, &self.shape.mesh.elements);
        let mut f = assemble_forces(&x, V, T, &self.v0, self.C, self.D);
        if self.gravity.is_some() {
            f += &self.weight;
        }
        for spring in springs {
            let gradient =
                dV_spring_particle_particle_dq(&node(&x, spring.node), &spring.target, 0.0, self.drag_stiffness);
            for i in 0..3 {
                f[3 * spring.node + i] -= gradient[i];
            }
        }
        self.constraints.free_coordinates(f)
    }

    /// [`stiffness`](Self::stiffness), or the one that is kept from an earlier iteration of the same step, where the body has
    /// hardly moved since: Newton's directions stay as good, and most of its time is saved.
    fn kept_stiffness(&self, q: &DVector<f64>, springs: &[Spring], kept: &RefCell<Option<Kept>>) -> CsrMatrix<f64> {
        let mut kept = kept.borrow_mut();
        match &*kept {
            Some(old) if (q - &old.q).amax() <= self.hardly_moved => old.K.clone(),
            _ => {
                let K = self.stiffness(q, springs);
                *kept = Some(Kept { q: q.clone(), K: K.clone() });
                K
            }
        }
    }

    /// ∂f/∂q of [`force`](Self::force) with projected elements, N/m. A spring of no rest length has the same stiffness
    /// in every direction; without it here, a stiff pull would be explicit and blow up.
    fn stiffness(&self, q: &DVector<f64>, springs: &[Spring]) -> CsrMatrix<f64> {
        self.work.count_stiffness_assembly(self.shape.mesh.elements.len());
        let x = self.constraints.all_coordinates(q);
        let (V, T) = (&self.shape.mesh.vertices, &self.shape.mesh.elements);
        let mut K = assemble_stiffness(&x, V, T, &self.v0, self.C, self.D);
        for spring in springs {
            let block = Matrix3::from_diagonal_element(-self.drag_stiffness);
            add_block(&mut K, spring.node, spring.node, &block);
        }
        self.constraints.free_block(K)
    }

    /// The pulls at a time: a person's where there is one, else the scene's.
    fn springs(&self, time: f64) -> Vec<Spring> {
        if let Some(pull) = &self.pull {
            let spring = |&(node, anchor): &(usize, Vector3<f64>)| Spring { node, target: anchor + pull.offset };
            return pull.anchors.iter().map(spring).collect();
        }
        let scripted = self.drag.as_ref().map(|(drag, node)| {
            let swing = drag.amplitude * (std::f64::consts::TAU * drag.frequency * time).sin();
            Spring { node: *node, target: self.shape.mesh.vertices[*node] + Vector3::from(drag.direction) * swing }
        });
        scripted.into_iter().collect()
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
