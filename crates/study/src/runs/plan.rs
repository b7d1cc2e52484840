//! The plan of a scene's runs: one choice at a time varies around the scene's own method and time step.
//!
//! Every integrator runs with a ladder of halved time steps. Explicit integrators start above their stability limit, so that the
//! failure is shown. Tolerance, solver, projection, precision and mesh vary around one point of the ladder of implicit Euler.

use fem_model::{Integrator, Precision, Preconditioner, Projection, SolverKind};
use fem_scene::tables::{AdaptiveTable, DragTable, NewmarkTable, NewtonTable, SolverTable, TimeTable};
use fem_scene::{Pipeline, Scene};

use crate::study::pairs;

/// A run to be made.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedRun {
    /// The varied choice: `method`, `tolerance`, `solver`, `projection`, `precision`, `mesh`, or `order`.
    pub group: &'static str,
    /// Name of the method.
    pub method: String,
    /// The scene, with its integrator and time step.
    pub scene: Scene,
    /// Number of steps. The product with the scene's `dt` is the horizon.
    pub steps: usize,
}

/// Runs of one method from coarse to fine. If a run takes too long, the finer ones are left out.
pub type Ladder = Vec<PlannedRun>;

/// The extent of a study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The short study, of less than a minute.
    pub is_quick: bool,
    /// Simulated time, s.
    pub horizon: f64,
    /// The scene's own number of steps in that time.
    pub steps: usize,
    /// Highest natural frequency, 1/s.
    pub fastest: f64,
}

/// ω_max dt of the largest explicit step, above the stability limits of all integrators.
const ABOVE_THE_LIMIT: f64 = 3.6;

/// Runs of the engine and of the course for a scene in motion. `scene` comes from [`base`].
pub fn dynamic(scene: &Scene, extent: Extent) -> Vec<Ladder> {
    let mut plan = Plan { extent, ladders: Vec::new() };
    let halvings = if extent.is_quick { -1..=3 } else { -2..=5 };
    let implicit: Vec<usize> = halvings.map(|k: i32| scaled(extent.steps, k)).collect();
    let of_first_order = [Integrator::ImplicitEuler, Integrator::LinearlyImplicitEuler];
    for integrator in of_first_order.into_iter().chain(Integrator::second_order_implicit()) {
        plan.add("method", integrator.facts().label, by(scene, integrator), &implicit);
    }
    let first = (extent.horizon * extent.fastest / ABOVE_THE_LIMIT).ceil().max(1.0) as usize;
    let most = if extent.is_quick { 3 } else { 5 };
    let explicit: Vec<usize> = (0..=most).map(|k| first << k).collect();
    for integrator in [Integrator::SemiImplicitEuler, Integrator::Rk2, Integrator::Rk4, Integrator::Verlet] {
        plan.add("method", integrator.facts().label, by(scene, integrator), &explicit);
    }
    // Growth by e^(ω² dt T/2) makes most of these runs fail: every other step size shows it.
    let sparse: Vec<usize> = explicit.iter().copied().step_by(2).collect();
    let unstable = Integrator::ExplicitEuler;
    plan.add("method", unstable.facts().label, by(scene, unstable), &sparse);
    plan.add_course(scene);
    plan.add_adaptive(scene);
    plan.add_variants(scene);
    plan.add_loose(scene, &implicit);
    plan.ladders
}

/// Ladders of a study.
struct Plan {
    extent: Extent,
    ladders: Vec<Ladder>,
}

impl Plan {
    /// Adds a run for each number of steps in the horizon.
    fn add(&mut self, group: &'static str, method: impl Into<String>, scene: Scene, steps: &[usize]) {
        let method = method.into();
        let run = |&steps: &usize| {
            let time = TimeTable { dt: Some(self.extent.horizon / steps as f64), ..scene.time.clone() };
            PlannedRun { group, method: method.clone(), scene: Scene { time, ..scene.clone() }, steps }
        };
        self.ladders.push(steps.iter().map(run).collect());
    }

    /// The same body in the course's pipeline.
    fn add_course(&mut self, scene: &Scene) {
        let halvings: &[i32] = if self.extent.is_quick { &[0, 2] } else { &[-1, 0, 1, 2] };
        let steps: Vec<_> = halvings.iter().map(|&k| scaled(self.extent.steps, k)).collect();
        for integrator in [Integrator::ImplicitEuler, Integrator::LinearlyImplicitEuler] {
            let method = format!("course: {}", integrator.facts().label);
            self.add("method", method, by(&in_course(scene), integrator), &steps);
        }
    }

    /// Adaptive steps within the scene's own, to several tolerances.
    fn add_adaptive(&mut self, scene: &Scene) {
        for (integrator, tolerance) in pairs(Integrator::second_order_implicit(), [1e-3, 1e-4, 1e-5]) {
            let mut scene = by(scene, integrator);
            scene.time.adaptive = Some(AdaptiveTable { tolerance });
            let method = format!("{}, adaptive to {tolerance:e}", integrator.facts().label);
            self.add("adaptive", method, scene, &[self.extent.steps]);
        }
    }

