//! Studies of the engine: errors against run time, and stiff and extreme cases. Their results become tables, charts and pages.
//!
//! What errors are measured against is in `fem-reference`.

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

pub mod experiments;
pub mod linear;
pub mod machine;
pub mod report;
pub mod runs;
mod scenes;
pub mod stability;
pub mod studies;
pub mod study;
pub mod sweep;
