//! The incremental potential: its minimum is a step of implicit Euler, or equilibrium.

use crate::forces::{Energy, HessianKind, Moment};
use crate::model::system::System;
use crate::number::Real;
use crate::sparse::Block;

/// E(w) = ‖w − ŵ‖²_M / (2 dt²) + wᵀ C w / (2 dt) + V(u₀ + w), C = α M + β K(u₀), for the displacement increment w: its minimum is a
/// step of implicit Euler, M (w − ŵ)/dt² = f − C w/dt. Without the first two terms it is equilibrium.
///
/// The unknown is the increment instead of the new displacement, so that velocities w/dt keep their digits in single precision.
#[derive(Clone, Copy)]
pub struct IncrementalPotential<'a, T: Real> {
    /// The body.
    pub system: &'a System<T>,
    /// The increment.
    pub increment: Increment<'a, T>,
    /// Gradient of the follower loads, kept fixed, N; empty where there are none.
    pub followers: &'a [[T; 3]],
}

/// The start and the end of a step.
#[derive(Clone, Copy)]
pub struct Increment<'a, T> {
    /// Displacements at its start, m.
    pub start: &'a [[T; 3]],
    /// Its end, at which forces are evaluated.
    pub end: Moment,
    /// Inertia and damping; `None` for equilibrium.
    pub inertia: Option<Inertia<'a, T>>,
}

/// Inertia and damping of a step.
#[derive(Clone, Copy)]
pub struct Inertia<'a, T> {
    /// ŵ = dt v₀, the increment without forces, m.
    pub inertial: &'a [[T; 3]],
    /// 1/dt², 1/s².
    pub over_dt2: T,
    /// α/dt, 1/s², and β/dt; `None` without damping.
    pub damping: Option<(T, T)>,
}

impl<'a, T: Real> Inertia<'a, T> {
    /// Inertia of a step of `dt` seconds.
    pub fn new(system: &System<T>, inertial: &'a [[T; 3]], dt: f64) -> Self {
        let rates = |damping: &fem_scene::RayleighDamping| (T::of(damping.alpha / dt), T::of(damping.beta / dt));
        Self { inertial, over_dt2: T::of(1.0 / (dt * dt)), damping: system.damping.as_ref().map(rates) }
    }
}

/// Vectors for evaluations, kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Workspace<T> {
    u: Vec<[T; 3]>,
    difference: Vec<[T; 3]>,
    product: Vec<[T; 3]>,
}

impl<T: Real> Workspace<T> {
    /// Allocates vectors for so many nodes.
    pub fn new(nodes: usize) -> Self {
        let zero = || vec![[T::default(); 3]; nodes];
        Self { u: zero(), difference: zero(), product: zero() }
    }

    fn set_u(&mut self, start: &[[T; 3]], w: &[[T; 3]]) {
        for (u, (start, w)) in self.u.iter_mut().zip(start.iter().zip(w)) {
            *u = std::array::from_fn(|i| start[i] + w[i]);
        }
    }
}

