//! Downloads of Canvas, Moodle and Gradescope as they come, with their rosters.

use std::io::Write;

use super::*;
use crate::class::find::Class;
use zip::write::SimpleFileOptions;

const BODY: &str = "pub fn psi_neo_hookean() -> f64 { 1.0 }";

/// A folder of a class with files of these names; a name that ends with `.zip` is an archive with `src/psi_neo_hookean.rs`.
fn download(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        if name.ends_with(".zip") {
            let mut zip = zip::ZipWriter::new(fs::File::create(path).unwrap());
            zip.start_file("src/psi_neo_hookean.rs", SimpleFileOptions::default()).unwrap();
            zip.write_all(text.as_bytes()).unwrap();
            zip.finish().unwrap();
        } else {
            fs::write(path, text).unwrap();
        }
    }
    folder
}

fn found(folder: &tempfile::TempDir) -> Class {
    find::class(folder.path(), None, Counts::Newest).unwrap_or_else(|error| panic!("{error}"))
}

/// Student, submission, and `older` for those that do not count.
fn rows(class: &Class) -> Vec<(&str, &str, &str)> {
    let state = |submission: &find::Submission| if submission.newer.is_some() { "older" } else { "" };
    class.submissions.iter().map(|one| (one.student.as_str(), one.name.as_str(), state(one))).collect()
}

fn is_read(submission: &find::Submission) -> bool {
    let read = crate::archive::read_submission(&submission.path).unwrap_or_else(|error| panic!("{error}"));
    matches!(read.functions["psi_neo_hookean"], grader::submission::Source::Written(_))
}

const GRADEBOOK: &str = "Student,ID,SIS User ID,SIS Login ID,Section,Finite elements (12),Current Score\n\
    ,,,,,Manual Posting,\n    Points Possible,,,,,100,(read only)\n\"Doe, Jane\",4711,1001,jdoe,A,,\n\"Roe, John\",4712,1002,jroe,A,,\n\
    \"Müller, Jörg\",4713,1003,jmueller,B,,\n\"Loe, Ann\",4714,1004,aloe,B,,\n\"Student, Test\",4999,,abcdef,A,,\n";

#[test]
fn a_download_of_canvas_is_read_with_its_gradebook() {
    let folder = download(&[
        ("2026-05-05T0900_Grades-FEM.csv", GRADEBOOK),
        ("doejane_4711_98765_hw.zip", BODY),
        ("doejane_LATE_4711_99001_hw-1.zip", BODY),
        ("roejohn_LATE_4712_98770_work.zip", BODY),
        ("müllerjörg_4713_98801_psi_neo_hookean-1.rs", BODY),
        ("müllerjörg_4713_98802_notes.pdf", ""),
        ("strangerann_4800_98900_hw.zip", BODY),
    ]);
    let class = found(&folder);
    let expected = [
        ("jdoe", "doejane_4711_98765_hw", "older"),
        ("jdoe", "doejane_LATE_4711_99001_hw-1", ""),
        ("jmueller", "müllerjörg_4713", ""),
        ("jroe", "roejohn_LATE_4712_98770_work", ""),
        ("strangerann_4800", "strangerann_4800_98900_hw", ""),
    ];
    assert_eq!(rows(&class), expected);
    assert!(class.submissions.iter().all(is_read));
    assert_eq!(
        class.people.iter().map(|person| person.student.as_str()).collect::<Vec<_>>(),
        ["jdoe", "jroe", "jmueller", "aloe"]
    );
    assert_eq!(
        (class.people[0].canvas.as_str(), class.people[0].id.as_str(), class.people[0].section.as_str()),
        ("4711", "1001", "A")
    );
    let late: Vec<_> = class.submissions.iter().filter(|one| one.is_late).map(|one| one.student.as_str()).collect();
    assert_eq!(late, ["jdoe", "jroe"]);
    assert_eq!(class.remarks.len(), 2, "{:?}", class.remarks);
    assert!(class.remarks[0].starts_with("müllerjörg_4713_98802_notes.pdf: left aside"), "{:?}", class.remarks);
    assert!(class.remarks[1].contains("the roster does not list it"), "{:?}", class.remarks);
}

