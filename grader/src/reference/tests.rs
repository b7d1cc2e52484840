//! The reference agrees with itself, and mistakes are found.

mod reworded;

use finite_elements_3d as solved;
use grader::implementation::Local;
use grader::properties::outcome::with_tolerance;
use grader::properties::{Course, FUNCTIONS, sentence};
use grader_child::{Functions, NAMES};

use reworded::REWORDED;

use super::judge::judge;
use super::{REFERENCE, TOLERANCE, trials};

#[test]
fn the_reference_agrees_with_itself() {
    for seed in 0..3 {
        for function in NAMES {
            let judgement = judge(function, seed, &Local(REFERENCE), TOLERANCE).expect("the reference answers");
            assert!(judgement.failures.is_empty(), "{function}: {:?}", judgement.failures[0]);
            assert_eq!(judgement.worst_error, Some(0.0), "{function}");
            assert!((20..=60).contains(&judgement.trials), "{function}: {} trials", judgement.trials);
        }
    }
}

#[test]
fn every_step_of_implicit_euler_converges_in_five_directions() {
    for seed in 0..20 {
        for trial in trials("implicit_euler", seed) {
            let residual = trial.run(&Local(REFERENCE)).expect("the reference answers").residual;
            assert!(residual.is_some_and(|left| left < 1e-6), "{}: {residual:?}", trial.name);
        }
    }
}

#[test]
fn a_seed_gives_the_same_trials_again_and_another_seed_gives_others() {
    for function in NAMES {
        let text = |seed| format!("{:?}", trials(function, seed));
        assert_eq!(text(1), text(1), "{function}");
        assert_ne!(text(1), text(2), "{function}");
    }
}

#[test]
fn other_round_off_is_no_mistake() {
    let functions = [
        "phi_linear_tetrahedron",
        "psi_neo_hookean",
        "dpsi_neo_hookean_dF",
        "linearly_implicit_euler",
        "newtons_method",
        "implicit_euler",
    ];
    for seed in 0..20 {
        for function in functions {
            let judgement = judge(function, seed, &Local(REWORDED), TOLERANCE).expect("the reference answers");
            let first = judgement.failures.first();
            assert!(first.is_none(), "{function}: {first:?}");
        }
    }
}

#[test]
fn every_check_is_named_on_the_page_of_its_function_and_no_other_is() {
    for (function, checks) in FUNCTIONS {
        let path = format!("{}/../include-docs/{function}.md", env!("CARGO_MANIFEST_DIR"));
        let page = std::fs::read_to_string(&path).expect("a page");
        let (_, list) = page.split_once("\n## What is checked\n").expect("a list of names");
        let (list, _) = list.split_once("\n## ").expect("a next part");
        let named: Vec<_> = list.lines().filter_map(|line| line.strip_prefix("- ")).collect();
        let compared = judge(function, 1, &Local(REFERENCE), TOLERANCE).expect("the reference answers");
        let compared = compared.checks(function).into_iter().map(|(check, _)| check.name());
        let expected = checks.iter().map(|check| check.name).chain(compared).map(sentence);
        assert_eq!(named, expected.collect::<Vec<_>>(), "{path}");
    }
}

/// The reference with answers that are wrong by a hundred-millionth.
const ROUGH: Functions = Functions {
    phi_linear_tetrahedron: |V, e, x| solved::phi_linear_tetrahedron(V, e, x) * ROUGHLY_ONE,
    psi_neo_hookean: |F, C, D| solved::psi_neo_hookean(F, C, D) * ROUGHLY_ONE,
    dpsi_neo_hookean_dF: |F, C, D| solved::dpsi_neo_hookean_dF(F, C, D) * ROUGHLY_ONE,
    T_linear_tetrahedron: |v, e, density, volume| solved::T_linear_tetrahedron(v, e, density, volume) * ROUGHLY_ONE,
    dV_linear_tetrahedron_dq: |q, V, e, v, C, D| solved::dV_linear_tetrahedron_dq(q, V, e, v, C, D) * ROUGHLY_ONE,
    mass_matrix_mesh: |n, T, density, v0| solved::mass_matrix_mesh(n, T, density, v0) * ROUGHLY_ONE,
    assemble_forces: |q, V, T, v0, C, D| solved::assemble_forces(q, V, T, v0, C, D) * ROUGHLY_ONE,
    ..REFERENCE
};
const ROUGHLY_ONE: f64 = 1.0 + 1e-8;

