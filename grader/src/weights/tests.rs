//! Edge cases cost little, and what never ends costs much.

use std::panic::{self, AssertUnwindSafe};

use finite_elements_3d as solved;
use grader::implementation::Local;
use grader::properties::{Course, FUNCTIONS};
use grader::status::Status;
use grader_child::{Functions, Gradient, Hessian, Objective, Solve};
use nalgebra::{DVector, SVector, Vector4};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::edge_cases::EDGE_CASES;
use super::table::checks_of;
use super::*;
use crate::assess::points;
use crate::grade::CheckGrade;
use crate::reference::judge::judge;
use crate::reference::{REFERENCE, TOLERANCE};
use crate::rubric::Rubric;

fn check(name: &str, status: Status) -> CheckGrade {
    CheckGrade { name: name.to_owned(), status, message: String::new(), counterexample: None }
}

fn score(function: &str, checks: &[CheckGrade]) -> f64 {
    let rubric = Rubric::load(None).expect("the grader's own rubric");
    let status = checks.iter().map(|check| check.status).max().expect("a check");
    points(function, &rubric.worth(function, 100.0), (status, checks))
}

/// The share of its points that a function keeps, in percent, as `grade` would find it.
fn kept(function: &'static str, functions: Functions) -> f64 {
    let subject = Local(functions);
    let judgement = judge(function, 3, &subject, TOLERANCE).expect("the reference answers");
    let status = |is_right| if is_right { Status::Passed } else { Status::Failed };
    let compared =
        judgement.checks(function).into_iter().map(|(found, why)| check(found.name(), status(why.is_none())));
    let course = Course { subject: &subject, trusted: &Local(REFERENCE), seed: 3 };
    let (_, properties) = FUNCTIONS.iter().find(|(name, _)| *name == function).expect("a function");
    let is_right = |run: fn(&Course) -> _| matches!(panic::catch_unwind(AssertUnwindSafe(|| run(&course))), Ok(Ok(())));
    let properties = properties.iter().map(|property| check(property.name, status(is_right(property.run))));
    let checks: Vec<_> = compared.chain(properties).collect();
    println!(
        "{function}: {:?}",
        checks.iter().filter(|c| c.status != Status::Passed).map(|c| &c.name).collect::<Vec<_>>()
    );
    score(function, &checks)
}

macro_rules! mistake {
    ($name:ident, $body:expr) => {
        (stringify!($name), Functions { $name: $body, ..REFERENCE })
    };
}

/// Newton's method with one test of a step, and what is done where no step passes it.
fn newton(
    x0: &mut DVector<f64>,
    f: Objective,
    g: Gradient,
    H: Hessian,
    solve: Solve,
    (max_steps, is_good, restores): (usize, fn(f64, f64) -> bool, bool),
) -> f64 {
    let at_start = g(x0).norm();
    for _ in 0..max_steps {
        let gradient = g(x0);
        if gradient.norm() <= 1e-10 * at_start {
            break;
        }
        let (d, value, old) = (solve(&H(x0), &-&gradient), f(x0), x0.clone());
        let mut alpha = 1.0;
        loop {
            *x0 = &old + &d * alpha;
            if is_good(f(x0), value + 1e-8 * alpha * gradient.dot(&d)) {
                break;
            }
            alpha /= 2.0;
            if alpha < 1e-8 {
                if restores {
                    *x0 = old;
                }
                return f(x0);
            }
        }
    }
    f(x0)
}

