//! From a scene to a simulation at rest.

use crate::materials::AnyLaw;
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;
use crate::skinning::Skinning;
use crate::solvers::{Preconditioner, SolverChoice};
use fem_scene::{Body, Integrator, Method, Scene, SceneError, SolverKind, SolverSettings};

use super::stepper::Stepper;
use super::{Refusal, Simulator, range, rigid};

/// Methods that a running simulation can be switched to.
pub fn integrators(integrator: Integrator) -> &'static [Integrator] {
    match integrator {
        Integrator::Static => &[Integrator::Static],
        Integrator::LinearlyImplicitEuler | Integrator::ImplicitEuler => {
            &[Integrator::LinearlyImplicitEuler, Integrator::ImplicitEuler]
        }
        // Where an explicit method is meant to be stable, all are.
        _ => &[
            Integrator::ExplicitEuler,
            Integrator::SemiImplicitEuler,
            Integrator::Rk2,
            Integrator::Rk4,
            Integrator::Verlet,
            Integrator::LinearlyImplicitEuler,
            Integrator::ImplicitEuler,
        ],
    }
}

/// Nodes up to which a factor is cheaper than iterations, where the scene names no solver: in motion, where inertia keeps
/// iterations few, and in equilibrium, where one factor does.
const DIRECT: (usize, usize) = (2000, 20_000);

/// The solver that the scene names, or the one that suits its size.
pub(super) fn solver_choice(method: &Method, nodes: usize) -> SolverChoice {
    let preconditioner = |solver: &SolverSettings| match solver.preconditioner {
        fem_scene::Preconditioner::BlockJacobi => Preconditioner::BlockJacobi,
        fem_scene::Preconditioner::IncompleteCholesky => Preconditioner::IncompleteCholesky,
        fem_scene::Preconditioner::Multigrid => Preconditioner::Multigrid,
        fem_scene::Preconditioner::Ssor => Preconditioner::Ssor,
    };
    let most_direct = if method.integrator == Integrator::Static { DIRECT.1 } else { DIRECT.0 };
    match &method.solver {
        Some(solver) => match solver.kind {
            SolverKind::Cholesky => SolverChoice::Cholesky,
            SolverKind::Lu => SolverChoice::Lu,
            SolverKind::Cg => SolverChoice::Cg,
            SolverKind::Pcg => SolverChoice::Pcg(preconditioner(solver)),
        },
        None if nodes <= most_direct => SolverChoice::Cholesky,
        // Inertia keeps the iterations of the cheapest one few; equilibrium has none.
        None if method.integrator == Integrator::Static => SolverChoice::Pcg(Preconditioner::Multigrid),
        None => SolverChoice::Pcg(Preconditioner::Ssor),
    }
}

impl<T: Real> Simulator<T> {
    /// Builds what the scene names, and nothing else.
    pub fn new(scene: &Scene, body: Body) -> Result<Self, SceneError> {
        let Some(law) = AnyLaw::new(&body.material) else {
            return Err(scene.refuse("material", "lacks the parameters of its model; give those that README.md names"));
        };
        let refuse = |(field, problem): Refusal| scene.refuse(field, &problem);
        let method = scene.method();
        if method.integrator == Integrator::Static {
            rigid::check(&body).map_err(refuse)?;
        }
        let skinning = body.shape.display.as_ref().map(|display| Skinning::new(&body.shape.mesh, &display.vertices));
        let choice = solver_choice(&method, body.shape.mesh.vertices.len());
        let (material, lumped_mass, drag) = (body.material.clone(), body.lumped_mass, body.drag);
        let system = System::new(body, law, choice);
        range::check(&method, &system).map_err(refuse)?;
        let state = State::at_rest(system.nodes());
        Ok(Self {
            stepper: Stepper::new(&method, &system, method.integrator, choice),
            integrator: method.integrator,
            choice,
            dt: method.dt,
            skinning,
            drag_stiffness: drag.map_or(hand_stiffness(&system), |drag| drag.stiffness),
            pull: None,
            springs: Vec::new(),
            counters: Default::default(),
            skinned_rows: Default::default(),
            skinned: Default::default(),
            reacted: Default::default(),
            last_good: state.clone(),
            state,
            system,
            method,
            material,
            lumped_mass,
        })
    }
}

/// Stiffness of the spring by which a user drags a node, N/m: half the shear modulus times the body's length, so that it
/// deforms the body visibly and does not tear it.
fn hand_stiffness<T: Real>(system: &System<T>) -> f64 {
    let [shear, _] = system.law.moduli();
    0.5 * shear * system.length
}