#[test]
fn without_a_roster_canvas_numbers_keep_students_apart_and_a_group_is_told() {
    let folder = download(&[
        ("doejane_4711_98765_hw.zip", BODY),
        ("doejane_4712_98766_hw.zip", BODY),
        ("anon_Ab1cD_98767_hw.zip", BODY),
    ]);
    let class = found(&folder);
    let students: Vec<_> = class.submissions.iter().map(|one| one.student.as_str()).collect();
    assert_eq!(students, ["anon_Ab1cD", "doejane_4711", "doejane_4712"]);
    let folder = download(&[("g.csv", GRADEBOOK), ("projectgroup1_4711_98765_hw.zip", BODY)]);
    let class = found(&folder);
    assert_eq!(rows(&class), [("jdoe", "projectgroup1_4711_98765_hw", "")]);
    assert!(
        class.remarks[0].contains("counts for jdoe alone") && class.remarks[0].contains("students.csv"),
        "{:?}",
        class.remarks
    );
}

const WORKSHEET: &str = "\u{feff}Identifier,Full name,ID number,Email address,Status,Group,Grade,Maximum grade,Grade can be changed,Last modified (submission)\n\
    Participant 657737,Jane Doe,1001,jane@x.org,Submitted for grading - ,Team Red,-,100,Yes,\"Monday, 4 May 2026, 2:14 PM\"\n\
    Participant 657738,John Roe,1002,john@x.org,Submitted for grading - 3 mins 31 secs late - ,Team Red,-,100,Yes,\"Tuesday, 5 May 2026, 2:14 PM\"\n\
    Participant 657739,Ann Loe,1003,ann@x.org,No submission - ,Team Blue,-,100,Yes,-\n";

#[test]
fn a_download_of_moodle_is_read_with_its_worksheet() {
    let folder = download(&[
        ("Grades-FEM-Assignment-12.csv", WORKSHEET),
        ("Jane Doe_657737_assignsubmission_file_/hw.zip", BODY),
        ("Jane Doe_657737_assignsubmission_file_/hw (1).zip", BODY),
        ("Jane Doe_657737_assignsubmission_onlinetext_/onlinetext.html", "Hello"),
        ("John Roe_657738_assignsubmission_file/psi_neo_hookean.rs", BODY),
        ("Eve Moe_700000_assignsubmission_file_/project/src/psi_neo_hookean.rs", BODY),
    ]);
    let class = found(&folder);
    let students: Vec<_> = class.submissions.iter().map(|one| (one.student.as_str(), one.is_late)).collect();
    assert_eq!(students, [("Eve Moe_700000", false), ("jane@x.org", false), ("john@x.org", true)]);
    assert!(class.submissions.iter().all(is_read));
    assert_eq!(class.people.len(), 3);
    assert_eq!(class.remarks.len(), 2, "{:?}", class.remarks);
    assert!(
        class.remarks[0].contains("typed into Moodle") && class.remarks[1].contains("Eve Moe"),
        "{:?}",
        class.remarks
    );
}

#[test]
fn moodle_s_flat_download_its_groups_and_its_list_of_participants_are_read() {
    let folder = download(&[
        ("w.csv", WORKSHEET),
        ("Jane Doe_657737_assignsubmission_file_psi_neo_hookean.rs", BODY),
        ("Jane Doe_657737_assignsubmission_file_T_linear_tetrahedron.rs", "pub fn T_linear_tetrahedron() {}"),
        ("John Roe_657738_assignsubmission_file_hw.zip", BODY),
    ]);
    let class = found(&folder);
    let students: Vec<_> = class.submissions.iter().map(|one| one.student.as_str()).collect();
    assert_eq!(students, ["jane@x.org", "john@x.org"]);
    assert!(class.submissions.iter().all(is_read) && class.remarks.is_empty(), "{:?}", class.remarks);

    let folder =
        download(&[("w.csv", WORKSHEET), ("Team Red-Jane Doe_657737_assignsubmission_file_/psi_neo_hookean.rs", BODY)]);
    assert_eq!(rows(&found(&folder))[0].0, "jane@x.org");

    // The number is the group's here, and happens to be that of a participant.
    let folder = download(&[("w.csv", WORKSHEET), ("Team Red_657739_assignsubmission_file_/psi_neo_hookean.rs", BODY)]);
    let students: Vec<_> = found(&folder).submissions.iter().map(|one| one.student.clone()).collect();
    assert_eq!(students, ["jane@x.org", "john@x.org"]);

    let participants = "First name,Last name,Email address,Groups\nJane,Doe,jane@x.org,\nJohn,Roe,john@x.org,\nJohn,Roe,other@x.org,\n";
    let folder = download(&[
        ("courseid_7_participants.csv", participants),
        ("Jane Doe_657737_assignsubmission_file_/psi_neo_hookean.rs", BODY),
        ("John Roe_657738_assignsubmission_file_/psi_neo_hookean.rs", BODY),
    ]);
    let class = found(&folder);
    let students: Vec<_> = class.submissions.iter().map(|one| one.student.as_str()).collect();
    assert_eq!(students, ["John Roe_657738", "jane@x.org"], "two of one name are never guessed");
    assert!(class.remarks[0].contains("John Roe"), "{:?}", class.remarks);
}

