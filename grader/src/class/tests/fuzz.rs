//! Mutated files for every reader of the grader: each is read or refused with a message, without a panic, without a hang, and without
//! memory beyond four times the file, or what an archive unpacks to.

#[path = "../../../../crates/mesh/tests/fuzz/mutation.rs"]
mod mutation;

use std::fmt::Display;
use std::fs;
use std::io::{Cursor, Read, Write};
use std::path::Path;

use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;
use grader::submission::{MAX_FILE_BYTES, NAMES, Source, Submission, Unreadable};
use tempfile::tempdir;
use zip::write::SimpleFileOptions;

use self::mutation::{fuzz, write_over};
use crate::archive::read_submission;
use crate::assess::{ADJUSTMENTS, Adjustments, Metadata};
use crate::class::{Index, find, regrade, store};
use crate::rubric::{Counts, Rubric};

/// The longest message, bytes: it may quote a line of the file.
const LONGEST_MESSAGE: usize = 4000;

const RUBRIC: &str = "partial_credit = true\ntolerance = 1e-9\nseconds = 5.0\ncompile_seconds = 20.0\n\
    later = [\"implicit_euler\"]\n[students]\ndiagnosis = true\nhints = false\n[simulation]\npoints = 0.0\n[deadline]\n\
    at = 2026-05-04T12:00:00Z\npenalty_per_day = 0.5\n[[extension]]\nstudent = \"anna\"\nuntil = 2026-05-06T12:00:00Z\n\
    [[function]]\nname = \"psi_neo_hookean\"\npoints = 4.0\nlevel = 1\n[[function]]\nname = \"assemble_forces\"\npoints = 6.5\n\
    level = 4\nhint = \"Add.\"\ntolerance = 1e-8\n";

const STUDENTS: &str = "submission,student,time,name,id,login,email,section\nteam,anna,2026-05-01T10:00:00Z,\"Ünal, Anna\",17,a1,a@x.org,A\n\
    team,bob,17.5,Bob,18,,,\n,carl,,Carl,19,,c@x.org,B\nsolo.zip,dora,\"Fri, 01 May 2026 10:00:00 +0200\",,,,,\ngone,emil,2026-05-01,,,,,\n";

const ADJUSTED: &str = "student,function,points,reason,comment\nanna,psi_neo_hookean,3.5,\"looked, by hand\",good\n\
    bob,,7,late train,\ncarl,assemble_forces,,,\"see page 3\"\ndora,simulation,0,shown,\n";

const METADATA: &str = r#"{"id": 123456, "created_at": "2018-07-01T14:22:32.365935-07:00", "assignment": {"title": "x", "total_points": "20.0"},
    "users": [{"email": "anna@x.org", "id": 1234, "name": "Anna", "sid": null}, {"email": "bob@x.org", "name": "Bob \u00fc"}]}"#;

const GRADEBOOK: &str = "Student,ID,SIS User ID,SIS Login ID,Section,Finite elements (12)\n    Points Possible,,,,,100\n\"Ünal, Anna\",4711,17,team,A,\n\
    Bob,4712,18,solo,B,\n";

const WORKSHEET: &str = "Identifier,Full name,Email address,Status,Group\nParticipant 1,Anna,a@x.org,Submitted - 3 mins late - ,team\n\
    Participant 2,Bob,b@x.org,No submission,team\n";

const EXPORTED: &str = "---\nteam:\n  :submitters:\n  - :name: \"\\xDCnal\"\n    :sid: \'17\'\n    :email: a@x.org\n  :created_at: 2026-05-04 18:32:11.2 Z\n\
    submission_2:\n  :submitters:\n  - :name: Bob\n    :email: b@x.org\n";

const GRADE: &str = r#"{"format_version": 1, "submission": "anna", "files": "ab", "score": 1.5, "max_score": 2, "seed": 7, "toolchain": "rustc",
    "sandbox": {"landlock": true}, "remarks": ["one"], "functions": [{"name": "f", "score": 1, "max_score": 2, "status": "failed",
    "diagnosis": "negated", "location": null, "message": "m", "hint": null, "error": 1e-3, "seconds": 0.5, "reference_seconds": 0.25,
    "growth": {"exponent": 1.0, "reference_exponent": null, "elements": 100}, "checks": [{"name": "c", "status": "passed",
    "message": "", "counterexample": null}]}], "simulation": {"name": "s", "score": 0, "max_score": 0, "status": "passed",
    "diagnosis": null, "message": null, "hint": null, "error": null, "seconds": null, "reference_seconds": null, "checks": []},
    "account": {"student": "anna", "raw_score": 1.5, "late": null, "adjustments": [{"function": null, "points": 1.5, "reason": "r",
    "comment": null}]}, "study": {"runs": [{"integrator": "implicit_euler", "dt": 0.01, "submission": {"error": 1e-3, "seconds": 0.1},
    "reference": {"error": 1e-3, "seconds": 0.1}}], "uncertainty": 1e-9}, "seconds": 1}"#;