/// Functions that are right but for an edge case.
fn wrong_in_an_edge_case() -> Vec<(&'static str, Functions)> {
    vec![
        mistake!(phi_linear_tetrahedron, |V, e, x| {
            let [a, b, c, d] = e.map(|vertex| V[vertex]);
            let volume = (b - a).cross(&(c - a)).dot(&(d - a));
            if volume.abs() < 1e-12 { Vector4::zeros() } else { solved::phi_linear_tetrahedron(V, e, x) }
        }),
        mistake!(psi_neo_hookean, |F, C, D| {
            let J = F.determinant();
            C * (J.powf(-2.0 / 3.0) * F.norm_squared() - 3.0) + D * (J - 1.0).powi(2)
        }),
        mistake!(V_spring_particle_particle, |a, b, l0, k| {
            if a == b { 0.0 } else { solved::V_spring_particle_particle(a, b, l0, k) }
        }),
        mistake!(dV_spring_particle_particle_dq, |a, b, l0, k| {
            let by_b = (b - a) * (k * (1.0 - l0 / (b - a).norm()));
            SVector::from([-by_b.x, -by_b.y, -by_b.z, by_b.x, by_b.y, by_b.z])
        }),
        mistake!(mass_matrix_mesh, |_, T, density, v0| {
            let vertices = T.iter().flatten().max().map_or(0, |last| last + 1);
            solved::mass_matrix_mesh(3 * vertices, T, density, v0)
        }),
        mistake!(build_skinning_matrix, |V, T, skin| skinned(V, T, skin, |phi| phi.min() >= -1e-6, false)),
        mistake!(build_skinning_matrix, |V, T, skin| skinned(V, T, skin, |phi| phi.min() > 0.0, true)),
        mistake!(fixed_point_constraints, |q_size, indices| {
            let free: Vec<_> = (0..q_size).filter(|row| !indices.contains(&(row / 3))).collect();
            let mut P = CooMatrix::new(q_size - 3 * indices.len(), q_size);
            free.iter().enumerate().for_each(|(row, &column)| P.push(row, column, 1.0));
            CsrMatrix::from(&P)
        }),
        mistake!(newtons_method, |x, f, g, H, solve, n| newton(x, f, g, H, solve, (n, is_not_worse, true))),
        mistake!(newtons_method, |x, f, g, H, solve, n| newton(x, f, g, H, solve, (n, |new, most| new <= most, true))),
        mistake!(newtons_method, |x, f, g, H, solve, n| newton(x, f, g, H, solve, (n, is_good, false))),
        mistake!(newtons_method, |x, f, g, H, solve, n| {
            let _ = H(x);
            solved::newtons_method(x, f, g, H, solve, n)
        }),
        mistake!(newtons_method, |x, f, g, H, solve, n| solved::newtons_method(x, f, g, H, solve, n.max(1))),
        mistake!(implicit_euler, |q, v, dt, M, energy, force, stiffness, solve| {
            let _ = stiffness(q, v);
            solved::implicit_euler(q, v, dt, M, energy, force, stiffness, solve);
        }),
    ]
}

/// The test that lets NaN through.
fn is_not_worse(new: f64, most: f64) -> bool {
    let is_worse = new > most;
    !is_worse
}

fn is_good(new: f64, most: f64) -> bool {
    new.is_finite() && new <= most
}

/// The first element that holds a display vertex; if none does, the first of all or an empty row.
fn skinned(
    V: &[nalgebra::Vector3<f64>],
    T: &[[usize; 4]],
    skin: &[nalgebra::Vector3<f64>],
    holds: fn(&Vector4<f64>) -> bool,
    has_rest: bool,
) -> CsrMatrix<f64> {
    let mut N = CooMatrix::new(skin.len(), V.len());
    for (row, x) in skin.iter().enumerate() {
        let found = T.iter().find(|element| holds(&solved::phi_linear_tetrahedron(V, element, x)));
        if let Some(element) = found.or(T.first().filter(|_| has_rest)) {
            let phi = solved::phi_linear_tetrahedron(V, element, x);
            (0..4).for_each(|i| N.push(row, element[i], phi[i]));
        }
    }
    CsrMatrix::from(&N)
}