#[test]
fn an_export_of_gradescope_is_read_with_its_metadata_and_roster() {
    let metadata = "---\nsubmission_101:\n  :submitters:\n  - :name: Jane Doe\n    :sid: '1001'\n    :email: jane@x.org\n  - :name: John Roe\n    \
        :sid: '1002'\n    :email: john@x.org\n  :created_at: 2026-05-04 18:32:11.262843000 Z\n  :score: 0.0\nsubmission_102:\n  :submitters:\n  \
        - :name: Ann Loe\n    :sid:\n    :email: ann@x.org\n  :created_at: 2026-05-04 20:32:11.262843000 +02:00\n";
    let roster = "First Name,Last Name,SID,Email,Role\nJane,Doe,1001,jane@x.org,Student\nJohn,Roe,1002,john@x.org,Student\n\
        Ann,Loe,1003,ann@x.org,Student\nMax,Poe,1004,max@x.org,Student\nTed,Boss,,ted@x.org,Instructor\n";
    let folder = download(&[
        ("assignment_7_export/submission_metadata.yml", metadata),
        ("assignment_7_export/FEM_roster.csv", roster),
        ("assignment_7_export/submission_101/psi_neo_hookean.rs", BODY),
        ("assignment_7_export/submission_102/fem/src/psi_neo_hookean.rs", BODY),
        ("assignment_7_export/submission_103/src/psi_neo_hookean.rs", BODY),
    ]);
    let class = found(&folder);
    let expected = [
        ("ann@x.org", "submission_102", ""),
        ("jane@x.org", "submission_101", ""),
        ("john@x.org", "submission_101", ""),
        ("submission_103", "submission_103", ""),
    ];
    assert_eq!(rows(&class), expected);
    assert!(class.submissions.iter().all(is_read));
    let times: Vec<_> = class.submissions.iter().map(|one| one.stated_time().map(|time| time.to_string())).collect();
    assert_eq!(
        times[..2],
        [Some("2026-05-04T18:32:11.262843Z".to_owned()), Some("2026-05-04T18:32:11.262843Z".to_owned())]
    );
    let people: Vec<_> = class.people.iter().map(|person| (person.student.as_str(), person.id.as_str())).collect();
    assert_eq!(people, [("jane@x.org", "1001"), ("john@x.org", "1002"), ("ann@x.org", "1003"), ("max@x.org", "1004")]);
    assert!(class.remarks.len() == 1 && class.remarks[0].contains("submission_103"), "{:?}", class.remarks);
}

