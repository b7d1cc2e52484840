//! Accelerations for explicit methods: a(u, v, t) = M⁻¹ f(u, v, t). They need neither an energy nor a stiffness matrix.

use fem_scene::simulation::{Cause, Counters};

use super::mass_inverse::MassInverse;
use crate::forces::Moment;
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;
use crate::vector::dot;

/// Accelerations, with the vectors that they need.
///
/// A prescribed motion has one velocity during a step, the one that reaches its place at the end. [`begin`](Self::begin) writes it
/// into the state; through a consistent mass, its change also accelerates the neighbours of constrained nodes.
#[derive(Clone, Debug)]
pub struct Accelerations<T: Real> {
    mass: MassInverse<T>,
    force: Vec<[T; 3]>,
    /// Accelerations of the constrained degrees of freedom, m/s², and their velocities, m/s; empty without a prescribed motion.
    prescribed: Vec<[T; 3]>,
    velocity: Vec<[T; 3]>,
    /// Time step, s, and power of the prescribed motions at the last evaluation, W.
    dt: f64,
    power: f64,
}

impl<T: Real> Accelerations<T> {
    /// Allocates its vectors for a body.
    pub fn new(system: &System<T>) -> Self {
        let zero = |nodes: usize| vec![[T::default(); 3]; nodes];
        let moving = if system.dirichlet.has_motion() { system.nodes() } else { 0 };
        Self {
            mass: MassInverse::new(&system.mass),
            force: zero(system.nodes()),
            prescribed: zero(moving),
            velocity: zero(moving),
            dt: 0.0,
            power: 0.0,
        }
    }

    /// Starts a step: gives constrained degrees of freedom the velocity of their prescribed motion.
    pub fn begin(&mut self, system: &System<T>, state: &mut State<T>, dt: f64) {
        if !system.dirichlet.has_motion() {
            return;
        }
        // A reset can bring back a motion that had ended when the vectors were allocated.
        self.prescribed.resize(system.nodes(), [T::default(); 3]);
        self.velocity.resize(system.nodes(), [T::default(); 3]);
        self.dt = dt;
        let over_dt = T::of(1.0 / dt);
        system.prescribe(&state.u, Moment::at(state.time + dt), &mut self.velocity);
        for node in 0..self.prescribed.len() {
            for i in 0..3 {
                self.velocity[node][i] *= over_dt;
                self.prescribed[node][i] = (self.velocity[node][i] - state.v[node][i]) * over_dt;
            }
        }
        system.dirichlet.clear_free(&mut self.prescribed);
        system.dirichlet.copy_constrained(&self.velocity, &mut state.v);
    }

    /// Accelerations at displacements `u`, velocities `v` and a time (s); zero at constrained degrees of freedom, m/s².
    pub fn at(
        &mut self,
        system: &System<T>,
        (u, v): (&[[T; 3]], &[[T; 3]]),
        time: f64,
        a: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        let Self { mass, force, prescribed, velocity, power, .. } = self;
        counters.force_assemblies += 1;
        system.force(u, v, u, Moment::at(time), force);
        if system.dirichlet.has_motion() {
            system.profile.prescribed.time(|| system.mass.add_times(T::of(-1.0), prescribed, force));
            // The reactions are minus the force, and free entries of the velocity are zero.
            *power = -dot(force, velocity);
        }
        system.profile.mass.time(|| {
            mass.solve(system, force, a)?;
            flush_to_zero(a);
            Ok(())
        })
    }

    /// Work of the prescribed motions on the body in the last step, with the power at its last evaluation, J.
    pub fn work_of_motions(&self) -> f64 {
        self.dt * self.power
    }
}

/// Sets accelerations to zero that are smaller than the largest by more than the arithmetic resolves. An elastic wave travels one
/// element in a step, and ahead of it motion fades within a few elements to numbers whose squares are subnormal in single precision,
/// with which a step takes several times as long.
fn flush_to_zero<T: Real>(a: &mut [[T; 3]]) {
    let largest = a.as_flattened().iter().fold(T::default(), |largest, entry| largest.max(entry.abs()));
    let limit = T::of(T::EPSILON.as_f64().powf(1.5)) * largest;
    for entry in a.as_flattened_mut() {
        if entry.abs() < limit {
            *entry = T::default();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::flush_to_zero;

    #[test]
    fn accelerations_far_below_the_largest_become_zero_and_others_stay() {
        let mut a = [[-2.0_f32, 1e-9, 1e-12], [1e-30, -1e-12, f32::MIN_POSITIVE / 4.0]];
        flush_to_zero(&mut a);
        assert_eq!(a, [[-2.0, 1e-9, 0.0], [0.0; 3]]);
        let mut small = [[1e-30_f32, 1e-35, 0.0]];
        flush_to_zero(&mut small);
        assert_eq!(small, [[1e-30, 1e-35, 0.0]]);
        let mut broken = [[f64::NAN, 1.0, f64::INFINITY]];
        flush_to_zero(&mut broken);
        assert!(broken[0][0].is_nan() && broken[0][2].is_infinite());
    }
}
