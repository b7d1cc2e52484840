//! Rosters, groups, deadlines and the submission that counts.

use super::*;

const DEADLINE: &str = "\n[deadline]\nat = 2026-05-04T12:00:00Z\npenalty_per_day = 0.5\n";

/// The named columns of `grades.csv`, by row.
fn columns(room: &Room, names: &[&str]) -> Vec<Vec<String>> {
    let table = room.table("out/grades.csv");
    let places: Vec<usize> = names.iter().map(|name| table[0].iter().position(|cell| cell == name).unwrap()).collect();
    table[1..].iter().map(|row| places.iter().map(|&place| row[place].clone()).collect()).collect()
}

fn run_with(room: &Room, rubric: &str) -> Summary {
    run(&ClassOptions { accounts: accounts(rubric, room.0.path()), ..options(room.0.path()) }).unwrap()
}

fn score(room: &Room, student: &str) -> f64 {
    let text = fs::read(room.path(&format!("out/students/{student}/grade.json"))).unwrap();
    serde_json::from_slice::<Grade>(&text).unwrap().score
}

#[test]
fn a_group_is_graded_once_and_a_student_without_a_submission_has_a_row() {
    let room = Room::new(&[("team", GOOD), ("dora", GOOD)]);
    let students = "submission,student,name,id,login,email,section\nteam,anna,\"=Ünal, Anna\",17,anna1,anna@x.org,A\n\
                    team,bob,Bob,18,,,\n,carl,Carl,19,,carl@x.org,B\ngone,emil,,,,,\n";
    fs::write(room.path("hw/students.csv"), students).unwrap();
    let summary = room.run();
    assert_eq!((room.calls(), summary.graded_now), (vec!["dora".to_owned(), "team".to_owned()], 2));
    let unlisted = "dora: students.csv does not list it; it counts as the submission of another student, dora";
    assert_eq!(summary.remarks, ["students.csv: there is no submission gone", unlisted]);
    let rows = columns(&room, &["student", "submission", "score", "note"]);
    let expected = [
        ["anna", "team", "1.5", ""],
        ["bob", "team", "1.5", ""],
        ["carl", "", "", "no submission"],
        ["dora", "dora", "1.5", ""],
        ["emil", "", "", "no submission"],
    ];
    assert_eq!(rows, expected);
    let canvas = room.table("out/canvas.csv");
    assert_eq!(canvas[0], ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "Finite elements"]);
    assert_eq!(canvas[1], ["    Points Possible", "", "", "", "", "100"]);
    assert!(
        canvas.contains(&["'=Ünal, Anna", "", "17", "anna1", "A", "1.5"].map(str::to_owned).to_vec()),
        "{canvas:?}"
    );
    assert!(canvas.contains(&["Carl", "", "19", "", "B", ""].map(str::to_owned).to_vec()));
    let moodle = room.table("out/moodle.csv");
    assert!(
        moodle.contains(&["Carl", "19", "", "carl@x.org", "", "100", ""].map(str::to_owned).to_vec()),
        "{moodle:?}"
    );
    assert_eq!((canvas.len(), moodle.len()), (7, 6));

    run_with(
        &room,
        &OURS.replacen("partial_credit", "no_submission = \"zero\"\ntitle = \"One (7)\"\npartial_credit", 1),
    );
    assert_eq!(columns(&room, &["score"])[2], ["0"]);
    let canvas = room.table("out/canvas.csv");
    assert_eq!(canvas[0][5], "One (7)");
    assert!(canvas.contains(&["Carl", "", "19", "", "B", "0"].map(str::to_owned).to_vec()));
    assert_eq!(room.calls().len(), 2);
}

