//! Costs of the parts of a step.

use std::path::Path;
use std::time::Instant;

use fem_engine::forces::{HessianKind, Moment};
use fem_engine::materials::AnyLaw;
use fem_engine::model::system::System;
use fem_engine::solvers::{Preconditioner, SolverChoice};
use fem_output::quantile;
use fem_study::machine::Machine;

use crate::cli::{RunArguments, SolverName};
use crate::end::End;

/// Least duration, s, and least number of repetitions of each part.
const LONG_ENOUGH: (f64, usize) = (0.5, 15);

/// Times each part alone, on a slightly bent body, and prints a table.
pub fn run(arguments: &RunArguments) -> Result<(), End> {
    let scene = arguments.scene().map_err(End::unusable)?;
    let body = fem_scene::body(&scene, &arguments.data).map_err(End::unusable)?;
    let Some(law) = AnyLaw::new(&body.material) else {
        return Err(End::unusable(
            scene.refuse("material", "is a body of springs, whose parts are others; write a law"),
        ));
    };
    let name = arguments.solver.unwrap_or(SolverName::Cholesky);
    let system = System::<f64>::new(body, law, choice(name));
    let (nodes, free, elements) = (system.nodes(), system.free(), system.elements.count());
    println!("{}\n", Machine::this(Path::new(".")).line());
    println!("{}: {nodes} nodes, {free} free, {elements} elements, {} blocks\n", scene.name, system.pattern.blocks());
    println!("| part | µs | fastest, µs | ns per element |\n|---|---:|---:|---:|");
    elastic(&system)?;
    linear(&system, name, scene.time.dt())
}

fn choice(name: SolverName) -> SolverChoice {
    match name {
        SolverName::Cholesky => SolverChoice::Cholesky,
        SolverName::BlockJacobi => SolverChoice::Pcg(Preconditioner::BlockJacobi),
        SolverName::Multigrid => SolverChoice::Pcg(Preconditioner::Multigrid),
        SolverName::Ssor => SolverChoice::Pcg(Preconditioner::Ssor),
    }
}

/// Displacements of slight bending and torsion, m.
fn bent(system: &System<f64>) -> Vec<[f64; 3]> {
    let by = 0.01 / system.length;
    system.rest.iter().map(|x| [by * x.y * x.y, 2.0 * by * x.x * x.x, by * x.x * x.z]).collect()
}

/// Assemblies over all elements.
fn elastic(system: &System<f64>) -> Result<(), End> {
    let (u, moment, count) = (bent(system), Moment::at(0.0), system.elements.count());
    let mut gradient = vec![[0.0; 3]; system.nodes()];
    let mut values = vec![[[0.0; 3]; 3]; system.pattern.blocks()];
    time("energy", count, || {
        std::hint::black_box(system.potential(&u, moment));
        Ok(())
    })?;
    time("gradient", count, || {
        system.gradient(&u, moment, &mut gradient);
        Ok(())
    })?;
    time("energy and gradient", count, || {
        std::hint::black_box(system.potential_and_gradient(&u, moment, &mut gradient));
        Ok(())
    })?;
    time("stiffness", count, || {
        system.add_stiffness(1.0, &u, HessianKind::Exact, &mut values);
        Ok(())
    })?;
    time("projected stiffness", count, || {
        system.add_stiffness(1.0, &u, HessianKind::Projected, &mut values);
        Ok(())
    })?;
    time("stiffness times vector, without a matrix", count, || {
        system.add_stiffness_times(1e-9, &u, &u, &mut gradient);
        Ok(())
    })?;
    time("smallest J", count, || {
        std::hint::black_box(system.elements.min_det_F(&u));
        Ok(())
    })
}

/// Mass, and the linear solver on K + M/dt².
fn linear(system: &System<f64>, name: SolverName, dt: f64) -> Result<(), End> {
    let (u, count) = (bent(system), system.elements.count());
    let mut product = vec![[0.0; 3]; system.nodes()];
    let mut values = vec![[[0.0; 3]; 3]; system.pattern.blocks()];
    time("mass times vector", count, || {
        system.mass.add_times(1e-9, &u, &mut product);
        Ok(())
    })?;
    time("mass into the matrix", count, || {
        system.mass.add_to(0.0, &system.pattern, &mut values);
        Ok(())
    })?;
    system.add_stiffness(1.0, &u, HessianKind::Exact, &mut values);
    system.mass.add_to(1.0 / (dt * dt), &system.pattern, &mut values);
    let mut solver = system.solver(choice(name));
    let mut x = vec![[0.0; 3]; system.nodes()];
    time(&format!("preparation, {}", name.name()), count, || solver.prepare(&values).map_err(End::wrong))?;
    time("one application of it", count, || {
        solver.apply(&u, &mut x);
        Ok(())
    })?;
    time("solution to 1e-12", count, || {
        x.fill([0.0; 3]);
        solver.solve(&values, &u, &mut x, 1e-12).map(|_| ()).map_err(End::wrong)
    })
}

/// Repeats the work and prints its row.
fn time(what: &str, elements: usize, mut work: impl FnMut() -> Result<(), End>) -> Result<(), End> {
    work()?;
    let (start, mut seconds) = (Instant::now(), Vec::new());
    while seconds.len() < LONG_ENOUGH.1 || start.elapsed().as_secs_f64() < LONG_ENOUGH.0 {
        let start = Instant::now();
        work()?;
        seconds.push(start.elapsed().as_secs_f64());
    }
    let at = |fraction| quantile(&seconds, fraction).unwrap_or(f64::NAN);
    let (median, fastest) = (at(0.5), at(0.0));
    println!("| {what} | {:.1} | {:.1} | {:.1} |", 1e6 * median, 1e6 * fastest, 1e9 * median / elements.max(1) as f64);
    Ok(())
}
