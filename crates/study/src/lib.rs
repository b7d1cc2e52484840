//! Studies of the engine: errors against run time, and stiff and extreme cases. Their results become tables, charts and pages.
//!
//! What errors are measured against is in `fem-reference`.
//!
//! ```
//! use fem_study::runs::convergence_order::fit;
//!
//! // Time steps, s, and errors that fall with the square of the step.
//! let order = fit(&[(0.1, 3e-2), (0.05, 7.5e-3), (0.025, 1.875e-3)]).ok_or("too few points")?;
//! assert!((order.value - 2.0).abs() < 1e-12);
//! # Ok::<(), fem_study::study::Problem>(())
//! ```

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
