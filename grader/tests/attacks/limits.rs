//! Submissions that use up all their time, or produce too much output.

use super::classroom::{Classroom, OPEN};
use grader::submission::NAMES;

/// Puts something before the first statement of a function.
fn first(statement: &str) -> impl Fn(&str, String) -> String {
    let statement = statement.to_owned();
    move |name, text| {
        let start = text.find(&format!("pub fn {name}")).expect("the function");
        let open = start + text[start..].find("{\n").expect("its body") + 2;
        format!("{}    {statement}\n{}", &text[..open], &text[open..])
    }
}

#[test]
fn one_that_sleeps_in_each_call_is_scored_within_its_budget() {
    let mut room = Classroom::new();
    let sleep = first("std::thread::sleep(std::time::Duration::from_secs(1));");
    for name in NAMES {
        room.change(name, "timed_out", |text| sleep(name, text));
    }
    let attacked = room.grade_with(&[
        ("\nseconds = 1.0", "\nseconds = 5.0"),
        ("check_seconds = 10.0", "check_seconds = 2.0"),
        ("function_seconds = 20.0", "function_seconds = 4.0"),
        ("submission_seconds = 120.0", "submission_seconds = 12.0"),
    ]);
    attacked.is_as_expected();
    assert!(attacked.remarks().iter().any(|remark| remark.contains("longer than 12 s")), "{:?}", attacked.remarks());
    let late = attacked.message("newtons_method");
    assert!(late.contains("within 2 s") || late.contains("within 4 s") || late.contains("used up"), "{late}");
}

#[test]
#[ignore = "takes a minute; .ci/long runs it"]
fn files_that_compile_alone_and_not_together_are_judged_alone() {
    let mut room = Classroom::new();
    // Each takes the compiler two seconds, and the eight of them, which are of one level, more than the ten that it has.
    let slow = "const SLOW: u64 = { let mut x = 0u64; while x < 2_000_000 { x += 1; } x };\nconst _: u64 = SLOW;";
    for name in [
        "phi_linear_tetrahedron",
        "psi_neo_hookean",
        "quadrature_single_point",
        "V_spring_particle_particle",
        "mass_matrix_linear_tetrahedron",
        "fixed_point_constraints",
        "pick_nearest_vertices",
        "linearly_implicit_euler",
    ] {
        room.change(name, "passed", |text| format!("#![allow(long_running_const_eval)]\n{text}\n{slow}\n"));
    }
    room.grade_with(&[("compile_seconds = 5.0", "compile_seconds = 10.0")]).is_as_expected();
}

#[test]
#[ignore = "takes a minute; .ci/long runs it"]
fn one_that_says_as_much_as_it_can_leaves_files_of_bounded_size() {
    let mut room = Classroom::new();
    for (index, name) in NAMES.into_iter().enumerate() {
        // Control characters take six bytes each in JSON.
        let length = if index == 0 { 60_000_000 } else { 1_000_000 };
        let body = format!("panic!(\"{{}}\", \"\\u{{1}}\".repeat({length}))");
        room.replace_body(name, "crashed", &body);
    }
    let long = "x".repeat(100_000);
    room.change("T_linear_tetrahedron", "did_not_compile", |_| format!("compile_error!(\"{long}\");\n").repeat(9));
    room.change("V_linear_tetrahedron", "did_not_compile", |text| text.replace("volume", "other").repeat(50));
    room.change("assemble_forces", "refused", |text| format!("{}\n{text}", "unsafe {}\n".repeat(50_000)));
    for file in 0..5000 {
        room.add(&format!("src/{file}{}.rs", &long[..200]), "");
    }
    let attacked = room.grade();
    attacked.is_as_expected();
    assert!(attacked.length("grade.json") <= 1 << 20, "{}", attacked.length("grade.json"));
    for name in OPEN {
        assert!(attacked.length(name) < 1 << 20, "{name}: {}", attacked.length(name));
    }
    assert!(attacked.remarks().len() < 30);
}
