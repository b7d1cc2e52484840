//! From a scene to a simulation at rest.

use crate::materials::AnyLaw;
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;
use crate::skinning::Skinning;
use crate::solvers::{Preconditioner, SolverChoice};
use fem_scene::{Body, Integrator, Scene, SceneError, Solver, SolverKind};

use super::stepper::Stepper;
use super::{Simulator, range, rigid};

/// Methods that a running simulation can be switched to.
pub fn integrators(scene: &Scene) -> &'static [Integrator] {
    match scene.time.integrator {
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
pub(super) fn solver_choice(scene: &Scene, nodes: usize) -> SolverChoice {
    let preconditioner = |solver: &Solver| match solver.preconditioner {
        None | Some(fem_scene::Preconditioner::BlockJacobi) => Preconditioner::BlockJacobi,
        Some(fem_scene::Preconditioner::IncompleteCholesky) => Preconditioner::IncompleteCholesky,
        Some(fem_scene::Preconditioner::Multigrid) => Preconditioner::Multigrid,
        Some(fem_scene::Preconditioner::Ssor) => Preconditioner::Ssor,
    };
    let most_direct = if scene.time.integrator == Integrator::Static { DIRECT.1 } else { DIRECT.0 };
    match &scene.solver {
        Some(solver) => match solver.kind {
            SolverKind::Cholesky => SolverChoice::Cholesky,
            SolverKind::Lu => SolverChoice::Lu,
            SolverKind::Cg => SolverChoice::Cg,
            SolverKind::Pcg => SolverChoice::Pcg(preconditioner(solver)),
        },
        None if nodes <= most_direct => SolverChoice::Cholesky,
        // Inertia keeps the iterations of the cheapest one few; equilibrium has none.
        None if scene.time.integrator == Integrator::Static => SolverChoice::Pcg(Preconditioner::Multigrid),
        None => SolverChoice::Pcg(Preconditioner::Ssor),
    }
}

impl<T: Real> Simulator<T> {
    /// Builds what the scene names, and nothing else.
    pub fn new(scene: &Scene, body: Body) -> Result<Self, SceneError> {
        let Some(law) = AnyLaw::new(&scene.material) else {
            return Err(scene.refuse("material", "lacks the parameters of its model; give those that README.md names"));
        };
        if scene.time.integrator == Integrator::Static {
            rigid::check(scene, &body)?;
        }
        let skinning = body.shape.display.as_ref().map(|display| Skinning::new(&body.shape.mesh, &display.vertices));
        let choice = solver_choice(scene, body.shape.mesh.vertices.len());
        let system = System::new(scene, body, law, choice);
        range::check(scene, &system)?;
        let state = State::at_rest(system.nodes());
        Ok(Self {
            stepper: Stepper::new(scene, &system, scene.time.integrator, choice),
            integrator: scene.time.integrator,
            choice,
            dt: scene.time.dt,
            skinning,
            drag_stiffness: scene.drag.as_ref().map_or(hand_stiffness(&system), |drag| drag.stiffness),
            pull: None,
            springs: Vec::new(),
            counters: Default::default(),
            skinned_rows: Default::default(),
            skinned: Default::default(),
            reacted: Default::default(),
            last_good: state.clone(),
            state,
            system,
            scene: scene.clone(),
        })
    }
}

/// Stiffness of the spring by which a user drags a node, N/m: half the shear modulus times the body's length, so that it
/// deforms the body visibly and does not tear it.
fn hand_stiffness<T: Real>(system: &System<T>) -> f64 {
    let [shear, _] = system.law.moduli();
    0.5 * shear * system.length
}
