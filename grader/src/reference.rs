//! The reference: our own solution, linked with the grader's own process and with no process that holds student code.

mod calls;
pub mod compare;
mod elements;
pub mod judge;
mod meshes;
mod picks;
mod random;
mod scales;
mod steps;
pub mod systems;
#[cfg(test)]
mod tests;
pub mod trial;

use finite_elements_3d as solved;
use grader_child::Functions;

pub use compare::compare;
pub use judge::trials;

/// Relative error that round-off alone does not reach, and that no student should fear.
pub const TOLERANCE: f64 = 1e-9;

/// Our own solution as a table.
pub const REFERENCE: Functions = Functions {
    phi_linear_tetrahedron: solved::phi_linear_tetrahedron,
    dphi_linear_tetrahedron_dX: solved::dphi_linear_tetrahedron_dX,
    psi_neo_hookean: solved::psi_neo_hookean,
    dpsi_neo_hookean_dF: solved::dpsi_neo_hookean_dF,
    d2psi_neo_hookean_dF2: solved::d2psi_neo_hookean_dF2,
    T_linear_tetrahedron: solved::T_linear_tetrahedron,
    V_linear_tetrahedron: solved::V_linear_tetrahedron,
    dV_linear_tetrahedron_dq: solved::dV_linear_tetrahedron_dq,
    d2V_linear_tetrahedron_dq2: solved::d2V_linear_tetrahedron_dq2,
    V_spring_particle_particle: solved::V_spring_particle_particle,
    dV_spring_particle_particle_dq: solved::dV_spring_particle_particle_dq,
    mass_matrix_linear_tetrahedron: solved::mass_matrix_linear_tetrahedron,
    mass_matrix_mesh: solved::mass_matrix_mesh,
    assemble_forces: solved::assemble_forces,
    assemble_stiffness: solved::assemble_stiffness,
    build_skinning_matrix: solved::build_skinning_matrix,
    fixed_point_constraints: solved::fixed_point_constraints,
    pick_nearest_vertices: solved::pick_nearest_vertices,
    quadrature_of_number: |V, element, volume, integrand| {
        solved::quadrature_single_point(V, element, volume, integrand)
    },
    quadrature_of_vector: |V, element, volume, integrand| {
        solved::quadrature_single_point(V, element, volume, integrand)
    },
    linearly_implicit_euler: |q, qdot, dt, mass, force, stiffness, solve| {
        solved::linearly_implicit_euler(q, qdot, dt, mass, force, stiffness, solve)
    },
    newtons_method: |x0, f, g, H, solve, max_steps| solved::newtons_method(x0, f, g, H, solve, max_steps),
    implicit_euler: |q, qdot, dt, mass, energy, force, stiffness, solve| {
        solved::implicit_euler(q, qdot, dt, mass, energy, force, stiffness, solve)
    },
};
