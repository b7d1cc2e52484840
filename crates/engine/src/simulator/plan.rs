//! Plans the parts of a simulation from its body and its method, before they are built: the parts, those left out, and the reasons.

use fem_model::simulation::Part;
use fem_model::{
    Body, CONSISTENT_MASS, ContactTreatment, Integrator as IntegratorKind, Material, Method, Precision, Projection,
};

use crate::forces::{self, Potential, contact};
use crate::simulator::device_assembly;
use fem_elements::plasticity;
use fem_solvers::{Real, SolverChoice};

/// Bytes, uses and seconds, which only a simulation knows.
const NO_COST: (usize, f64) = (0, 0.0);

/// The facts about a body that decide on its parts.
pub(super) struct Plan {
    nodes: usize,
    elements: usize,
    kind: &'static str,
    materials: String,
    has_lumped_mass: bool,
    is_mass_spring: bool,
    /// Description of the plastic flow.
    plasticity: Option<String>,
    /// Number of nodes of `[fixed]`, and the time until which they are, s.
    fixed: Option<(usize, Option<f64>)>,
    has_motion: bool,
    is_unconstrained: bool,
    /// Key and description of each force.
    forces: Vec<(&'static str, String)>,
    is_damped: bool,
    has_drag: bool,
    has_display: bool,
    /// Reason why a graphics device cannot assemble the elements; `None` if it can.
    unknown_on_device: Option<String>,
}

impl Plan {
    /// The plan of a body without forces beside its own elasticity.
    pub(super) fn new(body: &Body) -> Self {
        let fixed = body.dirichlet.iter().find(|condition| condition.motion.is_none());
        Self {
            nodes: body.shape.mesh.vertices().len(),
            elements: body.shape.mesh.elements(),
            kind: body.shape.mesh.element().name,
            materials: materials(body),
            has_lumped_mass: body.lumped_mass,
            is_mass_spring: body.material.is_mass_spring(),
            plasticity: body.plasticity.as_ref().map(plasticity::description),
            fixed: fixed.map(|condition| (condition.nodes.len(), condition.until)),
            has_motion: body.dirichlet.iter().any(|condition| condition.motion.is_some()),
            is_unconstrained: body.dirichlet.is_empty(),
            forces: impulses(body),
            is_damped: body.damping.is_some(),
            has_drag: body.drag.is_some(),
            has_display: body.shape.display.is_some(),
            unknown_on_device: device_assembly::unknown_in_body(body),
        }
    }

    /// Adds forces to the plan.
    pub(super) fn add_forces<'a, T: Real>(&mut self, forces: impl Iterator<Item = &'a dyn Potential<T>>) {
        self.forces.extend(forces.map(|force| (force.name(), force.description())));
    }

    /// Every part that the engine can have. `is_linear` tells whether one linear solve finds equilibrium.
    pub(super) fn parts(
        &self,
        kind: IntegratorKind,
        method: &Method,
        solver: SolverChoice,
        is_linear: bool,
    ) -> Vec<Part> {
        let mut parts = self.body(kind, method.precision).to_vec();
        parts.extend(self.constraints());
        parts.extend(self.forces());
        // The arc-length method does not minimise an energy.
        let is_minimized = !(kind == IntegratorKind::Static && (is_linear || method.arc_length));
        let assembly = self.assembly(kind, method, solver, is_linear);
        parts.extend(of_method(kind, method.newton.projection, solver, is_minimized, &assembly));
        parts.push(Part::skinning(self.has_display.then_some(0), NO_COST));
        parts.push(if self.is_unconstrained {
            Part::left_out("reactions", "the body is unconstrained")
        } else {
            built("reactions", "forces of the constraints, on request")
        });
        parts
    }

    /// Says which method needs the matrix, and whether the processor or the graphics device assembles it.
    fn assembly(&self, kind: IntegratorKind, method: &Method, solver: SolverChoice, is_linear: bool) -> String {
        let solves = format!("{} solves with it", kind.name());
        let other_method = device_assembly::other_method(kind, method, is_linear);
        match (solver, self.unknown_on_device.as_deref().or(other_method)) {
            (SolverChoice::Gpu(_), None) => format!("{solves}; the graphics device assembles it"),
            (SolverChoice::Gpu(_), Some(why)) => format!("{solves}; the processor assembles it: {why}"),
            _ => solves,
        }
    }

    /// Parts of the body itself.
    fn body(&self, kind: IntegratorKind, precision: Precision) -> [Part; 6] {
        let number = match precision {
            Precision::F64 => "f64",
            Precision::F32 => "f32",
        };
        [
            Part::mesh(self.nodes, self.elements, self.kind, 0),
            built("material", &self.materials),
            match &self.plasticity {
                Some(description) => built("plasticity", description),
                None => left_out_without("plasticity", "[plasticity]"),
            },
            built("state", format!("displacements and velocities in {number}")),
            built("mass", mass(self.has_lumped_mass, kind)),
            if self.is_mass_spring {
                Part::left_out("forces", "no element is elastic: material.model is \"mass_spring\"")
            } else {
                built("forces", "elastic forces, where no energy is needed")
            },
        ]
    }

