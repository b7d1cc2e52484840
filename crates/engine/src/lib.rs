//! The engine: deformable solids by the finite element method.
//!
//! A [`Body`](fem_scene::Body) becomes a [`System`](model::system::System), which never changes in a run, and a
//! [`State`](model::state::State), which an [`Integrator`](integrators::Integrator) advances. A
//! [`Simulator`](simulator::Simulator) has both and implements [`Simulation`](fem_scene::simulation::Simulation), the interface for the
//! window, the headless loop and the reports.
//!
//! ```
//! let text = r#"
//! pipeline = "engine"
//! [mesh]
//! box = { size = [2, 1, 1], cells_per_unit = 2 }
//! [material]
//! model = "stable_neo_hookean"
//! young = 1e5
//! poisson = 0.3
//! density = 1000
//! [gravity]
//! acceleration = [0, 0, -9.81]
//! [fixed]
//! plane = { axis = "x", below = 1e-9 }
//! [time]
//! dt = 0.01
//! integrator = "implicit_euler"
//! "#;
//! let scene = fem_scene::parse(text, "beam.toml".as_ref())?;
//! let body = fem_scene::body(&scene, "data".as_ref())?;
//! let mut simulation = fem_engine::simulator::build(&scene, body)?;
//! for _ in 0..20 {
//!     simulation.step()?;
//! }
//! let q = simulation.positions(); // (3n) m
//! let tip = q.len() - 1;
//! assert!(q[tip] < 1.0, "the free end has sunk to {} m", q[tip]);
//! assert_eq!(simulation.reactions()[0].name, "fixed");
//! assert_eq!(simulation.counters().unconverged_steps, 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The programs in `examples/` show more: a potential and an integrator of one's own, stresses, a study.

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

pub use fem_elements::{Real, elements, materials, number, plasticity, sparse, svd, tensor, vector};

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
mod refusal;
pub mod simulator;
pub mod skinning;
pub mod solvers;
