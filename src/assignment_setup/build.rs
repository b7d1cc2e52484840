//! Builds a simulation at rest from a scene.

use std::cell::RefCell;
use std::sync::Arc;

use fem_model::{Body, Integrator, Interaction, Law, Precision};
use fem_scene::{Pipeline, Scene, SceneError};
use nalgebra::{DVector, Vector3};

use super::constraints::{Constraints, stack};
use super::{AssignmentSetup, Profile};
use crate::given::{Solver, volumes};
use crate::{build_skinning_matrix, dphi_linear_tetrahedron_dX, mass_matrix_mesh};

/// The integrators that the course has.
pub(super) const INTEGRATORS: [Integrator; 2] = [Integrator::LinearlyImplicitEuler, Integrator::ImplicitEuler];

impl AssignmentSetup {
    /// Builds the parts that the scene names. Returns an error for what only the engine can do.
    pub fn new(scene: &Scene, body: Body) -> Result<Self, SceneError> {
        check_pipeline(scene)?;
        if body.shape.mesh.dimension() == 2 {
            return Err(
                scene.refuse("mesh", "is flat, which the course's pipeline is not; write pipeline = \"engine\"")
            );
        }
        let Law::NeoHookean(law) = body.material.law else {
            return Err(scene.refuse("material.model", "is not one that the course has; write \"neo_hookean\""));
        };
        let [C, D] = law.moduli();
        let (V, T) = (body.shape.mesh.vertices(), body.shape.mesh.tetrahedra());
        let constraints = Constraints::new(V, body.fixed_nodes());
        let q = constraints.free_coordinates(stack(V));
        let skinning = body.shape.display.as_ref().map(|display| build_skinning_matrix(V, T, &display.vertices));

        let mut setup = Self {
            name: body.name,
            v0: volumes(V, T),
            C,
            D,
            density: scene.material.density,
            gravity: body.gravity.map(|g| (g.try_normalize(0.0).unwrap_or_default(), g.norm())),
            M: mass_matrix_mesh(0, &[], 0.0, &[]),
            M_nonzero: mass_matrix_mesh(0, &[], 0.0, &[]),
            weight: DVector::zeros(0),
            constraints,
            skinning,
            interaction: Interaction::new(body.drag, C * extent(V)),
            has_springs_in_stiffness: scene.drag.as_ref().is_none_or(|drag| drag.in_stiffness == Some(true)),
            reuse_distance: REUSE * smallest_height(V, T),
            integrator: scene.time.integrator,
            dt: scene.time.dt(),
            time: 0.0,
            steps_since_reset: 0,
            qdot: DVector::zeros(q.len()),
            q,
            solver: RefCell::new(Solver::default()),
            profile: Profile::default(),
            shape: Arc::new(body.shape),
        };
        setup.weigh();
        Ok(setup)
    }

    /// Computes mass and weight; again when density or gravity has changed.
    pub(super) fn weigh(&mut self) {
        let mesh = &self.shape.mesh;
        let q_size = 3 * mesh.vertices().len();
        let M = mass_matrix_mesh(q_size, mesh.tetrahedra(), self.density, &self.v0);
        self.weight = match self.gravity {
            Some((direction, size)) => &M * DVector::from_fn(q_size, |i, _| direction[i % 3] * size),
            None => DVector::zeros(0),
        };
        self.M = self.constraints.free_block(M);
        self.M_nonzero = self.M.filter(|_, _, entry| *entry != 0.0);
    }
}

/// Part of the smallest element's height by which a coordinate may move before the stiffness is assembled again. Few elements are
/// strained by that much then, and projection makes Newton's directions worse than an older stiffness does.
const REUSE: f64 = 0.1;

/// The smallest height of all elements, m: one over the longest gradient of a shape function.
fn smallest_height(V: &[Vector3<f64>], T: &[[usize; 4]]) -> f64 {
    let gradients = T.iter().map(|element| dphi_linear_tetrahedron_dX(V, element, &V[element[0]]));
    let longest = gradients.map(|dphi| dphi.row_iter().map(|row| row.norm()).fold(0.0, f64::max)).fold(0.0, f64::max);
    1.0 / longest
}

/// Longest edge of the bounding box, m.
pub(super) fn extent(V: &[Vector3<f64>]) -> f64 {
    let (least, most) = V.iter().fold((V[0], V[0]), |(least, most), x| (least.inf(x), most.sup(x)));
    (most - least).max()
}

fn check_pipeline(scene: &Scene) -> Result<(), SceneError> {
    if scene.pipeline != Pipeline::Course {
        return Err(
            scene.refuse("pipeline", "is \"engine\", and these are the functions of the course; write \"course\"")
        );
    }
    if !INTEGRATORS.contains(&scene.time.integrator) {
        let names = INTEGRATORS.map(Integrator::name).join(" or ");
        let problem = format!("is {}, which the course does not have; use {names}", scene.time.integrator.name());
        return Err(scene.refuse("time.integrator", &problem));
    }
    let has_curve = scene.gravity.as_ref().is_some_and(|gravity| gravity.curve.is_some());
    let engine_only = [
        ("gravity.curve", has_curve),
        ("fixed.until", scene.fixed.as_ref().is_some_and(|fixed| fixed.until.is_some())),
        ("mesh.refine", scene.mesh.refine > 0),
        ("time.precision", scene.time.precision != Precision::F64),
        ("time.substeps", scene.time.substeps.is_some()),
        ("time.adaptive", scene.time.adaptive.is_some()),
        ("materials", !scene.materials.is_empty()),
        ("plasticity", scene.plasticity.is_some()),
        ("fibres", !scene.fibres.is_empty()),
        ("newton", scene.newton.is_some()),
        ("energy", scene.energy.is_some()),
        ("solver", scene.solver.is_some()),
        ("mass.lumped", scene.mass.lumped == Some(true)),
        ("damping", scene.damping.is_some()),
        ("static", scene.statics.is_some()),
        ("newmark", scene.newmark.is_some()),
        ("iterations", scene.iterations.is_some()),
        ("generalized_alpha", scene.generalized_alpha.is_some()),
        ("body_force", scene.body_force.is_some()),
        ("traction", !scene.traction.is_empty()),
        ("force", !scene.force.is_empty()),
        ("springs", !scene.springs.is_empty()),
        ("planes", !scene.planes.is_empty()),
        ("contact", scene.contact.is_some()),
        ("prescribed", !scene.prescribed.is_empty()),
        ("initial_velocity", !scene.initial_velocity.is_empty()),
    ];
    let field = scene.fields().tables().next();
    match engine_only.iter().find(|(_, present)| *present).map(|(field, _)| *field).or(field) {
        Some(field) => Err(scene.refuse(field, "belongs to the engine; the course's pipeline does without, remove it")),
        None => Ok(()),
    }
}
