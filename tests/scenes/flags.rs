//! Options that override a scene or describe it.

use crate::program::{Desk, course_scenes, data, shipped_scenes};
use crate::scene_text::{CUBE, edit, shipped};

#[test]
fn the_bunny_is_the_default_scene() {
    let outcome = Desk::new().run_well("--headless --steps 1");
    assert!(outcome.stdout.starts_with("bunny, linearly_implicit_euler: 1 steps"), "{}", outcome.stdout);
}

#[test]
fn the_options_override_time_step_steps_and_integrator() {
    let desk = Desk::with("cube.toml", CUBE);
    let outcome = desk.run_well("cube.toml --headless --dt 0.25e-2 --steps 7 --integrator linearly_implicit_euler");
    assert!(outcome.stdout.starts_with("cube, linearly_implicit_euler: 7 steps to t = 0.0175 s"), "{}", outcome.stdout);
}

#[test]
fn an_override_gives_the_same_motion_as_the_number_in_the_scene() {
    let desk = Desk::with("cube.toml", CUBE);
    desk.write("other.toml", edit(CUBE, "dt = 0.01", "dt = 0.003"));
    desk.run_well("cube.toml --headless --dt 0.003 --state flag.json");
    desk.run_well("other.toml --headless --state scene.json");
    assert_eq!(desk.read("flag.json"), desk.read("scene.json"));
}

#[test]
fn a_key_that_is_set_gives_the_same_motion_as_the_key_in_the_scene() {
    let desk = Desk::with("cube.toml", CUBE);
    desk.write(
        "other.toml",
        edit(&edit(CUBE, "C = 1e5", "C = 2e5"), "\"implicit_euler\"", "\"linearly_implicit_euler\""),
    );
    let set = "--set material.C=2e5 --set time.integrator=linearly_implicit_euler";
    desk.run_well(&format!("cube.toml --headless {set} --state flag.json"));
    desk.run_well("other.toml --headless --state scene.json");
    assert_eq!(desk.json("flag.json")["q"], desk.json("scene.json")["q"]);
    let message = desk.refused("cube.toml --headless --set material.C=-2");
    assert!(message.starts_with("error: --set material.C=-2: material.C"), "{message}");
}

#[test]
fn a_sweep_has_a_row_for_every_combination_of_values_and_runs_go_on_from_its_states() {
    let desk = Desk::with("cube.toml", CUBE);
    let sweep = "--sweep material.C=1e5,2e5 --sweep gravity.acceleration=[0,-9.81,0],[0,0,0]";
    desk.run_well(&format!("report cube.toml --out out {sweep}"));
    let table = desk.read("out/sweep.csv");
    let lines: Vec<_> = table.lines().collect();
    assert!(lines[0].starts_with("scene,material.C,gravity.acceleration,status,steps,time,"), "{table}");
    let starts = ["1e5,\"[0,-9.81,0]\"", "1e5,\"[0,0,0]\"", "2e5,\"[0,-9.81,0]\"", "2e5,\"[0,0,0]\""];
    assert_eq!(lines.len(), 5, "{table}");
    for (line, start) in lines[1..].iter().zip(starts) {
        assert!(line.starts_with(&format!("cube,{start},done,4,4.0")), "{line}");
    }
    let page = desk.read("out/sweep.html");
    assert_eq!(page.matches("<figure").count(), 2, "charts over material.C alone: the other key has no numbers");
    desk.run_well("cube.toml --headless --set material.C=2e5 --state flag.json");
    assert_eq!(desk.read("flag.json"), desk.read("out/states/cube-0003.json"));
    let outcome = desk.run("report spinning --out failing --sweep time.integrator=verlet --sweep time.dt=0.5,0.6");
    assert_eq!(outcome.code, Some(1), "{outcome:?}");
    assert!(outcome.stderr.contains("2 of 2 runs failed or did not converge"), "{}", outcome.stderr);
    assert_eq!(desk.read("failing/sweep.csv").lines().count(), 3);
    // A run that ends between two judgements of its energy is judged at its end.
    let sweep = "--sweep time.integrator=explicit_euler --sweep time.dt=2e-3 --sweep time.steps=60";
    assert_eq!(desk.run(&format!("report spinning --out gaining {sweep}")).code, Some(1));
    assert!(desk.read("gaining/sweep.csv").contains("from nothing"));
    let message = desk.refused("report cube.toml --out out --sweep material.C=1e5,-1");
    assert!(message.starts_with("error: --set material.C=-1: material.C"), "{message}");
}

