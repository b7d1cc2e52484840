#![doc = include_str!("../include-docs/course.md")]
#![cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
#![deny(missing_docs)]
#![allow(non_snake_case)] // T, V, F, J, C and D are the names that the mathematics and the course use

// In teaching order, which the blank lines keep: rustfmt sorts neighbouring modules by name.

#[doc = include_str!("../include-docs/phi_linear_tetrahedron.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod phi_linear_tetrahedron;
pub use phi_linear_tetrahedron::phi_linear_tetrahedron;

#[doc = include_str!("../include-docs/dphi_linear_tetrahedron_dX.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod dphi_linear_tetrahedron_dX;
pub use dphi_linear_tetrahedron_dX::dphi_linear_tetrahedron_dX;

#[doc = include_str!("../include-docs/psi_neo_hookean.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod psi_neo_hookean;
pub use psi_neo_hookean::psi_neo_hookean;

#[doc = include_str!("../include-docs/dpsi_neo_hookean_dF.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod dpsi_neo_hookean_dF;
pub use dpsi_neo_hookean_dF::dpsi_neo_hookean_dF;

#[doc = include_str!("../include-docs/d2psi_neo_hookean_dF2.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod d2psi_neo_hookean_dF2;
pub use d2psi_neo_hookean_dF2::d2psi_neo_hookean_dF2;

#[doc = include_str!("../include-docs/T_linear_tetrahedron.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod T_linear_tetrahedron;
pub use T_linear_tetrahedron::T_linear_tetrahedron;

#[doc = include_str!("../include-docs/quadrature_single_point.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod quadrature_single_point;
pub use quadrature_single_point::quadrature_single_point;

#[doc = include_str!("../include-docs/V_linear_tetrahedron.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod V_linear_tetrahedron;
pub use V_linear_tetrahedron::V_linear_tetrahedron;

#[doc = include_str!("../include-docs/dV_linear_tetrahedron_dq.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod dV_linear_tetrahedron_dq;
pub use dV_linear_tetrahedron_dq::dV_linear_tetrahedron_dq;

#[doc = include_str!("../include-docs/d2V_linear_tetrahedron_dq2.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod d2V_linear_tetrahedron_dq2;
pub use d2V_linear_tetrahedron_dq2::d2V_linear_tetrahedron_dq2;

#[doc = include_str!("../include-docs/V_spring_particle_particle.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod V_spring_particle_particle;
pub use V_spring_particle_particle::V_spring_particle_particle;

#[doc = include_str!("../include-docs/dV_spring_particle_particle_dq.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod dV_spring_particle_particle_dq;
pub use dV_spring_particle_particle_dq::dV_spring_particle_particle_dq;

#[doc = include_str!("../include-docs/mass_matrix_linear_tetrahedron.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod mass_matrix_linear_tetrahedron;
pub use mass_matrix_linear_tetrahedron::mass_matrix_linear_tetrahedron;

#[doc = include_str!("../include-docs/mass_matrix_mesh.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod mass_matrix_mesh;
pub use mass_matrix_mesh::mass_matrix_mesh;

#[doc = include_str!("../include-docs/assemble_forces.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod assemble_forces;
pub use assemble_forces::assemble_forces;

#[doc = include_str!("../include-docs/assemble_stiffness.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod assemble_stiffness;
pub use assemble_stiffness::assemble_stiffness;

#[doc = include_str!("../include-docs/build_skinning_matrix.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod build_skinning_matrix;
pub use build_skinning_matrix::build_skinning_matrix;

#[doc = include_str!("../include-docs/fixed_point_constraints.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod fixed_point_constraints;
pub use fixed_point_constraints::fixed_point_constraints;

#[doc = include_str!("../include-docs/pick_nearest_vertices.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod pick_nearest_vertices;
pub use pick_nearest_vertices::pick_nearest_vertices;

#[doc = include_str!("../include-docs/linearly_implicit_euler.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod linearly_implicit_euler;
pub use linearly_implicit_euler::linearly_implicit_euler;

#[doc = include_str!("../include-docs/newtons_method.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod newtons_method;
pub use newtons_method::newtons_method;

#[doc = include_str!("../include-docs/implicit_euler.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod implicit_euler;
pub use implicit_euler::implicit_euler;

#[doc = include_str!("../include-docs/given.md")]
#[cfg_attr(doc, doc = include_str!("../include-docs/math.html"))]
pub mod given;

#[cfg(feature = "demo")]
pub mod assignment_setup;
