//! The thesis' setting: material, damping, load and time step, and the simulations that have it.

use fem_engine::simulator::build;
use fem_mesh::TetrahedralMesh;
use fem_model::simulation::Simulation;
use fem_model::{
    Axis, Body, BodyMesh, Damping, DampingForm, Integrator, Method, NewtonSettings, Precision, Preconditioner,
    Selector, SolverKind, SolverSettings,
};
use nalgebra::Vector3;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::torus::{RING, TUBE};
use crate::scenes::{displaced, displacements, material, step};
use crate::study::Result;

/// Time step and duration of the thesis, s.
pub const DT: f64 = 0.016;
pub const DURATION: f64 = 15.0;

/// Young's modulus (Pa), Poisson's ratio, density (kg/m³), traction on each face (Pa) and Rayleigh damping (1/s, s) of the thesis.
pub const YOUNG: f64 = 7000.0;
pub const POISSON: f64 = 0.2;
pub const DENSITY: f64 = 1.0;
pub const TRACTION: f64 = 100.0;
pub const ALPHA: f64 = 10.0;
pub const BETA: f64 = 2.5;

/// The laws that are compared.
pub const LAWS: [&str; 3] = ["linear", "corotated", "neo_hookean"];

/// Linear solvers by name.
pub const SOLVERS: &[(&str, Option<SolverSettings>)] = &[
    ("by size", None),
    ("cholesky", solver(SolverKind::Cholesky, Preconditioner::BlockJacobi)),
    ("lu", solver(SolverKind::Lu, Preconditioner::BlockJacobi)),
    ("cg", solver(SolverKind::Cg, Preconditioner::BlockJacobi)),
    ("pcg, block_jacobi", solver(SolverKind::Pcg, Preconditioner::BlockJacobi)),
    ("pcg, multigrid", solver(SolverKind::Pcg, Preconditioner::Multigrid)),
    ("gpu, f32 on the device", Some(on_device(Precision::F32))),
    ("gpu, f64 on the device", Some(on_device(Precision::F64))),
    ("pcg, ssor", solver(SolverKind::Pcg, Preconditioner::Ssor)),
];

const fn solver(kind: SolverKind, preconditioner: Preconditioner) -> Option<SolverSettings> {
    Some(SolverSettings { kind, preconditioner, ..on_device(Precision::F32) })
}

/// Conjugate gradients on a graphics device.
pub const fn on_device(precision: Precision) -> SolverSettings {
    SolverSettings { kind: SolverKind::Gpu, tolerance: None, preconditioner: Preconditioner::BlockJacobi, precision }
}

/// Parameters of a run of the torus. The default is the thesis' numbers.
#[derive(Clone, Debug)]
pub struct Setting<'a> {
    /// Constitutive law.
    pub law: &'a str,
    /// Young's modulus, Pa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Number type.
    pub precision: Precision,
    /// Time integration method.
    pub integrator: Integrator,
    /// Linear solver; `None` for one that suits the size of the body.
    pub solver: Option<SolverSettings>,
}

impl Default for Setting<'_> {
    fn default() -> Self {
        let (precision, integrator) = (Precision::F64, Integrator::ImplicitEuler);
        Self { law: "linear", young: YOUNG, poisson: POISSON, precision, integrator, solver: None }
    }
}

