//! Submissions that are graded again, and the table of old and new points.

use super::*;

/// A grader's answer with one right function.
fn right(room: &Room) {
    let text = grade(7).replacen(
        r#""name": "f", "score": 1, "max_score": 2, "status": "failed""#,
        r#""name": "phi_linear_tetrahedron",
        "score": 4, "max_score": 4, "status": "passed""#,
        1,
    );
    fs::write(
        room.path("grade.json"),
        text.replace("\"score\": 1.5, \"max_score\": 2", "\"score\": 5, \"max_score\": 6"),
    )
    .unwrap();
}

#[test]
fn other_points_are_told_beside_the_old_ones_and_nothing_is_run() {
    let room = Room::new(&[("anna", GOOD), ("bob", GOOD)]);
    right(&room);
    assert!(room.run().changes.is_empty() && room.run().changes.is_empty());
    assert!(!room.path("out/regrade.csv").exists());
    let richer = OURS.replacen("points = 4.0", "points = 10.0", 1);
    let options = ClassOptions { accounts: accounts(&richer, room.0.path()), ..options(room.0.path()) };
    let summary = run(&options).unwrap();
    assert_eq!((room.calls().len(), summary.changes.len(), summary.graded_now), (2, 2, 0));
    let table = room.table("out/regrade.csv");
    assert_eq!(table[0], ["student", "submission", "function", "old_points", "new_points"]);
    assert_eq!(table[1], ["anna", "anna", "", "5", "11"]);
    assert_eq!(table[2], ["anna", "anna", "phi_linear_tetrahedron", "4", "10"]);
    assert_eq!(table.len(), 5);
    let told = reports::regrade::text(&summary.changes);
    assert!(told.contains("anna: 5 of 6 -> 11 of 12  (phi_linear_tetrahedron 4 -> 10)"), "{told}");
    assert!(fs::read_to_string(room.path("out/regrade.html")).unwrap().contains("5 of 6 -&gt; 11 of 12"));
    assert!(run(&options).unwrap().changes.is_empty(), "the second run has nothing new");
}

#[test]
fn those_that_are_named_are_graded_again_and_the_others_stay_whatever_has_changed() {
    let room = Room::new(&[("anna", GOOD), ("bob", GOOD), ("carl", "exit 1")]);
    room.run();
    let strict = OURS.replacen("tolerance = 1e-9", "tolerance = 1e-12", 1);
    let only = |names: &[&str]| {
        let only = names.iter().map(|name| (*name).to_owned()).collect();
        run(&ClassOptions { accounts: accounts(&strict, room.0.path()), only, ..options(room.0.path()) })
    };
    let summary = only(&["anna"]).unwrap();
    assert_eq!(
        (room.calls(), outcomes(&summary).as_str()),
        (["anna", "anna", "bob", "carl"].map(str::to_owned).to_vec(), "++.")
    );
    only(&["anna"]).unwrap();
    assert_eq!(room.calls().len(), 5, "asked again, graded again");
    assert!(only(&["emil"]).unwrap_err().to_string().contains("`emil` is neither a student nor a submission"));
}

#[test]
fn one_function_is_graded_again_beside_what_is_known_of_the_others() {
    let room = Room::new(&[("anna", &format!("echo \"$@\" >>\"$base/words\"\n{GOOD}"))]);
    room.run();
    let functions = vec!["psi_neo_hookean".to_owned()];
    run(&ClassOptions { functions, ..options(room.0.path()) }).unwrap();
    let words = fs::read_to_string(room.path("words")).unwrap();
    let lines: Vec<&str> = words.lines().collect();
    assert!(lines.len() == 2 && !lines[0].contains("--earlier"), "{words}");
    assert!(lines[1].contains("out/submissions/anna/grade.json --function=psi_neo_hookean"), "{words}");
}
