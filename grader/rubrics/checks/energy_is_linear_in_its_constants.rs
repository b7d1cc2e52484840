use grader::properties::Course;
use grader::properties::outcome::{Outcome, near_number, with_input};
use nalgebra::{Matrix3, Vector3};

/// Three times both constants is three times the energy, in any deformation.
pub fn check(course: &Course) -> Outcome {
    for stretch in [0.5, 1.0, 1.25, 2.0] {
        let F = Matrix3::from_diagonal(&Vector3::new(stretch, 1.0, 1.1));
        let energy = course.subject.psi_neo_hookean(&F, 2.0, 5.0)?;
        let tripled = course.subject.psi_neo_hookean(&F, 6.0, 15.0)?;
        let rule = "three times C and D is three times the energy";
        with_input(&format!("F = {F}"), near_number(rule, tripled, 3.0 * energy, 1e-12 * (1.0 + energy.abs())))?;
    }
    Ok(())
}