const INDEX: &str = r#"{"format_version": 1, "identity": {"grader": "ab", "toolchain": "rustc", "seed": 7, "rubric": null, "extra": ["--report"]},
    "shard": {"k": 1, "n": 2}, "remarks": ["one"], "people": [{"student": "anna", "name": "Anna", "id": "", "login": "", "email": "", "section": ""}],
    "title": "Finite elements", "max_score": 100.0, "release": null, "submissions": [
    {"submission": "anna", "student": "anna", "state": {"graded": "grades/ab"}}, {"submission": "bob", "student": "bob", "state": "waiting"},
    {"submission": "c", "student": "c", "state": {"not_graded": "no"}}, {"submission": "d", "student": "d", "state": {"no_submission": null}}]}"#;

const POINTS: &str = r#"{"anna": {"submission": "team", "score": 1.5, "max_score": 2.0, "functions": {"f": 1.0, "simulation": 0.5}},
    "bob": {"submission": "team", "score": 1e-3, "max_score": 2.0, "functions": {}}}"#;

/// Mutations of a text in a file of that name; `read` receives its folder.
fn fuzz_text<R>(name: &str, text: &str, read: impl Fn(&Path) -> R, go_on: impl Fn(R)) {
    let folder = tempdir().unwrap();
    for submission in ["team", "solo.zip"] {
        fs::create_dir(folder.path().join(submission)).unwrap();
    }
    let path = folder.path().join(name);
    fuzz(
        name,
        &[text.as_bytes().to_vec()],
        <[u8]>::len,
        |bytes| write_over(&path, bytes),
        |()| read(folder.path()),
        go_on,
    );
}

fn assert_told<T, E: Display>(found: Result<T, E>) -> Option<T> {
    found.map_err(|error| assert!((1..LONGEST_MESSAGE).contains(&error.to_string().len()), "{error}")).ok()
}

#[test]
fn mutated_rubrics_are_read_or_refused() {
    let read = |folder: &Path| Rubric::load(Some(&folder.join("rubric.toml")));
    fuzz_text("rubric.toml", RUBRIC, read, |found| {
        if let Some(rubric) = assert_told(found) {
            assert!((0.0..1e9).contains(&rubric.max_score()), "{}", rubric.max_score());
        }
    });
}

#[test]
fn mutated_tables_of_a_class_are_read_or_refused() {
    let read = |folder: &Path| find::class(folder, None, Counts::Newest);
    fuzz_text("students.csv", STUDENTS, read, |found| {
        if let Some(class) = assert_told(found) {
            assert!(class.people.iter().all(|person| !person.student.is_empty()));
            assert!(class.submissions.iter().all(|submission| submission.submitted().is_some()));
        }
    });
    for (name, text) in
        [("gradebook.csv", GRADEBOOK), ("worksheet.csv", WORKSHEET), ("submission_metadata.yml", EXPORTED)]
    {
        fuzz_text(name, text, read, |found| {
            if let Some(class) = assert_told(found) {
                assert!(class.submissions.iter().all(|submission| !submission.student.is_empty()));
            }
        });
    }
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("rubric.toml"), RUBRIC).unwrap();
    let rubric = Rubric::load(Some(&folder.path().join("rubric.toml"))).unwrap_or_else(|error| panic!("{error}"));
    let read = |folder: &Path| Adjustments::of_class(folder, &rubric);
    fuzz_text(ADJUSTMENTS, ADJUSTED, read, |found| {
        if let Some(adjustments) = assert_told(found) {
            let points = adjustments.of(&["anna"]).into_iter().filter_map(|adjustment| adjustment.points);
            assert!(points.into_iter().all(|points| (0.0..=rubric.max_score()).contains(&points)));
        }
    });
}

#[test]
fn mutated_results_are_read_or_refused() {
    fuzz_text("grade.json", GRADE, store::read_grade, |found| {
        if let Some(grade) = assert_told(found) {
            assert!((0.0..=grade.max_score).contains(&grade.score));
        }
    });
    fuzz_text("class.json", INDEX, Index::read, |found| drop(assert_told(found)));
    fuzz_text("points.json", POINTS, regrade::read, |table| assert!(regrade::changes(&table, &table).is_empty()));
    let metadata = |folder: &Path| Metadata::read(&folder.join("submission_metadata.json"));
    fuzz_text("submission_metadata.json", METADATA, metadata, |found| drop(assert_told(found)));
}

