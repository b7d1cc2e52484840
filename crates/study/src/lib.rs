//! Studies of the engine: errors against run time, and stiff and extreme cases. Their results become tables, charts and pages.
//!
//! References in time ([`mod@reference`]) and in space ([`space`]) come from methods that are not under study.
//!
//! ```
//! use fem_model::element::Element;
//! use fem_study::space::manufactured;
//!
//! // A manufactured solution on two meshes: halving the edges divides the error of linear tetrahedra by about four.
//! let [coarse, fine] = [4, 8].map(|cells| manufactured::solve("linear", Element::ALL[0], cells));
//! let order = (coarse?.l2 / fine?.l2).log2();
//! assert!(order > 1.5, "{order}");
//! # Ok::<(), fem_study::study::Problem>(())
//! ```

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

pub mod experiments;
pub mod linear;
pub mod machine;
pub mod reference;
pub mod report;
pub mod runs;
mod scenes;
pub mod space;
pub mod stability;
pub mod studies;
pub mod study;
pub mod sweep;
