//! A panic or a time-out in one check costs that check, and the others are judged.
#![cfg(target_os = "linux")]

#[path = "attacks/classroom.rs"]
#[allow(dead_code)] // the attacks need more of it
mod classroom;

use std::collections::BTreeMap;

use classroom::{Attacked, Classroom};

/// The solution under another name, and in its place a function that begins with a `guard`.
fn guarded(text: &str, name: &str, guard: &str, call: &str) -> String {
    let start = text.find(&format!("pub fn {name}")).expect("the function");
    let open = start + text[start..].find("{\n").expect("its body");
    let signature = &text[start..open];
    format!(
        "{}\n{signature}{{\n    {guard}\n    right({call})\n}}\n",
        text.replace(&format!("pub fn {name}"), "fn right")
    )
}

/// Statuses of the checks of a function.
fn checks<'a>(graded: &'a Attacked, name: &str) -> BTreeMap<&'a str, &'a str> {
    let checks = graded.function(name)["checks"].as_array().expect("checks");
    checks.iter().map(|check| (check["name"].as_str().unwrap_or(""), check["status"].as_str().unwrap_or(""))).collect()
}

/// The function has this status, loses exactly these checks, and keeps this share of its points.
fn keeps(share: f64, graded: &Attacked, name: &str, status: &str, lost: &[&str]) {
    let function = graded.function(name);
    assert_eq!(function["status"], status, "{function:#}");
    let checks = checks(graded, name);
    let found: Vec<_> = checks.iter().filter(|(_, status)| **status != "passed").map(|(name, _)| *name).collect();
    assert_eq!(found, lost, "{name}");
    let (score, most) = (function["score"].as_f64().expect("a score"), function["max_score"].as_f64().expect("points"));
    assert!((score - most * share).abs() < 0.01 && score > 0.0, "{name}: {score} of {most}");
}

#[test]
fn a_panic_a_crash_a_time_out_or_an_open_branch_costs_its_own_checks() {
    let mut room = Classroom::new();
    let mut guard =
        |name, status, guard: &str, call: &str| room.change(name, status, |text| guarded(&text, name, guard, call));
    guard(
        "build_skinning_matrix",
        "crashed",
        "let is_inside = |x: &nalgebra::Vector3<f64>| T.iter().any(|e| crate::phi_linear_tetrahedron(V, e, x).min() >= -1e-6);\n    \
         assert!(V_skin.iter().all(is_inside), \"a vertex outside\");",
        "V, T, V_skin",
    );
    guard("psi_neo_hookean", "crashed", "if F.determinant() <= 0.0 { todo!() }", "F, C, D");
    guard(
        "fixed_point_constraints",
        "timed_out",
        "while q_size > 0 && (0..q_size / 3).all(|vertex| indices.contains(&vertex)) { std::hint::spin_loop() }",
        "q_size, indices",
    );
    guard("V_spring_particle_particle", "crashed", "if l0 == 0.0 { std::process::abort() }", "q0, q1, l0, stiffness");
    let graded = room.grade();
    // Two of six edge cases, which have a fifth together.
    keeps(
        1.0 - 0.2 * 2.0 / 6.0,
        &graded,
        "build_skinning_matrix",
        "crashed",
        &[
            "a_point_in_no_element_goes_to_the_one_with_the_largest_smallest_weight",
            "edge_cases_agree_with_the_reference",
        ],
    );
    let psi = checks(&graded, "psi_neo_hookean");
    assert_eq!(psi["agrees_with_the_reference"], "passed", "{psi:?}");
    assert_eq!(psi["edge_cases_agree_with_the_reference"], "crashed", "{psi:?}");
    assert!(
        graded.function("psi_neo_hookean")["score"].as_f64() > Some(2.0),
        "{:#}",
        graded.function("psi_neo_hookean")
    );
    assert!(graded.message("psi_neo_hookean").contains("todo!"), "{}", graded.message("psi_neo_hookean"));
    // Two of four.
    keeps(
        0.9,
        &graded,
        "fixed_point_constraints",
        "timed_out",
        &["all_vertices_fixed_give_a_matrix_without_rows", "edge_cases_agree_with_the_reference"],
    );
    let spring = graded.function("V_spring_particle_particle");
    println!("{spring:#}");
    assert_eq!(spring["status"], "crashed");
    assert!(graded.function("phi_linear_tetrahedron")["status"] == "passed");
}

