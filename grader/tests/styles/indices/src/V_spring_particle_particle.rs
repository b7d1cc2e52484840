use nalgebra::Vector3;

/// Hooke's law.
pub fn V_spring_particle_particle(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> f64 {
    let mut squared = 0.0;
    for axis in 0..3 {
        squared += (q1[axis] - q0[axis]) * (q1[axis] - q0[axis]);
    }
    let longer = squared.sqrt() - l0;
    stiffness * longer * longer / 2.0
}
