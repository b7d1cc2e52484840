//! Elements of deformable solids: constitutive laws, plastic flow, and the loops over all elements of a body that sum up its energy,
//! gradient and stiffness.
//!
//! Kernels are compiled once for each law, kind of element, number type and instruction set. This takes long, so that they are a
//! package of their own.
//! [`Real::solids`] makes the [`Solids`](solids::Solids) of a body, whose loops are called once per pass, so that nothing else is
//! compiled for a law.

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

pub mod elements;
pub mod history;
pub mod materials;
pub mod number;
pub mod plasticity;
pub mod polar;
mod real;
pub mod solids;
pub mod sparse;
pub mod svd;
pub mod tensor;
pub mod threads;
pub mod vector;

pub use real::Real;
