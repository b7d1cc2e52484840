//! `experiment`: the experiments of theses.

use std::fs;

use crate::program::Desk;

#[test]
fn the_short_experiments_on_flat_bodies_hold_their_marks_and_write_a_page_tables_and_pictures() {
    let desk = Desk::new();
    let said = desk.run_well("experiment flat --quick --out found").stdout;
    assert!(!said.contains("DOES NOT HOLD"), "{said}");
    for (part, table) in [
        ("stability", "stability"),
        ("speed", "speed"),
        ("modulus", "modulus"),
        ("mesh", "mesh"),
        ("plasticity", "plasticity"),
        ("plasticity", "plasticity-cylinder"),
        ("stability", "stability-square"),
        ("mesh", "mesh-scattered"),
        ("drop", "drop"),
        ("sweep", "sweep"),
        ("contact", "contact-stopping"),
        ("contact", "contact-hertz"),
        ("mistakes", "mistakes"),
        ("convergence", "convergence"),
    ] {
        assert!(said.lines().any(|line| line.starts_with(part)), "{part}: {said}");
        let table = fs::read_to_string(desk.path(&format!("found/flat-{table}.csv"))).unwrap();
        assert!(table.lines().count() > 1, "{part}: {table}");
    }
    let page = fs::read_to_string(desk.path("found/flat.html")).unwrap();
    assert!(page.contains("marks hold") && !page.contains("does not hold") && page.contains("<svg"), "{page}");
    for picture in [
        "flat-speed.svg",
        "flat-mesh.svg",
        "flat-convergence.svg",
        "flat-plasticity.svg",
        "flat-plasticity-tension.svg",
        "flat-drop.svg",
        "flat-mesh-bunny.svg",
        "flat-stability-square.svg",
        "flat-sweep-friction.svg",
    ] {
        assert!(fs::read_to_string(desk.path("found").join(picture)).unwrap().starts_with("<svg"), "{picture}");
    }
}

#[test]
fn the_short_experiment_on_the_torus_holds_its_marks_and_writes_a_page_tables_and_pictures() {
    let desk = Desk::new();
    let said = desk.run_well("experiment rtfem --quick --out found").stdout;
    assert!(!said.contains("DOES NOT HOLD"), "{said}");
    let parts = [
        "speed",
        "precision",
        "equilibrium",
        "materials",
        "structures",
        "picture",
        "slivers",
        "methods",
        "modulus",
        "momentum",
        "mistakes",
    ];
    for part in parts {
        assert!(said.lines().any(|line| line.starts_with(part)), "{part}: {said}");
    }
    for table in [
        "speed",
        "solvers",
        "parts",
        "precision",
        "equilibrium",
        "block",
        "young",
        "poisson",
        "structures",
        "slivers",
        "mistakes",
        "methods",
        "methods-times",
        "methods-errors",
        "modulus",
        "momentum",
    ] {
        let text = fs::read_to_string(desk.path(&format!("found/rtfem-{table}.csv"))).unwrap();
        assert!(text.lines().count() > 1, "{table}: {text}");
    }
    let solvers = fs::read_to_string(desk.path("found/rtfem-solvers.csv")).unwrap();
    let is_right = |line: &str| match line.contains("gpu, ") {
        // Times of adapters that are programs on the processor are left out.
        true => line.ends_with("converged") || line.ends_with("to time it") || line.contains("no adapter"),
        false => line.ends_with("converged") && !line.contains("not"),
    };
    assert!(solvers.lines().skip(1).all(is_right), "{solvers}");
    let runs = fs::read_to_string(desk.path("found/rtfem-methods.csv")).unwrap();
    assert!(runs.lines().skip(1).all(|line| line.ends_with(",done")), "{runs}");
    let page = fs::read_to_string(desk.path("found/rtfem.html")).unwrap();
    assert!(page.contains("marks hold") && !page.contains("does not hold") && page.contains("<svg"), "{page}");
    for picture in ["squashed", "turning", "slivers"] {
        let text = fs::read_to_string(desk.path(&format!("found/rtfem-{picture}.svg"))).unwrap();
        assert!(text.starts_with("<svg"), "{picture}");
    }
}

#[test]
fn explicit_substeps_live_at_the_predicted_number_and_explode_at_one_less() {
    let desk = Desk::new();
    desk.run_well("experiment flat stability --quick --out found");
    let table = fs::read_to_string(desk.path("found/flat-stability.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().skip(1).map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 6, "{table}");
    for row in rows {
        assert_eq!((row[6], row[7]), ("lives", "explodes"), "{table}");
    }
}

#[test]
fn every_mistake_of_the_thesis_has_figures_of_its_own_that_differ_from_the_truth() {
    let desk = Desk::new();
    desk.run_well("experiment flat mistakes --quick --out found");
    let table = fs::read_to_string(desk.path("found/flat-mistakes.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().skip(1).map(|line| line.rsplit(',').take(3).collect()).collect();
    // Friction has a row for each number of substeps.
    assert_eq!(rows.len(), 11, "{table}");
    for row in rows {
        let [truth, ours, theirs] = [0, 1, 2].map(|i| row[i].parse::<f64>().unwrap());
        assert!((theirs - truth).abs() > 10.0 * (ours - truth).abs(), "{row:?}: {table}");
    }
}

#[test]
fn an_unknown_part_of_an_experiment_is_refused_with_the_known_ones() {
    let run = Desk::new().run("experiment flat fast");
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("fast") && run.stderr.contains("stability"), "{}", run.stderr);
}