#[test]
fn a_second_attempt_belongs_to_the_first_and_an_unlisted_folder_is_told() {
    let files = [
        ("anna.zip", BODY),
        ("anna (1).zip", BODY),
        ("bob/src/psi_neo_hookean.rs", BODY),
        ("bob-1/src/psi_neo_hookean.rs", BODY),
        ("Mallory.zip", BODY),
    ];
    let folder = download(&files);
    let class = found(&folder);
    assert_eq!(rows(&class)[..3], [("Mallory", "Mallory", ""), ("anna", "anna", "older"), ("anna", "anna (1)", "")]);
    assert!(class.remarks[0].contains("bob, bob-1: counted as different students"), "{:?}", class.remarks);

    let table = "submission,student,time\nanna,Anna,2026-05-04T20:11:00Z\nanna,Carl,2026-05-04T20:11:00Z\nbob,bob,\n";
    fs::write(folder.path().join("students.csv"), table).unwrap();
    let class = found(&folder);
    let expected = [
        ("Anna", "anna", "older"),
        ("Anna", "anna (1)", ""),
        ("Carl", "anna", "older"),
        ("Carl", "anna (1)", ""),
        ("Mallory", "Mallory", ""),
        ("bob", "bob", "older"),
        ("bob", "bob-1", ""),
    ];
    assert_eq!(rows(&class), expected);
    let told = [
        "Mallory: students.csv does not list it; it counts as the submission of another student, Mallory",
        "bob-1: counts as a further attempt of bob; if it is another student's, the table must say so",
    ];
    assert_eq!(class.remarks, told);
}

#[test]
fn no_file_of_a_student_passes_for_a_roster_or_for_the_class() {
    let forged = GRADEBOOK.replace("4711", "4712");
    let folder = download(&[
        ("gradebook.csv", GRADEBOOK),
        ("doejane_4711_98765_hw.zip", BODY),
        ("roejohn_4712_98766_hw.zip", BODY),
        ("roejohn_4712_98767_students.csv", &forged),
        ("__MACOSX/._x", ""),
    ]);
    assert_eq!(rows(&found(&folder)), [("jdoe", "doejane_4711_98765_hw", ""), ("jroe", "roejohn_4712_98766_hw", "")]);
    let metadata = "---\nx:\n  :submitters:\n  - :name: Eve\n";
    let folder =
        download(&[("assignment_1_export/submission_metadata.yml", metadata), ("bob/src/psi_neo_hookean.rs", BODY)]);
    assert_eq!(rows(&found(&folder)), [("assignment_1_export", "assignment_1_export", ""), ("bob", "bob", "")]);
    let twins = "First Name,Last Name,SID,Email\nAnn,Loe,1,a@x.org\nAnn,Loe,2,b@x.org\n";
    let folder = download(&[("roster.csv", twins), ("Ann Loe.zip", BODY), ("1.zip", BODY)]);
    let class = found(&folder);
    assert_eq!(rows(&class), [("Ann Loe", "Ann Loe", ""), ("a@x.org", "1", "")]);
}

#[test]
fn a_roster_beside_the_class_takes_the_place_of_its_tables() {
    let folder = download(&[
        ("doejane_4711_98765_hw.zip", BODY),
        ("roejohn_4712_98770_work.zip", BODY),
        ("students.csv", "student\nx\n"),
    ]);
    let beside =
        download(&[("gradebook.csv", GRADEBOOK), ("table.csv", "submission,student\ndoejane_4711_98765_hw,Jane\n")]);
    let students = |roster: &str| {
        let class = find::class(folder.path(), Some(&beside.path().join(roster)), Counts::Newest)
            .unwrap_or_else(|error| panic!("{error}"));
        class.submissions.iter().map(|one| one.student.clone()).collect::<Vec<_>>()
    };
    assert_eq!(students("gradebook.csv"), ["jdoe", "jroe"]);
    assert_eq!(students("table.csv"), ["Jane", "roejohn_4712"]);
    let missing = find::class(folder.path(), Some(&beside.path().join("nothing.csv")), Counts::Newest);
    let missing = missing.err().expect("an error").to_string();
    assert!(missing.contains("nothing.csv: ") && missing.contains("--roster takes the path of"), "{missing}");
}

#[test]
fn a_roster_that_names_no_student_is_refused_before_anything_is_graded() {
    let folder = download(&[("anna.zip", BODY)]);
    for text in ["", "\0\u{1}", "First Name,Last Name,SID,Email,Role\n", "student\n", "Pages,Words\n"] {
        let beside = download(&[("roster.csv", text)]);
        let class = find::class(folder.path(), Some(&beside.path().join("roster.csv")), Counts::Newest);
        assert!(class.is_err_and(|error| error.to_string().contains("roster.csv: names no student")), "{text:?}");
    }
}
