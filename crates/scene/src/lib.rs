//! Scene files, the bodies that they describe, and the loop that steps a simulation.
//!
//! [`load`] reads and checks a file; [`tables`] are its tables as they stand there. [`body`] reads the meshes that the scene names
//! and turns the tables into values in the mesh's node numbers; [`Scene::method`] does the same for the numerical method.

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

mod body;
mod check;
mod curve;
mod error;
mod identity;
mod integrator;
mod interaction;
mod load;
pub mod output;
mod overrides;
pub mod simulate;
pub mod simulation;
pub mod tables;
mod timer;
mod values;
mod warnings;

pub use body::{Body, CONSISTENT_MASS, body, body_of};
pub use curve::LoadCurve;
pub use error::SceneError;
pub use integrator::Integrator;
pub use interaction::{Anchor, Interaction};
pub use load::{load, load_with, names, parse};
pub use overrides::Override;
pub use tables::{Axis, MODELS, Material, Pipeline, Precision, Preconditioner, Projection, Scene, SolverKind};
pub use timer::Timer;
pub use values::{
    DirichletCondition, Drag, MaterialRegion, Method, Motion, NewtonSettings, Pressure, RayleighDamping, Rotation,
    SolverSettings, Spring, Traction, highest_node,
};
pub use warnings::warnings;

pub use fem_mesh::Side;
