//! The reference agrees with itself, and mistakes are found.

mod reworded;

use finite_elements_3d as solved;
use grader::implementation::Local;
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
    // With the elements in the opposite order another one is the first that holds it.
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
    assert_eq!(failed("newtons_method", eager), [CALLS]);
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
