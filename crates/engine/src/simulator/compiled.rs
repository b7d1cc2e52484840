//! The number types in which simulations are compiled.
//!
//! A generic function is compiled anew in each crate that calls it, and a simulation holds all elements, laws and solvers. Large
//! functions are therefore called through a trait with an implementation for each type, which is compiled once, here.

use fem_model::simulation::{Energies, EnergyLedger, Failure, Reaction};
use fem_model::{Body, Method, Refusal};
use nalgebra::Matrix3;

use super::Simulator;
use crate::forces::Moment;
use crate::integrators::critical_time_step;
use crate::model::system::OwnForces;
use fem_solvers::Real;

/// A number type that the engine simulates in: `f32` or `f64`. Its functions are the bodies of [`Simulator`]'s of the same names.
pub trait Compiled: Real {
    #[doc(hidden)]
    fn with_forces(body: Body, method: &Method, own: OwnForces<Self>) -> Result<Simulator<Self>, Refusal>;
    #[doc(hidden)]
    fn step(simulator: &mut Simulator<Self>) -> Result<(), Failure>;
    #[doc(hidden)]
    fn next_integrator(simulator: &mut Simulator<Self>);
    #[doc(hidden)]
    fn energies(simulator: &Simulator<Self>) -> Energies;
    #[doc(hidden)]
    fn energy_ledger(simulator: &Simulator<Self>) -> EnergyLedger;
    #[doc(hidden)]
    fn failure_at_end(simulator: &Simulator<Self>) -> Option<Failure>;
    #[doc(hidden)]
    fn reactions(simulator: &Simulator<Self>) -> Vec<Reaction>;
    #[doc(hidden)]
    fn nodal_forces(simulator: &Simulator<Self>) -> Vec<[f64; 3]>;
    #[doc(hidden)]
    fn stresses(simulator: &Simulator<Self>) -> Vec<Matrix3<f64>>;
    #[doc(hidden)]
    fn stresses_at_points(simulator: &Simulator<Self>) -> Vec<Matrix3<f64>>;
    #[doc(hidden)]
    fn critical_time_step(simulator: &Simulator<Self>) -> Option<f64>;
    #[doc(hidden)]
    fn min_J(simulator: &Simulator<Self>) -> (f64, usize);
    #[doc(hidden)]
    fn inverted_elements(simulator: &Simulator<Self>) -> usize;
}

macro_rules! compiled {
    ($($number:ty),*) => { $(
        impl Compiled for $number {
            fn with_forces(body: Body, method: &Method, own: OwnForces<Self>) -> Result<Simulator<Self>, Refusal> {
                Simulator::assembled(body, method, own)
            }

            fn step(simulator: &mut Simulator<Self>) -> Result<(), Failure> {
                simulator.advance_step()
            }

            fn next_integrator(simulator: &mut Simulator<Self>) {
                simulator.switch_integrator();
            }

            fn energies(simulator: &Simulator<Self>) -> Energies {
                simulator.energies_now()
            }

            fn energy_ledger(simulator: &Simulator<Self>) -> EnergyLedger {
                simulator.ledger.report(&simulator.system, &simulator.state)
            }

            fn failure_at_end(simulator: &Simulator<Self>) -> Option<Failure> {
                simulator.failure_at_end_now()
            }

            fn reactions(simulator: &Simulator<Self>) -> Vec<Reaction> {
                simulator.reactions_now()
            }

            fn nodal_forces(simulator: &Simulator<Self>) -> Vec<[f64; 3]> {
                simulator.nodal_forces_now()
            }

            fn stresses(simulator: &Simulator<Self>) -> Vec<Matrix3<f64>> {
                simulator.system.stresses(&simulator.state.u, Moment::at(simulator.state.time))
            }

            fn stresses_at_points(simulator: &Simulator<Self>) -> Vec<Matrix3<f64>> {
                simulator.system.stresses_at_points(&simulator.state.u, Moment::at(simulator.state.time))
            }

            fn critical_time_step(simulator: &Simulator<Self>) -> Option<f64> {
                critical_time_step(simulator.kind, simulator.method.newmark, &simulator.system)
            }

            fn min_J(simulator: &Simulator<Self>) -> (f64, usize) {
                simulator.min_J_now()
            }

            fn inverted_elements(simulator: &Simulator<Self>) -> usize {
                simulator.inverted_elements_now()
            }
        }
    )* };
}

compiled!(f32, f64);