#[test]
fn the_unmutated_files_are_read() {
    let folder = tempdir().unwrap();
    let all = [
        ("rubric.toml", RUBRIC),
        ("students.csv", STUDENTS),
        (ADJUSTMENTS, ADJUSTED),
        ("grade.json", GRADE),
        ("class.json", INDEX),
        ("points.json", POINTS),
        ("submission_metadata.json", METADATA),
    ];
    all.iter().for_each(|(name, text)| fs::write(folder.path().join(name), text).unwrap());
    let rubric = Rubric::load(Some(&folder.path().join("rubric.toml"))).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(find::class(folder.path(), None, Counts::Newest).unwrap().people.len(), 5);
    assert_eq!(Adjustments::of_class(folder.path(), &rubric).unwrap().of(&["anna"]).len(), 1);
    assert_eq!(store::read_grade(folder.path()).unwrap().functions.len(), 1);
    assert_eq!(Index::read(folder.path()).unwrap().submissions.len(), 4);
    assert_eq!(regrade::read(folder.path()).len(), 2);
    assert_eq!(Metadata::read(&folder.path().join("submission_metadata.json")).unwrap().students.len(), 4);
}

const BODY: &str = "pub fn psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64 { C * F.trace() + D }";
const FILES: [&str; 4] =
    ["ada/src/psi_neo_hookean.rs", "ada/src/assemble_forces.rs", "ada/data/mesh.obj", "ada/src/own.rs"];

fn tar() -> Vec<u8> {
    let mut tar = tar::Builder::new(Vec::new());
    for path in FILES {
        let mut header = tar::Header::new_gnu();
        header.set_size(BODY.len() as u64);
        header.set_mode(0o644);
        tar.append_data(&mut header, path, BODY.as_bytes()).unwrap();
    }
    tar.into_inner().unwrap()
}

fn zip() -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for path in FILES {
        zip.start_file(path, SimpleFileOptions::default()).unwrap();
        zip.write_all(BODY.as_bytes()).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut gzip = GzEncoder::new(Vec::new(), Compression::fast());
    gzip.write_all(bytes).unwrap();
    gzip.finish().unwrap()
}

/// Sets the check sums of all headers, so that readers do not reject every mutation of them.
fn with_check_sums(tar: &mut [u8]) {
    for block in tar.as_chunks_mut::<512>().0.iter_mut().filter(|block| block[257..262] == *b"ustar") {
        block[148..156].fill(b' ');
        let sum: u32 = block.iter().map(|&byte| u32::from(byte)).sum();
        block[148..156].copy_from_slice(format!("{sum:06o}\0 ").as_bytes());
    }
}

/// Bytes that a stream yields up to the limit of a file.
fn length(stream: impl Read) -> usize {
    let mut all = Vec::new();
    let _ = stream.take(MAX_FILE_BYTES + 1).read_to_end(&mut all);
    all.len()
}

fn unzipped(bytes: &[u8]) -> usize {
    let Ok(mut archive) = zip::ZipArchive::new(Cursor::new(bytes)) else { return bytes.len() };
    let files = (0..archive.len()).map(|index| archive.by_index(index).map_or(0, length));
    bytes.len() + files.sum::<usize>()
}

#[test]
fn mutated_archives_are_read_or_refused() {
    let folder = tempdir().unwrap();
    let fuzz_archive = |name: &str, file: Vec<u8>, size: &dyn Fn(&[u8]) -> usize, mend: &dyn Fn(&[u8]) -> Vec<u8>| {
        let path = folder.path().join(name);
        let go_on = |found: Result<Submission, Unreadable>| {
            if let Some(submission) = assert_told(found) {
                assert!(submission.functions.keys().all(|name| NAMES.contains(name)));
            }
        };
        let prepare = |bytes: &[u8]| write_over(&path, &mend(bytes));
        prepare(&file);
        let whole = read_submission(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(matches!(whole.functions["psi_neo_hookean"], Source::Written(_)), "{name}");
        fuzz(name, &[file], size, prepare, |()| read_submission(&path), go_on);
    };
    let mended = |bytes: &[u8]| {
        let mut bytes = bytes.to_vec();
        with_check_sums(&mut bytes);
        bytes
    };
    let whole = <[u8]>::len;
    fuzz_archive("ada.zip", zip(), &unzipped, &<[u8]>::to_vec);
    fuzz_archive("ada.tar", tar(), &whole, &mended);
    fuzz_archive("ada.tgz", gzip(&tar()), &|bytes| length(MultiGzDecoder::new(bytes)), &<[u8]>::to_vec);
    // Headers inside of a compressed archive.
    fuzz_archive("adb.tgz", tar(), &whole, &|bytes| gzip(&mended(bytes)));
}
