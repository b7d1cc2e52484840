//! Remedies of failures.

use fem_model::Integrator;
use fem_model::simulation::{Cause, Failure};

#[test]
fn the_remedy_of_an_explicit_method_names_its_critical_step_unless_the_mesh_is_at_fault() {
    let remedy = |cause| {
        let failure = Failure::of_step(3, 0.3, 0.1, Integrator::Verlet, cause);
        failure.with_critical_time_step(Some(0.01)).remedy
    };
    assert!(remedy(Cause::Inverted { element: 7, J: -0.5 }).contains("critical time step"));
    let of_corner = remedy(Cause::InvertedAtCorner { element: 7, J: -0.5 });
    assert!(of_corner.contains("finer mesh") && !of_corner.contains("critical"), "{of_corner}");
}