#[test]
fn the_default_number_of_steps_is_the_scenes_or_100() {
    let desk = Desk::with("cube.toml", CUBE);
    assert!(desk.run_well("cube.toml --headless").stdout.contains(": 4 steps to t = 0.0400 s"));
    desk.write("cube.toml", edit(CUBE, "steps = 4\n", ""));
    assert!(desk.run_well("cube.toml --headless").stdout.contains(": 100 steps to t = 1.0000 s"));
}

#[test]
fn options_may_stand_before_the_scene() {
    let desk = Desk::with("cube.toml", CUBE);
    assert!(desk.run_well("--headless --steps 2 cube.toml").stdout.starts_with("cube, implicit_euler: 2 steps"));
}

// On other systems no environment variable prevents a window.
#[cfg(any(target_os = "linux", not(feature = "viewer")))]
#[test]
fn a_scene_runs_headless_with_a_message_if_no_window_can_be_opened() {
    let desk = Desk::with("cube.toml", CUBE);
    let outcome = desk.run("cube.toml");
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
    assert!(outcome.stderr.starts_with("no window (") && outcome.stderr.contains("--headless"), "{}", outcome.stderr);
    assert!(outcome.stdout.starts_with("cube, "), "{}", outcome.stdout);
}

#[test]
fn scenes_are_found_by_path_and_in_the_current_data_folder_by_name() {
    let desk = Desk::with("data/scenes/mine.toml", CUBE);
    assert!(desk.run_well("mine --headless").stdout.starts_with("mine, "));
    assert!(desk.run_well("./data/scenes/mine.toml --headless").stdout.starts_with("mine, "));
    assert!(desk.run_well("list").stdout.starts_with("mine "));
}

#[test]
fn explain_lists_every_part_with_its_reason_and_takes_no_step() {
    for name in course_scenes() {
        let desk = Desk::new();
        let text = desk.run_well(&format!("{name} --explain --headless --state q.json")).stdout;
        assert!(!desk.path("q.json").exists(), "{name} has run");
        assert!(text.contains(&shipped(&name).about), "{text}");
        let parts =
            ["mesh", "mass", "gravity", "fixed", "drag", "skinning", "forces", "stiffness", "solver", "line_search"];
        for part in parts {
            let line = text.lines().find(|line| line.split_whitespace().any(|word| word == part));
            let line = line.unwrap_or_else(|| panic!("no line about {part}:\n{text}"));
            assert!(line.contains("builds ") || line.contains("leaves out "), "{line}");
        }
    }
}

#[test]
fn explain_lists_the_parts_that_a_scene_leaves_out() {
    let desk = Desk::with("cube.toml", crate::scene_text::free_cube());
    let text = desk.run_well("cube.toml --explain --integrator linearly_implicit_euler").stdout;
    let left_out: Vec<_> = text.lines().filter_map(|line| line.trim_start().strip_prefix("leaves out ")).collect();
    let names: Vec<_> = left_out.iter().map(|line| line.split_whitespace().next().unwrap()).collect();
    assert_eq!(names, ["gravity", "fixed", "drag", "skinning", "line_search"], "{text}");
}

#[test]
fn explain_lists_every_part_of_every_engine_scene_with_its_reason() {
    let all = [
        "mesh material state mass forces dead_load fixed prescribed springs pressure damping drag stiffness projection",
        "solver preconditioner line_search skinning reactions contact friction plasticity mass_spring averaged_volume mixed_volume central_gravity viscosity fibres",
    ];
    let mut all: Vec<_> = all.iter().flat_map(|line| line.split(' ')).collect();
    all.sort_unstable();
    for name in shipped_scenes().into_iter().filter(|name| !course_scenes().contains(name)) {
        let text = Desk::new().run_well(&format!("{name} --explain")).stdout;
        let parts = text.lines().filter_map(|line| {
            let line = line.trim_start();
            line.strip_prefix("builds ").or_else(|| line.strip_prefix("leaves out "))
        });
        let mut words: Vec<Vec<_>> = parts.map(|part| part.split_whitespace().collect()).collect();
        words.sort_unstable();
        assert_eq!(words.iter().map(|words| words[0]).collect::<Vec<_>>(), all, "{name}");
        assert!(words.iter().all(|words| words.len() > 2), "a part without a reason:\n{text}");
    }
}

