//! Quadratic triangles in equilibrium.

use fem_mesh::{Mesh, Pattern, rectangle_mesh};
use fem_model::simulation::Simulation;
use fem_model::{BodyMesh, Law};

use crate::flat::{affine, flat};
use crate::{block, build, distance, run, side, soft};

/// The strip of [`flat`] with quadratic triangles.
pub fn quadratic(text: &str) -> String {
    flat(text).replace("cells_per_unit = 3 }", "cells_per_unit = 3 }\norder = 2")
}

fn mesh() -> Mesh<3, 6> {
    let linear = rectangle_mesh([2.0, 1.0], 3, Pattern::Alternating).unwrap();
    BodyMesh::flat(linear, 1.0).of_order(2).unwrap().mesh().unwrap()
}

fn solved(text: &str) -> Box<dyn Simulation> {
    let mut simulation = build(text);
    run(&mut *simulation, 1);
    simulation
}

const WEIGHT: &str = "[gravity]\nacceleration = [1, -3, 0]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";

#[test]
fn an_affine_state_is_an_equilibrium_with_the_energy_and_the_stress_of_linear_triangles_for_every_law() {
    let G = [[0.08, 0.05], [-0.02, -0.03]];
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        let simulation = solved(&quadratic(&block(model, &affine(&mesh(), G))));
        let q = simulation.positions();
        for (node, x) in mesh().vertices.iter().enumerate() {
            let expected = [0, 1].map(|i| x[i] + G[i][0] * x.x + G[i][1] * x.y);
            (0..2).for_each(|i| assert!((q[3 * node + i] - expected[i]).abs() < 1e-12, "{model}, node {node}"));
        }
        let linear =
            solved(&flat(&block(model, &affine(&rectangle_mesh([2.0, 1.0], 3, Pattern::Alternating).unwrap(), G))));
        let [found, expected] = [&simulation, &linear].map(|simulation| simulation.energies().potential);
        assert!((found - expected).abs() < 1e-12 * expected, "{model}: {found} {expected}");
        let [found, expected] = [&simulation, &linear].map(|simulation| simulation.stresses()[5]);
        assert!((found - expected).amax() < 1e-9 * expected.amax(), "{model}: {found} {expected}");
        assert_eq!(simulation.stresses().len(), mesh().elements.len());
    }
}

/// Pure bending, exactly: u = (κ x y, −κ/2 (x² + ν' y²)) with ν' = ν/(1 − ν) in plane strain and ν in plane stress, about y = 0.
fn bent(plane: &str, ratio: f64) -> f64 {
    let curvature = 0.01;
    let exact = |x: f64, y: f64| [curvature * x * y, -0.5 * curvature * (x * x + ratio * y * y)];
    let mut tables = String::new();
    for (node, X) in mesh().vertices.iter().enumerate() {
        if X.x == 0.0 || X.x == 2.0 || X.y == 0.0 || X.y == 1.0 {
            let [u, v] = exact(X.x, X.y);
            let components = "components = [\"x\", \"y\"]";
            tables += &format!("[[prescribed]]\nnodes = [{node}]\ndisplacement = [{u:e}, {v:e}, 0]\n{components}\n");
        }
    }
    let text =
        quadratic(&block("linear", &tables)).replace("[material]\n", &format!("[material]\nplane = \"{plane}\"\n"));
    let q = solved(&text).positions();
    let error = |(node, X): (usize, &nalgebra::Vector3<f64>)| {
        let u = exact(X.x, X.y);
        (0..2).map(|i| (q[3 * node + i] - X[i] - u[i]).abs()).fold(0.0, f64::max)
    };
    mesh().vertices.iter().enumerate().map(error).fold(0.0, f64::max)
}

#[test]
fn pure_bending_is_exact_in_plane_strain_and_in_plane_stress() {
    assert!(bent("strain", 0.3 / 0.7) < 1e-13);
    assert!(bent("stress", 0.3) < 1e-13);
    // Another lateral contraction is no equilibrium.
    assert!(bent("stress", 0.0) > 1e-5);
}

#[test]
fn reactions_carry_the_weight_with_either_mass() {
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        for mass in ["", "[mass]\nlumped = true\n"] {
            let force = solved(&quadratic(&block(model, &format!("{WEIGHT}{mass}")))).reactions()[0].force;
            for (found, weight) in force.iter().zip([600.0, -1800.0, 0.0]) {
                assert!((found + weight).abs() < 1e-9 * 1800.0, "{model}: {force:?}");
            }
        }
    }
}

#[test]
fn a_traction_on_an_edge_leaves_a_uniform_stress() {
    let tables = side("x", "min", 0.0)
        + &side("y", "min", 0.0)
        + "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nforce_per_area = [200, 0, 0]\n";
    let simulation = solved(&quadratic(&block("linear", &tables)));
    for stress in simulation.stresses() {
        assert!((stress[(0, 0)] - 200.0).abs() < 1e-9 && stress[(1, 1)].abs() < 1e-9, "{stress}");
    }
    assert!((simulation.reactions()[0].force[0] + 200.0 * 0.3).abs() < 1e-10 * 60.0);
}