    /// Variants of implicit Euler; precision of other integrators too.
    fn add_variants(&mut self, scene: &Scene) {
        let Extent { is_quick, horizon, steps, fastest } = self.extent;
        let base = by(scene, Integrator::ImplicitEuler);
        let finer = scaled(steps, 2);
        let tolerances: &[f64] = if is_quick { &[1e-3, 1e-12] } else { &[1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12] };
        for &tolerance in tolerances {
            self.add("tolerance", format!("implicit Euler to {tolerance:e}"), to(&base, tolerance), &[finer]);
        }
        for solver in SOLVERS {
            let scene = solved_by(&base, solver);
            self.add("solver", format!("implicit Euler by {}", solver_name(&scene)), scene, &[finer]);
        }
        for (projection, word) in [(Projection::Always, "always"), (Projection::Never, "never")] {
            let newton = Some(NewtonTable { projection: Some(projection), ..newton(&base) });
            let scene = Scene { newton, ..base.clone() };
            self.add("projection", format!("implicit Euler, projected {word}"), scene, &[finer]);
        }
        let explicit = (horizon * fastest / ABOVE_THE_LIMIT).ceil() as usize;
        for (integrator, steps) in [
            (Integrator::ImplicitEuler, finer),
            (Integrator::LinearlyImplicitEuler, finer),
            (Integrator::Verlet, 4 * explicit),
        ] {
            let method = format!("{} in f32", integrator.facts().label);
            self.add("precision", method, by(&single(scene), integrator), &[steps]);
        }
        for (cells, scene) in meshes(&base) {
            let method = format!("{}, {cells} cells per metre", Integrator::ImplicitEuler.facts().label);
            self.add("mesh", method, scene, &[steps, finer]);
        }
    }

    /// Implicit methods as fast as errors of 1e-4 allow, in single precision with a loose tolerance; Newmark's method with its most accurate
    /// periods too, from just below its critical time step on.
    fn add_loose(&mut self, scene: &Scene, implicit: &[usize]) {
        let scene = to(&single(scene), 1e-4);
        for integrator in [Integrator::ImplicitEuler].into_iter().chain(Integrator::second_order_implicit()) {
            let method = format!("{} in f32 to 1e-4", integrator.facts().label);
            self.add("precision", method, by(&scene, integrator), implicit);
        }
        let stable = (self.extent.horizon * self.extent.fastest / (0.95 * 6f64.sqrt())).ceil().max(1.0) as usize;
        let newmark = Some(NewmarkTable { beta: Some(1.0 / 12.0), gamma: None });
        let accurate = Scene { newmark, ..by(&scene, Integrator::Newmark) };
        let steps = [stable, 2 * stable, 4 * stable];
        self.add("precision", "Newmark, β = 1/12, in f32 to 1e-4", accurate, &steps);
    }
}

/// The scene with another integrator.
fn by(scene: &Scene, integrator: Integrator) -> Scene {
    Scene { time: TimeTable { integrator, ..scene.time.clone() }, ..scene.clone() }
}

/// The scene with another tolerance of Newton's method.
fn to(scene: &Scene, tolerance: f64) -> Scene {
    Scene { newton: Some(NewtonTable { tolerance: Some(tolerance), ..newton(scene) }), ..scene.clone() }
}

/// The scene with another linear solver.
fn solved_by(scene: &Scene, (kind, preconditioner): (SolverKind, Option<Preconditioner>)) -> Scene {
    let solver = Some(SolverTable { kind, tolerance: None, preconditioner, precision: None });
    Scene { solver, ..scene.clone() }
}

/// The scene in the course's pipeline, with the spring of its drag in the stiffness, as the engine has it: rows compare methods, and the
/// course leaves that spring out unless a scene asks for it.
fn in_course(scene: &Scene) -> Scene {
    let drag = scene.drag.clone().map(|drag| DragTable { in_stiffness: drag.in_stiffness.or(Some(true)), ..drag });
    Scene { pipeline: Pipeline::Course, newton: None, solver: None, drag, ..scene.clone() }
}

/// A box with half and with twice as many cells per metre, with their number.
fn meshes(scene: &Scene) -> Vec<(usize, Scene)> {
    let with = |cells: usize| {
        let mut scene = scene.clone();
        if let Some(cuboid) = &mut scene.mesh.cuboid {
            cuboid.cells_per_unit = cells;
        }
        (cells, scene)
    };
    levels(scene).map_or(Vec::new(), |[half, _, twice]| vec![with(half), with(twice)])
}

/// Cells per metre of three nested meshes around the scene's. The error says why the scene has no such meshes.
pub fn levels(scene: &Scene) -> Result<[usize; 3], String> {
    let Some(cuboid) = &scene.mesh.cuboid else {
        let text = "the mesh comes from a file. Subdivision does not refine its surface, and constraints and loads on \
                    single nodes have no limit in the continuum";
        return Err(text.to_owned());
    };
    let cells = cuboid.cells_per_unit;
    let is_whole = |edge: &f64| (edge * (cells / 2) as f64).fract() == 0.0;
    if cells % 2 == 0 && cuboid.size.iter().all(is_whole) {
        return Ok([cells / 2, cells, 2 * cells]);
    }
    Err(format!("{cells} cells per metre cannot be halved; an even number can, if edges stay whole numbers of cells"))
}