#[test]
fn a_deadline_counts_for_each_student_of_a_group_and_shows_both_scores() {
    let room = Room::new(&[("team", GOOD), ("dora@2026-05-05T11-00-00Z", GOOD)]);
    let students = "submission,student,time\nteam,anna,2026-05-04T15:00:00+02:00\nteam,bob,2026-05-04T15:00:00+02:00\n";
    fs::write(room.path("hw/students.csv"), students).unwrap();
    let extension = "[[extension]]\nstudent = \"anna\"\ndays = 7\n[[extension]]\nstudent = \"fritz\"\ndays = 1\n";
    let summary = run_with(&room, &format!("{OURS}{DEADLINE}{extension}"));
    let rows = columns(&room, &["student", "score", "raw_score", "submitted", "days_late", "penalty"]);
    let expected = [
        ["anna", "1.5", "1.5", "2026-05-04T13:00:00Z", "0", "0"],
        ["bob", "0.75", "1.5", "2026-05-04T13:00:00Z", "1", "0.5"],
        ["dora", "0.75", "1.5", "2026-05-05T11:00:00Z", "1", "0.5"],
    ];
    assert_eq!(rows, expected);
    assert_eq!((score(&room, "anna"), score(&room, "bob")), (1.5, 0.75));
    let unlisted = "dora@2026-05-05T11-00-00Z: students.csv does not list it; it counts as the submission of another student, dora";
    assert_eq!(summary.remarks, [unlisted, "the rubric has an extension for fritz, who is no student"]);
    let page = fs::read_to_string(room.path("out/students/bob/report.html")).unwrap();
    assert!(page.contains("1 day late: 1.5 points, less 50 %, are 0.75"), "{page}");
    assert_eq!(room.calls().len(), 2);
}

#[test]
fn the_best_submission_counts_after_the_penalty_if_the_rubric_says_so() {
    let better = r#"sed 's/"score": 1.5/"score": 1.75/' "$base/grade.json" >"$out/grade.json""#;
    let room =
        Room::new(&[("anna@2026-05-04T11-00-00Z", GOOD), ("anna@2026-05-04T13-00-00Z", better), ("bob", "exit 1")]);
    let best = OURS.replacen("partial_credit", "counts = \"best\"\npartial_credit", 1);
    for (rubric, score, old) in
        [(OURS.to_owned(), "1.75", "11"), (format!("{best}{DEADLINE}"), "1.5", "13"), (best, "1.75", "11")]
    {
        let summary = run_with(&room, &rubric);
        let rows = columns(&room, &["student", "score", "note"]);
        assert_eq!(rows[0], ["anna", score, &format!("in place of anna@2026-05-04T{old}-00-00Z")]);
        assert_eq!(self::score(&room, "anna").to_string(), score);
        assert_eq!((rows.len(), outcomes(&summary).matches('o').count()), (2, 1));
    }
    assert_eq!(room.calls().iter().filter(|name| name.starts_with("anna")).count(), 2, "none is graded twice");
}

#[test]
fn adjustments_reach_the_student_and_need_no_new_grading() {
    let room = Room::new(&[("anna", GOOD), ("bob", GOOD)]);
    room.run();
    fs::write(
        room.path("hw/adjustments.csv"),
        "student,function,points,reason,comment\nanna,,2,appeal of May,Sorry!\nx,,1,y,\n",
    )
    .unwrap();
    let summary = room.run();
    let rows = columns(&room, &["student", "score", "raw_score", "note"]);
    assert_eq!(rows, [["anna", "2", "1.5", "2 points in all, given by hand; Sorry!"], ["bob", "1.5", "1.5", ""]]);
    let page = fs::read_to_string(room.path("out/students/anna/report.md")).unwrap();
    assert!(page.contains("Sorry") && !page.contains("appeal of May"));
    assert_eq!((room.calls().len(), summary.remarks), (2, vec!["adjustments.csv: there is no student x".to_owned()]));
}

#[test]
fn no_name_of_a_student_leads_out_of_the_results() {
    let room = Room::new(&[("a", GOOD), ("b", GOOD)]);
    fs::write(room.path("hw/students.csv"), "submission,student\na,../../evil\nb,..\n").unwrap();
    room.run();
    let names: Vec<_> =
        fs::read_dir(room.path("out/students")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names.len(), 2, "{names:?}");
    assert!(!room.path("evil").exists() && !room.path("out/evil").exists() && !room.path("out/grade.json").exists());
}

