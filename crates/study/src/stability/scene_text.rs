//! Scenes of this study as the text of scene files, so that every row can be reproduced.

use fem_model::{Body, BodyMesh, Family, Integrator};
use nalgebra::Vector3;

use super::case::{Case, Finding, Outcome, SMALLEST_J};
use super::march::march;
use crate::scenes::{Elements, LINEAR, scene_and_body, simulator};
use crate::study::Deadline;

use fem_engine::simulator::{Compiled, Simulator};
use fem_mesh::TetrahedralMesh;
use fem_scene::{Scene, SceneError};

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

/// The parts of a scene file.
#[derive(Clone, Debug)]
pub struct SceneText {
    /// Contents of `[mesh]`.
    pub mesh: String,
    /// The elements.
    pub elements: Elements,
    /// The material.
    pub model: &'static str,
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
    /// Further tables.
    pub rest: String,
}

/// Fixes the face of smallest x.
pub const CLAMPED: &str = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";

/// Lumped mass.
pub const LUMPED: &str = "[mass]\nlumped = true\n";

impl SceneText {
    /// A box of 2 × 1 × 1 m of soft rubber, with cells of 1 m.
    pub fn small(integrator: Integrator, model: &'static str) -> Self {
        Self {
            mesh: "box = { size = [2, 1, 1], pattern = \"kuhn\", cells_per_unit = 1 }".to_owned(),
            elements: LINEAR,
            model,
            young: 1e5,
            poisson: 0.3,
            density: 1000.0,
            integrator,
            dt: 0.01,
            rest: String::new(),
        }
    }

    /// The same box with cells of 0.5 m.
    pub fn finer(integrator: Integrator, model: &'static str) -> Self {
        let mesh = "box = { size = [2, 1, 1], pattern = \"kuhn\", cells_per_unit = 2 }".to_owned();
        Self { mesh, ..Self::small(integrator, model) }
    }

    /// Adds tables.
    pub fn with(mut self, tables: &str) -> Self {
        self.rest.push_str(tables);
        self
    }

    /// The text of the file.
    pub fn text(&self) -> String {
        let Self { mesh, elements, model, young, poisson, density, integrator, dt, rest } = self;
        let [order, volumetric] = elements.keys();
        // Springs have the ratio of their directions.
        let poisson = if *model == "mass_spring" { String::new() } else { format!("poisson = {poisson}\n") };
        format!(
            "pipeline = \"engine\"\n[mesh]\n{mesh}\n{order}[material]\nmodel = \"{model}\"\nyoung = {young:e}\n{poisson}{volumetric}\
             density = {density:e}\n[time]\ndt = {dt:e}\nintegrator = \"{}\"\n{rest}",
            integrator.name()
        )
    }

    /// A case of this scene. It is expected to survive with J > 0; override the other fields with `..`.
    pub fn case(
        &self,
        family: &'static str,
        case: impl Into<String>,
        parameters: String,
        work: impl FnOnce(Deadline) -> Result<Finding, Finding> + Send + 'static,
    ) -> Case {
        let parameters = match self.elements {
            LINEAR => parameters,
            elements => format!("{parameters}, {elements}"),
        };
        Case {
            family,
            case: case.into(),
            parameters,
            integrator: self.integrator.name().to_owned(),
            material: self.model.to_owned(),
            expected: Outcome::Survives,
            margin_is: SMALLEST_J,
            seed: None,
            work: Box::new(move |deadline| work(deadline).unwrap_or_else(|finding| finding)),
        }
    }

    /// A case that survives a number of steps.
    pub fn surviving(self, family: &'static str, case: impl Into<String>, parameters: String, steps: usize) -> Case {
        let text = self.clone();
        self.case(family, case, parameters, move |deadline| Ok(march(&mut text.build()?, steps, deadline).survival()))
    }

    /// The simulation of the scene, at rest.
    pub fn build(&self) -> Result<Simulator<f64>, Finding> {
        simulator(&self.text(), None).map_err(refused)
    }

    /// The simulation on another mesh.
    pub fn build_on(&self, mesh: TetrahedralMesh) -> Result<Simulator<f64>, Finding> {
        self.build_on_as(mesh)
    }

    /// The simulation on another mesh in a precision, which the scene must name too.
    pub fn build_on_as<T: Compiled>(&self, mesh: TetrahedralMesh) -> Result<Simulator<T>, Finding> {
        let mesh = BodyMesh::from(mesh).of_order(self.elements.order);
        simulator(&self.text(), mesh).map_err(refused)
    }

    /// The scene and its body.
    pub fn scene_and_body(&self) -> Result<(Scene, Body), Finding> {
        scene_and_body(&self.text(), None).map_err(refused)
    }
}

/// Light mass-proportional damping, so that bodies come to rest within the run.
pub const DAMPED: &str = "[damping]\nalpha = 0.2\n";

/// The finding for a refused scene.
pub fn refused(error: SceneError) -> Finding {
    Finding::plain(Outcome::Refused, error.to_string())
}

/// `[gravity]`, m/s².
pub fn gravity(acceleration: [f64; 3]) -> String {
    format!("[gravity]\nacceleration = {acceleration:?}\n")
}

/// `[[prescribed]]` for all nodes of the face of largest x.
pub fn prescribed_end(motion: &str, over: f64) -> String {
    format!("[[prescribed]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\n{motion}\nover = {over:e}\n")
}

/// The mesh of a box with transformed vertices.
pub fn moved_box(
    size: [f64; 3],
    cells_per_unit: usize,
    place: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> Result<TetrahedralMesh, Finding> {
    let mesh = fem_mesh::box_mesh(size, cells_per_unit, fem_mesh::Pattern::Kuhn);
    let mut mesh = mesh.map_err(|error| Finding::plain(Outcome::Refused, error.to_string()))?;
    for vertex in &mut mesh.vertices {
        *vertex = place(vertex);
    }
    Ok(mesh)
}
