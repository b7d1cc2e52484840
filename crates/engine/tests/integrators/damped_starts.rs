//! Bodies whose damping brings most vibrations to rest within a small part of a step: no method may add energy where such a motion starts,
//! by an initial velocity, at a release, or when a prescribed motion sets in.

use crate::build;

const METHODS: [&str; 5] = [
    "integrator = \"newmark\"",
    "integrator = \"generalized_alpha\"",
    "integrator = \"generalized_alpha\"\n[generalized_alpha]\nspectral_radius = 0.0",
    "integrator = \"generalized_alpha\"\n[generalized_alpha]\nspectral_radius = 0.5",
    "integrator = \"generalized_alpha\"\n[generalized_alpha]\nspectral_radius = 1.0",
];

const FACE: &str = "on = { axis = \"x\", side = \"max\", within = 1e-9 }";

/// A bar of hard rubber with β = 1 ms, in steps of 10 ms.
fn bar(law: &str, method: &str, tables: &str) -> String {
    format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [1.5, 0.5, 0.5], cells_per_unit = 4 }}\n[material]\nmodel = \"{law}\"\nyoung = 1e9\n\
         poisson = 0.3\ndensity = 1000.0\n[damping]\nbeta = 1e-3\n{tables}[time]\ndt = 0.01\n{method}\n"
    )
}

/// The largest total energy in so many steps, over that at the start.
fn growth(text: &str, steps: usize) -> f64 {
    let mut simulation = build(text);
    let start = simulation.energies().total();
    let mut largest = start;
    for _ in 0..steps {
        simulation.step().unwrap_or_else(|failure| panic!("{failure}\n{text}"));
        largest = largest.max(simulation.energies().total());
    }
    largest / start
}

#[test]
fn an_overdamped_body_never_has_more_energy_than_at_its_start() {
    let pushed = format!("[[initial_velocity]]\n{FACE}\nvelocity = [0, 1, 0]\n");
    let released =
        "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\nuntil = 0.05\n[[initial_velocity]]\nvelocity = [0, 1, 0]\n";
    for method in METHODS {
        for law in ["linear", "corotated", "neo_hookean"] {
            for tables in [&pushed, released] {
                let growth = growth(&bar(law, method, tables), 12);
                assert!(growth < 1.0 + 1e-6, "{law}, {method}\n{tables}: {growth} times the energy");
            }
        }
    }
}

#[test]
fn steel_that_is_pulled_at_a_constant_speed_moves_no_faster_than_its_end() {
    let side = |axis: &str| {
        format!(
            "[[prescribed]]\non = {{ axis = \"{axis}\", side = \"min\", within = 1e-9 }}\ncomponents = [\"{axis}\"]\n\
             displacement = [0, 0, 0]\n"
        )
    };
    let held = ["x", "y", "z"].map(side).concat();
    for method in METHODS {
        let text = format!(
            "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [0.1, 0.1, 0.1], cells_per_unit = 20 }}\n[material]\nmodel = \"linear\"\n\
             young = 2e11\npoisson = 0.3\ndensity = 7800.0\n[damping]\nbeta = 1e-4\n{held}[[prescribed]]\n{FACE}\ncomponents = [\"x\"]\n\
             velocity = [0.01, 0, 0]\n[time]\ndt = 1e-3\n{method}\n"
        );
        let mut simulation = build(&text);
        for _ in 0..10 {
            simulation.step().unwrap_or_else(|failure| panic!("{failure}"));
            // The end moves at 1 cm/s, the sides at no more than ν times that.
            let kinetic = simulation.energies().kinetic;
            assert!(kinetic < 0.5 * 7.8 * 0.01 * 0.01, "{method}: {kinetic} J");
        }
    }
}
