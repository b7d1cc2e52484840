//! The thesis' setting: material, damping, load and time step, and the simulations that have it.

use fem_mesh::TetrahedralMesh;
use fem_model::Integrator;
use fem_model::simulation::Simulation;
use nalgebra::Vector3;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::torus::{RING, TUBE};
use crate::scenes::{REPLACED, simulation, step, text};

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

/// Linear solvers: a name, and the table of a scene.
pub const SOLVERS: &[(&str, &str)] = &[
    ("by size", ""),
    ("cholesky", "[solver]\nkind = \"cholesky\"\n"),
    ("lu", "[solver]\nkind = \"lu\"\n"),
    ("cg", "[solver]\nkind = \"cg\"\n"),
    ("pcg, block_jacobi", "[solver]\nkind = \"pcg\"\n"),
    ("pcg, multigrid", "[solver]\nkind = \"pcg\"\npreconditioner = \"multigrid\"\n"),
    ("gpu, f32 on the device", "[solver]\nkind = \"gpu\"\n"),
    ("gpu, f64 on the device", "[solver]\nkind = \"gpu\"\nprecision = \"f64\"\n"),
    ("pcg, ssor", "[solver]\nkind = \"pcg\"\npreconditioner = \"ssor\"\n"),
];

/// Parameters of a run of the torus. The default is the thesis' numbers.
#[derive(Clone, Debug)]
pub struct Setting<'a> {
    /// Constitutive law.
    pub law: &'a str,
    /// Young's modulus, Pa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// `f64` or `f32`.
    pub precision: &'a str,
    /// Time integration method.
    pub integrator: Integrator,
    /// Further tables of the scene, such as `[solver]`.
    pub tables: &'a str,
}

impl Default for Setting<'_> {
    fn default() -> Self {
        let integrator = Integrator::ImplicitEuler;
        Self { law: "linear", young: YOUNG, poisson: POISSON, precision: "f64", integrator, tables: "" }
    }
}

impl Setting<'_> {
    /// The thesis' setting with another law.
    pub fn of_law(law: &str) -> Setting<'_> {
        Setting { law, ..Setting::default() }
    }

    /// The tables `[material]` and `[mass]`, and those of the method.
    pub fn text(&self) -> String {
        let Self { law, young, poisson, precision, integrator, tables } = self;
        // One solve is exact for a linear body; the thesis' tolerance avoids a second one that would confirm it.
        let newton = match (*law, *integrator) {
            ("linear", Integrator::ImplicitEuler) => "[newton]\ntolerance = 1e-5\n",
            _ => "",
        };
        let time = match *integrator {
            Integrator::Static => "steps = 1".to_owned(),
            _ => format!("dt = {DT}\n[damping]\nalpha = {ALPHA}\nbeta = {BETA}"),
        };
        let material = format!(
            "model = \"{law}\"\nyoung = {young:e}\npoisson = {poisson}\ndensity = {DENSITY}\n[mass]\nlumped = false\n{tables}{newton}"
        );
        text(
            REPLACED,
            &material,
            &format!("integrator = \"{}\"\nprecision = \"{precision}\"\n{time}", integrator.name()),
            "",
        )
    }

    /// The torus, squashed along x by a traction on its sides `left` and `right`. Nodes next to the planes
    /// of symmetry stay on them, which prevents rigid motion.
    ///
    /// # Errors
    /// A scene that the engine refuses.
    pub fn torus(&self, mesh: &TetrahedralMesh) -> Result<Box<dyn Simulation>, String> {
        let mut text = self.text();
        for (side, sign) in [("left", 1.0), ("right", -1.0)] {
            text += &format!("[[traction]]\nset = \"{side}\"\nforce_per_area = [{}, 0, 0]\n", sign * TRACTION);
        }
        for (axis, nodes) in supports(mesh).iter().enumerate() {
            let name = ["x", "y", "z"][axis];
            text +=
                &format!("[[prescribed]]\nnodes = {nodes:?}\ndisplacement = [0, 0, 0]\ncomponents = [\"{name}\"]\n");
        }
        simulation(&text, mesh.clone())
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

/// Displacements of all nodes, m.
pub fn displacements(simulation: &dyn Simulation) -> Vec<Vector3<f64>> {
    let (shape, q) = (simulation.shape(), simulation.positions());
    shape.mesh.vertices().iter().enumerate().map(|(i, X)| q.fixed_rows::<3>(3 * i) - X).collect()
}

/// Equilibrium under the full load: displacements, m.
///
/// # Errors
/// A scene that is refused, or a load step that does not converge.
pub fn equilibrium(setting: &Setting, mesh: &TetrahedralMesh) -> Result<Vec<Vector3<f64>>, String> {
    let mut simulation = Setting { integrator: Integrator::Static, ..setting.clone() }.torus(mesh)?;
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
///
/// # Errors
/// A thread that cannot be started.
pub fn one_thread() -> Result<ThreadPool, String> {
    ThreadPoolBuilder::new().num_threads(1).build().map_err(|error| error.to_string())
}

/// The middle of some numbers, and the one below which 95 % of them lie.
pub fn median_and_p95(mut values: Vec<f64>) -> (f64, f64) {
    values.sort_by(f64::total_cmp);
    let at =
        |part: f64| values.get((part * values.len() as f64) as usize).or(values.last()).copied().unwrap_or(f64::NAN);
    (at(0.5), at(0.95))
}
