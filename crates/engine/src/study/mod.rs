//! Studies of the engine itself: how large an error is for how much time, what it does with stiff and extreme cases, and what
//! the pages show that tell of it.
//!
//! Charts ([`svg`]) and pages ([`page`]) know nothing of what they show. References in time ([`mod@reference`]) and in space
//! ([`manufactured`], [`nested`], [`closed_forms`]) are computed by none of the methods that are studied.

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
pub mod page;
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
pub mod svg;
pub mod table;
pub mod text;
