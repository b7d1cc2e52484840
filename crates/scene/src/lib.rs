//! Scene files, the bodies that they describe, and the loop that steps a simulation.
//!
//! [`load`] reads and checks a file; [`tables`] are its tables as they stand there. [`body`] reads the meshes that the scene names
//! and turns the tables into values in the mesh's node numbers; [`Scene::method`] does the same for the numerical method.
//!
//! ```
//! let text = r#"
//! pipeline = "engine"
//! [mesh]
//! box = { size = [2, 1, 1], cells_per_unit = 1 }
//! [material]
//! model = "neo_hookean"
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
//! assert_eq!(body.shape.mesh.vertices().len(), 12);
//! assert_eq!(body.fixed_nodes(), Some(&[0, 3, 6, 9][..]));
//! assert_eq!(scene.method().dt, 0.01);
//!
//! // A mistake is refused with file, line, field and remedy.
//! let error = fem_scene::parse(&text.replace("0.01", "-1"), "beam.toml".as_ref()).unwrap_err();
//! assert_eq!(error.to_string(), "beam.toml, line 15: time.dt is -1; give a positive number of seconds");
//! # Ok::<(), fem_scene::SceneError>(())
//! ```

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

mod body;
mod body_length;
mod body_mesh;
mod check;
mod conditions;
mod curve;
mod error;
mod identity;
mod integrator;
mod interaction;
mod load;
mod mass;
mod meshes;
pub mod output;
mod overrides;
mod paths;
mod picture;
mod save;
pub mod simulate;
pub mod simulation;
pub mod tables;
mod timer;
mod values;
mod warnings;

pub use body::{Body, body, body_of, body_of_shape};
pub use body_mesh::BodyMesh;
pub use conditions::Conditions;
pub use curve::{LoadCurve, is_before};
pub use error::SceneError;
pub use integrator::Integrator;
pub use interaction::{Anchor, Interaction};
pub use load::{load, load_with, names, parse};
pub use mass::{CONSISTENT_MASS, lumps_mass};
pub use overrides::Override;
pub use save::{SaveError, save};
pub use tables::{
    Axis, DampingForm, MODELS, Material, Pipeline, PlaneState, Precision, Preconditioner, Projection, Scene, SolverKind,
};
pub use timer::Timer;
pub use values::{
    Contact, ContactPlane, ContactTreatment, Damping, DirichletCondition, Drag, EnvironmentValues, IterationSettings,
    MaterialRegion, Method, Motion, NewmarkParameters, NewtonSettings, NodalForce, PlaneMotion, Plasticity, Pressure,
    Rotation, SolverSettings, Spring, Traction, highest_node,
};
pub use warnings::warnings;

pub use fem_mesh::Side;
