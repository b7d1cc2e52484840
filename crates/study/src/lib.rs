//! Studies of the engine itself: how large an error is for how much time, what it does with stiff and extreme cases, and what
//! the pages show that tell of it.
//!
//! References in time ([`mod@reference`]) and in space
//! ([`manufactured`], [`nested`], [`closed_forms`]) are computed by none of the methods that are studied.

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

pub mod closed_forms;
pub mod costs;
pub mod equations;
pub mod ldl;
pub mod led;
pub mod locking;
pub mod machine;
pub mod manufactured;
pub mod measure;
pub mod nested;
pub mod norms;
pub mod order;
pub mod pareto;
pub mod plan;
pub mod quadrature;
pub mod reference;
pub mod report;
pub mod row;
pub mod scene;
pub mod space;
pub mod stability;
pub mod states;
pub mod table;
pub mod text;
