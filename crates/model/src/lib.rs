//! Models as plain values: bodies, materials, loads, constraints, obstacles, methods; and the trait
//! [`Simulation`](simulation::Simulation) of what simulates them. No files and no numerics.
//!
//! ```
//! use fem_model::{Axis, Body, Elastic, Law, Material, Selector};
//!
//! let mesh = fem_mesh::box_mesh([2.0, 1.0, 1.0], 2, fem_mesh::Pattern::default())?;
//! let rubber = Material::new(Law::StableNeoHookean(Elastic::new(1e5, 0.3)), 1000.0);
//! let body = Body::new(mesh, rubber)?.gravity([0.0, 0.0, -9.81])?.fix(&Selector::least(Axis::X))?;
//! assert_eq!(body.fixed_nodes().map(<[usize]>::len), Some(9));
//!
//! // What cannot be simulated is refused at once, with the remedy.
//! let error = body.fix(&Selector::Nodes(vec![500])).unwrap_err();
//! assert_eq!(error.to_string(), "fixed.nodes names node 500; the mesh has nodes 0 to 44");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

mod axis;
mod batch;
mod body;
mod body_length;
mod body_mesh;
mod conditions;
mod contact;
mod curve;
mod elastic;
pub mod element;
mod fibres;
mod fields;
mod integrator;
mod interaction;
mod law;
mod loads;
mod material;
mod method;
pub mod numbers;
mod obstacles;
mod planes;
mod plasticity;
mod refusal;
mod regions;
mod selector;
pub mod simulation;
mod solver;
mod timer;
mod viscosity;

pub use axis::Axis;
pub use batch::{Batch, EnvironmentValues};
pub use body::Body;
pub use body_mesh::BodyMesh;
pub use conditions::{DirichletCondition, Motion, Rotation, check_disjoint};
pub use contact::{Contact, ContactTreatment};
pub use curve::{LoadCurve, is_before};
pub use elastic::{Elastic, PlaneState};
pub use fibres::{FibreDirections, FibreFamily, FibreLaw};
pub use fields::*;
pub use integrator::{CONSISTENT_MASS, Facts, Family, Integrator};
pub use interaction::{Anchor, Interaction};
pub use law::{EdgeStiffness, Given, Law, LawFacts, NeoHookean, VolumeEnergy};
pub use loads::{Drag, NodalForce, Pressure, Spring, Traction, highest_node};
pub use material::{Material, Volumetric};
pub use method::{Damping, DampingForm, IterationSettings, Method, NewmarkParameters, NewtonSettings, Projection};
pub use planes::{ContactPlane, PlaneMotion};
pub use plasticity::Plasticity;
pub use refusal::Refusal;
pub use regions::{MaterialRegion, density_factors};
pub use selector::{Region, Selector, elements, listed, loaded_faces, nodes};
pub use solver::{Precision, Preconditioner, SolverKind, SolverSettings};
pub use timer::Timer;
pub use viscosity::{PronyTerm, Viscosity};
