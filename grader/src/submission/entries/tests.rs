use std::fs;

use super::Content;
use crate::submission::{NAMES, Source, Submission, is_stub};

const BODY: &str = "pub fn psi_neo_hookean() -> f64 { 1.0 }";

fn of(files: &[(&str, &[u8])]) -> Submission {
    let entries = files.iter().map(|(path, bytes)| (path.to_string(), Content::File(bytes.to_vec()))).collect();
    Submission::from_entries("ada".to_owned(), entries).unwrap()
}

fn psi(submission: &Submission) -> &Source {
    &submission.functions["psi_neo_hookean"]
}

#[test]
fn the_22_files_are_taken_also_out_of_one_folder_that_wraps_them() {
    let plain = of(&[("src/psi_neo_hookean.rs", BODY.as_bytes())]);
    let wrapped = of(&[("ada-main/src/psi_neo_hookean.rs", BODY.as_bytes()), ("__MACOSX/src/._x", b"")]);
    assert_eq!(psi(&plain), &Source::Written(BODY.to_owned()));
    assert_eq!(plain.functions, wrapped.functions);
    assert_eq!(plain.hash(), wrapped.hash());
    assert_eq!(plain.functions.len(), 22);
    assert_eq!(plain.functions["newtons_method"], Source::Missing("there is no src/newtons_method.rs".to_owned()));
}

#[test]
fn line_ends_and_byte_order_marks_make_no_difference() {
    let text = "fn a() {}\npub fn psi_neo_hookean() {}";
    let odd = format!("\u{feff}{}", text.replace('\n', "\r\n"));
    assert_eq!(of(&[("src/psi_neo_hookean.rs", odd.as_bytes())]), of(&[("src/psi_neo_hookean.rs", text.as_bytes())]));
}

#[test]
fn a_file_that_is_no_text_or_too_large_costs_its_own_function_alone() {
    let large = vec![b' '; (1 << 20) + 1];
    let submission = of(&[
        ("src/psi_neo_hookean.rs", b"fn f() {}\n\xff"),
        ("src/newtons_method.rs", &large),
        ("src/assemble_forces.rs", b"pub fn assemble_forces() {}"),
    ]);
    assert!(matches!(psi(&submission), Source::Refused { line: Some(2), .. }));
    assert!(matches!(submission.functions["newtons_method"], Source::Refused { line: None, .. }));
    assert!(matches!(submission.functions["assemble_forces"], Source::Written(_)));
}

#[test]
fn what_is_left_aside_and_may_surprise_is_remarked() {
    let submission = of(&[
        ("src/psi_neo_hookean.rs", BODY.as_bytes()),
        ("src/Newtons_Method.rs", b"fn f() {}"),
        ("assemble_forces.rs", b"fn f() {}"),
        ("src/helpers.rs", b"fn f() {}"),
        ("src/lib.rs", b""),
        ("src/given/mod.rs", b""),
        ("tests/functions/psi_neo_hookean.rs", b""),
        ("include-docs/psi_neo_hookean.md", b""),
        ("Cargo.toml", b""),
        ("build.rs", b"fn main() {}"),
        (".cargo/config.toml", b"[build]"),
        (".cargo/credentials.toml", b""),
    ]);
    assert_eq!(
        submission.remarks,
        [
            ".cargo is ignored: all submissions are built in the same way",
            "assemble_forces.rs is ignored: the file must be src/assemble_forces.rs",
            "build.rs is ignored: all submissions are built in the same way",
            "src/Newtons_Method.rs is ignored: with the same capitals its name must be src/newtons_method.rs",
            "src/helpers.rs is ignored: put helpers into the function's own file",
        ]
    );
}

#[test]
fn remarks_and_files_that_are_looked_at_have_an_end() {
    let names: Vec<_> = (0..1000).map(|i| format!("src/{i}{}.rs", "x".repeat(300))).collect();
    let files: Vec<_> = names.iter().map(|name| (name.as_str(), &b""[..])).collect();
    let remarks = of(&files).remarks;
    assert_eq!((remarks.len(), remarks[20].as_str()), (21, "980 more files are ignored"));
    assert!(remarks.iter().all(|remark| remark.len() < 300));
    let folder = tempfile::tempdir().unwrap();
    for top in ["a", "b"] {
        fs::create_dir_all(folder.path().join(top).join("src")).unwrap();
        for i in 0..5001 {
            fs::write(folder.path().join(top).join(format!("src/{i}")), "").unwrap();
        }
    }
    let refused = Submission::read_folder(folder.path()).unwrap_err().to_string();
    assert!(refused.contains("more than 10000 files"), "{refused}");
}

#[test]
fn a_macro_of_one_file_makes_words_of_another_suspect() {
    let define = b"macro_rules! call { ($m:ident $a:tt) => { $m!$a } } pub(crate) use call;";
    let submission = of(&[
        ("src/newtons_method.rs", define),
        ("src/psi_neo_hookean.rs", b"const X: &str = crate::newtons_method::call!(env (\"HOME\"));"),
    ]);
    assert!(matches!(psi(&submission), Source::Refused { line: Some(1), .. }), "{:?}", psi(&submission));
}

