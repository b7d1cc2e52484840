//! Studies of users, their shards, and scripts for a cluster.

use std::fs;
use std::process::Command;

use crate::program::Desk;
use crate::scene_text::{CUBE, edit};

/// Two methods with two moduli each, of which the largest displacement is judged.
const STUDY: &str = r#"
title = "Two methods <and> two moduli"
scenes = ["cube.toml"]
measure = "largest_displacement"
expected = 0.022
tolerance = 0.2

[[vary]]
key = "material.C"
values = [1e5, 2e5]

[[case]]
name = "newton"

[[case]]
name = "verlet"
set = { "time.integrator" = "verlet", "time.dt" = 1e-3, "time.steps" = 40 }
quick = false
"#;

fn desk() -> Desk {
    let desk = Desk::with("mine/cube.toml", edit(CUBE, "\"course\"", "\"engine\""));
    desk.write("mine/cubes.toml", STUDY);
    desk
}

/// The cells of a line; those in quotes may hold commas.
fn cells(line: &str) -> Vec<String> {
    let mut is_quoted = false;
    let cells = line.split(|c: char| {
        is_quoted ^= c == '"';
        c == ',' && !is_quoted
    });
    cells.map(str::to_owned).collect()
}

/// The cells of a column.
fn column(desk: &Desk, file: &str, name: &str) -> Vec<String> {
    let text = desk.read(file);
    let mut lines = text.lines().map(cells);
    let place = lines.next().unwrap().iter().position(|known| known == name).unwrap();
    lines.map(|row| row[place].clone()).collect()
}

/// The rows of a table without the measured times.
fn rows(desk: &Desk, file: &str) -> Vec<Vec<String>> {
    let text = desk.read(file);
    let mut lines = text.lines().map(cells);
    let time = lines.next().unwrap().iter().position(|name| name == "median_step_seconds");
    let without_time = |mut row: Vec<String>| {
        row.remove(time.unwrap());
        row
    };
    lines.map(without_time).collect()
}

#[test]
fn a_study_has_a_row_for_each_case_and_value_and_judges_it() {
    let desk = desk();
    desk.run_well("study mine/cubes.toml --out found");
    let table = desk.read("found/cubes.csv");
    assert!(table.starts_with("scene,case,material.C,status,steps,"), "{table}");
    let found = rows(&desk, "found/cubes.csv");
    let names: Vec<String> = found.iter().map(|row| row[..4].join(" ")).collect();
    let expected = [
        "cube newton 100000.0 done",
        "cube newton 200000.0 done",
        "cube verlet 100000.0 done",
        "cube verlet 200000.0 done",
    ];
    assert_eq!(names, expected, "{table}");
    assert!(found.iter().all(|row| row.last().unwrap() == "true"), "{table}");
    let page = desk.read("found/cubes.html");
    assert!(page.contains("Two methods &lt;and&gt; two moduli") && page.contains("All <b>4</b> rows are as expected"));
    assert_eq!(page.matches("<figure").count(), 2, "both charts over the modulus");
    assert!(!desk.path("found/rows.jsonl").exists());
    desk.run_well("study mine/cubes.toml --quick --out short");
    assert_eq!(rows(&desk, "short/cubes.csv").len(), 2);
    desk.write("mine/cubes.toml", STUDY.replace("expected = 0.022", "expected = 4.0"));
    let wrong = desk.run("study mine/cubes.toml --out wrong");
    assert_eq!(wrong.code, Some(1), "{wrong:?}");
    assert!(wrong.stderr.contains("4 of 4 rows are not as expected"), "{}", wrong.stderr);
}

#[test]
fn the_distance_from_a_reference_falls_with_the_step() {
    let desk = desk();
    desk.write(
        "mine/steps.toml",
        "scenes = [\"cube.toml\"]\nmeasure = \"distance\"\ntolerance = 0.01\nset = { \"time.steps\" = 4 }\n\
         [reference]\n\"time.dt\" = 1e-3\n\"time.steps\" = 40\n\"time.integrator\" = \"bathe\"\n\
         [[vary]]\nkey = \"time.integrator\"\nvalues = [\"implicit_euler\", \"bathe\"]\n",
    );
    desk.run_well("study mine/steps.toml --out found");
    let distances: Vec<f64> =
        column(&desk, "found/steps.csv", "distance").iter().map(|cell| cell.parse().unwrap()).collect();
    assert!(distances[1] < 0.3 * distances[0] && distances[1] > 0.0, "{distances:?}");
    assert_eq!(desk.read("found/steps.html").matches("<figure").count(), 0, "names of methods are no numbers");
}

#[test]
fn mistakes_in_a_study_are_refused_with_their_place_and_a_remedy() {
    let desk = desk();
    for (from, to, words) in [
        (
            "measure = \"largest_displacement\"",
            "measure = \"stress\"",
            "measure is \"stress\"; give one of steps, time",
        ),
        ("tolerance = 0.2", "tolerance = -1", "tolerance is -1; give 0 or more"),
        ("tolerance = 0.2", "", "expected needs `tolerance`"),
        ("measure = \"largest_displacement\"", "measure = \"distance\"", "needs `reference`"),
        ("measure = \"largest_displacement\"", "", "expected needs `measure`"),
        ("title =", "titel =", "line 2: unknown field `titel`"),
        ("values = [1e5, 2e5]", "values = [-1]", "material.C"),
        ("scenes = [\"cube.toml\"]", "scenes = [\"ball\"]", "ball"),
        ("scenes = [\"cube.toml\"]", "scenes = []", "has no runs"),
    ] {
        desk.write("mine/cubes.toml", STUDY.replace(from, to));
        let message = desk.refused("study mine/cubes.toml --out found");
        assert!(message.contains(words), "{to}: {message}");
    }
    assert!(desk.refused("study mine/none.toml").contains("mine/none.toml"));
}