#[test]
fn students_get_back_what_they_may_see_and_not_before_its_time() {
    let room = Room::new(&[("anna", GOOD), ("bob", "exit 1"), ("carl", GOOD)]);
    let secret = r#""checks": [{"name": "c", "status": "failed", "message": "", "counterexample": "SECRET"}]"#;
    fs::write(room.path("grade.json"), grade(7).replacen(r#""checks": []"#, secret, 1)).unwrap();
    run_with(&room, &OURS.replacen("hints = true", "hints = true\nrelease = 2026-06-01T12:00:00+02:00", 1));
    assert!(fs::read_to_string(room.path("out/students/anna/grade.json")).unwrap().contains("SECRET"));
    let write = |to: &str, now: &str| {
        let archive = room.path("all.zip");
        crate::feedback::write(&room.path("out"), &room.path(to), Some(&archive), now.parse().unwrap())
    };
    let early = write("back", "2026-06-01T09:59:59Z").unwrap_err().to_string();
    assert!(early.contains("2026-06-01T10:00:00Z") && !room.path("back").exists(), "{early}");
    assert_eq!(write("back", "2026-06-01T10:00:00Z").unwrap(), 2);
    let mut found = Vec::new();
    for student in fs::read_dir(room.path("back")).unwrap() {
        for file in fs::read_dir(student.unwrap().path()).unwrap() {
            let path = file.unwrap().path();
            assert!(!fs::read_to_string(&path).unwrap().contains("SECRET"), "{}", path.display());
            found.push(path.strip_prefix(room.path("back")).unwrap().display().to_string());
        }
    }
    found.sort();
    let files = ["junit.xml", "report.html", "report.md", "results.json"];
    let expected: Vec<String> =
        ["anna", "carl"].iter().flat_map(|name| files.map(|file| format!("{name}/{file}"))).collect();
    assert_eq!(found, expected);
    let archive = zip::ZipArchive::new(fs::File::open(room.path("all.zip")).unwrap()).unwrap();
    let mut names: Vec<String> = archive.file_names().map(|name| name.unwrap().into_owned()).collect();
    names.sort();
    assert_eq!(names, expected);
    assert!(write("back", "2026-06-01T10:00:00Z").unwrap_err().to_string().contains("not empty"));
}

#[test]
fn a_submission_without_a_function_is_named_and_points_have_two_decimals() {
    let room = Room::new(&[("anna", GOOD), ("bob", GOOD)]);
    let text = fs::read_to_string(room.path("grade.json")).unwrap();
    let text = text.replace("1.5", "1.5000000000000002").replace(r#""score": 1,"#, r#""score": 1.1234567,"#);
    fs::write(room.path("grade.json"), text).unwrap();
    let empty = r#"sed -e 's/"failed"/"missing"/' -e 's/"remarks": \[\]/"remarks": ["there is no folder"]/' "$base/grade.json" >"$out/grade.json""#;
    fs::write(room.path("hw/bob/do.sh"), empty).unwrap();
    let summary = room.run();
    assert_eq!(summary.remarks, ["bob: no function was found: there is no folder"]);
    let table = room.table("out/grades.csv");
    assert_eq!((table[1][2].as_str(), table[1][5].as_str()), ("1.5", "1.12"));
}

#[test]
fn a_late_mark_without_a_time_is_told_where_there_is_a_deadline() {
    let room = Room::new(&[]);
    for name in ["doejane_LATE_4711_98765_hw.zip", "roejohn_4712_98770_work.zip"] {
        fs::write(room.path("hw").join(name), "").unwrap();
    }
    let summary = run_with(&room, &format!("{OURS}{DEADLINE}"));
    assert!(
        summary.remarks[0].starts_with("marked as late, but without a time: doejane_LATE_4711_98765_hw;"),
        "{:?}",
        summary.remarks
    );
}
