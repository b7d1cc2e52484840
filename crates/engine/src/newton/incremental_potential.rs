//! What a step of implicit Euler or a search for equilibrium minimises.

use crate::forces::acting::Acting;
use crate::model::system::{Energy, System};
use crate::number::Real;
use crate::sparse::Block;

/// E(w) = ‖w − ŵ‖²_M / (2 dt²) + wᵀ C w / (2 dt) + V(u₀ + w), C = α M + β K(u₀): its minimum is the displacement w of a step of
/// implicit Euler, M (w − ŵ)/dt² = f − C w/dt. Without the first two it is that of equilibrium.
///
/// The unknown is what the step adds, not where it ends, so that velocities w/dt keep their digits in single precision.
#[derive(Clone, Copy)]
pub struct IncrementalPotential<'a, T: Real> {
    /// The body.
    pub system: &'a System<T>,
    /// Pulls and loads at the end of the step.
    pub acting: Acting<'a, T>,
    /// Displacements at its start, m.
    pub start: &'a [[T; 3]],
    /// What makes it a motion; `None` for equilibrium.
    pub motion: Option<Motion<'a, T>>,
}

/// Inertia and damping of a step.
#[derive(Clone, Copy)]
pub struct Motion<'a, T> {
    /// ŵ = dt v₀: what the step would add without forces, m.
    pub inertial: &'a [[T; 3]],
    /// 1/dt², 1/s².
    pub over_dt2: T,
    /// α/dt, 1/s², and β/dt; `None` for no damping.
    pub damping: Option<(T, T)>,
}

impl<'a, T: Real> Motion<'a, T> {
    /// That of a step of `dt` seconds.
    pub fn new(system: &System<T>, inertial: &'a [[T; 3]], dt: f64) -> Self {
        let rates = |damping: &fem_scene::RayleighDamping| (T::of(damping.alpha / dt), T::of(damping.beta / dt));
        Self { inertial, over_dt2: T::of(1.0 / (dt * dt)), damping: system.damping.as_ref().map(rates) }
    }
}

/// Vectors that evaluations need; kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Scratch<T> {
    u: Vec<[T; 3]>,
    difference: Vec<[T; 3]>,
    product: Vec<[T; 3]>,
}

impl<T: Real> Scratch<T> {
    /// For so many nodes.
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
    /// E(w), and its gradient with zeros where nodes are held, N.
    pub fn energy_and_gradient(&self, w: &[[T; 3]], gradient: &mut [[T; 3]], scratch: &mut Scratch<T>) -> Energy {
        scratch.set_u(self.start, w);
        let potential = self.system.potential_and_gradient(&scratch.u, self.acting, gradient);
        let moving = self.motion.map_or(Energy::default(), |motion| self.add_motion(&motion, w, gradient, scratch));
        self.system.held.clear(gradient);
        potential + moving
    }

    /// Smallest J of all elements.
    pub fn min_det_F(&self, w: &[[T; 3]], scratch: &mut Scratch<T>) -> f64 {
        scratch.set_u(self.start, w);
        self.system.elements.min_det_F(&scratch.u).0.as_f64()
    }

    /// Size of what cancels in E(w) without being among its terms, J.
    pub fn cancelled(&self, w: &[[T; 3]], scratch: &mut Scratch<T>) -> f64 {
        scratch.set_u(self.start, w);
        self.system.cancelled(&scratch.u)
    }

    /// Adds the gradient of inertia and damping, and returns their energy.
    fn add_motion(
        &self,
        motion: &Motion<T>,
        w: &[[T; 3]],
        gradient: &mut [[T; 3]],
        scratch: &mut Scratch<T>,
    ) -> Energy {
        let Scratch { difference, product, .. } = scratch;
        for (difference, (w, inertial)) in difference.iter_mut().zip(w.iter().zip(motion.inertial)) {
            *difference = std::array::from_fn(|i| w[i] - inertial[i]);
        }
        product.fill([T::default(); 3]);
        self.system.add_mass_times(motion.over_dt2, difference, product);
        let mut energy = Energy::of(add_and_multiply(difference, product, gradient));
        if let Some((alpha, beta)) = motion.damping {
            let damp = || {
                product.fill([T::default(); 3]);
                self.system.mass.add_times(alpha, w, product);
                self.system.add_stiffness_times(beta, self.start, w, product);
                Energy::of(add_and_multiply(w, product, gradient))
            };
            energy = energy + self.system.work.damping.time(damp);
        }
        energy
    }

    /// The gradient at `led`, the step of held directions, of E to second order about w = 0; with zeros where nodes are held, N.
    /// No energy, no matrix.
    pub fn linear_slope(&self, led: &[[T; 3]], gradient: &mut [[T; 3]], scratch: &mut Scratch<T>) {
        let system = self.system;
        system.gradient(self.start, self.acting, gradient);
        let mut stiffness = T::of(1.0);
        if let Some(motion) = self.motion {
            for (difference, (led, inertial)) in scratch.difference.iter_mut().zip(led.iter().zip(motion.inertial)) {
                *difference = std::array::from_fn(|i| led[i] - inertial[i]);
            }
            system.add_mass_times(motion.over_dt2, &scratch.difference, gradient);
            if let Some((alpha, beta)) = motion.damping {
                stiffness += beta;
                system.work.damping.time(|| system.mass.add_times(alpha, led, gradient));
            }
        }
        if system.held.leads() {
            system.work.prescribed.time(|| system.add_stiffness_times(stiffness, self.start, led, gradient));
        }
        system.held.clear(gradient);
    }

    /// ∂²E/∂w², N/m; each element's part projected, or as it is.
    pub fn hessian(&self, w: &[[T; 3]], projected: bool, values: &mut [Block<T, 3>], scratch: &mut Scratch<T>) {
        scratch.set_u(self.start, w);
        let system = self.system;
        values.fill([[T::default(); 3]; 3]);
        let mut add = |factor: T, u: &[[T; 3]]| match projected {
            true => system.add_projected_stiffness(factor, u, values),
            false => system.add_stiffness(factor, u, values),
        };
        add(T::of(1.0), &scratch.u);
        let mut mass = T::default();
        if let Some(motion) = self.motion {
            mass = motion.over_dt2;
            if let Some((alpha, beta)) = motion.damping {
                mass += alpha;
                if beta > T::default() {
                    add(beta, self.start);
                }
            }
        }
        if !self.acting.pulls.is_empty() {
            system.work.drag.time(|| self.acting.add_stiffness(&system.pattern, values));
        }
        if self.motion.is_some() {
            system.work.mass.time(|| system.mass.add_to(mass, &system.pattern, values));
        }
        system.held.take_out(&system.pattern, values);
    }
}

/// sum += y, and ½ x · y.
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
