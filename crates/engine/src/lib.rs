//! The engine: deformable solids by the finite element method.
//!
//! A [`Body`](fem_scene::Body) becomes a [`System`](model::system::System), which never changes in a run, and a
//! [`State`](model::state::State), which an [`Integrator`](integrators::Integrator) advances. A
//! [`Simulator`](simulator::Simulator) holds both and implements [`Simulation`](fem_scene::simulation::Simulation), all that the
//! window, the headless loop and the reports see.

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

pub mod boundary;
pub mod cantilever;
pub mod elements;
pub mod forces;
mod history;
pub mod integrators;
pub mod materials;
pub mod model;
pub mod newton;
pub mod number;
mod pick;
pub mod profile;
mod refusal;
pub mod simulator;
pub mod skinning;
pub mod solvers;
pub mod sparse;
pub mod svd;
pub mod tensor;
pub mod vector;
