//! Properties of references in time and in space, and of the norms that measure distances from them.

#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field

mod closed_forms;
mod conditioning;
mod ldl;
mod locking;
mod manufactured;
mod nested;
mod norms;
mod points;
mod time;
