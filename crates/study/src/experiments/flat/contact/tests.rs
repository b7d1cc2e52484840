//! The closed forms with every method that supports contact.

use fem_model::Integrator;

use super::{METHODS, block, hertz, impact};

#[test]
fn a_block_rests_where_the_barrier_carries_its_weight_however_stiff_it_is() {
    // The softer block leans by its strain.
    for (young, tolerance) in [(1e7, 1e-5), (2e11, 1e-8)] {
        let block = block::block(young).unwrap();
        assert!((block.force / block::WEIGHT - 1.0).abs() < 1e-8, "E = {young:e}: {} N", block.force);
        let error = (block.gap - block.root).abs();
        assert!(error < tolerance * block::ACTIVATION, "E = {young:e}: {} and {}", block.gap, block.root);
    }
}

#[test]
fn below_the_angle_of_friction_a_body_creeps_slower_than_the_transition_speed_or_sticks() {
    for method in METHODS {
        let creep = block::creep(method).unwrap();
        // ε_v is 1e-3 lengths a second.
        assert!(creep.abs() <= 1e-3, "{method:?}: {creep:e} m in a second");
    }
}

#[test]
fn above_the_angle_of_friction_a_body_accelerates_by_the_difference() {
    for method in METHODS {
        for factor in [1.01, 2.0] {
            let [found, expected] = block::acceleration(method, factor).unwrap();
            assert!((found - expected).abs() < 0.01 * expected, "{method:?}, {factor}: {found} and {expected} m/s²");
        }
    }
}

#[test]
fn a_sliding_body_stops_after_v_squared_over_2_mu_g_with_any_number_of_substeps() {
    let expected = block::STOPPING;
    for method in METHODS {
        let substeps = if method == Integrator::ImplicitEuler { [1.0, 10.0, 40.0] } else { [1.0, 4.0, 10.0] };
        let ways = substeps.map(|substeps| block::way(method, block::frame(method) / substeps).unwrap());
        for way in &ways[1..] {
            assert!((way - expected).abs() < 0.01 * expected, "{method:?}: {ways:?} and not {expected}");
        }
        assert!((ways[0] - expected).abs() < 0.05 * expected, "{method:?}: {ways:?} and not {expected}");
    }
}

#[test]
fn an_elastic_bar_leaves_the_wall_after_two_passages_of_the_wave() {
    for method in [Integrator::Verlet, Integrator::SemiImplicitEuler, Integrator::ImplicitEuler] {
        let impact::Impact { duration, stress, impulse_error } = impact::bar(method, 100, 1).unwrap();
        assert!((duration / impact::DURATION - 1.0).abs() < 0.02, "{method:?}: in contact for {duration} s");
        assert!((stress / impact::STRESS - 1.0).abs() < 0.02, "{method:?}: {stress} Pa");
        assert!(impulse_error < 1e-5, "{method:?}: {impulse_error}");
    }
}

#[test]
fn the_contact_of_a_cylinder_is_as_wide_as_hertz_says() {
    let error = |[found, expected]: [f64; 2]| (found - expected).abs() / expected;
    let [found, expected] = hertz::widths(hertz::WIDTH / 8.0).unwrap();
    assert!(
        (expected - hertz::WIDTH).abs() < 0.2 * hertz::WIDTH,
        "the mesh is made for another width than {expected} m"
    );
    let (coarse, fine) = (error([found, expected]), error(hertz::widths(hertz::WIDTH / 16.0).unwrap()));
    assert!(coarse < 0.03 && fine < coarse, "errors {coarse} and {fine} with 8 and 16 elements on a half-width");
}
