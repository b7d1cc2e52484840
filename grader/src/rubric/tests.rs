//! Mistakes in rubrics, and the gradings that a change of a rubric requires.

use std::fs;

use super::*;

fn problem(text: impl AsRef<[u8]>) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rubric.toml");
    fs::write(&path, text).unwrap();
    Rubric::load(Some(&path)).unwrap_err().to_string()
}

#[test]
fn our_rubric_is_worth_100_points_and_names_every_function() {
    let rubric = Rubric::load(None).unwrap();
    assert_eq!(rubric.functions.iter().map(|function| function.points.get_ref()).sum::<f64>(), 100.0);
    assert_eq!(rubric.functions.len(), 22);
    assert_eq!(rubric.levels(), [1, 2, 3, 4]);
}

#[test]
fn mistakes_are_named_with_their_line() {
    let unknown = OURS.replacen("name = \"psi_neo_hookean\"", "name = \"psi_neo_hooke\"", 1);
    let line = OURS.lines().position(|line| line == "name = \"psi_neo_hookean\"").unwrap() + 1;
    assert!(
        problem(&unknown).contains(&format!("line {line}: `psi_neo_hooke` is not a function")),
        "{}",
        problem(&unknown)
    );
    assert!(problem(OURS.replacen("points = 4.0", "points = -4.0", 1)).contains("points = -4"));
    assert!(problem(OURS.replacen("points = 4.0", "points = 1e308", 1)).contains("from 0 to 1000000"));
    assert!(problem(OURS.replacen("points = 4.0", "points = \"four\"", 1)).contains("line "));
    assert!(problem(OURS.replacen("hints = true", "hint = true", 1)).contains("hint"));
    assert!(problem(OURS.replacen("tolerance = 1e-9", "tolerance = nan", 1)).contains("tolerance"));
    assert!(problem(OURS.replacen("compile_seconds = 20.0", "compile_seconds = 0.0", 1)).contains("compile_seconds"));
    for pages in ["javascript:alert('{name}')", "https://x.org/pages"] {
        let text = OURS.replacen("hints = true", &format!("hints = true\npages = \"{pages}\""), 1);
        assert!(problem(text).contains("give an address that begins with https://"), "{pages}");
    }
    let twice = format!("{OURS}\n[[function]]\nname = \"psi_neo_hookean\"\npoints = 1.0\nlevel = 1\n");
    assert!(problem(twice).contains("second time"));
    assert!(problem(b"partial_credit = true\n# \xff").contains("line 2: is not UTF-8 text"));
    assert!(problem("").contains("grader/rubric.toml shows"));
    let own = OURS.replacen("name = \"psi_neo_hookean\"", "name = \"psi_neo_hookean\"\ntolerance = 2.0", 1);
    assert!(problem(own).contains("tolerance = 2 of psi_neo_hookean; give"));
    assert!(problem(OURS.replacen("seconds = 5.0", "seconds = 1e-12", 1)).contains("from 0.1 to 600"));
    let both = OURS.replacen("seconds = 5.0", "later = [\"newtons_method\"]\nseconds = 5.0", 1);
    assert!(problem(both).contains("`newtons_method` has a table [[function]] and is `later`"));
    let head = OURS.split("[[function]]").next().unwrap();
    let with = |more: &str| problem(format!("{OURS}\n{more}"));
    assert!(with("[deadline]\nat = \"4 May\"").contains("offset included"));
    assert!(with("[deadline]\nat = 2026-05-04T23:59:00").contains("offset included"));
    assert!(with("[deadline]\nat = 2026-05-04T23:59:00Z\npenalty_per_day = 10.0").contains("such as 0.1 for 10 %"));
    assert!(with("[[extension]]\nstudent = \"anna\"\ndays = 1").contains("without a table [deadline]"));
    let own =
        |function: &str| with(&format!("[[check]]\nfunction = \"{function}\"\nname = \"x\"\nfile = \"checks/x.rs\""));
    assert!(own("psi").contains("a [[check]] of `psi`, which the rubric does not ask for"));
    assert!(own("psi_neo_hookean").contains("checks/x.rs: there is no such file; name one beside the rubric"));
    let late = "[deadline]\nat = 2026-05-04T23:59:00Z\n[[extension]]\nstudent = \"anna\"\n";
    assert!(with(late).contains("needs `until` or `days`"));
    assert!(with(&format!("{late}days = 1\n[[extension]]\nstudent = \"anna\"\ndays = 2")).contains("second extension"));
    assert!(problem(format!("function = []\n{head}")).contains("asks for no function"));
}

#[test]
fn points_hints_and_deadlines_need_no_new_grading_and_all_else_does() {
    let judging = |text: String| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rubric.toml");
        fs::write(&path, text).unwrap();
        Rubric::load(Some(&path)).unwrap().judging()
    };
    let ours = judging(OURS.to_owned());
    let late = "\n[deadline]\nat = 2026-05-04T23:59:00+02:00\n[[extension]]\nstudent = \"anna\"\ndays = 7\n";
    for same in [
        OURS.replacen("points = 4.0", "points = 5.5", 1),
        OURS.replacen("hint = \"Try", "hint = \"Look: try", 1),
        OURS.replacen("partial_credit = true", "# a remark\ncounts = \"best\"\npartial_credit = false", 1),
        OURS.replacen("diagnosis = true", "diagnosis = false", 1),
        OURS.replacen("edge_cases = 0.2", "edge_cases = 0.5", 1),
        format!("{OURS}{late}"),
    ] {
        assert_eq!(judging(same), ours);
    }
    for other in [
        OURS.replacen("tolerance = 1e-9", "tolerance = 1e-8", 1),
        OURS.replacen("\nseconds = 5.0", "\nseconds = 6.0", 1),
        OURS.replacen("points = 4.0", "points = 4.0\ntolerance = 1e-6", 1),
        OURS.replacen("level = 4", "level = 5", 1),
        OURS.split("[[function]]\nname = \"implicit").next().unwrap().to_owned(),
    ] {
        assert_ne!(judging(other), ours);
    }
}
