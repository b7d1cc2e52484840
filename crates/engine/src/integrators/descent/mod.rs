//! Vertex block descent: Chen, Liu, Yang and Yuksel, Vertex block descent (2024), algorithm 1.
//!
//! A step of implicit Euler minimises 1/(2Δt²) ‖x − y‖²_M + E(x), with y the positions that inertia and dead loads alone would give. A sweep takes the
//! nodes one after the other and moves each by Newton's method for its own position, the other nodes fixed: equation 9,
//! (m/Δt² + Σ_e ∂²ψ_e/∂x²) Δx = −(m/Δt² (x − y) + Σ_e ∂ψ_e/∂x). Nodes are coloured, and those of one colour share no element and no spring,
//! so that several are moved side by side, in SIMD lanes and by several threads, with the same result.
//!
//! A line search on the energy around a node sets the length of its step if the block is not positive definite, or if the step is long
//! beside the elements ([`search`]).

mod chebyshev;
mod groups;
mod kernel;
mod links;
mod method;
mod nodes;
mod patches;
mod search;
mod slot;
mod solve;
mod sums;

pub use method::Descent;
