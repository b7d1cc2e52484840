//! The programs of `examples/` compute the results that they print.

use std::path::Path;

#[path = "../examples/01_patch_test.rs"]
mod patch_test;

#[path = "../examples/02_own_potential.rs"]
mod own_potential;

#[path = "../examples/03_own_integrator.rs"]
mod own_integrator;

#[path = "../examples/04_mesh_in_stress_out.rs"]
mod mesh_in_stress_out;

#[path = "../examples/05_own_study.rs"]
mod own_study;

#[test]
fn every_law_passes_the_patch_test() {
    for (law, stress, difference) in patch_test::run().unwrap() {
        assert!(difference < 1e-8, "{law}: {difference:e}");
        // Young's modulus times 20 %, within the nonlinearity of the laws.
        assert!((1e5..4e5).contains(&stress), "{law}: {stress:e} Pa");
    }
}

#[test]
fn a_floor_of_ones_own_carries_the_weight_of_the_cube() {
    let (force, weight) = own_potential::run().unwrap();
    // After 6 s, implicit Euler has damped the bouncing to a hundred-thousandth.
    assert!((force / weight - 1.0).abs() < 1e-5, "{force} N, {weight} N");
}

#[test]
fn an_integrator_of_ones_own_has_its_order() {
    let [coarse, fine] = own_integrator::run().unwrap();
    let order = (coarse / fine).log2();
    assert!((order - 4.0).abs() < 0.3, "{order}: {coarse:e} J, {fine:e} J");
}

#[test]
fn the_stress_of_a_mesh_balances_its_weight_and_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("stress.vtu");
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/own/armadillo_own_coarse.node");
    let found = mesh_in_stress_out::run(&mesh, &out).unwrap();
    assert!(found.von_mises > 1e3 && found.von_mises.is_finite(), "{:e} Pa", found.von_mises);
    assert!((found.reaction[1] / found.weight - 1.0).abs() < 1e-7, "{:?} N, {} N", found.reaction, found.weight);
    let written = fem_mesh::read_tetrahedra(&out).unwrap();
    assert_eq!(written, fem_mesh::read_tetrahedra(&mesh).unwrap());
    assert!(found.element < written.elements.len());
}

#[test]
fn the_methods_of_the_study_have_their_orders() {
    for row in own_study::run().unwrap() {
        let order = row.observed_order();
        assert!((order - row.expected_order).abs() < 0.1, "{}: {order}, errors {:?}", row.method.name(), row.errors);
    }
}

#[test]
fn the_program_of_the_readme_is_the_one_that_the_engine_s_documentation_runs() {
    let read = |path: &str| std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap();
    let (readme, engine) = (read("README.md"), read("crates/engine/src/lib.rs"));
    let program = readme.split_once("```rust\n").unwrap().1.split_once("```").unwrap().0;
    let documented: String = program.lines().map(|line| format!("//! {line}").trim_end().to_owned() + "\n").collect();
    assert!(engine.contains(&documented), "{program}");
}
