//! The methods on a short beam: beside their bounds, beside each other, and on matrices that have no solution.

use fem_engine::solvers::SolverChoice;
use fem_model::simulation::Breakdown;
use fem_model::{Axis, Body, Elastic, Law, Material, NeoHookean, Selector};

use super::*;
use std::path::Path;

/// The stiffness of a short beam, fixed at one end, with a right-hand side of all frequencies.
fn system() -> LinearSystem {
    let mesh = fem_mesh::box_mesh([2.0, 1.0, 1.0], 2, fem_mesh::Pattern::Kuhn).unwrap();
    let rubber = Material::new(Law::NeoHookean(NeoHookean::Elastic(Elastic::new(1e5, 0.3))), 1000.0);
    let body = Body::new(mesh, rubber).unwrap().fix(&Selector::least(Axis::X)).unwrap();
    LinearSystem::new("beam", body, None).unwrap()
}

#[test]
fn every_bound_holds_on_a_step_and_on_a_stiffness_and_descent_takes_the_most_iterations() {
    let text = "pipeline = \"engine\"\n[mesh]\nbox = { size = [2, 1, 1], cells_per_unit = 3, pattern = \"kuhn\" }\n[material]\nmodel = \"neo_hookean\"\n\
                young = 1e5\npoisson = 0.3\ndensity = 1000\n[gravity]\nacceleration = [0, 0, -9.81]\n[fixed]\n\
                plane = { axis = \"x\", below = 1e-9 }\n[time]\ndt = 0.01\nintegrator = \"implicit_euler\"\n";
    let scene = fem_scene::parse(text, Path::new("beam.toml")).unwrap();
    let body = fem_scene::body(&scene, Path::new("")).unwrap();
    let found = crate::study::rows(&LinearSolvers { systems: vec![(scene, body)], quick: true, names: &[] }).rows;
    assert_eq!(found.len(), 2);
    for part in &found {
        assert_eq!(part.marks.len(), 3);
        assert!(part.passes(), "{}: {:#?}", part.title, part.marks);
        let iterations = |name: &str| {
            let mut rows = part.tables[0].rows.iter().filter(|row| row[0] == name);
            rows.next_back().unwrap()[1].parse::<usize>().unwrap()
        };
        assert!(iterations("steepest_descent") > 2 * iterations("cg"), "{}", part.title);
        assert!(iterations("cg") > iterations("pcg, multigrid"), "{}", part.title);
        // Rounding errors cost conjugate gradients some conjugacy, which all kept directions keep; they decide the last iteration, too.
        assert!(iterations("cg") + 1 >= iterations("conjugate_directions"), "{}", part.title);
    }
}

#[test]
fn conjugate_directions_have_the_iterates_of_conjugate_gradients_and_descent_takes_more() {
    let system = system();
    let errors = |method: Method, tolerance| {
        let (iterates, breakdown) = system.iterates(method, tolerance);
        assert_eq!(breakdown, None);
        iterates.into_iter().map(|[_, error]| error).collect::<Vec<_>>()
    };
    let directions = errors(Method::ConjugateDirections, 1e-10);
    let gradients = errors(Method::Gradients(None), 1e-10);
    for (i, (one, other)) in directions.iter().zip(&gradients).take(20).enumerate() {
        assert!((one - other).abs() < 1e-9 * directions[0], "iteration {i}: {one:e} and {other:e}");
    }
    // Round-off decides the last iteration.
    let most = gradients.len().min(3 * system.system.free()) + 1;
    assert!(directions.len() <= most, "{} of {most} iterates", directions.len());
    let descent = errors(Method::SteepestDescent, 1e-6);
    assert!(descent.len() > 4 * errors(Method::Gradients(None), 1e-6).len(), "{} iterates of descent", descent.len());
    for errors in [descent, directions] {
        assert!(errors.windows(2).all(|pair| pair[1] <= pair[0] * (1.0 + 1e-12) + 1e-12 * errors[0]));
    }
}

#[test]
fn an_indefinite_matrix_and_numbers_that_are_none_are_reported() {
    for (factor, breakdown) in [(-1.0, Breakdown::NotPositiveDefinite), (f64::NAN, Breakdown::Singular)] {
        let mut system = system();
        system.values.iter_mut().flatten().flatten().for_each(|value| *value *= factor);
        for method in [Method::SteepestDescent, Method::ConjugateDirections, Method::Gradients(None)] {
            assert_eq!(system.iterates(method, 1e-10).1, Some(breakdown), "{method:?}");
        }
        assert!(system.iterates(Method::IncompleteCholesky, 1e-10).1.is_some());
    }
}

#[test]
fn preconditioned_gradients_take_fewer_iterations() {
    let system = system();
    let iterations = |method| system.iterates(method, 1e-8).0.len();
    let plain = iterations(Method::Gradients(None));
    assert!(iterations(Method::IncompleteCholesky) < plain);
    assert!(iterations(Method::Gradients(Some(Preconditioner::BlockJacobi))) < plain);
    assert!(system.system.solver(SolverChoice::Cg).prepare(&system.values).is_ok());
}