/// Newton's method with a line search that goes on until a step is accepted, and a function that does not end for half of its inputs.
const ENDLESS_SEARCH: &str = "    let mut gradient = g(x0);
    let small = 1e-10 * gradient.norm();
    for _ in 0..max_steps {
        if gradient.norm() <= small {
            break;
        }
        let d = solve(&H(x0), &-&gradient);
        let (value, slope, mut alpha) = (f(x0), gradient.dot(&d), 1.0);
        loop {
            let tried = f(&(&*x0 + &d * alpha));
            if tried.is_finite() && tried <= value + 1e-8 * alpha * slope {
                break;
            }
            alpha *= 0.5;
        }
        *x0 += d * alpha;
        gradient = g(x0);
    }
    f(x0)";
const ENDLESS_HALF: &str = "    while F[(0, 1)] > 0.0 {
        std::hint::spin_loop();
    }
    let J = F.determinant();
    if J <= 0.0 {
        return f64::INFINITY;
    }
    C * (J.powf(-2.0 / 3.0) * F.norm_squared() - 3.0) + D * (J - 1.0).powi(2)";

#[test]
#[ignore = "waits a minute for functions that never end; .ci/long runs it"]
fn what_never_ends_in_edge_cases_costs_a_fifth_at_most_and_what_never_ends_on_half_of_its_inputs_at_least_half() {
    let mut room = Classroom::new();
    room.replace_body("newtons_method", "timed_out", ENDLESS_SEARCH);
    room.replace_body("psi_neo_hookean", "timed_out", ENDLESS_HALF);
    let graded = room.grade();
    let share = |name: &str| {
        let function = graded.function(name);
        function["score"].as_f64().expect("a score") / function["max_score"].as_f64().expect("points")
    };
    let newton = checks(&graded, "newtons_method");
    assert_eq!(newton["agrees_with_the_reference"], "passed", "{newton:#?}");
    assert!((0.8..0.95).contains(&share("newtons_method")), "{} {newton:#?}", share("newtons_method"));
    assert!(share("psi_neo_hookean") <= 0.5, "{}", share("psi_neo_hookean"));
    assert!((share("phi_linear_tetrahedron"), share("implicit_euler")) == (1.0, 1.0), "no other function loses points");
}

/// A full matrix, and a search through all elements for each vertex: right, and slow on large meshes.
const FULL: &str = "    let mut M = nalgebra::DMatrix::<f64>::zeros(q_size, q_size);
    for (element, &volume) in T.iter().zip(v0) {
        let own = crate::mass_matrix_linear_tetrahedron(density, volume);
        for (i, j) in (0..144).map(|k| (k / 12, k % 12)) {
            M[(3 * element[i / 3] + i % 3, 3 * element[j / 3] + j % 3)] += own[(i, j)];
        }
    }
    CsrMatrix::from(&M)";
const SEARCH: &str = "    let gradients: Vec<_> =
        T.iter().zip(v0).map(|(element, &volume)| crate::dV_linear_tetrahedron_dq(q, V, element, volume, C, D)).collect();
    let mut f = DVector::zeros(q.len());
    for vertex in 0..V.len() {
        for (element, gradient) in T.iter().zip(&gradients) {
            for i in 0..4 {
                if element[i] == vertex {
                    for k in 0..3 {
                        f[3 * vertex + k] -= gradient[3 * i + k];
                    }
                }
            }
        }
    }
    f";

/// Searches of the whole mesh for each vertex or triangle of it.
const FOR_EACH_VERTEX: &str =
    "let used = (0..V.len()).filter(|v| T.iter().filter(|t| t.contains(v)).count() > 0).count();
    std::hint::black_box(used);
    let boxes";
const FOR_EACH_TRIANGLE: &str = "let single = F.iter().filter(|t| F.iter().filter(|u| u == t).count() == 1).count();
    std::hint::black_box(single);
    let hits";

#[test]
#[ignore = "measures times"]
fn an_assembly_whose_time_grows_as_n_squared_passes_and_is_told() {
    let mut room = Classroom::new();
    room.replace_body("mass_matrix_mesh", "passed", FULL);
    room.replace_body("assemble_forces", "passed", SEARCH);
    room.change("build_skinning_matrix", "passed", |text| text.replacen("let boxes", FOR_EACH_VERTEX, 1));
    room.change("pick_nearest_vertices", "passed", |text| text.replacen("let hits", FOR_EACH_TRIANGLE, 1));
    let graded = room.grade();
    graded.is_as_expected();
    for (name, is_told) in [
        ("build_skinning_matrix", true),
        ("pick_nearest_vertices", true),
        ("mass_matrix_mesh", true),
        ("assemble_forces", true),
        ("assemble_stiffness", false),
        ("fixed_point_constraints", false),
    ] {
        let growth = &graded.function(name)["growth"];
        println!("{name}: {growth}");
        let exponent = growth["exponent"].as_f64().expect("it was measured");
        assert_eq!(exponent > 1.5, is_told, "{name}: {growth}");
        assert_eq!(growth["reference_exponent"].is_number(), is_told, "{name}: {growth}");
    }
}