impl Setting<'_> {
    /// The thesis' setting with another law.
    pub fn of_law(law: &str) -> Setting<'_> {
        Setting { law, ..Setting::default() }
    }

    /// The same in equilibrium.
    pub fn in_equilibrium(&self) -> Self {
        Self { integrator: Integrator::Static, ..self.clone() }
    }

    /// The method.
    pub fn method(&self) -> Method {
        let is_static = self.integrator == Integrator::Static;
        // One solve is exact for a linear body; the thesis' tolerance avoids a second one that would confirm it.
        let tolerance = (self.law == "linear" && !is_static).then_some(1e-5);
        Method {
            precision: self.precision,
            newton: NewtonSettings { tolerance, ..NewtonSettings::default() },
            solver: self.solver.clone(),
            ..Method::new(self.integrator, if is_static { 1.0 } else { DT })
        }
    }

    /// A body with the material, its consistent mass and, in motion, the damping.
    pub fn body(&self, mesh: impl Into<BodyMesh>) -> Result<Body> {
        let body = Body::new(mesh, material(self.law, self.young, self.poisson, DENSITY)?)?;
        match self.integrator {
            Integrator::Static => Ok(body),
            _ => Ok(body.damping(Damping { alpha: ALPHA, beta: BETA, form: DampingForm::default() })?),
        }
    }

    /// The torus, squashed along x by a traction on its sides `left` and `right`. Nodes next to the planes
    /// of symmetry stay on them, which prevents rigid motion.
    pub fn torus_body(&self, mesh: &TetrahedralMesh) -> Result<Body> {
        let mut body = self.body(mesh.clone())?;
        for (side, sign) in [("left", 1.0), ("right", -1.0)] {
            body = body.traction(&Selector::Set(side.to_owned()), [sign * TRACTION, 0.0, 0.0])?;
        }
        for (axis, nodes) in [Axis::X, Axis::Y, Axis::Z].into_iter().zip(supports(mesh)) {
            body = displaced(body, &Selector::Nodes(nodes), axis, 0.0)?;
        }
        Ok(body)
    }

    /// The simulation of that body.
    pub fn torus(&self, mesh: &TetrahedralMesh) -> Result<Box<dyn Simulation>> {
        Ok(build(self.torus_body(mesh)?, &self.method())?)
    }
}

/// Nodes for each axis, next to the plane of symmetry across it, whose displacement along it is zero. The body cannot turn away under the
/// load, as it would on three single nodes: two opposite dead loads that push inwards turn a free body over.
pub fn supports(mesh: &TetrahedralMesh) -> [Vec<usize>; 3] {
    [0, 1, 2].map(|axis| {
        let distance = |i: &usize| mesh.vertices[*i][axis].abs();
        let mut nodes: Vec<usize> = (0..mesh.vertices.len()).collect();
        nodes.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let count = nodes.iter().filter(|i| distance(i) <= NEXT_TO_PLANE).count().max(LEAST_SUPPORTS);
        nodes.truncate(count);
        nodes
    })
}

/// Distance from a plane of symmetry up to which its nodes are supported, m, and their least number on a coarse mesh.
const NEXT_TO_PLANE: f64 = 0.05 * TUBE;
const LEAST_SUPPORTS: usize = 4;

/// Equilibrium under the full load: displacements, m.
pub fn equilibrium(setting: &Setting, mesh: &TetrahedralMesh) -> Result<Vec<Vector3<f64>>> {
    let mut simulation = setting.in_equilibrium().torus(mesh)?;
    step(&mut *simulation)?;
    Ok(displacements(&*simulation))
}

/// Largest distance between two states, over the diameter of the torus.
pub fn difference(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    let largest = a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    largest / (2.0 * (RING + TUBE))
}

/// Nodal forces of the traction on `left` and `right`, N: each triangle's force in equal parts on its corners. Computed apart from the engine.
pub fn loads(mesh: &TetrahedralMesh) -> Vec<Vector3<f64>> {
    let mut forces = vec![Vector3::zeros(); mesh.vertices.len()];
    for (side, sign) in [("left", 1.0), ("right", -1.0)] {
        for face in mesh.sets.get(side).iter().flat_map(|set| &set.faces) {
            let [a, b, c] = face.map(|i| mesh.vertices[i]);
            let area = 0.5 * (b - a).cross(&(c - a)).norm();
            face.iter().for_each(|&i| forces[i].x += sign * TRACTION * area / 3.0);
        }
    }
    forces
}

/// Approach of the two loaded sides, each averaged with its load, m, and the load of a side, N.
pub fn squash(mesh: &TetrahedralMesh, displacements: &[Vector3<f64>]) -> (f64, f64) {
    let loads = loads(mesh);
    let work: f64 = loads.iter().zip(displacements).map(|(f, u)| f.dot(u)).sum();
    let force = 0.5 * loads.iter().map(|f| f.x.abs()).sum::<f64>();
    (work / force, force)
}

/// A pool of one thread.
pub fn one_thread() -> Result<ThreadPool> {
    Ok(ThreadPoolBuilder::new().num_threads(1).build()?)
}

/// The middle of some numbers, and the one below which 95 % of them lie.
pub fn median_and_p95(mut values: Vec<f64>) -> (f64, f64) {
    values.sort_by(f64::total_cmp);
    let at =
        |part: f64| values.get((part * values.len() as f64) as usize).or(values.last()).copied().unwrap_or(f64::NAN);
    (at(0.5), at(0.95))
}
