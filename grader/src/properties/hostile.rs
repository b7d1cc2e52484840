//! Malformed answers never make a check panic or pass.

use grader_child::{
    Force, Functions, Gradient, Hessian, Integrand, Objective, Solve, Stiffness, UNWRITTEN, course_functions,
};
use nalgebra::{DVector, Matrix3, Matrix4, SMatrix, Vector3, Vector4};
use nalgebra_sparse::CsrMatrix;

use super::outcome::{Mistake, message_of};
use super::{Check, Course, FUNCTIONS};
use crate::implementation::{Local, Trouble};

/// Kinds of malformed answers.
trait Garbage {
    fn garbage(kind: u8) -> Self;
}

impl Garbage for f64 {
    fn garbage(kind: u8) -> Self {
        [f64::NAN, f64::INFINITY, f64::MAX, -f64::MAX][usize::from(kind % 4)]
    }
}

impl<const R: usize, const C: usize> Garbage for SMatrix<f64, R, C> {
    fn garbage(kind: u8) -> Self {
        Self::repeat(f64::garbage(kind))
    }
}

impl Garbage for DVector<f64> {
    fn garbage(kind: u8) -> Self {
        DVector::from_element([0, 1, 2, 1000][usize::from(kind % 4)], f64::garbage(kind))
    }
}

impl Garbage for CsrMatrix<f64> {
    fn garbage(kind: u8) -> Self {
        let (rows, columns) = [(0, 0), (1, usize::MAX), (usize::from(kind), 3), (24, 24)][usize::from(kind % 4)];
        CsrMatrix::zeros(rows, columns)
    }
}

impl Garbage for Vec<usize> {
    fn garbage(kind: u8) -> Self {
        vec![usize::MAX; usize::from(kind)]
    }
}

impl Garbage for () {
    fn garbage(_: u8) {}
}

macro_rules! without_closures {
    ($($kind:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        /// Answers garbage and calls no closure.
        fn returning_garbage<const KIND: u8>() -> Functions {
            Functions { $($name: |$(_: $type),*| Garbage::garbage(KIND)),* }
        }
    };
}
course_functions!(without_closures);

/// Answers garbage, and passes garbage to the closures.
fn answering_garbage<const KIND: u8>() -> Functions {
    Functions {
        quadrature_single_point: |_, _, _, f| f(&Vector3::garbage(KIND)).push(1.0),
        linearly_implicit_euler: |q, qdot, _, _, force, stiffness, solve| {
            force(&DVector::garbage(KIND), &DVector::garbage(KIND));
            stiffness(qdot, &DVector::garbage(KIND));
            solve(&CsrMatrix::garbage(KIND), &DVector::garbage(KIND));
            (*q, *qdot) = (DVector::garbage(KIND), DVector::garbage(KIND));
        },
        newtons_method: |x, f, g, H, solve, _| {
            f(&DVector::garbage(KIND));
            g(&DVector::garbage(KIND));
            H(&DVector::garbage(KIND));
            solve(&CsrMatrix::garbage(KIND), &DVector::garbage(KIND));
            *x = DVector::garbage(KIND);
            f64::garbage(KIND)
        },
        implicit_euler: |q, qdot, _, _, energy, force, stiffness, solve| {
            energy(&DVector::garbage(KIND));
            force(&DVector::garbage(KIND), qdot);
            stiffness(&DVector::garbage(KIND), &DVector::garbage(KIND));
            solve(&CsrMatrix::garbage(KIND), &DVector::garbage(KIND));
            (*q, *qdot) = (DVector::garbage(KIND), DVector::garbage(KIND));
        },
        ..returning_garbage::<KIND>()
    }
}

fn mistakes(function: &str, checks: &[Check], functions: Functions) -> Vec<Mistake> {
    let asked = Local(functions);
    let course = Course { subject: &asked, trusted: &asked, seed: 7 };
    let found: Vec<_> = checks.iter().filter_map(|check| (check.run)(&course).err()).collect();
    assert!(!found.is_empty(), "{function} passes although it is not written");
    found
}

#[test]
fn a_function_that_is_not_there_fails_every_check() {
    for (function, checks) in FUNCTIONS {
        let found = mistakes(function, checks, UNWRITTEN);
        assert_eq!(found.len(), checks.len(), "{function}");
        assert!(found.iter().all(|mistake| !matches!(mistake, Mistake::Wrong { .. })), "{function}: {found:?}");
    }
}

#[test]
fn whatever_is_answered_no_check_panics() {
    let kinds =
        [answering_garbage::<0>(), answering_garbage::<1>(), answering_garbage::<2>(), answering_garbage::<3>()];
    for functions in kinds {
        for (function, checks) in FUNCTIONS {
            // These functions do not panic, so a panic comes from a closure of a check.
            let panicked = |mistake: &Mistake| matches!(mistake, Mistake::Trouble(Trouble::Panicked { .. }));
            assert!(!mistakes(function, checks, functions).iter().any(panicked), "{function}");
        }
    }
}

/// Figures of the pages and names of entries, which anyone may read.
const PUBLIC: [&str; 4] = ["1e-10", "P_01", "P_10", "12×12"];

#[test]
fn no_rule_gives_away_an_input() {
    let kinds =
        [answering_garbage::<0>(), answering_garbage::<1>(), answering_garbage::<2>(), answering_garbage::<3>()];
    for (functions, (function, checks)) in kinds.into_iter().flat_map(|kind| FUNCTIONS.map(|entry| (kind, entry))) {
        for mistake in mistakes(function, checks, functions) {
            let Mistake::Wrong { rule, .. } = mistake else { continue };
            let secret = PUBLIC.iter().fold(rule.clone(), |rule, public| rule.replace(public, ""));
            let mut figures = secret.split(|c: char| !c.is_ascii_digit() && c != '.');
            assert!(figures.all(|figure| figure.len() < 2), "{function}: {rule:?}; figures belong into the input");
        }
    }
}

#[test]
fn a_function_that_a_check_needs_is_named_where_it_is_not_there() {
    let (asked, needed) = (Local(answering_garbage::<0>()), Local(UNWRITTEN));
    let course = Course { subject: &asked, trusted: &needed, seed: 7 };
    let (_, checks) = FUNCTIONS.iter().find(|(name, _)| *name == "dpsi_neo_hookean_dF").expect("a function");
    let waits = checks.iter().filter_map(|check| (check.run)(&course).err());
    let needs = waits.filter_map(|mistake| match mistake {
        Mistake::Waits { needs, .. } => Some(needs),
        _ => None,
    });
    let needs: Vec<_> = needs.collect();
    assert_eq!(needs, ["psi_neo_hookean"]);
}

#[test]
fn a_student_is_told_the_page() {
    let text = message_of("psi_neo_hookean", &Mistake::Trouble(Trouble::Missing));
    assert!(text.ends_with("Read include-docs/psi_neo_hookean.md"), "{text}");
}

#[test]
fn names_of_checks_are_unique_and_every_function_has_some() {
    for (function, checks) in FUNCTIONS {
        let mut names: Vec<_> = checks.iter().map(|check| check.name).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert!(count > 1 && names.len() == count, "{function}: {names:?}");
    }
}
