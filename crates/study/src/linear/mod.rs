//! Convergence of the linear solvers, iteration by iteration, beside the bounds of Shewchuk, An Introduction to the Conjugate Gradient Method
//! Without the Agonizing Pain (1994), equations 28 and 52: on the matrix of a scene's first step, and on its stiffness.

mod incomplete_cholesky;
mod iterations;

#[cfg(test)]
mod tests;

use std::io;
use std::path::Path;

use fem_chart::{Axis, Chart, Dot, Series};
use fem_engine::forces::Moment;
use fem_engine::simulator::double::{self, System};
use fem_engine::solvers::krylov::{self, Workspace, conjugate_gradients};
use fem_engine::solvers::lanczos::irregular;
use fem_engine::solvers::{Preconditioner, SolverChoice};
use fem_engine::sparse::Pattern;
use fem_engine::vector::{dot, norm};
use fem_model::simulation::Breakdown;
use fem_model::{Body, Integrator};
use fem_scene::Scene;

use crate::study::{Case, Finished, Found, Mark, Page, Part, Study, Table, write};
use fem_reference::space::conditioning::largest_eigenvalue;
use incomplete_cholesky::IncompleteCholesky;
use iterations::{conjugate_directions, steepest_descent};

/// Relative residual at which solvers end, in a whole study and in a short one.
const TOLERANCE: [f64; 2] = [1e-8, 1e-4];

/// Number of nodes beyond which conjugate directions keep too many vectors, and beyond which no system is studied.
const MOST_NODES: [usize; 2] = [1000, 20_000];

/// Part of the first error below which rounding decides.
const ROUND_OFF: f64 = 1e-9;

/// Margin for a condition number that Lanczos's method approaches from below.
const MARGIN: f64 = 1.001;

/// A comparison of the solvers on the systems of scenes.
pub struct LinearSolvers<'a> {
    /// The scenes, each with its body.
    pub systems: Vec<(Scene, Body)>,
    /// Larger residuals.
    pub quick: bool,
    /// The names of the scenes as arguments of the program.
    pub names: &'a [String],
}

const TEXT: &str = "Each solver starts from zero. The error is that of the solution in the energy norm, √(eᵀ A e), against a direct solve. With the condition \
    number κ of the matrix, steepest descent multiplies it by at most (κ − 1)/(κ + 1) an iteration, and conjugate gradients have \
    at most 2 ((√κ − 1)/(√κ + 1))ⁱ of it after i (Shewchuk 1994).";

impl Study for LinearSolvers<'_> {
    type Row = Part;

    fn arguments(&self) -> Vec<String> {
        let options = ["--linear"].into_iter().chain(self.quick.then_some("--quick")).map(str::to_owned);
        ["report".to_owned()].into_iter().chain(self.names.iter().cloned()).chain(options).collect()
    }

    fn cases(&self) -> Vec<Case<'_, Part>> {
        let mut cases = Vec::new();
        for (scene, body) in &self.systems {
            let mut add = |name: &'static str, title: &'static str, dt: Option<f64>| {
                let work = move || self.part(scene, body, dt, name).unwrap_or_else(Part::failed).titled(name, title);
                cases.push(Case::new(format!("{}, {name}", scene.name), work));
            };
            if scene.time.integrator != Integrator::Static {
                add("step", "The first step", Some(scene.time.dt()));
            }
            // A free body has a singular stiffness.
            if !body.dirichlet.is_empty() {
                add("stiffness", "The stiffness", None);
            }
        }
        cases
    }

    fn finish(&self, found: Found<Part>, out: &Path) -> io::Result<Finished> {
        let title = "Convergence of linear solvers";
        let Found { rows: parts, machine, .. } = found;
        let page = Page { name: "linear", title, text: TEXT, machine, quick: self.quick, parts };
        write(&page, out)?;
        let line = |mark: &Mark| {
            let holds = if mark.holds == Some(true) { "holds" } else { "DOES NOT HOLD" };
            format!("{holds}: {}: {}", mark.statement, mark.ours)
        };
        let mut lines: Vec<String> = page.marks().map(|(_, mark)| line(mark)).collect();
        lines.push(out.join("linear.html").display().to_string());
        let holds = page.parts.iter().all(Part::passes);
        Ok(Finished { lines, failed: (!holds).then(|| "a bound does not hold".to_owned()) })
    }
}

/// Returns an error if a body has too many nodes for this study.
pub fn check(scene: &Scene, body: &Body) -> Result<(), String> {
    let (nodes, most) = (body.shape.mesh.vertices().len(), MOST_NODES[1]);
    match nodes > most {
        true => Err(format!("{}: has {nodes} nodes; solvers are compared on at most {most}", scene.name)),
        false => Ok(()),
    }
}

