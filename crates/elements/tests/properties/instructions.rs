use fem_elements::number::{Instructions, choose};

#[test]
fn instructions_are_the_widest_unless_the_environment_names_others() {
    assert!(matches!(choose(Some("fallback")), Ok(Instructions::Fallback)));
    let widest = format!("{:?}", choose(None).unwrap());
    assert_eq!(format!("{:?}", choose(Some("")).unwrap()), widest);
}

#[test]
fn instructions_that_are_missing_are_refused_by_name() {
    let problem = choose(Some("avx1024")).unwrap_err();
    assert!(
        problem.starts_with("is run with FEM_INSTRUCTIONS = \"avx1024\", and this processor has fallback"),
        "{problem}"
    );
}
