//! Submissions and results that are larger than they should be.

use super::*;

#[test]
fn a_grade_that_is_too_large_is_read_no_further_and_graded_again() {
    let room = Room::new(&[("anna", GOOD)]);
    assert_eq!(outcomes(&room.run()), "+");
    let folder = fs::read_dir(room.path("out/grades")).unwrap().next().unwrap().unwrap().path();
    let whole = fs::read_to_string(folder.join("grade.json")).unwrap();
    fs::write(folder.join("grade.json"), format!("{whole}{}", " ".repeat(1 << 20))).unwrap();
    assert_eq!(outcomes(&room.run()), "+");
    assert_eq!(room.calls(), ["anna", "anna"]);
}

#[test]
fn a_submission_is_looked_at_no_further_than_a_grader_reads_it() {
    let room = Room::new(&[("anna", GOOD)]);
    let anna = room.path("hw/anna");
    fs::File::create(anna.join("endless")).unwrap().set_len(1 << 40).unwrap();
    let deep = anna.join("a/src/b/c/d");
    fs::create_dir_all(&deep).unwrap();
    fs::File::create(deep.join("endless")).unwrap().set_len(1 << 40).unwrap();
    assert_eq!(outcomes(&room.run()), "+");
    fs::write(anna.join("a/src/psi_neo_hookean.rs"), "").unwrap();
    assert_eq!(outcomes(&room.run()), "+");
    assert_eq!(room.calls(), ["anna", "anna"]);
}
