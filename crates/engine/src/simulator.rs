//! The engine's simulation of one body: a [`System`] and its [`State`], advanced by an integrator, as a [`Simulation`].

mod adaptive;
mod capabilities;
mod checkpoint;
mod compiled;
mod contact;
mod corners;
mod creep;
pub(crate) mod device_assembly;
#[cfg(feature = "gpu")]
pub(crate) mod device_elements;
pub mod double;
mod energies;
mod integrator;
mod ledger;
mod parts;
mod plan;
mod range_check;
mod simulation;
mod step;
#[cfg(feature = "gpu")]
mod step_from;
mod substep;
mod volumes;
mod work;

use std::sync::atomic::AtomicUsize;

use fem_model::simulation::{Counters, Part, Simulation};
use fem_model::{Body, Integrator as IntegratorKind, Material, Method, Precision, Refusal, Timer};
use nalgebra::Vector3;

use crate::boundary::rigid_modes;
use crate::forces::contact::barrier::largest_shear_modulus;
use crate::forces::{self, Moment, drag};
use crate::integrators::Integrator;
use crate::model::state::State;
use crate::model::system::{OwnForces, System};
use crate::skinning::Skinning;
use fem_elements::materials::AnyLaw;
use fem_elements::number::check_instructions;
use fem_solvers::numbering::Numbering;
use fem_solvers::{Real, SolverChoice};

use adaptive::Control;
use contact::Contacts;
use corners::Corners;
use ledger::Ledger;
use plan::Plan;
use work::{LastForces, Room, StepWork};

pub use compiled::Compiled;

/// A body that the engine moves, in one number type.
pub struct Simulator<T: Real> {
    method: Method,
    plan: Plan,
    system: System<T>,
    state: State<T>,
    /// Velocities at the start in the engine's numbering, m/s; empty for a body at rest.
    initial_velocity: Vec<[T; 3]>,
    /// The state before the last step, to which a failed step returns.
    last_good: State<T>,
    /// The account of its energy: supplied, stored, dissipated.
    ledger: Ledger,
    /// Works of the step that was computed last, and the forces at its end.
    work: (StepWork, LastForces<T>),
    last_forces: LastForces<T>,
    room: Room<T>,
    contact: Option<Contacts<T>>,
    corners: Corners,
    /// N; `None` without gravity.
    weight: Option<f64>,
    integrator: Box<dyn Integrator<T>>,
    kind: IntegratorKind,
    solver: SolverChoice,
    /// Time step, the number of its substeps, and the duration of one, s.
    dt: f64,
    substeps: usize,
    substep_dt: f64,
    /// Control of the size of substeps; `None` for equal ones.
    control: Option<Control>,
    skinning: Option<Skinning>,
    counters: Counters,
    /// Display vertices that were computed; they are counted through `&self`.
    skinned_rows: AtomicUsize,
    skinning_timer: Timer,
    reactions_timer: Timer,
}

/// Builds the simulation of a body in the precision that the method names. Returns an error that names the quantity if they ask for
/// something impossible.
pub fn build(body: Body, method: &Method) -> Result<Box<dyn Simulation>, Refusal> {
    Ok(match method.precision {
        Precision::F64 => Box::new(Simulator::<f64>::new(body, method)?),
        Precision::F32 => Box::new(Simulator::<f32>::new(body, method)?),
    })
}

/// The parts that the simulation of a body would have, without building it. Returns the same errors.
pub fn planned_parts(body: &Body, method: &Method) -> Result<Vec<Part>, Refusal> {
    let epsilon = match method.precision {
        Precision::F64 => f64::EPSILON,
        Precision::F32 => f64::from(f32::EPSILON),
    };
    let is_linear = |material: &Material| AnyLaw::<f64>::new(material).is_some_and(|law| law.is_linear());
    check::<f64>(body, method, epsilon)?;
    let is_law_linear = is_linear(&body.material) && body.regions.iter().all(|region| is_linear(&region.material));
    let nodes = body.shape.mesh.vertices().len();
    let numbering = Numbering::of_mesh(nodes);
    let forces: Vec<_> = forces::kinds::<f64>().into_iter().filter_map(|kind| (kind.build)(body, &numbering)).collect();
    for force in &forces {
        capabilities::check_force(method, &**force)?;
    }
    let is_linear = is_law_linear && forces.iter().all(|force| force.may_be_quadratic());
    let mut plan = Plan::new(body);
    plan.add_forces(forces.iter().map(|force| &**force));
    Ok(plan.parts(method.integrator, method, integrator::solver_choice(method, body), is_linear))
}

/// The law of a body that the engine can simulate with numbers of this machine epsilon; `None` for a mass-spring body.
fn check<T: Real>(body: &Body, method: &Method, epsilon: f64) -> Result<Option<AnyLaw<T::Single>>, Refusal> {
    check_instructions().map_err(|problem| Refusal::new("pipeline", problem))?;
    let materials = body.regions.iter().map(|region| (&region.name[..], &region.material));
    for (table, material) in std::iter::once(("material", &body.material)).chain(materials) {
        range_check::check_shear_modulus(material).map_err(|problem| Refusal::new(table, problem))?;
    }
    method.check()?;
    capabilities::check(method, body)?;
    range_check::check_tolerance(method, epsilon)?;
    if method.integrator == IntegratorKind::Static {
        rigid_modes::check(body)?;
    }
    Ok(AnyLaw::new(&body.material))
}

