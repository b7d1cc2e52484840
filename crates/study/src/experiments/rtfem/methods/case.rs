//! A body with its material and time step, and the motions that all methods are measured by.

use fem_model::simulation::Simulation;
use fem_model::{BodyMesh, Integrator};
use nalgebra::DVector;

use super::bodies::Shape;
use crate::reference::{Equations, reference};
use crate::scenes::{REPLACED, REPLACED_FLAT, scene_and_body, simulation};

/// Density, kg/m³, and gravity, m/s².
pub const DENSITY: f64 = 1000.0;
pub const GRAVITY: f64 = 9.81;

/// The law of all elements; that of the springs' name for the same bodies of springs.
pub const LAW: &str = "corotated";
pub const SPRINGS: &str = "mass_spring";

/// Longest time of a reference, s.
const PATIENCE: f64 = 60.0;

/// A body that bends under its weight from rest.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its shape, and its cells across.
    pub shape: Shape,
    pub cells: usize,
    /// Young's modulus (Pa), Poisson's ratio.
    pub young: f64,
    pub poisson: f64,
    /// Steps of a second, and of the run.
    pub rate: usize,
    pub steps: usize,
}

impl Case {
    /// The case in words.
    pub fn name(&self) -> String {
        format!("{}, E = {:e} Pa, ν = {:.4}, dt = 1/{} s", self.shape.name(), self.young, self.poisson, self.rate)
    }

    /// Cells of tables: the body, E, ν, dt.
    pub fn cells(&self) -> [String; 4] {
        let poisson = format!("{:.4}", self.poisson);
        [self.shape.name().to_owned(), format!("{:e}", self.young), poisson, format!("1/{}", self.rate)]
    }

    /// The scene of a model with an integrator and its tables, and the mesh.
    pub fn scene(&self, model: &str, integrator: Integrator, tables: &str) -> (String, BodyMesh) {
        let (mesh, clamp) = self.shape.mesh(self.cells);
        let Self { young, poisson, rate, .. } = self;
        let poisson = if model == SPRINGS { String::new() } else { format!("poisson = {poisson}\n") };
        let (shape, plane, down) = match (self.shape, model) {
            (Shape::Beam, _) => (REPLACED, "", [0.0, 0.0, -GRAVITY]),
            (Shape::Strip, SPRINGS) => (REPLACED_FLAT, "", [0.0, -GRAVITY, 0.0]),
            (Shape::Strip, _) => (REPLACED_FLAT, "plane = \"stress\"\n", [0.0, -GRAVITY, 0.0]),
        };
        let text = format!(
            "pipeline = \"engine\"\n[mesh]\n{shape}\n[material]\nmodel = \"{model}\"\nyoung = {young:e}\n{poisson}{plane}\
             density = {DENSITY}\n[mass]\nlumped = true\n[gravity]\nacceleration = {down:?}\n[fixed]\nplane = {{ axis = \"x\", below = {clamp:e} }}\n\
             {tables}[time]\ndt = {:e}\nintegrator = \"{}\"\n",
            1.0 / *rate as f64,
            integrator.name()
        );
        (text, mesh)
    }

    /// The simulation of a model.
    ///
    /// # Errors
    /// A scene that the engine refuses.
    pub fn simulation(&self, model: &str, integrator: Integrator, tables: &str) -> Result<Box<dyn Simulation>, String> {
        let (text, mesh) = self.scene(model, integrator, tables);
        simulation(&text, mesh)
    }

    /// Undeformed positions, m.
    fn undeformed(&self) -> DVector<f64> {
        let mesh = self.shape.mesh(self.cells).0;
        DVector::from_iterator(3 * mesh.vertices().len(), mesh.vertices().iter().flat_map(|x| x.iter().copied()))
    }

    /// Positions at the end of the equations of motion of a model, integrated to round-off, m.
    fn exact(&self, model: &str) -> Result<DVector<f64>, String> {
        let (text, mesh) = self.scene(model, Integrator::Verlet, "");
        let (_, body) = scene_and_body(&text, Some(mesh)).map_err(|error| error.to_string())?;
        let equations = Equations::new(body)?;
        Ok(reference(&equations, self.steps as f64 / self.rate as f64, PATIENCE)?.q)
    }

    /// The motions that the errors of this case are distances from.
    ///
    /// # Errors
    /// A converged motion that fails, or a reference that does not converge.
    pub fn measures(&self) -> Result<Measures, String> {
        let named = |error: String| format!("{}: {error}", self.name());
        let mut simulation =
            self.simulation(LAW, Integrator::ImplicitEuler, "[newton]\ntolerance = 1e-14\n").map_err(named)?;
        for _ in 0..self.steps {
            simulation.step().map_err(|failure| named(failure.to_string()))?;
        }
        Ok(Measures {
            rest: self.undeformed(),
            converged: simulation.positions(),
            exact: self.exact(LAW).map_err(named)?,
            springs: self.exact(SPRINGS).map_err(named)?,
        })
    }
}

/// Motions at the end of a run, positions in m.
pub struct Measures {
    rest: DVector<f64>,
    /// Implicit Euler with Newton's method to round-off, at the time step of the case.
    converged: DVector<f64>,
    /// The equations of motion of the elements, and of springs in their place.
    exact: DVector<f64>,
    springs: DVector<f64>,
}

impl Measures {
    /// Distance of an end from the converged steps of implicit Euler, over their largest displacement.
    pub fn solver_error(&self, end: &DVector<f64>) -> f64 {
        distance(end, &self.converged) / distance(&self.converged, &self.rest)
    }

    /// Distance of an end from the exact motion of the elements, over its largest displacement.
    pub fn total_error(&self, end: &DVector<f64>) -> f64 {
        distance(end, &self.exact) / distance(&self.exact, &self.rest)
    }

    /// The part of the total error that converged implicit Euler has.
    pub fn time_error(&self) -> f64 {
        self.total_error(&self.converged)
    }

    /// The part of the total error that springs have however small their steps.
    pub fn model_error(&self) -> f64 {
        self.total_error(&self.springs)
    }
}

/// Largest distance of a node, m. NaN if a position is NaN.
pub fn distance(a: &DVector<f64>, b: &DVector<f64>) -> f64 {
    let nodes = (0..a.len() / 3).map(|node| (a.fixed_rows::<3>(3 * node) - b.fixed_rows::<3>(3 * node)).norm());
    nodes.fold(0.0, |largest: f64, found| if found.is_nan() { found } else { largest.max(found) })
}
