//! Scene files, the bodies that they describe, and the files from which their runs go on.
//!
//! [`load`] reads and checks a file; [`tables`] are its tables as they stand there. [`body`] reads the meshes that the scene names
//! and turns the tables into a [`Body`](fem_model::Body); [`Scene::method`] turns them into a [`Method`](fem_model::Method).
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

mod batch_state;
mod body;
mod check;
mod conditions;
mod error;
mod identity;
mod load;
mod meshes;
mod overrides;
mod paths;
mod picture;
mod save;
mod state;
pub mod tables;
mod values;
mod warnings;

pub use batch_state::{EnvironmentEnd, write_batch};
pub use body::{body, body_of, body_of_shape};
pub use conditions::Conditions;
pub use error::SceneError;
pub use load::{load, load_with, names, parse};
pub use overrides::Override;
pub use save::{SaveError, save};
pub use state::{ResumeError, resume, write_state};
pub use tables::{Pipeline, Scene};
pub use warnings::warnings;
