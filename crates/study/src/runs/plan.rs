//! The plan of a scene's runs: one choice at a time varies around the scene's own method and time step.
//!
//! Every integrator runs with a ladder of halved time steps. Explicit integrators start above their stability limit, so that the
//! failure is shown. Tolerance, solver, projection, precision and mesh vary around one point of the ladder of implicit Euler.

use fem_model::{Integrator, Precision, Preconditioner, Projection, SolverKind};
use fem_scene::tables::{AdaptiveTable, DragTable, NewmarkTable, NewtonTable, SolverTable, TimeTable};
use fem_scene::{Pipeline, Scene};

use super::names::solver_name;

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
    let mut ladders = Vec::new();
    let with = |integrator: Integrator| {
        let mut scene = scene.clone();
        scene.time.integrator = integrator;
        scene
    };
    let halvings = if extent.is_quick { -1..=3 } else { -2..=5 };
    let implicit: Vec<usize> = halvings.map(|k: i32| scaled(extent.steps, k)).collect();
    let of_first_order = [Integrator::ImplicitEuler, Integrator::LinearlyImplicitEuler];
    for integrator in of_first_order.into_iter().chain(Integrator::second_order_implicit()) {
        ladders.push(ladder("method", integrator.facts().label, &with(integrator), &implicit, extent));
    }
    let first = (extent.horizon * extent.fastest / ABOVE_THE_LIMIT).ceil().max(1.0) as usize;
    let most = if extent.is_quick { 3 } else { 5 };
    let explicit: Vec<usize> = (0..=most).map(|k| first << k).collect();
    for integrator in [Integrator::SemiImplicitEuler, Integrator::Rk2, Integrator::Rk4, Integrator::Verlet] {
        ladders.push(ladder("method", integrator.facts().label, &with(integrator), &explicit, extent));
    }
    // Growth by e^(ω² dt T/2) makes most of these runs fail: every other step size shows it.
    let sparse: Vec<usize> = explicit.iter().copied().step_by(2).collect();
    ladders.push(ladder(
        "method",
        Integrator::ExplicitEuler.facts().label,
        &with(Integrator::ExplicitEuler),
        &sparse,
        extent,
    ));
    ladders.extend(course(scene, extent));
    ladders.extend(adaptive(scene, extent));
    ladders.extend(variants(scene, extent));
    ladders.extend(loose(scene, &implicit, extent));
    ladders
}

/// Implicit methods as fast as errors of 1e-4 allow, in single precision with a loose tolerance; Newmark's method with its most accurate periods
/// too, from just below its critical time step on.
fn loose(scene: &Scene, implicit: &[usize], extent: Extent) -> Vec<Ladder> {
    let mut scene = single(scene);
    scene.newton = Some(NewtonTable { tolerance: Some(1e-4), ..newton(&scene) });
    let stable = (extent.horizon * extent.fastest / (0.95 * 6f64.sqrt())).ceil().max(1.0) as usize;
    let accurate = NewmarkTable { beta: Some(1.0 / 12.0), gamma: None };
    let mut ladders = Vec::new();
    for integrator in [Integrator::ImplicitEuler].into_iter().chain(Integrator::second_order_implicit()) {
        scene.time.integrator = integrator;
        ladders.push(ladder(
            "precision",
            &format!("{} in f32 to 1e-4", integrator.facts().label),
            &scene,
            implicit,
            extent,
        ));
    }
    scene.time.integrator = Integrator::Newmark;
    scene.newmark = Some(accurate);
    let steps = [stable, 2 * stable, 4 * stable];
    ladders.push(ladder("precision", "Newmark, β = 1/12, in f32 to 1e-4", &scene, &steps, extent));
    ladders
}

/// Adaptive steps within the scene's own, to several tolerances.
fn adaptive(scene: &Scene, extent: Extent) -> Vec<Ladder> {
    let run = |(integrator, tolerance): (Integrator, f64)| {
        let mut scene = scene.clone();
        scene.time.integrator = integrator;
        scene.time.adaptive = Some(AdaptiveTable { tolerance });
        ladder(
            "adaptive",
            &format!("{}, adaptive to {tolerance:e}", integrator.facts().label),
            &scene,
            &[extent.steps],
            extent,
        )
    };
    let tolerances = [1e-3, 1e-4, 1e-5];
    Integrator::second_order_implicit().flat_map(|of| tolerances.map(|tolerance| run((of, tolerance)))).collect()
}

/// The scene in the course's pipeline, with the spring of its drag in the stiffness, as the engine has it: rows compare methods, and the
/// course leaves that spring out unless a scene asks for it.
fn in_course(scene: &Scene) -> Scene {
    let drag = scene.drag.clone().map(|drag| DragTable { in_stiffness: drag.in_stiffness.or(Some(true)), ..drag });
    Scene { pipeline: Pipeline::Course, newton: None, solver: None, drag, ..scene.clone() }
}

/// The same body in the course's pipeline.
fn course(scene: &Scene, extent: Extent) -> Vec<Ladder> {
    let mut scene = in_course(scene);
    let halvings: &[i32] = if extent.is_quick { &[0, 2] } else { &[-1, 0, 1, 2] };
    let steps: Vec<_> = halvings.iter().map(|&k| scaled(extent.steps, k)).collect();
    let of = |integrator: Integrator| {
        scene.time.integrator = integrator;
        ladder("method", &format!("course: {}", integrator.facts().label), &scene, &steps, extent)
    };
    [Integrator::ImplicitEuler, Integrator::LinearlyImplicitEuler].map(of).into()
}

