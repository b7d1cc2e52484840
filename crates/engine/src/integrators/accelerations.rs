//! Accelerations for explicit methods: a(u, v, t) = M⁻¹ f(u, v, t). They need neither an energy nor a stiffness matrix.

use fem_model::simulation::{Cause, Counters};

use super::mass_inverse::MassInverse;
use super::prescribed_motion::PrescribedMotion;
use crate::forces::Moment;
use crate::model::state::State;
use crate::model::system::System;
use fem_elements::vector::{axpy, dot};
use fem_solvers::Real;

/// Accelerations, with the vectors that they need.
///
/// A step is [`begin`](Self::begin), evaluations [`at`](Self::at) its stages, and [`end`](Self::end). In each stage constrained degrees
/// of freedom have the displacement, velocity and acceleration of their prescribed motion. A consistent mass couples their acceleration to
/// their neighbours. Methods keep their order in this way.
#[derive(Clone, Debug)]
pub struct Accelerations<T: Real> {
    mass: MassInverse<T>,
    force: Vec<[T; 3]>,
    /// Forces of Rayleigh damping and of dampers at the last stage, N; empty without.
    damping: [Vec<[T; 3]>; 2],
    motion: PrescribedMotion<T>,
    /// Start of the step and its duration, s.
    time: f64,
    dt: f64,
    /// Works in the step.
    work: StageWork,
}

/// Works in a step, summed over its stages, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageWork {
    /// Of the prescribed motions on the body.
    pub motions: f64,
    /// Of the impulses with which prescribed velocities jump at the start of the step.
    pub jump: f64,
    /// Dissipated by Rayleigh damping.
    pub rayleigh: f64,
    /// Dissipated by the dampers of forces.
    pub dampers: f64,
}

/// A stage of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// Part of the step after which the stage is evaluated: 0 is its start, 1 its end.
    pub after: f64,
    /// Weight of the stage in the sums over the step.
    pub weight: f64,
}

impl<T: Real> Accelerations<T> {
    /// Allocates its vectors for a body.
    pub fn new(system: &System<T>) -> Self {
        let force = vec![[T::default(); 3]; system.nodes()];
        let zero = |is_there: bool| vec![[T::default(); 3]; if is_there { system.nodes() } else { 0 }];
        let damping = [zero(system.damping.is_some()), zero(system.has_dampers())];
        let (mass, motion) = (MassInverse::new(&system.mass), PrescribedMotion::new(system));
        Self { mass, force, damping, motion, time: 0.0, dt: 0.0, work: StageWork::default() }
    }

    /// Starts a step. A jump of a prescribed velocity changes the velocities of the neighbours through a consistent mass:
    /// M_ff Δv_f = −M_fp Δv_p. `a` is overwritten then. Returns whether a velocity jumps.
    pub fn begin(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        a: &mut [[T; 3]],
    ) -> Result<bool, Cause> {
        (self.time, self.dt, self.work) = (state.time, dt, StageWork::default());
        if !system.dirichlet.has_motion() {
            return Ok(false);
        }
        let Self { mass, force, motion, work, .. } = self;
        let has_jump = system.profile.prescribed.time(|| {
            motion.begin(system, state, dt);
            motion.start(system, state, force)
        });
        if has_jump {
            work.jump = system.profile.mass.time(|| impulse(system, mass, motion, (force, a), state))?;
        }
        Ok(has_jump)
    }

    /// Accelerations at a stage with displacements `u` and velocities `v`; zero at constrained degrees of freedom, m/s². Sets the
    /// constrained entries of `u` and `v`.
    pub fn at(
        &mut self,
        system: &System<T>,
        (u, v): (&mut [[T; 3]], &mut [[T; 3]]),
        Stage { after, weight }: Stage,
        a: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        let Self { mass, force, damping, motion, time, dt, work } = self;
        let has_motion = system.dirichlet.has_motion();
        if has_motion {
            system.profile.prescribed.time(|| motion.place(system, after, u, v));
        }
        counters.force_assemblies += 1;
        system.undamped_force(u, Moment::at(*time + after * *dt), force);
        system.add_damping_forces(u, v, damping, force);
        if has_motion {
            system.profile.prescribed.time(|| system.mass.add_times(T::of(-1.0), &motion.acceleration, force));
            // The reactions are minus the force, and free entries of the velocity are zero.
            work.motions -= weight * *dt * dot(force, &motion.velocity);
        }
        system.profile.mass.time(|| {
            mass.solve(system, force, a)?;
            flush_to_zero(a);
            Ok(())
        })?;
        if has_motion && !system.mass.is_lumped() {
            work.motions += weight * *dt * product(system, a, &motion.velocity, force);
        }
        Ok(())
    }

    /// Adds what the damping forces of the last stage take from a body with these velocities (m/s) in a part of the step.
    pub fn dissipate(&mut self, v: &[[T; 3]], part: f64) {
        let [rayleigh, dampers] = &self.damping;
        self.work.rayleigh -= part * self.dt * dot(rayleigh, v);
        self.work.dampers -= part * self.dt * dot(dampers, v);
    }

    /// Ends a step: constrained degrees of freedom have their prescribed displacement and velocity.
    pub fn end(&mut self, system: &System<T>, state: &mut State<T>) {
        if system.dirichlet.has_motion() {
            system.profile.prescribed.time(|| self.motion.place(system, 1.0, &mut state.u, &mut state.v));
        }
    }

    /// Works in the last step.
    pub fn work(&self) -> StageWork {
        self.work
    }
}

/// Gives free nodes their velocities after a jump of the prescribed ones, m/s. Returns the work of the impulses on the
/// constrained nodes: each times the mean of the velocities before and after, J.
fn impulse<T: Real>(
    system: &System<T>,
    mass: &mut MassInverse<T>,
    motion: &mut PrescribedMotion<T>,
    (jump, change): (&mut [[T; 3]], &mut [[T; 3]]),
    state: &mut State<T>,
) -> Result<f64, Cause> {
    // Free entries of the mean velocity are zero. Each stage writes the accelerations anew.
    let mean = &mut motion.acceleration;
    mean.copy_from_slice(&motion.velocity);
    axpy(-0.5, jump, mean);
    change.fill([T::default(); 3]);
    system.mass.add_times(T::one(), jump, change);
    let mut work = dot(change, mean);
    if system.mass.is_lumped() {
        return Ok(work);
    }
    jump.copy_from_slice(change);
    mass.solve(system, jump, change)?;
    work -= product(system, change, mean, jump);
    axpy(-1.0, change, &mut state.v);
    Ok(work)
}

/// xᵀ M y; overwrites `product`.
fn product<T: Real>(system: &System<T>, x: &[[T; 3]], y: &[[T; 3]], product: &mut [[T; 3]]) -> f64 {
    product.fill([T::default(); 3]);
    system.mass.add_times(T::one(), x, product);
    dot(product, y)
}

/// Sets accelerations to zero that are negligible beside the largest one in this precision. An elastic wave travels one
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