#[test]
fn explain_measures_the_moduli_of_springs() {
    let text = Desk::new().run_well("net --explain").stdout;
    let line = text.lines().find(|line| line.starts_with("apparent moduli in the plane at small strain: E = "));
    let line = line.unwrap_or_else(|| panic!("no line of moduli:\n{text}"));
    assert!(line.contains("the 48 nodes of the boundary") && line.contains("105 inside"), "{line}");
    assert!(line.ends_with("if these followed it too, E = 5.0000e4 Pa, ν = 1/3"), "{line}");
    assert!(text.contains("408 edges of ") && text.contains("damping 5.0000e0 N s/m along each"), "{text}");
    assert!(!Desk::new().run_well("beam --explain").stdout.contains("apparent"));
}

#[test]
fn explain_warns_of_locking() {
    let scene = std::fs::read_to_string(data().join("scenes/cantilever.toml")).unwrap();
    let desk = Desk::with("beam.toml", edit(&scene, "poisson = 0.3", "poisson = 0.4999"));
    let explained = desk.run("beam.toml --explain");
    assert_eq!(explained.code, Some(0));
    assert!(explained.stdout.contains("linear elements lock so close to ν = ½"), "{}", explained.stdout);
    let warned = explained.stderr;
    assert!(warned.contains("linear tetrahedra lock near ½") && warned.contains("0.45 at ν = 0.49"), "{warned}");
    assert!(!desk.run_well("cantilever --explain").stdout.contains("lock"));
}

#[test]
fn the_list_has_one_line_for_each_scene() {
    let text = Desk::new().run_well("list").stdout;
    let first_words: Vec<_> = text.lines().map(|line| line.split_whitespace().next().unwrap()).collect();
    assert_eq!(first_words, shipped_scenes());
    for (line, name) in text.lines().zip(shipped_scenes()) {
        assert!(line.contains(&shipped(&name).about) && line.ends_with(']'), "{line}");
        assert!(line.contains("[mesh, mass") || !course_scenes().contains(&name), "{line}");
    }
}

#[test]
fn help_and_version_go_to_stdout_with_exit_code_0() {
    let desk = Desk::new();
    assert!(desk.run_well("--help").stdout.contains("Exit codes: 0 done"));
    assert!(desk.run_well("--version").stdout.contains(env!("CARGO_PKG_VERSION")));
    assert!(desk.run_well("mesh --help").stdout.contains("convert"));
}

#[test]
fn the_data_of_the_repository_is_found_from_any_folder() {
    assert!(data().join("scenes").is_dir());
    assert_eq!(Desk::new().run_well("arma --headless --steps 1 --export a.obj").code, Some(0));
}

#[cfg(unix)]
#[test]
fn an_output_file_does_not_replace_a_link_or_a_device() {
    use std::os::unix::fs::FileTypeExt;

    let desk = Desk::with("cube.toml", CUBE);
    desk.write("target.json", "old");
    std::os::unix::fs::symlink(desk.path("target.json"), desk.path("link.json")).unwrap();
    desk.run_well("cube.toml --headless --steps 1 --state link.json");
    assert!(desk.path("link.json").is_symlink(), "the link has become a file");
    assert!(desk.json("target.json")["q"].is_array(), "the link's target holds the state");
    desk.run_well("cube.toml --headless --steps 1 --state /dev/null");
    assert!(std::fs::metadata("/dev/null").unwrap().file_type().is_char_device(), "/dev/null has become a file");
}

#[test]
fn colours_of_a_field_that_the_body_does_not_have_are_refused() {
    let desk = Desk::with("cube.toml", CUBE);
    let message = desk.refused("cube.toml --headless --color plastic_strain");
    assert!(message.starts_with("error: --color plastic_strain: the body has no plastic strain"), "{message}");
    let message = desk.refused("cube.toml --headless --color colour");
    let names = "stress, pressure, stress_error, displacement, plastic_strain, quality";
    assert!(message.contains(names), "{message}");
    desk.run_well("cube.toml --headless --color stress");
}
