//! Families of cases, one file each.

mod contact;
mod degenerate_bodies;
mod elements;
mod energy;
mod explosions;
mod flat_bodies;
pub mod incompressibility;
mod invariance;
mod iterated_methods;
mod large_strains;
mod long_runs;
pub mod maps;
mod mass_spring;
mod material_contrast;
mod plastic_flow;
mod recovery;
mod refusals;
mod single_precision;
mod slivers;
mod stability_limits;
mod stiffness_and_step;

// What the families have in common.
use super::case::{Case, Cell, Finding, Map, Outcome, SMALLEST_J};
use super::initial_state::{CENTRE, Random, TANGLES, Tangle, distance_from_rest, largest_speed, place, place_moving};
use super::march::{march, march_with};
use super::setup::{
    EndMotion, Grid, LAWS, NEO_HOOKEAN, Setup, clamp, clamp_within, damp, dynamic, gravity, iterated, lump, moved_box,
    prescribed_end, refused, turned,
};
use super::theory::{self, Scheme, clamped, excite, forecast, try_forecast, unit_omega};
use crate::study::{Deadline, pairs};

/// The cases of all families.
pub fn cases(quick: bool) -> Vec<Case> {
    let mut cases = Vec::new();
    stiffness_and_step::add(&mut cases, quick);
    maps::add(&mut cases, quick);
    stability_limits::add(&mut cases, quick);
    explosions::add(&mut cases);
    incompressibility::add(&mut cases, quick);
    elements::add(&mut cases, quick);
    invariance::add(&mut cases, quick);
    slivers::add(&mut cases, quick);
    single_precision::add(&mut cases, quick);
    material_contrast::add(&mut cases, quick);
    large_strains::add(&mut cases, quick);
    recovery::add(&mut cases, quick);
    degenerate_bodies::add(&mut cases, quick);
    long_runs::add(&mut cases, quick);
    flat_bodies::add(&mut cases, quick);
    plastic_flow::add(&mut cases, quick);
    mass_spring::add(&mut cases, quick);
    iterated_methods::add(&mut cases, quick);
    contact::add(&mut cases, quick);
    energy::add(&mut cases, quick);
    refusals::add(&mut cases);
    cases
}
