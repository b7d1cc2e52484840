//! Time integration methods, one file each. A step starts from a state, and either ends in a new one or says why it cannot.

mod accelerations;
mod explicit_euler;
mod follower;

mod implicit_euler;
mod linearly_implicit_euler;
mod mass_inverse;
mod momentum;

mod initial_guess;
mod rk2;
mod rk4;
mod semi_implicit_euler;
mod statics;
mod verlet;

pub use explicit_euler::ExplicitEuler;
pub use implicit_euler::ImplicitEuler;
pub use linearly_implicit_euler::LinearlyImplicitEuler;
pub use mass_inverse::MassInverse;

pub use rk2::Rk2;
pub use rk4::Rk4;
pub use semi_implicit_euler::SemiImplicitEuler;
pub use statics::Statics;
pub use verlet::Verlet;
