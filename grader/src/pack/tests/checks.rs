//! An instructor's own checks in a package.

use super::*;

#[test]
fn checks_beside_a_rubric_are_packed_beside_it_and_others_are_refused() {
    let folder = packed(Platform::Gradescope);
    let repository = folder.path().join("repository");
    let read = |out: &Path, name: &str| fs::read_to_string(out.join("autograder").join(name)).unwrap();
    assert!(!read(&repository.join("out"), "setup.sh").contains("--rubric"), "the rubric is in the grader");
    let rubric = folder.path().join("rubric.toml");
    fs::create_dir(folder.path().join("checks")).unwrap();
    let own = folder.path().join("checks/own.rs");
    fs::write(&rubric, "# the assignment").unwrap();
    fs::write(&own, "// a check").unwrap();
    let pack_with = |check: &Path, out: &str| {
        pack(&PackOptions {
            platform: Platform::Gradescope,
            out: folder.path().join(out),
            repository: repository.clone(),
            seed: 1,
            rubric: Some(rubric.clone()),
            functions: 3,
            checks: vec![check.to_owned()],
            vendor: false,
        })
    };
    pack_with(&own, "with").unwrap();
    let with = folder.path().join("with");
    assert_eq!(read(&with, "grader/checks/own.rs"), "// a check");
    assert!(read(&with, "setup.sh").contains("grade . --rubric grader/rubric.toml --out"));
    assert!(read(&with, "setup.sh").contains("\"3 of 3 functions pass\""));
    assert!(read(&with, "run_autograder").contains("\"$submission\" --rubric grader/rubric.toml --out"));
    let other = tempfile::tempdir().unwrap();
    fs::write(other.path().join("own.rs"), "").unwrap();
    for misplaced in [other.path().join("own.rs"), folder.path().join("checks/../../own.rs")] {
        assert!(matches!(pack_with(&misplaced, "without"), Err(PackError::Misplaced(..))), "{}", misplaced.display());
    }
}
