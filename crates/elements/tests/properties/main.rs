//! Properties of the parts of the package, from numbers to elements. They are not in the package: it would be compiled once more.

#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field

mod elements;
mod functions;
mod instructions;
mod lanes;
mod materials;
mod plasticity;
mod polar;
mod sparse;
mod vector;
