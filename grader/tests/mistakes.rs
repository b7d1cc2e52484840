//! A mistake costs its own function alone, whichever functions call it.
#![cfg(target_os = "linux")]

#[path = "attacks/classroom.rs"]
#[allow(dead_code)] // the attacks need more of it
mod classroom;

use classroom::Classroom;

/// Factor 1 where `dpsi_neo_hookean_dF` is right, for pure dilation by two has the stress 56 D.
const USES_ITS_NEIGHBOUR: &str =
    "* (crate::dpsi_neo_hookean_dF(&(nalgebra::Matrix3::identity() * 2.0), 0.0, 1.0)[0] / 56.0)";

/// A function at the end of a file that another file calls.
const HELPER: &str = "\npub fn volume_ratio(F: &nalgebra::Matrix3<f64>) -> f64 {\n    F.determinant()\n}\n";

fn negated(name: &str, text: &str) -> String {
    let renamed = text.replace(&format!("pub fn {name}"), "fn right");
    format!(
        "{renamed}\npub fn {name}(F: &nalgebra::Matrix3<f64>, C: f64, D: f64) -> nalgebra::SVector<f64, 9> {{\n    -right(F, C, D)\n}}\n"
    )
}

#[test]
fn a_call_of_a_wrong_function_of_the_same_level_costs_nothing() {
    let mut room = Classroom::new();
    room.change("dpsi_neo_hookean_dF", "failed", |text| negated("dpsi_neo_hookean_dF", &text));
    room.change("d2psi_neo_hookean_dF2", "passed", |text| {
        let renamed = text.replace("pub fn d2psi_neo_hookean_dF2", "fn right");
        format!(
            "{renamed}\npub fn d2psi_neo_hookean_dF2(F: &nalgebra::Matrix3<f64>, C: f64, D: f64) -> nalgebra::SMatrix<f64, 9, 9> {{\n    \
             right(F, C, D) {USES_ITS_NEIGHBOUR}\n}}\n"
        )
    });
    room.grade_beside_others().is_as_expected();
}

#[test]
fn a_file_may_call_into_another_whose_function_is_wrong_below_it_or_beside_it() {
    let mut room = Classroom::new();
    room.change("psi_neo_hookean", "failed", |text| {
        let renamed = text.replace("pub fn psi_neo_hookean", "fn right");
        let wrong =
            "pub fn psi_neo_hookean(F: &nalgebra::Matrix3<f64>, C: f64, D: f64) -> f64 {\n    right(F, C, D) - C\n}\n";
        format!("{renamed}{HELPER}\n{wrong}")
    });
    // Below: level 1 for level 2. Each also calls the wrong function, and gets the right answer.
    for name in ["dpsi_neo_hookean_dF", "d2psi_neo_hookean_dF2"] {
        room.change(name, "passed", |text| {
            let reach = "\nfn one(F: &nalgebra::Matrix3<f64>) -> f64 {\n    \
                         crate::psi_neo_hookean::volume_ratio(F) / F.determinant() + crate::psi_neo_hookean(&nalgebra::Matrix3::identity(), 1.0, 1.0)\n}\n";
            let renamed = text.replace(&format!("pub fn {name}"), "fn right");
            let result = if name.starts_with("d2") { "SMatrix<f64, 9, 9>" } else { "SVector<f64, 9>" };
            format!(
                "{renamed}{reach}\npub fn {name}(F: &nalgebra::Matrix3<f64>, C: f64, D: f64) -> nalgebra::{result} {{\n    right(F, C, D) * one(F)\n}}\n"
            )
        });
    }
    // Beside: both of level 1.
    room.change("mass_matrix_linear_tetrahedron", "passed", |text| {
        format!("{text}\npub fn half() -> f64 {{\n    0.5\n}}\n")
    });
    room.change("V_spring_particle_particle", "passed", |text| {
        format!("{text}\nconst _: fn() -> f64 = crate::mass_matrix_linear_tetrahedron::half;\n")
    });
    room.grade_beside_others().is_as_expected();
}
