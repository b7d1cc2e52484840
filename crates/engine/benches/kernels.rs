//! Throughput of what a step is made of, on a beam of 24 000 elements: sums over elements for each law in both precisions,
//! factorisation and substitution. `cargo bench -p fem-engine`.

use std::fmt::Write as _;
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use fem_engine::Real;
use fem_engine::forces::{HessianKind, Moment};
use fem_engine::materials::AnyLaw;
use fem_engine::model::system::System;
use fem_engine::solvers::{Preconditioner, SolverChoice};
use fem_scene::{Scene, body, parse};

const LAWS: [&str; 5] = ["linear", "corotated", "st_venant_kirchhoff", "neo_hookean", "stable_neo_hookean"];

/// A beam of 4 m × 1 m × 1 m, clamped at one end.
fn beam(law: &str, cells: usize) -> Scene {
    let mut text = String::from("pipeline = \"engine\"\n");
    writeln!(text, "[mesh]\nbox = {{ size = [4, 1, 1], cells_per_unit = {cells} }}").expect("writing to a string");
    writeln!(text, "[material]\nmodel = \"{law}\"\nyoung = 1e6\npoisson = 0.4\ndensity = 1000.0")
        .expect("writing to a string");
    text += "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[time]\ndt = 0.01\nintegrator = \"implicit_euler\"\n";
    parse(&text, Path::new("beam.toml")).expect("a scene that is right")
}

fn system<T: Real>(scene: &Scene, choice: SolverChoice) -> System<T> {
    let body = body(scene, Path::new("")).expect("a box needs no files");
    let law = AnyLaw::new(&scene.material.value()).expect("a known law with its parameters");
    System::new(body, law, choice)
}

/// Displacements that bend and twist a little, m.
fn bent<T: Real>(system: &System<T>) -> Vec<[T; 3]> {
    let at = |x: &nalgebra::Vector3<f64>| [0.01 * x.y * x.y, 0.02 * x.x * x.x, 0.01 * x.x * x.z].map(T::of);
    system.rest.iter().map(at).collect()
}

/// Sums over elements, for one law in one precision.
fn sums<T: Real>(group: &mut BenchmarkGroup<WallTime>, law: &str, precision: &str) {
    let system = system::<T>(&beam(law, 10), SolverChoice::Cholesky);
    let (u, moment) = (bent(&system), Moment::at(0.0));
    let mut gradient = vec![[T::default(); 3]; system.nodes()];
    let mut values = vec![[[T::default(); 3]; 3]; system.pattern.blocks()];
    group.throughput(Throughput::Elements(system.elements.count() as u64));
    let name = |part: &str| format!("{part}/{law}/{precision}");
    group.bench_function(name("gradient"), |b| b.iter(|| system.gradient(&u, moment, black_box(&mut gradient))));
    group.bench_function(name("energy and gradient"), |b| {
        b.iter(|| system.potential_and_gradient(&u, moment, black_box(&mut gradient)))
    });
    group.bench_function(name("stiffness"), |b| {
        b.iter(|| system.add_stiffness(T::of(1.0), &u, HessianKind::Exact, black_box(&mut values)))
    });
}

fn elements(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("elements");
    group.sample_size(20).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(1));
    for law in LAWS {
        sums::<f64>(&mut group, law, "f64");
        sums::<f32>(&mut group, law, "f32");
    }
    group.finish();
}

/// Preparation and one application of each solver's, on K + M/dt² of beams of 1 225 and 4 961 nodes.
fn solvers(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("solvers");
    group.sample_size(10).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2));
    let choices = [("cholesky", SolverChoice::Cholesky), ("multigrid", SolverChoice::Pcg(Preconditioner::Multigrid))];
    for cells in [6, 10] {
        for (name, choice) in choices {
            let system = system::<f64>(&beam("neo_hookean", cells), choice);
            let mut values = vec![[[0.0; 3]; 3]; system.pattern.blocks()];
            let u = bent(&system);
            system.add_stiffness(1.0, &u, HessianKind::Exact, &mut values);
            system.mass.add_to(1e4, &system.pattern, &mut values);
            let mut solver = system.solver(choice);
            let mut x = vec![[0.0; 3]; system.nodes()];
            group.throughput(Throughput::Elements(system.elements.count() as u64));
            group.bench_function(format!("preparation/{name}/{cells} cells"), |b| {
                b.iter(|| solver.prepare(&values).expect("positive definite"))
            });
            group.bench_function(format!("application/{name}/{cells} cells"), |b| {
                b.iter(|| solver.apply(&u, black_box(&mut x)))
            });
        }
    }
    group.finish();
}

criterion_group!(kernels, elements, solvers);
criterion_main!(kernels);
