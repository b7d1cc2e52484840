//! The bodies and methods of this study.

use std::sync::Arc;

use fem_engine::simulator::{Compiled, Simulator};
use fem_mesh::{MeshError, Pattern, TetrahedralMesh, box_mesh, rectangle_mesh};
use fem_model::{
    Axis, Body, BodyMesh, Damping, DampingForm, Family, Integrator, IterationSettings, LoadCurve, Material, Method,
    Motion, Refusal, Region, Rotation, Selector,
};
use nalgebra::Vector3;

use super::case::{Case, Finding, Outcome, SMALLEST_J};
use super::march::march;
use crate::scenes;
use crate::study::{Deadline, Result};
use fem_reference::{Elements, LINEAR};

/// The integrators in time that are not iterated.
pub fn dynamic() -> impl Iterator<Item = Integrator> {
    let is_dynamic = |of: &Integrator| !of.is_iterated() && of.facts().family != Family::Equilibrium;
    Integrator::ALL.into_iter().filter(is_dynamic)
}

/// The iterated methods.
pub fn iterated() -> impl Iterator<Item = Integrator> {
    Integrator::ALL.into_iter().filter(|of| of.is_iterated())
}

/// The materials.
pub const LAWS: [&str; 5] = ["linear", "corotated", "st_venant_kirchhoff", "neo_hookean", "stable_neo_hookean"];

/// The law with an energy barrier at J = 0, and the one without.
pub const NEO_HOOKEAN: [&str; 2] = ["neo_hookean", "stable_neo_hookean"];

/// Size, m, and cells per metre of a solid or a flat body, cut in Kuhn's pattern.
#[derive(Clone, Copy, Debug)]
pub enum Grid {
    /// A box.
    Solid([f64; 3], usize),
    /// A rectangle of 1 m thickness.
    Flat([f64; 2], usize),
}

impl Grid {
    fn mesh(self) -> Result<BodyMesh, MeshError> {
        Ok(match self {
            Self::Solid(size, cells) => box_mesh(size, cells, Pattern::Kuhn)?.into(),
            Self::Flat(size, cells) => BodyMesh::flat(rectangle_mesh(size, cells, Pattern::Kuhn)?, 1.0),
        })
    }
}

/// A load or a condition of a body that moves by a method.
pub type Condition = Arc<dyn Fn(Body, &Method) -> Result<Body, Refusal> + Send + Sync>;

/// A setting of a method.
pub type Setting = Arc<dyn Fn(&mut Method) + Send + Sync>;

/// A body and a method.
#[derive(Clone)]
pub struct Setup {
    /// The mesh.
    pub grid: Grid,
    /// The elements.
    pub elements: Elements,
    /// The name of the law.
    pub law: &'static str,
    /// Pa
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// kg/m³
    pub density: f64,
    /// The integrator.
    pub integrator: Integrator,
    /// s
    pub dt: f64,
    /// Loads and conditions, in their order.
    pub conditions: Vec<Condition>,
    /// Changes of the method.
    pub settings: Vec<Setting>,
}

/// Runs a case with its setup.
type Work = Box<dyn FnOnce(&Setup, Deadline) -> Result<Finding, Finding> + Send>;

impl Setup {
    /// A box of 2 × 1 × 1 m of soft rubber, with cells of 1 m.
    pub fn small(integrator: Integrator, law: &'static str) -> Self {
        Self {
            grid: Grid::Solid([2.0, 1.0, 1.0], 1),
            elements: LINEAR,
            law,
            young: 1e5,
            poisson: 0.3,
            density: 1000.0,
            integrator,
            dt: 0.01,
            conditions: Vec::new(),
            settings: Vec::new(),
        }
    }

    /// The same box with cells of 0.5 m.
    pub fn finer(integrator: Integrator, law: &'static str) -> Self {
        Self { grid: Grid::Solid([2.0, 1.0, 1.0], 2), ..Self::small(integrator, law) }
    }

    /// Adds a load or a condition.
    pub fn with(mut self, condition: impl Fn(Body, &Method) -> Result<Body, Refusal> + Send + Sync + 'static) -> Self {
        self.conditions.push(Arc::new(condition));
        self
    }

    /// Adds one where it is wanted.
    pub fn with_if(
        self,
        is_wanted: bool,
        condition: impl Fn(Body, &Method) -> Result<Body, Refusal> + Send + Sync + 'static,
    ) -> Self {
        if is_wanted { self.with(condition) } else { self }
    }

    /// Changes the method.
    pub fn set(mut self, setting: impl Fn(&mut Method) + Send + Sync + 'static) -> Self {
        self.settings.push(Arc::new(setting));
        self
    }

    /// Sets the tolerance of Newton's method, if the integrator has one.
    pub fn newton(self, tolerance: f64) -> Self {
        if self.integrator.has_newton() {
            self.set(move |method| method.newton.tolerance = Some(tolerance))
        } else {
            self
        }
    }

    /// Sets the number of load steps of `static`.
    pub fn load_steps(self, count: usize) -> Self {
        if self.integrator == Integrator::Static { self.set(move |method| method.load_steps = count) } else { self }
    }

    /// Sets the number of iterations of iterated methods.
    pub fn iterations(self, count: usize) -> Self {
        self.set(move |method| method.iterations = IterationSettings { count, ..method.iterations })
    }

