//! The functions that each function builds on. An assignment that asks for a function and leaves one that it builds on for later cannot be
//! finished with `check`, although it can be graded.

use super::{Role, Rubric};

/// Functions, and those that their pages build on or that their checks compare them with.
const BUILDS_ON: [(&str, &[&str]); 14] = [
    ("dphi_linear_tetrahedron_dX", &["phi_linear_tetrahedron"]),
    ("dpsi_neo_hookean_dF", &["psi_neo_hookean"]),
    ("d2psi_neo_hookean_dF2", &["dpsi_neo_hookean_dF"]),
    ("T_linear_tetrahedron", &["mass_matrix_linear_tetrahedron"]),
    ("V_linear_tetrahedron", &["dphi_linear_tetrahedron_dX", "psi_neo_hookean", "quadrature_single_point"]),
    (
        "dV_linear_tetrahedron_dq",
        &["dphi_linear_tetrahedron_dX", "dpsi_neo_hookean_dF", "quadrature_single_point", "V_linear_tetrahedron"],
    ),
    (
        "d2V_linear_tetrahedron_dq2",
        &["dphi_linear_tetrahedron_dX", "d2psi_neo_hookean_dF2", "quadrature_single_point", "dV_linear_tetrahedron_dq"],
    ),
    ("dV_spring_particle_particle_dq", &["V_spring_particle_particle"]),
    ("mass_matrix_mesh", &["mass_matrix_linear_tetrahedron", "T_linear_tetrahedron"]),
    ("assemble_forces", &["dV_linear_tetrahedron_dq", "V_linear_tetrahedron"]),
    ("assemble_stiffness", &["d2V_linear_tetrahedron_dq2", "assemble_forces"]),
    ("build_skinning_matrix", &["phi_linear_tetrahedron"]),
    ("linearly_implicit_euler", &["mass_matrix_mesh", "assemble_forces", "assemble_stiffness"]),
    (
        "implicit_euler",
        &["mass_matrix_mesh", "assemble_forces", "assemble_stiffness", "V_linear_tetrahedron", "newtons_method"],
    ),
];

impl Rubric {
    /// A sentence for each function that is asked for and builds on one that is left for later.
    pub fn unfinishable(&self) -> Vec<String> {
        let asked = BUILDS_ON.into_iter().filter(|(name, _)| self.role(name) == Role::Asked);
        let pairs = asked.flat_map(|(name, needs)| needs.iter().map(move |needed| (name, *needed)));
        let sentence = |(name, needed)| {
            format!(
                "{name} is asked for and builds on {needed}, which is `later`: whoever follows its page cannot finish it with `check`; ask \
                 for both, or give {needed} solved"
            )
        };
        pairs.filter(|(_, needed)| self.role(needed) == Role::Later).map(sentence).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::fs;
    use std::path::Path;

    use grader::submission::{NAMES, mentions};

    use super::*;

    /// The functions that checks ask for, as their sources say.
    fn asked_in(file: &str) -> BTreeSet<&'static str> {
        let text = fs::read_to_string(Path::new("src/properties").join(file)).unwrap();
        NAMES.into_iter().filter(|name| text.contains(&format!("waits(\"{name}\")"))).collect()
    }

    #[test]
    fn the_list_has_all_that_solutions_call_and_checks_ask() {
        for name in NAMES {
            let solution = fs::read_to_string(format!("../src/{name}.rs")).unwrap();
            let mut needs = mentions(&solution);
            needs.extend(asked_in(&format!("{name}.rs")));
            if name.ends_with("implicit_euler") {
                needs.extend(asked_in("bodies.rs"));
            }
            needs.remove(name);
            let listed = BUILDS_ON.iter().find(|(found, _)| *found == name).map_or(&[][..], |(_, needs)| needs);
            let missing: Vec<_> = needs.into_iter().filter(|need| !listed.contains(need)).collect();
            let energy_of_a_step = name == "linearly_implicit_euler" && missing == ["V_linear_tetrahedron"];
            assert!(missing.is_empty() || energy_of_a_step, "{name}: {missing:?}");
        }
    }

    #[test]
    fn both_assignments_can_be_finished_and_one_without_the_element_mass_cannot() {
        let load = |name: &str| Rubric::load(Some(&Path::new("rubrics").join(name))).unwrap();
        assert_eq!((load("first.toml").unfinishable(), load("second.toml").unfinishable()), (Vec::new(), Vec::new()));
        let mut first = load("first.toml");
        let mass = first.functions.pop().unwrap().name;
        assert_eq!(mass.get_ref(), "mass_matrix_linear_tetrahedron");
        first.later.push(mass);
        let told = first.unfinishable();
        assert!(matches!(&told[..], [one] if one.starts_with("T_linear_tetrahedron is asked for")), "{told:?}");
    }
}