/// A linear system with its condition number and its solution.
struct LinearSystem {
    system: System,
    values: Vec<[[f64; 3]; 3]>,
    b: Vec<[f64; 3]>,
    exact: Vec<[f64; 3]>,
    condition: f64,
}

/// The residual over the first one and the error in the energy norm of an iterate.
type Iterate = [f64; 2];

impl LinearSystem {
    /// M/dt² + K of the first step, or K without a time step; the right-hand side is the force at the start.
    fn new(name: &str, body: Body, dt: Option<f64>) -> Result<Self, String> {
        let system = double::system(body, SolverChoice::Lu);
        let undeformed = vec![[0.0; 3]; system.nodes()];
        let mut values = vec![[[0.0; 3]; 3]; system.pattern.blocks()];
        double::add_stiffness(&system, &undeformed, &mut values);
        double::add_external_hessian(&system, &undeformed, &mut values);
        if let Some(dt) = dt {
            system.mass.add_to(1.0 / (dt * dt), &system.pattern, &mut values);
        }
        system.dirichlet.eliminate(&system.pattern, &mut values);
        let mut b = undeformed.clone();
        double::force(&system, &undeformed, &undeformed, Moment::at(dt.unwrap_or(0.0)), &mut b);
        system.dirichlet.clear_constrained(&mut b);
        // Without loads every vibration takes part.
        if norm(&b) == 0.0 {
            b = irregular(system.nodes());
            system.dirichlet.clear_constrained(&mut b);
        }
        let failed = |cause: fem_model::simulation::Breakdown| format!("{name}: its matrix has no factor: {cause}");
        let mut direct = system.solver(SolverChoice::Lu);
        direct.prepare(&values).map_err(failed)?;
        let mut exact = undeformed;
        direct.solve(&values, &b, &mut exact, 1e-13).map_err(failed)?;
        let largest = largest_eigenvalue(&system, |x, y| times(&system.pattern, &values, x, y));
        let smallest = 1.0 / largest_eigenvalue(&system, |x, y| direct.apply(x, y));
        Ok(Self { condition: MARGIN * largest / smallest, system, values, b, exact })
    }

    /// The iterates of a method, from zero to a relative residual, or to the breakdown that ends it early.
    fn iterates(&self, method: Method, tolerance: f64) -> (Vec<Iterate>, Option<Breakdown>) {
        let Self { system: System { pattern, .. }, values, b, exact, .. } = self;
        let (b, exact) = (&b[..pattern.rows()], &exact[..pattern.rows()]);
        let (mut x, mut e, mut product) = (vec![[0.0; 3]; b.len()], exact.to_vec(), exact.to_vec());
        let mut found = Vec::new();
        let size = norm(b);
        let mut observe = |x: &[[f64; 3]]| {
            for (e, (x, exact)) in e.iter_mut().zip(x.iter().zip(exact)) {
                *e = [0, 1, 2].map(|i| exact[i] - x[i]);
            }
            // b − A x = A e
            times(pattern, values, &e, &mut product);
            found.push([norm(&product) / size, dot(&product, &e).max(0.0).sqrt()]);
        };
        let largest_entry = || {
            let entries = pattern.diagonal().flat_map(|block| (0..3).map(move |i| values[block][i][i].abs()));
            entries.fold(0.0, f64::max)
        };
        let A = |x: &[[f64; 3]], y: &mut [[f64; 3]]| times(pattern, values, x, y);
        let of = krylov::LinearSystem { A, largest_entry, b, tolerance };
        let room = &mut Workspace::new(b.len());
        let solved = match method {
            Method::SteepestDescent => steepest_descent(of, &mut x, &mut observe),
            Method::ConjugateDirections => conjugate_directions(of, &mut x, &mut observe),
            Method::IncompleteCholesky => IncompleteCholesky::new(pattern, values)
                .and_then(|factor| conjugate_gradients(of, |r, z| factor.apply(r, z), &mut x, room, &mut observe)),
            Method::Gradients(preconditioner) => {
                let mut solver = self.system.solver(preconditioner.map_or(SolverChoice::Cg, SolverChoice::Pcg));
                solver
                    .prepare(values)
                    .and_then(|()| conjugate_gradients(of, |r, z| solver.apply(r, z), &mut x, room, &mut observe))
            }
        };
        (found, solved.err())
    }
}

/// An iteration for linear systems.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Method {
    SteepestDescent,
    ConjugateDirections,
    /// Conjugate gradients, with a preconditioner of the engine.
    Gradients(Option<Preconditioner>),
    /// Conjugate gradients with the factor of [`IncompleteCholesky`].
    IncompleteCholesky,
}

