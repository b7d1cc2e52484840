//! The engine: deformable solids by the finite element method.
//!
//! A [`Body`](fem_model::Body) becomes a [`System`](model::system::System), which never changes in a run, and a
//! [`State`](model::state::State), which an [`Integrator`](integrators::Integrator) advances. A
//! [`Simulator`](simulator::Simulator) has both and implements [`Simulation`](fem_model::simulation::Simulation), the interface for the
//! window, the headless loop and the reports.
//!
//! ```
//! use fem_model::{Axis, Body, Elastic, Integrator, Law, Material, Method, Selector};
//!
//! let mesh = fem_mesh::box_mesh([2.0, 1.0, 1.0], 2, fem_mesh::Pattern::default())?;
//! let rubber = Material::new(Law::StableNeoHookean(Elastic::new(1e5, 0.3)), 1000.0);
//! let body = Body::new(mesh, rubber)?.fix(&Selector::least(Axis::X))?.gravity([0.0, 0.0, -9.81])?;
//! let method = Method::new(Integrator::ImplicitEuler, 0.01);
//! let mut simulation = fem_engine::simulator::build(body, &method)?;
//! for _ in 0..20 {
//!     simulation.step()?;
//! }
//! let q = simulation.positions(); // (3n) m
//! println!("the free end has sunk to {} m", q[q.len() - 1]);
//! println!("the support carries {:?} N", simulation.reactions()[0].force);
//! assert_eq!(simulation.counters().unconverged_steps, 0);
//! assert!(q[q.len() - 1] < 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The programs in `examples/` show more: a potential and an integrator of one's own, stresses, a study.

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

pub use fem_elements::{elements, materials, number, plasticity, sparse, svd, tensor, vector};
pub use fem_solvers::{self as solvers, Real, numbering};

pub mod apparent_moduli;
pub mod batch;
pub mod boundary;
pub mod cantilever;
pub mod forces;
pub mod integrators;
pub mod model;
pub mod newton;
mod pick;
pub mod profile;
pub mod simulator;
pub mod skinning;
