//! What explicit methods ask for: accelerations, a(u, v, t) = M⁻¹ (f(u, t) − C v). No energy, no matrix.

use super::mass_inverse::MassInverse;
use crate::forces::pulls::{AnchorSpring, Pulls};
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;
use fem_scene::simulation::{Cause, Counters};

/// Accelerations, with the vectors that they need.
///
/// A prescribed motion has one velocity during a step, that which takes it to its place at the end; `begin` writes it into the
/// state, and its change is felt by the neighbours of led nodes through a consistent mass.
#[derive(Clone, Debug)]
pub struct Accelerations<T: Real> {
    mass: MassInverse<T>,
    springs: Vec<AnchorSpring<T>>,
    force: Vec<[T; 3]>,
    /// Accelerations of led directions, and their velocities; empty where nothing is led.
    led: Vec<[T; 3]>,
    velocity: Vec<[T; 3]>,
}

impl<T: Real> Accelerations<T> {
    /// For a body.
    pub fn new(system: &System<T>) -> Self {
        let zero = |nodes: usize| vec![[T::default(); 3]; nodes];
        let led = if system.held.leads() { system.nodes() } else { 0 };
        Self {
            mass: MassInverse::new(&system.mass),
            springs: Vec::new(),
            force: zero(system.nodes()),
            led: zero(led),
            velocity: zero(led),
        }
    }

    /// The pulls of the last evaluation.
    pub fn springs(&self) -> &[AnchorSpring<T>] {
        &self.springs
    }

    /// Starts a step: gives led directions their velocity.
    pub fn begin(&mut self, system: &System<T>, state: &mut State<T>, dt: f64) {
        if !system.held.leads() {
            return;
        }
        let (end, over_dt) = (state.time + dt, T::of(1.0 / dt));
        system.lead(|motion| motion.fraction(end), &state.u, &mut self.velocity);
        for node in 0..self.led.len() {
            for i in 0..3 {
                self.velocity[node][i] *= over_dt;
                self.led[node][i] = (self.velocity[node][i] - state.v[node][i]) * over_dt;
            }
        }
        system.held.keep(&mut self.led);
        system.held.copy(&self.velocity, &mut state.v);
    }

    /// Accelerations at displacements `u`, velocities `v` and a time (s); zero where nodes are held, m/s².
    pub fn at(
        &mut self,
        pulls: &Pulls<T>,
        (u, v): (&[[T; 3]], &[[T; 3]]),
        time: f64,
        a: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        let system = pulls.system;
        let force = &mut self.force;
        counters.force_assemblies += 1;
        pulls.at(time, &mut self.springs);
        system.gradient(u, system.acting(&self.springs), force);
        for force in force.as_flattened_mut() {
            *force = -*force;
        }
        system.add_pressures(T::of(1.0), u, force);
        if let Some(damping) = &system.damping {
            system.work.damping.time(|| {
                system.mass.add_times(T::of(-damping.alpha), v, force);
                if damping.beta > 0.0 {
                    system.add_stiffness_times(T::of(-damping.beta), u, v, force);
                }
            });
        }
        if system.held.leads() {
            system.work.prescribed.time(|| system.mass.add_times(T::of(-1.0), &self.led, force));
        }
        system.work.mass.time(|| self.mass.solve(system, force, a))
    }
}