    fn constraints(&self) -> [Part; 2] {
        let fixed = match self.fixed {
            Some((nodes, Some(until))) => {
                let why = format!("[fixed]: {nodes} nodes, free from {until} s on, keep their rows in the matrix");
                built("fixed", why)
            }
            Some((nodes, None)) => built("fixed", format!("[fixed]: {nodes} nodes have no row in any matrix")),
            None => left_out_without("fixed", "[fixed]"),
        };
        let prescribed = if self.has_motion {
            built("prescribed", "[[prescribed]]: nodes follow a given motion")
        } else {
            left_out_without("prescribed", "[[prescribed]]")
        };
        [fixed, prescribed]
    }

    fn forces(&self) -> Vec<Part> {
        let mut parts: Vec<Part> = self.forces.iter().map(|(name, description)| built(name, description)).collect();
        for kind in forces::kinds::<f64>() {
            if parts.iter().all(|part| part.name != kind.name) {
                parts.push(left_out_without(kind.name, kind.tables));
            }
        }
        parts.push(if self.is_damped {
            built("damping", "[damping]: α M + β K in force and stiffness")
        } else {
            left_out_without("damping", "[damping]")
        });
        parts.push(Part::drag(self.has_drag, true, NO_COST));
        parts
    }
}

/// Contact of explicit methods, whose impulses are no forces of the system.
fn impulses(body: &Body) -> Vec<(&'static str, String)> {
    let contact = body.contact.iter().find(|contact| contact.treatment == ContactTreatment::Impulses);
    let Some(contact) = contact else { return Vec::new() };
    let description = format!("[[planes]]: {}, with impulses at the end of each step", contact.planes.len());
    let mut parts = vec![(contact::NAME, description)];
    if contact.planes.iter().any(|plane| plane.friction > 0.0) {
        let description = "[[planes]] with friction: Coulomb's bound on the impulses";
        parts.push((contact::friction::NAME, description.to_owned()));
    }
    parts
}

/// The laws of all materials, the body's own first.
fn materials(body: &Body) -> String {
    let regions = body.regions.iter().map(|region| {
        format!("; {}: {} elements of {}", region.name, region.elements.len(), material(&region.material))
    });
    std::iter::once(material(&body.material)).chain(regions).collect()
}

/// The law and its parameters, with a warning where linear elements lock.
fn material(material: &Material) -> String {
    let note = if material.locks() {
        "; linear elements lock so close to ν = ½: displacements come out far too small"
    } else {
        ""
    };
    let parameter = |(name, value)| match name {
        "young" => format!(", E = {value:.4e} Pa"),
        "poisson" => format!(", ν = {value}"),
        "stiffness" => format!(", {name} = {value:.4e} N/m"),
        "damping" => format!(", {name} = {value:.4e} N s/m"),
        _ => format!(", {name} = {value:.4e} Pa"),
    };
    let parameters: String = material.law.parameters().into_iter().map(parameter).collect();
    format!("{}{parameters}{note}", material.law.name())
}

fn mass(is_lumped: bool, kind: IntegratorKind) -> String {
    if is_lumped && kind.needs_node_masses() {
        return format!("lumped at the nodes: {} moves them one by one", kind.name());
    }
    if is_lumped {
        return format!(
            "lumped at the nodes: [mass], or an explicit method and more than {CONSISTENT_MASS} nodes or [[planes]]"
        );
    }
    let cost =
        if kind.is_explicit() { "; each evaluation solves with it, where mass.lumped = true divides" } else { "" };
    format!("consistent: couples the nodes of each element{cost}")
}

/// Parts of the time integration method.
fn of_method(
    kind: IntegratorKind,
    projection: Projection,
    choice: SolverChoice,
    is_minimized: bool,
    assembly: &str,
) -> Vec<Part> {
    let name = kind.name();
    let has_matrix = kind.has_matrix();
    let has_line_search = kind.has_newton() && is_minimized;
    let mut parts: Vec<Part> = if has_matrix {
        solver(assembly, choice).into()
    } else {
        ["stiffness", "solver", "preconditioner"].map(|part| Part::left_out(part, needs_no(name, "matrix"))).into()
    };
    parts.push(if !has_matrix || !is_minimized {
        Part::left_out("projection", format!("{name} does without"))
    } else if projection == Projection::Never {
        Part::left_out("projection", "newton.projection is \"never\"")
    } else {
        built("projection", "elements, where the matrix would not be positive definite")
    });
    parts.push(if has_line_search {
        built("line_search", "Newton's method decreases an energy along each direction")
    } else {
        Part::left_out("line_search", needs_no(name, "energy"))
    });
    parts
}

/// Parts of the linear solver. A factor belongs to the solver; a preconditioner is a part of its own.
fn solver(assembly: &str, choice: SolverChoice) -> [Part; 3] {
    let preconditioner = if choice.has_preconditioner() {
        built("preconditioner", "[solver] with kind \"pcg\", or a body of many nodes")
    } else {
        Part::left_out("preconditioner", format!("the solver is {choice}"))
    };
    [built("stiffness", assembly), built("solver", choice.to_string()), preconditioner]
}

fn built(name: &'static str, why: impl Into<String>) -> Part {
    Part::built(name, why, 0, NO_COST)
}

fn left_out_without(name: &'static str, table: &str) -> Part {
    Part::left_out(name, format!("the scene has no {table}"))
}

fn needs_no(method: &str, thing: &str) -> String {
    format!("{method} needs no {thing}")
}
