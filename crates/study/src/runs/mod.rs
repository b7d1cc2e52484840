//! Runs of a study: the plan, the measurement, and the row that each run becomes.

pub mod convergence_order;
pub(crate) mod costs;
pub(crate) mod measure;
pub mod pareto;
pub(crate) mod plan;
pub mod row;
pub(crate) mod states;
