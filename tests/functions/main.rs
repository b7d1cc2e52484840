//! The checks that an implementation of the 22 functions is held to, one module each.
//!
//! `cargo test --no-default-features --test functions psi_neo_hookean` runs those of one function and of the functions
//! whose names contain its name. A message says what is wrong and which page to read.

#![allow(non_snake_case)] // V, T, F, J, C and D are the names that the mathematics and the course use

mod bodies;
mod double_double;
mod finite_differences;
mod meshes;
mod outcome;
mod random;
mod scales;

mod T_linear_tetrahedron;
mod V_linear_tetrahedron;
mod V_spring_particle_particle;
mod assemble_forces;
mod assemble_stiffness;
mod build_skinning_matrix;
mod d2V_linear_tetrahedron_dq2;
mod d2psi_neo_hookean_dF2;
mod dV_linear_tetrahedron_dq;
mod dV_spring_particle_particle_dq;
mod dphi_linear_tetrahedron_dX;
mod dpsi_neo_hookean_dF;
mod fixed_point_constraints;
mod given_assembly;
mod given_kinematics;
mod given_project;
mod given_solve;
mod implicit_euler;
mod linearly_implicit_euler;
mod mass_matrix_linear_tetrahedron;
mod mass_matrix_mesh;
mod newtons_method;
mod phi_linear_tetrahedron;
mod pick_nearest_vertices;
mod psi_neo_hookean;
mod quadrature_single_point;
mod solution;
