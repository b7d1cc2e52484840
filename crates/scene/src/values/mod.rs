//! A scene's tables as values: SI units, the mesh's node numbers, defaults filled in.

mod batch;
mod constraints;
mod contact;
mod initial;
mod loads;
mod materials;
mod method;
mod planes;
mod plasticity;
mod selection;
mod transition;

pub use batch::EnvironmentValues;
pub use constraints::{DirichletCondition, Motion, Rotation};
pub use contact::{Contact, ContactTreatment};
pub use loads::{Drag, NodalForce, Pressure, Spring, Traction, highest_node};
pub use materials::MaterialRegion;
pub use method::{Damping, IterationSettings, Method, NewmarkParameters, NewtonSettings, SolverSettings};
pub use planes::{ContactPlane, PlaneMotion};
pub use plasticity::Plasticity;

pub(crate) use constraints::dirichlet_conditions;
pub(crate) use contact::contact;
pub(crate) use initial::initial_velocity;
pub(crate) use loads::{curve, drag, loaded_faces, nodal_forces, springs, surface_loads};
pub(crate) use materials::{density_factors, regions};
pub(crate) use method::damping;
pub(crate) use plasticity::plasticity;