impl<T: Real> IncrementalPotential<'_, T> {
    /// E(w), and its gradient with zero entries at constrained degrees of freedom, N.
    pub fn energy_and_gradient(&self, w: &[[T; 3]], gradient: &mut [[T; 3]], workspace: &mut Workspace<T>) -> Energy {
        let Increment { start, end, inertia } = self.increment;
        workspace.set_u(start, w);
        let potential = self.system.potential_and_gradient(&workspace.u, end, gradient);
        let of_followers = self.add_followers(&workspace.u, gradient);
        let kinetic = inertia.map_or(Energy::default(), |inertia| self.add_inertia(&inertia, w, gradient, workspace));
        self.system.dirichlet.clear_constrained(gradient);
        potential + of_followers + kinetic
    }

    /// Minimum of det F over the elements whose law does not allow inversion.
    pub fn min_det_F(&self, w: &[[T; 3]], workspace: &mut Workspace<T>) -> f64 {
        workspace.set_u(self.increment.start, w);
        self.system.elements.min_det_F_of_barriers(&workspace.u).0.as_f64()
    }

    /// Magnitude of the terms that cancel within E(w), J.
    pub fn cancelled(&self, w: &[[T; 3]], workspace: &mut Workspace<T>) -> f64 {
        workspace.set_u(self.increment.start, w);
        self.system.cancelled(&workspace.u)
    }

    /// The largest multiple of `direction` from w up to which every force stays feasible.
    pub fn largest_step(&self, w: &[[T; 3]], direction: &[[T; 3]], workspace: &mut Workspace<T>) -> f64 {
        workspace.set_u(self.increment.start, w);
        self.system.largest_step(&workspace.u, direction)
    }

    /// Adds the fixed gradient of the follower loads, and returns the energy g·u that it is the gradient of.
    fn add_followers(&self, u: &[[T; 3]], gradient: &mut [[T; 3]]) -> Energy {
        let mut energy = Energy::default();
        for ((sum, g), u) in gradient.iter_mut().zip(self.followers).zip(u) {
            let mut work = 0.0;
            for i in 0..3 {
                sum[i] += g[i];
                work += g[i].as_f64() * u[i].as_f64();
            }
            energy = energy + Energy::of(work);
        }
        energy
    }

    /// Adds the gradient of inertia and damping, and returns their energy.
    fn add_inertia(
        &self,
        inertia: &Inertia<T>,
        w: &[[T; 3]],
        gradient: &mut [[T; 3]],
        workspace: &mut Workspace<T>,
    ) -> Energy {
        let Workspace { difference, product, .. } = workspace;
        for (difference, (w, inertial)) in difference.iter_mut().zip(w.iter().zip(inertia.inertial)) {
            *difference = std::array::from_fn(|i| w[i] - inertial[i]);
        }
        product.fill([T::default(); 3]);
        self.system.add_mass_times(inertia.over_dt2, difference, product);
        let mut energy = Energy::of(add_and_multiply(difference, product, gradient));
        if let Some((alpha, beta)) = inertia.damping {
            let damp = || {
                product.fill([T::default(); 3]);
                self.system.mass.add_times(alpha, w, product);
                self.system.add_stiffness_times(beta, self.increment.start, w, product);
                Energy::of(add_and_multiply(w, product, gradient))
            };
            energy = energy + self.system.profile.damping.time(damp);
        }
        energy
    }

    /// The gradient at the increment `prescribed` of E to second order about w = 0, with zero entries at constrained degrees of
    /// freedom, N. It needs neither an energy nor a matrix.
    pub fn linearized_gradient(&self, prescribed: &[[T; 3]], gradient: &mut [[T; 3]], workspace: &mut Workspace<T>) {
        let Self { system, increment: Increment { start, end, inertia }, .. } = *self;
        system.gradient(start, end, gradient);
        self.add_followers(start, gradient);
        let mut stiffness = T::of(1.0);
        if let Some(inertia) = inertia {
            let increments = prescribed.iter().zip(inertia.inertial);
            for (difference, (prescribed, inertial)) in workspace.difference.iter_mut().zip(increments) {
                *difference = std::array::from_fn(|i| prescribed[i] - inertial[i]);
            }
            system.add_mass_times(inertia.over_dt2, &workspace.difference, gradient);
            if let Some((alpha, beta)) = inertia.damping {
                stiffness += beta;
                system.profile.damping.time(|| system.mass.add_times(alpha, prescribed, gradient));
            }
        }
        if system.dirichlet.has_motion() {
            let profile = &system.profile;
            profile.prescribed.time(|| system.add_stiffness_times(stiffness, start, prescribed, gradient));
        }
        system.dirichlet.clear_constrained(gradient);
    }

    /// ∂²E/∂w², N/m.
    pub fn hessian(&self, w: &[[T; 3]], kind: HessianKind, values: &mut [Block<T, 3>], workspace: &mut Workspace<T>) {
        let Self { system, increment: Increment { start, inertia, .. }, .. } = *self;
        workspace.set_u(start, w);
        values.fill([[T::default(); 3]; 3]);
        system.add_stiffness(T::of(1.0), &workspace.u, kind, values);
        if let Some((_, beta)) = inertia.and_then(|inertia| inertia.damping)
            && beta > T::default()
        {
            system.add_stiffness(beta, start, kind, values);
        }
        system.add_external_hessian(&workspace.u, kind, values);
        if let Some(inertia) = inertia {
            let mass = inertia.over_dt2 + inertia.damping.map_or(T::default(), |(alpha, _)| alpha);
            system.profile.mass.time(|| system.mass.add_to(mass, &system.pattern, values));
        }
        system.dirichlet.eliminate(&system.pattern, values);
    }
}

/// sum += y; returns ½ x · y.
fn add_and_multiply<T: Real>(x: &[[T; 3]], y: &[[T; 3]], sum: &mut [[T; 3]]) -> f64 {
    let mut twice = 0.0;
    for (sum, (x, y)) in sum.iter_mut().zip(x.iter().zip(y)) {
        for i in 0..3 {
            sum[i] += y[i];
            twice += x[i].as_f64() * y[i].as_f64();
        }
    }
    0.5 * twice
}