/// Variants of implicit Euler; precision of other integrators too.
fn variants(scene: &Scene, extent: Extent) -> Vec<Ladder> {
    let mut base = scene.clone();
    base.time.integrator = Integrator::ImplicitEuler;
    let at = [scaled(extent.steps, 2)];
    let mut ladders = Vec::new();
    let tolerances: &[f64] = if extent.is_quick { &[1e-3, 1e-12] } else { &[1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12] };
    for &tolerance in tolerances {
        let mut scene = base.clone();
        scene.newton = Some(NewtonTable { tolerance: Some(tolerance), ..newton(&scene) });
        ladders.push(ladder("tolerance", &format!("implicit Euler to {tolerance:e}"), &scene, &at, extent));
    }
    for (kind, preconditioner) in SOLVERS {
        let mut scene = base.clone();
        scene.solver = Some(SolverTable { kind, tolerance: None, preconditioner, precision: None });
        let method = format!("implicit Euler by {}", solver_name(&scene));
        ladders.push(ladder("solver", &method, &scene, &at, extent));
    }
    for (projection, word) in [(Projection::Always, "always"), (Projection::Never, "never")] {
        let mut scene = base.clone();
        scene.newton = Some(NewtonTable { projection: Some(projection), ..newton(&scene) });
        ladders.push(ladder("projection", &format!("implicit Euler, projected {word}"), &scene, &at, extent));
    }
    let explicit = (extent.horizon * extent.fastest / ABOVE_THE_LIMIT).ceil() as usize;
    for (integrator, steps) in [
        (Integrator::ImplicitEuler, scaled(extent.steps, 2)),
        (Integrator::LinearlyImplicitEuler, scaled(extent.steps, 2)),
        (Integrator::Verlet, 4 * explicit),
    ] {
        let mut scene = single(scene);
        scene.time.integrator = integrator;
        ladders.push(ladder("precision", &format!("{} in f32", integrator.facts().label), &scene, &[steps], extent));
    }
    ladders.extend(meshes(scene).into_iter().map(|scene| {
        let cells = scene.mesh.cuboid.as_ref().map_or(0, |cuboid| cuboid.cells_per_unit);
        let method = format!("{}, {cells} cells per metre", scene.time.integrator.facts().label);
        ladder("mesh", &method, &scene, &[extent.steps, at[0]], extent)
    }));
    ladders
}

/// A box with half and with twice as many cells per edge, with implicit Euler.
fn meshes(scene: &Scene) -> Vec<Scene> {
    let with = |cells: usize| {
        let mut scene = scene.clone();
        scene.time.integrator = Integrator::ImplicitEuler;
        if let Some(cuboid) = &mut scene.mesh.cuboid {
            cuboid.cells_per_unit = cells;
        }
        scene
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
    let halvings = if extent.is_quick { 3 } else { 4 };
    let steps = |first: usize| (0..halvings).map(|k| first << k).collect::<Vec<_>>();
    let mut ladders = Vec::new();
    for (integrator, first) in FIRST {
        let mut scene = scene.clone();
        scene.time.integrator = integrator;
        ladders.push(ladder("order", integrator.facts().label, &scene, &steps(first), extent));
        if matches!(integrator, Integrator::LinearlyImplicitEuler | Integrator::ImplicitEuler) {
            let method = format!("course: {}", integrator.facts().label);
            ladders.push(ladder("order", &method, &in_course(&scene), &steps(first), extent));
        }
    }
    ladders
}

/// Runs of a static scene: solvers, precision and meshes.
pub fn equilibrium(scene: &Scene, load_steps: usize) -> Vec<Ladder> {
    let run = |group, method: String, scene: &Scene| {
        vec![PlannedRun { group, method, scene: scene.clone(), steps: load_steps }]
    };
    let mut ladders = vec![run("method", "static".to_owned(), scene)];
    for (kind, preconditioner) in SOLVERS {
        let mut scene = scene.clone();
        scene.solver = Some(SolverTable { kind, tolerance: None, preconditioner, precision: None });
        ladders.push(run("solver", format!("static by {}", solver_name(&scene)), &scene));
    }
    ladders.push(run("precision", "static in f32".to_owned(), &single(scene)));
    for scene in meshes(scene) {
        let scene = Scene { time: TimeTable { integrator: Integrator::Static, ..scene.time }, ..scene };
        let cells = scene.mesh.cuboid.as_ref().map_or(0, |cuboid| cuboid.cells_per_unit);
        ladders.push(run("mesh", format!("static, {cells} cells per metre"), &scene));
    }
    ladders
}

/// The scene in single precision, with a tolerance above round-off.
fn single(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.time.precision = Precision::F32;
    scene.newton = Some(NewtonTable { tolerance: Some(1e-6), ..newton(&scene) });
    scene
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

fn ladder(group: &'static str, method: &str, scene: &Scene, steps: &[usize], extent: Extent) -> Ladder {
    let run = |&steps: &usize| {
        let mut scene = scene.clone();
        scene.time.dt = Some(extent.horizon / steps as f64);
        PlannedRun { group, method: method.to_owned(), scene, steps }
    };
    steps.iter().map(run).collect()
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
