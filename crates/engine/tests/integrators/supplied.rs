//! Energy that a run is given beside its loads: by moving planes, by prescribed motions from rest, and by contact, which gives none.

use crate::build;

const CUBE: &str = "pipeline = \"engine\"\n[mesh]\nbox = { size = [1, 1, 1], cells_per_unit = 2 }\n";

/// The largest total and kinetic energy in so many steps, J.
fn largest_energies(text: &str, steps: usize) -> [f64; 2] {
    let mut simulation = build(text);
    let mut largest = [f64::NEG_INFINITY; 2];
    for _ in 0..steps {
        simulation.step().unwrap_or_else(|failure| panic!("{failure}\n{text}"));
        let energies = simulation.energies();
        largest = [largest[0].max(energies.total()), largest[1].max(energies.kinetic)];
    }
    largest
}

#[test]
fn a_plane_that_hits_a_body_at_rest_gives_it_at_most_twice_its_speed() {
    for integrator in ["newmark", "implicit_midpoint", "generalized_alpha", "bdf2", "implicit_euler"] {
        let text = format!(
            "{CUBE}[material]\nmodel = \"corotated\"\nyoung = 1e6\npoisson = 0.3\ndensity = 1000.0\n[[planes]]\npoint = [0, -0.05, 0]\n\
             normal = [0, 1, 0]\nvelocity = [0, 1, 0]\nuntil = 0.2\n[time]\nintegrator = \"{integrator}\"\ndt = 0.002\n"
        );
        let [total, kinetic] = largest_energies(&text, 100);
        // 1000 kg at up to 2 m/s.
        assert!(kinetic > 100.0 && total < 2100.0, "{integrator}: {kinetic} J, {total} J in all");
    }
}

#[test]
fn a_prescribed_motion_that_starts_from_rest_is_no_growth_without_bound() {
    for integrator in ["semi_implicit_euler", "explicit_euler", "verlet", "rk2", "rk4", "linearly_implicit_euler"] {
        let text = format!(
            "{CUBE}[material]\nmodel = \"corotated\"\nyoung = 1e5\npoisson = 0.3\ndensity = 1000.0\n[[prescribed]]\n\
             on = {{ axis = \"x\", side = \"min\", within = 1e-9 }}\nvelocity = [0.3, 0.5, 0]\ncurve = {{ sine = {{ frequency = 4.0 }} }}\n\
             [time]\nintegrator = \"{integrator}\"\ndt = 1e-4\n"
        );
        let [_, kinetic] = largest_energies(&text, 60);
        assert!(kinetic > 1e-3, "{integrator}: {kinetic} J");
    }
}

#[test]
fn a_falling_body_gains_nothing_from_a_plane_whatever_newmarks_parameters_are() {
    for beta in [0.0834, 0.15, 0.25, 0.4] {
        let text = format!(
            "{CUBE}[material]\nmodel = \"neo_hookean\"\nyoung = 2e5\npoisson = 0.3\ndensity = 1000.0\n[gravity]\nacceleration = [0, -9.81, 0]\n\
             [[planes]]\npoint = [0, -0.1, 0]\nnormal = [0, 1, 0]\n[newmark]\nbeta = {beta}\n[time]\nintegrator = \"newmark\"\ndt = 5e-4\n"
        );
        let [total, kinetic] = largest_energies(&text, 600);
        assert!(kinetic > 500.0 && total < 1e-6, "β = {beta}: {kinetic} J, {total} J in all");
    }
}