#[test]
fn a_file_that_is_there_twice_is_refused() {
    let twice = of(&[("src/psi_neo_hookean.rs", BODY.as_bytes()), ("src/psi_neo_hookean.rs", b"fn f() {}")]);
    assert!(matches!(psi(&twice), Source::Refused { line: None, .. }));
}

#[test]
fn without_one_folder_src_nothing_can_be_read() {
    let read = |paths: &[&str]| {
        let entries = paths.iter().map(|path| (path.to_string(), Content::Unread)).collect();
        Submission::from_entries(String::new(), entries).map_err(|error| error.to_string())
    };
    let none = Err("there is no folder `src` in it; hand in the files as src/NAME.rs".to_owned());
    assert_eq!(read(&[]), none);
    assert_eq!(
        read(&["a/b/psi.rs", "tests/functions/psi_neo_hookean.rs", "grader/handed_out/psi_neo_hookean.rs"]),
        none
    );
    assert!(read(&["hw.zip"]).is_err_and(|error| error.contains("only the archive hw.zip")));
    assert!(read(&["a/psi_neo_hookean.rs", "b/psi_neo_hookean.rs"]).is_err_and(|error| error.contains("(a, b)")));
    assert!(read(&["a/src/x.rs", "b/src/x.rs"]).is_err_and(|error| error.contains("(a, b)")));
}

#[test]
fn files_nested_too_deep_or_at_the_top_are_taken() {
    let body = BODY.as_bytes();
    for (path, remark) in [
        ("a/b/c/src/psi_neo_hookean.rs", None),
        ("psi_neo_hookean.rs", Some("there is no folder `src` in it; the files were taken from its top")),
        ("hw/Ada Doe/psi_neo_hookean.rs", Some("there is no folder `src` in it; the files were taken from hw/Ada Doe")),
    ] {
        let submission = of(&[
            (path, body),
            ("tests/functions/psi_neo_hookean.rs", b"given"),
            ("__MACOSX/src/psi_neo_hookean.rs", b"x"),
        ]);
        assert_eq!(psi(&submission), &Source::Written(BODY.to_owned()), "{path}");
        assert_eq!(submission.remarks.first().map(String::as_str), remark, "{path}");
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir_all(folder.path().join(path).parent().unwrap()).unwrap();
        fs::write(folder.path().join(path), BODY).unwrap();
        fs::create_dir_all(folder.path().join("tests/functions")).unwrap();
        fs::write(folder.path().join("tests/functions/psi_neo_hookean.rs"), "given").unwrap();
        let read = Submission::read_folder(folder.path()).unwrap();
        assert_eq!((read.functions, read.remarks), (submission.functions, submission.remarks), "{path}");
    }
    let both = of(&[("old/deep/src/psi_neo_hookean.rs", b"old"), ("new/src/psi_neo_hookean.rs", body)]);
    assert_eq!(psi(&both), &Source::Written(BODY.to_owned()), "the uppermost `src` counts");
}

#[test]
fn the_handouts_function_is_missing_and_a_written_one_is_not() {
    let stub = "use a::B;\npub fn f(x: &B) -> f64 { let _ = x; todo!(\"write this function\") }";
    assert!(is_stub("f", stub));
    assert!(is_stub("f", "fn g() {} pub fn f() { unimplemented!() }"));
    assert!(is_stub("f", "pub fn f() { std::todo!(); }"));
    assert!(!is_stub("f", "pub fn f(x: f64) -> f64 { if x < 0.0 { todo!() } x }"));
    assert!(!is_stub("f", "pub fn f() {}"));
    assert!(!is_stub("g", "pub fn f() { todo!() }"));
    assert!(!is_stub("f", "pub fn f( { todo!() }"));
}

#[test]
fn a_folder_is_read_and_its_links_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let src = folder.path().join("work").join("src");
    fs::create_dir_all(&src).unwrap();
    fs::write(src.join("psi_neo_hookean.rs"), BODY).unwrap();
    fs::write(src.join("helpers.rs"), "").unwrap();
    fs::create_dir(src.join("assemble_forces.rs")).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("/etc/passwd", src.join("newtons_method.rs")).unwrap();
    let submission = Submission::read_folder(folder.path()).unwrap();
    assert_eq!(psi(&submission), &Source::Written(BODY.to_owned()));
    assert!(matches!(submission.functions["assemble_forces"], Source::Refused { .. }));
    #[cfg(unix)]
    assert!(
        matches!(&submission.functions["newtons_method"], Source::Refused { reason, .. } if reason.contains("link"))
    );
    assert_eq!(submission.remarks.len(), 1);
    assert!(Submission::read_folder(&folder.path().join("nothing")).is_err());
}

#[test]
fn names_are_22_different_ones() {
    let mut sorted = NAMES;
    sorted.sort_unstable();
    assert!(sorted.windows(2).all(|pair| pair[0] != pair[1]));
}
