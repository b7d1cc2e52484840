//! Tables of facts.

use fem_model::{Integrator, Preconditioner, SolverKind};

#[test]
fn the_tables_of_facts_are_in_the_order_of_the_variants() {
    assert!(SolverKind::FACTS.iter().enumerate().all(|(place, (kind, ..))| *kind as usize == place));
    assert!(Preconditioner::FACTS.iter().enumerate().all(|(place, (kind, ..))| *kind as usize == place));
}

#[test]
fn the_table_of_facts_is_in_the_order_of_the_methods() {
    for (place, (integrator, facts)) in Integrator::FACTS.into_iter().enumerate() {
        assert_eq!(integrator as usize, place, "{}", facts.name);
        let name: String = format!("{integrator:?}").chars().fold(String::new(), |name, c| {
            let gap = if c.is_uppercase() && !name.is_empty() { "_" } else { "" };
            name + gap + &c.to_lowercase().to_string()
        });
        assert_eq!(facts.name, name);
    }
}
