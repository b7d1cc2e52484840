//! What errors of the engine are measured against: solutions in [time](mod@time) and in [space](mod@space) by methods that are not under study, and the
//! norms of the differences.
//!
//! ```
//! use fem_model::element::Element;
//! use fem_reference::space::manufactured;
//!
//! // A manufactured solution on two meshes: halving the edges divides the error of linear tetrahedra by about four.
//! let [coarse, fine] = [4, 8].map(|cells| manufactured::solve("linear", Element::ALL[0], cells));
//! let order = (coarse?.l2 / fine?.l2).log2();
//! assert!(order > 1.5, "{order}");
//! # Ok::<(), fem_reference::Problem>(())
//! ```

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

mod elements;
pub mod space;
pub mod time;

pub use elements::{Elements, LINEAR, QUADRATIC, WITHOUT_LOCKING};

/// The reason why a computation has no result, as a sentence.
pub type Problem = Box<dyn std::error::Error + Send + Sync>;

/// The result of such a computation.
pub type Result<T, E = Problem> = std::result::Result<T, E>;