/// Deflection of the tip of a strip of 8 × 1 m with `cells` squares per metre that is fixed at one end and pulled down at the other, over
/// Timoshenko's, in plane stress with ν = 0.3.
fn tip(cells: usize, order: u32) -> f64 {
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [8, 1], cells_per_unit = {cells} }}\norder = {order}\n\
         [material]\nplane = \"stress\"\nmodel = \"linear\"\nyoung = 1e6\npoisson = 0.3\ndensity = 1000\n\
         [time]\nintegrator = \"static\"\n[fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n\
         [[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\nforce_per_area = [0, -10, 0]\n"
    );
    let simulation = solved(&text);
    let (q, shape) = (simulation.positions(), simulation.shape());
    let node = shape.mesh.vertices().iter().position(|x| x.x == 8.0 && x.y == 0.0).unwrap();
    let (length, force, young, shear): (f64, f64, f64, f64) = (8.0, 10.0, 1e6, 1e6 / 2.6);
    let factor = 10.0 * 1.3 / (12.0 + 11.0 * 0.3);
    let expected = force * length.powi(3) / (3.0 * young / 12.0) + force * length / (factor * shear);
    -q[3 * node + 1] / expected
}

#[test]
fn a_cantilever_of_two_layers_bends_as_timoshenko_says_where_linear_triangles_are_far_too_stiff() {
    let (linear, quadratic, fine) = (tip(2, 1), tip(1, 2), tip(2, 2));
    assert!(linear < 0.8, "{linear}");
    assert!((quadratic - 1.0).abs() < 0.02, "{quadratic}");
    assert!((fine - 1.0).abs() < 0.01, "{fine}");
}

#[test]
fn every_solver_and_single_precision_find_the_same_equilibrium() {
    let end = |extra: &str, precision: &str| {
        let text = quadratic(&soft("implicit_euler", 0.02, &format!("{WEIGHT}{extra}")));
        let mut simulation = build(&text.replace("dt = 2e-2", &format!("dt = 2e-2\n{precision}")));
        run(&mut *simulation, 10);
        simulation.positions()
    };
    let expected = end("", "");
    let preconditioned = |name: &str| format!("kind = \"pcg\"\npreconditioner = \"{name}\"");
    let mut solvers = vec!["kind = \"cholesky\"".to_owned(), "kind = \"lu\"".to_owned(), "kind = \"cg\"".to_owned()];
    solvers.extend(["block_jacobi", "ssor", "multigrid"].map(preconditioned));
    for solver in solvers {
        let error = distance(&end(&format!("[solver]\n{solver}\n"), ""), &expected);
        assert!(error < 1e-8, "{solver}: {error:e} m");
    }
    let error = distance(&end("", "precision = \"f32\""), &expected);
    assert!(error < 1e-5 * 2.0, "{error:e} m");
}

#[test]
fn parts_of_two_equal_materials_are_one_body() {
    let region = "[[materials]]\nbox = { min = [1, 0, 0], max = [2, 1, 0] }\nmodel = \"neo_hookean\"\nyoung = 1e5\npoisson = 0.3\ndensity = 1000\n";
    let [whole, parts] = ["", region].map(|region| {
        let simulation = solved(&quadratic(&block("neo_hookean", &format!("{WEIGHT}{region}"))));
        (simulation.positions(), simulation.stresses(), simulation.min_J())
    });
    assert!(distance(&whole.0, &parts.0) < 1e-12);
    assert!(whole.1.iter().zip(&parts.1).all(|(a, b)| (a - b).amax() < 1e-6));
    assert!((whole.2.0 - parts.2.0).abs() < 1e-12 && whole.2.1 == parts.2.1 && whole.2.1 < mesh().elements.len());
}

#[test]
fn other_orders_are_refused() {
    let third = quadratic(&soft("static", 1.0, "")).replace("order = 2", "order = 3");
    let error = fem_scene::parse(&third, "a.toml".as_ref()).unwrap_err().to_string();
    assert!(error.contains("mesh.order is 3; write 1"), "{error}");
}

#[test]
fn stresses_at_points_are_those_of_the_places_that_the_mesh_gives() {
    let table = "pipeline = \"engine\"\n[mesh]\nrectangle = { size = [1, 1], cells_per_unit = 1 }\norder = 2\n\
         [material]\nmodel = \"linear\"\nyoung = 1e5\npoisson = 0.25\ndensity = 1000\n[time]\ndt = 1e-3\nintegrator = \"implicit_euler\"\n";
    let shape = build(table).shape();
    // u_x = 0.01 x², so that σ_xx = (λ + 2 μ) 0.02 x with λ = μ = 4e4 Pa.
    let motions =
        shape.mesh.vertices().iter().enumerate().map(|(node, X)| {
            format!("[[prescribed]]\nnodes = [{node}]\ndisplacement = [{:e}, 0, 0]\n", 0.01 * X.x * X.x)
        });
    let mut simulation = build(&format!("{table}{}", motions.collect::<String>()));
    run(&mut *simulation, 1);
    let places = (0..shape.mesh.elements()).flat_map(|element| shape.mesh.points(element));
    let stresses = simulation.stresses_at_points();
    assert_eq!(stresses.len(), 6);
    for (place, stress) in places.zip(stresses) {
        assert!((stress[(0, 0)] - 1.2e5 * 0.02 * place.x).abs() < 1e-8, "{place} {stress}");
    }
}
