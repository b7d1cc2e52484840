//! Deformable solids by the finite element method: scene files, meshes, the loop and its counters.
//!
//! A scene file becomes a [`Scene`](scene::Scene), a pipeline turns that into a [`Simulation`](simulation::Simulation),
//! and whoever drives it (window, headless loop) sees nothing but that trait. A [`run`](simulate::run) ends in the files of
//! [`output`].

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

pub mod boundary;
pub mod cantilever;
pub mod elements;
pub mod forces;
pub mod integrators;
pub mod materials;
pub mod model;
pub mod newton;
pub mod number;
pub mod pick;
pub mod profile;
pub mod simulator;
pub mod skinning;
pub mod solvers;
pub mod sparse;
pub mod svd;
pub mod tensor;
pub mod vector;