/// Solvers with their preconditioners.
const SOLVERS: [(SolverKind, Option<Preconditioner>); 6] = [
    (SolverKind::Cholesky, None),
    (SolverKind::Lu, None),
    (SolverKind::Cg, None),
    (SolverKind::Pcg, Some(Preconditioner::BlockJacobi)),
    (SolverKind::Pcg, Some(Preconditioner::Multigrid)),
    (SolverKind::Pcg, Some(Preconditioner::Ssor)),
];

/// Numbers of steps in the horizon at which each integrator is in its asymptotic range.
const FIRST: [(Integrator, usize); 12] = [
    (Integrator::ExplicitEuler, 400),
    (Integrator::SemiImplicitEuler, 400),
    (Integrator::LinearlyImplicitEuler, 400),
    (Integrator::ImplicitEuler, 400),
    (Integrator::Rk2, 100),
    (Integrator::Verlet, 100),
    (Integrator::Rk4, 50),
    (Integrator::ImplicitMidpoint, 100),
    (Integrator::Newmark, 100),
    (Integrator::GeneralizedAlpha, 100),
    (Integrator::Bdf2, 100),
    (Integrator::Bathe, 100),
];

/// Ladders in the asymptotic range of each integrator.
pub fn orders(scene: &Scene, extent: Extent) -> Vec<Ladder> {
    let mut plan = Plan { extent, ladders: Vec::new() };
    for (integrator, first) in FIRST {
        let steps: Vec<usize> = (0..if extent.is_quick { 3 } else { 4 }).map(|k| first << k).collect();
        let (label, scene) = (integrator.facts().label, by(scene, integrator));
        plan.add("order", label, scene.clone(), &steps);
        if matches!(integrator, Integrator::LinearlyImplicitEuler | Integrator::ImplicitEuler) {
            plan.add("order", format!("course: {label}"), in_course(&scene), &steps);
        }
    }
    plan.ladders
}

/// Runs of a static scene: solvers, precision and meshes.
pub fn equilibrium(scene: &Scene, load_steps: usize) -> Vec<Ladder> {
    let run = |group, method: String, scene: Scene| vec![PlannedRun { group, method, scene, steps: load_steps }];
    let mut ladders = vec![run("method", "static".to_owned(), scene.clone())];
    for solver in SOLVERS {
        let scene = solved_by(scene, solver);
        ladders.push(run("solver", format!("static by {}", solver_name(&scene)), scene));
    }
    ladders.push(run("precision", "static in f32".to_owned(), single(scene)));
    let meshes = meshes(scene).into_iter();
    ladders.extend(meshes.map(|(cells, scene)| run("mesh", format!("static, {cells} cells per metre"), scene)));
    ladders
}

/// The scene in single precision, with a tolerance above round-off.
fn single(scene: &Scene) -> Scene {
    let time = TimeTable { precision: Precision::F32, ..scene.time.clone() };
    to(&Scene { time, ..scene.clone() }, 1e-6)
}

/// The scene for the engine, without its display mesh, and with a coarse mesh for the short study.
pub fn base(scene: &Scene, is_quick: bool) -> Scene {
    let mut scene = Scene { pipeline: Pipeline::Engine, ..scene.clone() };
    scene.mesh.display = None;
    scene.make_substeps_steps();
    // Every method moves the same body, whatever its size.
    scene.mass.lumped = Some(scene.mass.lumped == Some(true));
    if is_quick && let Some(cuboid) = &mut scene.mesh.cuboid {
        cuboid.cells_per_unit = cuboid.cells_per_unit.min(2);
    }
    scene
}

/// `steps` · 2^k, at least one.
fn scaled(steps: usize, k: i32) -> usize {
    (steps as f64 * 2f64.powi(k)).round().max(1.0) as usize
}

/// The solver of a scene, or `automatic`.
pub fn solver_name(scene: &Scene) -> String {
    let Some(solver) = &scene.solver else { return "automatic".to_owned() };
    let preconditioner =
        solver.preconditioner.map_or(String::new(), |preconditioner| format!(" {}", preconditioner.name()));
    format!("{}{preconditioner}", solver.kind.name())
}

fn newton(scene: &Scene) -> NewtonTable {
    scene.newton.clone().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::{Extent, Pipeline, dynamic};

    #[test]
    fn the_course_is_compared_with_the_spring_of_the_drag_in_its_stiffness() {
        let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data");
        let scene = fem_scene::load("arma-engine", data.as_ref()).unwrap();
        let extent = Extent { is_quick: true, horizon: 0.1, steps: 10, fastest: 1e3 };
        let runs: Vec<_> = dynamic(&scene, extent).into_iter().flatten().collect();
        let of_course = runs.iter().filter(|run| run.scene.pipeline == Pipeline::Course);
        let is_in = |run: &&super::PlannedRun| run.scene.drag.as_ref().unwrap().in_stiffness == Some(true);
        assert_eq!((of_course.clone().count(), of_course.filter(is_in).count()), (4, 4));
    }
}