    /// A case of this setup. It is expected to survive with J > 0; override the other fields with `..`.
    pub fn case(
        self,
        family: &'static str,
        case: impl Into<String>,
        parameters: String,
        work: impl FnOnce(&Self, Deadline) -> Result<Finding, Finding> + Send + 'static,
    ) -> Case {
        self.case_of(family, case.into(), parameters, Box::new(work))
    }

    fn case_of(self, family: &'static str, case: String, parameters: String, work: Work) -> Case {
        let parameters = match self.elements {
            LINEAR => parameters,
            elements => format!("{parameters}, {elements}"),
        };
        Case {
            family,
            case,
            parameters,
            integrator: self.integrator.name().to_owned(),
            material: self.law.to_owned(),
            expected: Outcome::Survives,
            margin_is: SMALLEST_J,
            seed: None,
            work: Box::new(move |deadline| work(&self, deadline).unwrap_or_else(|finding| finding)),
        }
    }

    /// A case that survives a number of steps.
    pub fn surviving(self, family: &'static str, case: impl Into<String>, parameters: String, steps: usize) -> Case {
        self.case(family, case, parameters, move |setup, deadline| {
            Ok(march(&mut setup.build()?, steps, deadline).survival())
        })
    }

    /// A case that survives a number of steps, in which elements may invert.
    pub fn enduring(self, family: &'static str, case: impl Into<String>, parameters: String, steps: usize) -> Case {
        self.case(family, case, parameters, move |setup, deadline| {
            Ok(march(&mut setup.build()?, steps, deadline).endurance())
        })
    }

    /// The method.
    pub fn method(&self) -> Method {
        let mut method = Method::new(self.integrator, self.dt);
        self.settings.iter().for_each(|setting| setting(&mut method));
        method
    }

    /// The body on a mesh of linear elements.
    fn body_on(&self, mesh: BodyMesh) -> Result<Body> {
        let mesh = mesh.of_order(self.elements.order).ok_or("there is no such element")?;
        let material = scenes::material(self.law, self.young, self.poisson, self.density)?;
        let body = Body::new(mesh, Material { volumetric: self.elements.volumetric, ..material })?;
        let method = self.method();
        let body = self.conditions.iter().try_fold(body, |body, condition| condition(body, &method))?;
        Ok(if body.lumped_mass { body } else { body.lump_mass_for(&method) })
    }

    /// The body.
    pub fn body(&self) -> Result<Body, Finding> {
        self.grid.mesh().map_err(|error| error.into()).and_then(|mesh| self.body_on(mesh)).map_err(refused)
    }

    /// The simulation, at rest.
    pub fn build(&self) -> Result<Simulator<f64>, Finding> {
        Simulator::new(self.body()?, &self.method()).map_err(refused)
    }

    /// The simulation on another mesh, in a precision that the method names too.
    pub fn build_on<T: Compiled>(&self, mesh: TetrahedralMesh) -> Result<Simulator<T>, Finding> {
        Simulator::new(self.body_on(mesh.into()).map_err(refused)?, &self.method()).map_err(refused)
    }
}

/// The finding for a refused setup.
pub fn refused(problem: impl ToString) -> Finding {
    Finding::plain(Outcome::Refused, problem.to_string())
}

/// Fixes the face of smallest x.
pub fn clamp(body: Body, _: &Method) -> Result<Body, Refusal> {
    body.fix(&Selector::least(Axis::X))
}

/// Fixes the nodes within a distance, m, of the smallest x.
pub fn clamp_within(below: f64) -> impl Fn(Body, &Method) -> Result<Body, Refusal> {
    move |body, _| body.fix(&Selector::Region(Region::Plane { axis: Axis::X, below }))
}

/// Lumps the mass.
pub fn lump(body: Body, _: &Method) -> Result<Body, Refusal> {
    Ok(Body { lumped_mass: true, ..body })
}

/// Light mass-proportional damping, so that bodies come to rest within the run.
pub fn damp(body: Body, _: &Method) -> Result<Body, Refusal> {
    body.damping(Damping { alpha: 0.2, beta: 0.0, form: DampingForm::default() })
}

/// Gravity, m/s².
pub fn gravity(acceleration: [f64; 3]) -> impl Fn(Body, &Method) -> Result<Body, Refusal> {
    move |body, _| body.gravity(acceleration)
}

/// A motion of the end of largest x, with its name.
pub type EndMotion = (&'static str, fn() -> Motion);

/// Prescribes a motion of all nodes of the face of largest x within a time, s, or within the load steps of `static`.
pub fn prescribed_end(motion: Motion, over: f64) -> impl Fn(Body, &Method) -> Result<Body, Refusal> {
    move |body, method| {
        let curve = (method.integrator != Integrator::Static).then_some(LoadCurve::Ramp(over));
        body.prescribe(&Selector::most(Axis::X), [true; 3], Motion { curve, ..motion.clone() })
    }
}

/// Full turns about an axis along x through a point, m.
pub fn turned(center: [f64; 3], turns: f64) -> Motion {
    let rotation = Rotation { axis: Vector3::x_axis(), center: center.into(), turns };
    Motion { rotation: Some(rotation), ..Motion::by([0.0; 3]) }
}

/// The mesh of a box with transformed vertices.
pub fn moved_box(
    size: [f64; 3],
    cells_per_unit: usize,
    place: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> Result<TetrahedralMesh, Finding> {
    let mut mesh = box_mesh(size, cells_per_unit, Pattern::Kuhn).map_err(refused)?;
    mesh.vertices.iter_mut().for_each(|vertex| *vertex = place(vertex));
    Ok(mesh)
}