impl<T: Compiled> Simulator<T> {
    /// Builds the parts that body and method need, in the initial state.
    pub fn new(body: Body, method: &Method) -> Result<Self, Refusal> {
        Self::with_forces(body, method, &|_| Vec::new())
    }

    /// The same with forces of one's own beside those of the body.
    pub fn with_forces(body: Body, method: &Method, own: OwnForces<T>) -> Result<Self, Refusal> {
        T::with_forces(body, method, own)
    }
}

impl<T: Real> Simulator<T> {
    fn assembled(body: Body, method: &Method, own: OwnForces<T>) -> Result<Self, Refusal> {
        let law = check::<T>(&body, method, T::EPSILON.as_f64())?;
        let method = method.clone();
        let mesh = &body.shape.mesh;
        let shown = body.shape.display.as_ref().filter(|_| mesh.dimension() == 3);
        let skinning = shown.map(|shown| Skinning::new(mesh, &shown.vertices));
        let solver = integrator::solver_choice(&method, &body);
        let velocities = body.initial_velocity.clone();
        let mut plan = Plan::new(&body);
        let gravity = body.gravity;
        let with_obstacles = body.contact.is_some().then(|| body.clone());
        let is_free = method.integrator == IntegratorKind::Static && rigid_modes::free_part(&body).is_some();
        let modulus_of_free_body = is_free.then(|| largest_shear_modulus(&body));
        let mut system = match method.integrator.has_matrix() {
            true => System::with_forces(body, law, solver, own),
            false => System::without_matrix(&body, law, own),
        };
        range_check::check(&method, &system)?;
        system.forces.all().try_for_each(|(force, _)| capabilities::check_force(&method, force))?;
        plan.add_forces(system.forces.all().map(|(force, _)| force).filter(|force| force.name() != drag::NAME));
        system.modulus_of_free_body = modulus_of_free_body;
        let contact = Contacts::new(with_obstacles.as_ref(), &mut system);
        let initial_velocity = initial_velocity(&velocities, &system);
        let state = State::at_start(system.nodes(), &initial_velocity);
        Ok(Self {
            integrator: integrator::build(
                method.integrator,
                &method,
                &system,
                solver,
                contact.as_ref().map(|contact| contact.planes()),
            ),
            ledger: Ledger::new(method.accept_gain),
            work: <_>::default(),
            corners: Corners::new(&system),
            last_forces: LastForces::default(),
            room: Room::default(),
            contact,
            weight: gravity.map(|gravity| gravity.norm() * system.total_mass),
            kind: method.integrator,
            solver,
            dt: method.dt,
            substeps: method.substeps,
            substep_dt: method.dt / method.substeps as f64,
            control: method.adaptive.map(Control::new),
            skinning,
            counters: Counters::default(),
            skinned_rows: AtomicUsize::default(),
            skinning_timer: Timer::default(),
            reactions_timer: Timer::default(),
            last_good: state.clone(),
            state,
            initial_velocity,
            system,
            plan,
            method,
        })
    }

    /// The body.
    pub fn system(&self) -> &System<T> {
        &self.system
    }

    /// Its state, in the engine's numbering.
    pub fn state(&self) -> &State<T> {
        &self.state
    }

    /// Sets the state: displacements (m) and velocities (m/s) in the mesh's numbering. Time stays.
    pub fn set_state(&mut self, displacements: &[[f64; 3]], velocities: &[[f64; 3]]) {
        for (node, &mesh_node) in self.system.numbering.mesh_node.iter().enumerate() {
            self.state.u[node] = displacements[mesh_node as usize].map(T::of);
            self.state.v[node] = velocities[mesh_node as usize].map(T::of);
        }
        self.forget();
    }

    /// Switches the check of the energy off, so that the growth of a motion can be measured, or on again.
    pub fn accept_gain(&mut self, is_accepted: bool) {
        self.ledger = Ledger::new(is_accepted);
    }

    /// Drops all that was derived from earlier states and parameters.
    fn forget(&mut self) {
        self.integrator.forget();
        self.ledger.forget();
        self.last_forces.forget();
        if let Some(control) = &mut self.control {
            control.forget();
        }
        if let Some(contact) = &mut self.contact {
            contact.forget(&mut self.system, &self.state.u);
            // Energies of the new state are those of its own faces.
            self.system.forces.begin_step(&self.state.u, Moment::at(self.state.time), self.substep_dt);
        }
    }

    /// Returns true if the size of steps follows an estimate of their error.
    fn is_adaptive(&self) -> bool {
        self.control.is_some() && self.kind.estimates_error()
    }

    /// Updates the Dirichlet conditions that apply in a step from this time, s. Returns whether they have changed.
    fn apply_conditions_at(&mut self, time: f64) -> bool {
        // Times are sums of steps, so the time of the release may be wrong by a rounding error.
        self.system.apply_conditions_at(time + ROUNDING * self.substep_dt)
    }
}

/// Part of a time step by which the time of a step may be rounded.
const ROUNDING: f64 = 1e-6;

/// The velocities of the mesh's nodes in the engine's numbering, zero at constrained degrees of freedom, m/s.
fn initial_velocity<T: Real>(of_mesh: &[Vector3<f64>], system: &System<T>) -> Vec<[T; 3]> {
    if of_mesh.is_empty() {
        return Vec::new();
    }
    let of_node = |&node: &u32| -> [f64; 3] { of_mesh[node as usize].into() };
    let mut velocities: Vec<[T; 3]> = system.numbering.mesh_node.iter().map(|node| of_node(node).map(T::of)).collect();
    system.dirichlet.clear_constrained(&mut velocities);
    velocities
}