#[test]
fn a_laxer_tolerance_in_the_rubric_holds_for_every_check() {
    let names = [
        "phi_linear_tetrahedron",
        "psi_neo_hookean",
        "dpsi_neo_hookean_dF",
        "T_linear_tetrahedron",
        "dV_linear_tetrahedron_dq",
        "mass_matrix_mesh",
        "assemble_forces",
    ];
    let (subject, trusted) = (Local(ROUGH), Local(REFERENCE));
    let course = Course { subject: &subject, trusted: &trusted, seed: 5 };
    for (function, checks) in FUNCTIONS.into_iter().filter(|(function, _)| names.contains(function)) {
        let failures = |tolerance: f64| {
            let judgement = judge(function, 5, &subject, tolerance).expect("the reference answers");
            let compared = judgement.checks(function).into_iter().filter_map(|(check, why)| why.map(|_| check.name()));
            let failing = checks.iter().filter(|check| with_tolerance(tolerance, || (check.run)(&course)).is_err());
            compared.chain(failing.map(|check| check.name)).collect::<Vec<_>>()
        };
        assert_eq!(failures(1e-6), [""; 0], "{function}");
        assert!(failures(TOLERANCE).len() > 1, "{function}");
    }
}

fn failed(function: &str, functions: Functions) -> Vec<&'static str> {
    let judgement = judge(function, 5, &Local(functions), TOLERANCE).expect("the reference answers");
    let checks = judgement.checks(function).into_iter();
    checks.filter_map(|(check, failure)| failure.map(|_| check.name())).collect()
}

const VALUES: &str = "agrees_with_the_reference";
const EDGES: &str = "edge_cases_agree_with_the_reference";
const CALLS: &str = "closures_are_called_as_often_as_promised";

#[test]
fn wrong_values_and_values_that_are_none_fail() {
    let nan = Functions { psi_neo_hookean: |_, _, _| f64::NAN, ..REFERENCE };
    assert_eq!(failed("psi_neo_hookean", nan), [VALUES, EDGES]);
    let slightly = Functions { psi_neo_hookean: |F, C, D| solved::psi_neo_hookean(F, C * 1.0000001, D), ..REFERENCE };
    assert_eq!(failed("psi_neo_hookean", slightly), [VALUES]);
    let finite = Functions { psi_neo_hookean: |F, C, D| solved::psi_neo_hookean(F, C, D).min(1e300), ..REFERENCE };
    assert_eq!(failed("psi_neo_hookean", finite), [EDGES]);
    let counted = Functions {
        fixed_point_constraints: |n, indices| {
            let all: Vec<_> = (0..n).filter(|k| !indices.contains(&(k / 3))).collect();
            let mut P = nalgebra_sparse::CooMatrix::new(n - (3 * indices.len()).min(n), n);
            all.iter().take(P.nrows()).enumerate().for_each(|(i, &j)| P.push(i, j, 1.0));
            (&P).into()
        },
        ..REFERENCE
    };
    assert_eq!(failed("fixed_point_constraints", counted), [EDGES]);
}

#[test]
fn any_tetrahedron_that_holds_a_point_will_do() {
    // With the elements in the opposite order, another one is the first that contains the point.
    let last = Functions {
        build_skinning_matrix: |V, T, S| {
            let reversed: Vec<_> = T.iter().rev().copied().collect();
            solved::build_skinning_matrix(V, &reversed, S)
        },
        ..REFERENCE
    };
    assert!(failed("build_skinning_matrix", last).is_empty());
    let nearest_of_one =
        Functions { build_skinning_matrix: |V, T, S| solved::build_skinning_matrix(V, &T[..1], S), ..REFERENCE };
    assert_eq!(failed("build_skinning_matrix", nearest_of_one), [VALUES, EDGES]);
}

#[test]
fn calls_too_many_fail_and_do_not_change_the_rest() {
    let twice = Functions {
        linearly_implicit_euler: |q, v, dt, M, f, K, solve| {
            f(q, v);
            solved::linearly_implicit_euler(q, v, dt, M, f, K, solve);
        },
        ..REFERENCE
    };
    assert_eq!(failed("linearly_implicit_euler", twice), [CALLS]);
    let eager = Functions {
        newtons_method: |x, f, g, H, solve, most| {
            H(x);
            solved::newtons_method(x, f, g, H, solve, most)
        },
        ..REFERENCE
    };
    // Only where the start is the solution.
    assert_eq!(failed("newtons_method", eager), [EDGES]);
}

#[test]
fn newtons_method_without_a_line_search_fails() {
    let bold = Functions {
        newtons_method: |x, f, g, H, solve, most| {
            for _ in 0..most {
                let d = solve(&H(x), &-g(x));
                *x += d;
            }
            f(x)
        },
        ..REFERENCE
    };
    assert!(failed("newtons_method", bold).contains(&VALUES));
}

#[test]
fn a_matrix_of_any_size_is_wrong_and_harmless() {
    let huge = Functions {
        build_skinning_matrix: |_, _, _| nalgebra_sparse::CsrMatrix::zeros(3, usize::MAX / 2),
        linearly_implicit_euler: |q, v, _, _, _, _, solve| {
            *v = solve(&nalgebra_sparse::CsrMatrix::identity(100_000), &nalgebra::DVector::zeros(100_000));
            *q = v.clone();
        },
        ..REFERENCE
    };
    assert_eq!(failed("build_skinning_matrix", huge), [VALUES, EDGES]);
    assert_eq!(failed("linearly_implicit_euler", huge)[0], VALUES);
}