#[test]
fn shards_are_joined_to_the_table_of_the_whole_study_and_a_killed_one_goes_on() {
    let desk = desk();
    desk.run_well("study mine/cubes.toml --out whole");
    let told = desk.run_well("study mine/cubes.toml --shard 1/3 --out a").stdout;
    assert!(told.starts_with("shard 1/3: 2 cases"), "{told}");
    desk.run_well("study mine/cubes.toml --shard 2/3 --out b");
    let early = desk.run("merge a b --out early");
    assert_eq!(early.code, Some(1), "{early:?}");
    assert!(early.stderr.contains("1 of 4 cases have no row"), "{}", early.stderr);
    desk.run_well("study mine/cubes.toml --shard 3/3 --out c");
    // A shard that was killed while it wrote its last row.
    let text = desk.read("a/rows.jsonl");
    let whole_lines: Vec<&str> = text.lines().collect();
    desk.write("a/rows.jsonl", format!("{}\n{}\n{{\"case\":", whole_lines[0], whole_lines[1]));
    desk.run_well("study mine/cubes.toml --shard 1/3 --out a");
    desk.run_well("merge a b c --out joined");
    assert_eq!(rows(&desk, "joined/cubes.csv"), rows(&desk, "whole/cubes.csv"));
    assert_eq!(desk.read("joined/states/cube-0004.json"), desk.read("whole/states/cube-0004.json"));
    let message = desk.refused("study mine/cubes.toml --quick --shard 1/3 --out a");
    assert!(message.contains("a/rows.jsonl: has rows of another study"), "{message}");
    assert!(desk.refused("study mine/cubes.toml --shard 4/3").contains("K/N"));
    assert!(desk.refused("merge mine").contains("mine/rows.jsonl"));
}

#[test]
fn a_report_and_an_experiment_run_in_shards_too() {
    let desk = desk();
    let sweep = "report mine/cube.toml --sweep material.C=1e5,2e5 --sweep gravity.acceleration=[0,-9.81,0],[0,0,0]";
    for (options, page) in [(sweep, "sweep.html"), ("experiment flat modulus", "flat.html")] {
        for shard in 1..=2 {
            desk.run_well(&format!("{options} --shard {shard}/2 --out {page}-{shard}"));
        }
        desk.run_well(&format!("merge {page}-1 {page}-2 --out {page}-joined"));
        desk.run_well(&format!("{options} --out {page}-whole"));
        let [joined, whole] = ["joined", "whole"].map(|of| desk.read(&format!("{page}-{of}/{page}")));
        assert_eq!(joined.matches("<tr>").count(), whole.matches("<tr>").count(), "{page}");
    }
    assert_eq!(rows(&desk, "sweep.html-joined/sweep.csv"), rows(&desk, "sweep.html-whole/sweep.csv"));
    assert_eq!(desk.read("flat.html-joined/flat-modulus.csv"), desk.read("flat.html-whole/flat-modulus.csv"));
}

/// A cluster of one machine: it runs the tasks of an array, and what is wrapped, at once.
const SBATCH: &str = r#"#!/usr/bin/env bash
set -euo pipefail
tasks=1 wrap=
while [ $# -gt 0 ]; do
    case $1 in
        --array=1-*) tasks=${1#--array=1-} ;;
        --wrap=*) wrap=${1#--wrap=} ;;
        --*) ;;
        *) break ;;
    esac
    shift
done
if [ -n "$wrap" ]; then bash -c "$wrap" >&2; fi
if [ $# -gt 0 ]; then
    for ((k = 1; k <= tasks; k++)); do SLURM_ARRAY_TASK_ID=$k bash "$@" >&2; done
fi
echo 42
"#;

#[test]
fn the_scripts_for_slurm_run_every_shard_and_join_them() {
    let desk = desk();
    desk.run_well("study mine/cubes.toml --out whole");
    let told = desk.run_well("study mine/cubes.toml --pack slurm --out jobs").stdout;
    assert_eq!(told.trim(), "jobs/submit.sh");
    desk.write("bin/sbatch", SBATCH);
    let sbatch = desk.path("bin/sbatch");
    #[cfg(unix)]
    fs::set_permissions(&sbatch, std::os::unix::fs::PermissionsExt::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", sbatch.parent().unwrap().display(), std::env::var("PATH").unwrap());
    let mut submit = Command::new("bash");
    submit.args(["jobs/submit.sh", "results", "3"]).current_dir(desk.path("")).env("PATH", path);
    submit.env("PROGRAM", env!("CARGO_BIN_EXE_finite-elements-3d"));
    let output = submit.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).starts_with("shards: job 42, merge: job 42"));
    assert_eq!(rows(&desk, "results/merged/cubes.csv"), rows(&desk, "whole/cubes.csv"));
}

#[test]
fn the_shipped_studies_are_as_expected() {
    let desk = Desk::new();
    for (name, count) in [("cantilever", 3), ("quadratic", 1)] {
        let file = crate::program::data().join(format!("studies/{name}.toml"));
        desk.run_well(&format!("study {} --quick --out found", file.display()));
        assert_eq!(rows(&desk, &format!("found/{name}.csv")).len(), count);
    }
}