/// y = A x for the rows of the matrix.
fn times(pattern: &Pattern, values: &[[[f64; 3]; 3]], x: &[[f64; 3]], y: &mut [[f64; 3]]) {
    for row in 0..pattern.rows() {
        y[row] = [0.0; 3];
        for block in pattern.row(row) {
            let x = x[pattern.columns[block] as usize];
            for i in 0..3 {
                y[row][i] += values[block][i][0] * x[0] + values[block][i][1] * x[1] + values[block][i][2] * x[2];
            }
        }
    }
}

/// The methods with their names, and the bound of each: a factor, and the factor of an iteration for the condition number.
type Bounded = (&'static str, Method, Option<(f64, fn(f64) -> f64)>);

const METHODS: [Bounded; 6] = [
    ("steepest_descent", Method::SteepestDescent, Some((1.0, |kappa| (kappa - 1.0) / (kappa + 1.0)))),
    ("conjugate_directions", Method::ConjugateDirections, Some((2.0, of_root))),
    ("cg", Method::Gradients(None), Some((2.0, of_root))),
    ("pcg, block_jacobi", Method::Gradients(Some(Preconditioner::BlockJacobi)), None),
    ("pcg, incomplete_cholesky", Method::IncompleteCholesky, None),
    ("pcg, multigrid", Method::Gradients(Some(Preconditioner::Multigrid)), None),
];

fn of_root(kappa: f64) -> f64 {
    (kappa.sqrt() - 1.0) / (kappa.sqrt() + 1.0)
}

impl LinearSolvers<'_> {
    fn part(&self, scene: &Scene, body: &Body, dt: Option<f64>, file: &str) -> Result<Part, String> {
        let of = LinearSystem::new(&scene.name, body.clone(), dt)?;
        let tolerance = TOLERANCE[usize::from(self.quick)];
        let what = match dt {
            Some(dt) => format!("M/dt² + K of the first step of {dt} s of `{}`", scene.name),
            None => format!("the stiffness K of `{}`", scene.name),
        };
        let name = format!("linear-{}-{file}", scene.name);
        let (mut marks, mut rows, mut series) = (Vec::new(), Vec::new(), Vec::new());
        for (colour, (method, iteration, bound)) in METHODS.into_iter().enumerate() {
            if iteration == Method::ConjugateDirections && of.system.nodes() > MOST_NODES[0] {
                continue;
            }
            let (found, breakdown) = of.iterates(iteration, tolerance);
            let Some(first) = found.first().map(|iterate| iterate[1]) else { continue };
            let mut curve = Series::line(method, colour, [] as [Dot; 0]);
            let mut limit = Series::line("", colour, [] as [Dot; 0]);
            let mut worst: f64 = 0.0;
            for (i, [residual, error]) in found.iter().enumerate() {
                let part = error / first;
                let bound = bound.map(|(factor, rate)| factor * rate(of.condition).powf(i as f64));
                if let Some(bound) = bound.filter(|_| part > ROUND_OFF) {
                    worst = worst.max(part / bound);
                }
                if is_shown(i) || i + 1 == found.len() {
                    curve.dots.push((i as f64 + 1.0, part).into());
                    limit.dots.extend(bound.map(|y| Dot::from((i as f64 + 1.0, y))));
                    let told = bound.map_or(String::new(), |bound| format!("{bound:.6e}"));
                    rows.push(vec![
                        method.to_owned(),
                        i.to_string(),
                        format!("{residual:.6e}"),
                        format!("{part:.6e}"),
                        told,
                    ]);
                }
            }
            if bound.is_some() {
                let end = breakdown.map_or(String::new(), |breakdown| format!(", ended early: {breakdown}"));
                let figure = format!("{} iterations, at most {worst:.3} of the bound{end}", found.len() - 1);
                marks.push(Mark::new(
                    format!("{method} stays below its bound at every iteration"),
                    figure,
                    worst <= 1.0,
                ));
                series.push(limit);
            }
            series.push(curve);
        }
        let chart = Chart {
            series,
            ..Chart::new(&what, Axis::log("iteration + 1"), Axis::log("error over the first one, energy norm"))
        };
        let text =
            format!("The matrix is {what}: {} unknowns, κ = {:.4e}.", 3 * of.system.free(), of.condition / MARGIN);
        let table = Table::new(&name, "solver | >iteration | >residual | >error | >bound", rows);
        let caption = format!("Solvers on {what}; lines without a name are bounds.");
        Ok(Part::new(text).marks(marks).tables([table]).chart(name, &chart, caption))
    }
}

/// Returns true if an iteration is shown in the table and in the picture: the first fifty, and then twenty in each decade.
fn is_shown(i: usize) -> bool {
    let place = |i: usize| (20.0 * (i as f64).log10()).floor();
    i < 50 || place(i) > place(i - 1)
}