#[test]
fn a_mistake_in_an_edge_case_costs_something_and_at_most_a_fifth() {
    let all = wrong_in_an_edge_case().into_iter().map(|(function, functions)| (function, kept(function, functions)));
    let others: Vec<_> = all.filter(|(_, kept)| !(80.0..100.0).contains(kept)).collect();
    assert!(others.is_empty(), "{others:?}");
}

#[test]
fn minus_infinity_may_be_accepted_as_the_page_says_nothing_of_it() {
    let functions = Functions {
        newtons_method: |x, f, g, H, solve, n| {
            newton(x, f, g, H, solve, (n, |new, most| new < f64::INFINITY && new <= most, true))
        },
        ..REFERENCE
    };
    assert_eq!(kept("newtons_method", functions), 100.0);
}

#[test]
fn a_wrong_answer_to_an_ordinary_input_costs_everything() {
    let functions = Functions { psi_neo_hookean: |F, C, D| 2.0 * solved::psi_neo_hookean(F, C, D), ..REFERENCE };
    assert_eq!(kept("psi_neo_hookean", functions), 0.0);
}

#[test]
fn every_edge_case_is_a_check_and_together_they_have_at_most_a_fifth() {
    let rubric = Rubric::load(None).expect("the grader's own rubric");
    for (function, _) in FUNCTIONS {
        let checks = checks_of(function, &rubric);
        let shares = shares(function, &checks, rubric.edge_cases);
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{function}");
        let edges = checks.iter().zip(&shares).filter(|(check, _)| is_edge_case(function, check));
        let edges: f64 = edges.map(|(_, share)| share).sum();
        assert!(edges <= 0.2 + 1e-12, "{function}: {edges}");
        let listed = EDGE_CASES.iter().filter(|(whose, _)| *whose == function).flat_map(|(_, names)| names.iter());
        listed.for_each(|name| assert!(checks.contains(name), "{function} has no check {name}"));
    }
}

#[test]
fn a_function_that_never_ends_in_half_of_its_checks_or_in_an_ordinary_one_loses_half() {
    let rubric = Rubric::load(None).expect("the grader's own rubric");
    for (function, _) in FUNCTIONS {
        let names = checks_of(function, &rubric);
        let with = |endless: &dyn Fn(usize, &str) -> bool| {
            let status = |k: usize, name: &str| if endless(k, name) { Status::TimedOut } else { Status::Passed };
            let checks: Vec<_> = names.iter().enumerate().map(|(k, name)| check(name, status(k, name))).collect();
            score(function, &checks)
        };
        for first in 1..names.len() {
            assert!(with(&|k, _| k >= first && 2 * (k - first) < names.len()) <= 50.0 || 2 * first > names.len());
        }
        let ordinary = names.iter().rposition(|name| !is_edge_case(function, name)).expect("an ordinary check");
        assert!(with(&|k, _| k == ordinary) <= 50.0, "{function}");
        let all_edges = with(&|_, name| is_edge_case(function, name));
        let count = names.iter().filter(|name| is_edge_case(function, name)).count();
        assert!(all_edges >= 80.0 - 1e-9 || 2 * count >= names.len(), "{function}: {all_edges}");
    }
}

#[test]
fn the_table_has_a_line_for_every_check_and_the_two_rules() {
    let rubric = Rubric::load(None).expect("the grader's own rubric");
    let table = table(&rubric);
    let of =
        |function: &str| table.lines().filter(|line| line.starts_with(&format!("{function} "))).collect::<Vec<_>>();
    let newton = of("newtons_method");
    assert_eq!(newton.len(), checks_of("newtons_method", &rubric).len() + 2);
    assert!(newton[0].contains("agrees with the reference") && newton[0].ends_with("100.0 %    7.00"), "{}", newton[0]);
    let rest = newton.iter().filter(|line| line.contains("all edge cases") || line.contains("no answer in time"));
    assert_eq!(
        rest.map(|line| line[line.len() - 15..].trim()).collect::<Vec<_>>(),
        ["20.0 %    1.40", "50.0 %    3.50"]
    );
}
