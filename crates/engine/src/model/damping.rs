//! Damping: Rayleigh's −(α M + β K) v, and the forces that damp motions themselves, such as the dampers of springs.

use fem_scene::RayleighDamping;

use super::system::System;
use crate::forces::HessianKind;
use fem_elements::Real;
use fem_elements::sparse::Block;
use fem_elements::vector::{axpy, dot};

/// Multiples of the mass, the stiffness and the damping matrices of forces in a sum α M + β K + γ D.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DampingRates<T> {
    /// α
    pub mass: T,
    /// β
    pub stiffness: T,
    /// γ
    pub forces: T,
}

impl<T: Real> DampingRates<T> {
    /// The damping matrix of a body times this factor.
    pub fn new(rayleigh: Option<&RayleighDamping>, factor: f64) -> Self {
        let (alpha, beta) = rayleigh.map_or((0.0, 0.0), |damping| (damping.alpha, damping.beta));
        Self { mass: T::of(factor * alpha), stiffness: T::of(factor * beta), forces: T::of(factor) }
    }
}

impl<T: Real> System<T> {
    /// Returns true if motions are damped.
    pub fn is_damped(&self) -> bool {
        self.damping.is_some() || self.has_dampers()
    }

    /// Returns true if a force has a damping matrix.
    pub fn has_dampers(&self) -> bool {
        self.forces.active().any(|(potential, _)| potential.has_damping())
    }

    /// Adds the damping force −(α M + β K(u) + D(u)) v, N.
    pub fn add_damping_force(&self, u: &[[T; 3]], v: &[[T; 3]], force: &mut [[T; 3]]) {
        if self.is_damped() {
            self.add_damping_times(DampingRates::new(self.damping.as_ref(), -1.0), u, v, force);
        }
    }

    /// The same, with the forces of Rayleigh damping and of dampers, N, each empty if the body has none.
    pub fn add_damping_forces(&self, u: &[[T; 3]], v: &[[T; 3]], parts: &mut [Vec<[T; 3]>; 2], force: &mut [[T; 3]]) {
        let rates = DampingRates::new(self.damping.as_ref(), -1.0);
        for part in &mut *parts {
            part.fill([T::default(); 3]);
        }
        let [rayleigh, dampers] = &mut *parts;
        if !rayleigh.is_empty() {
            self.add_rayleigh_times(rates, u, v, rayleigh);
            axpy(1.0, rayleigh, force);
        }
        if !dampers.is_empty() {
            self.add_dampers_times(rates.forces, u, v, dampers);
            axpy(1.0, dampers, force);
        }
    }

    /// vᵀ (α M + β K(u)) v and vᵀ D(u) v, W if `v` are velocities.
    pub fn damping_powers(&self, u: &[[T; 3]], v: &[[T; 3]]) -> [f64; 2] {
        let rates = DampingRates::new(self.damping.as_ref(), 1.0);
        let mut product = vec![[T::default(); 3]; v.len()];
        self.add_rayleigh_times(rates, u, v, &mut product);
        let rayleigh = if self.damping.is_some() { dot(&product, v) } else { 0.0 };
        if !self.has_dampers() {
            return [rayleigh, 0.0];
        }
        product.fill([T::default(); 3]);
        self.add_dampers_times(rates.forces, u, v, &mut product);
        [rayleigh, dot(&product, v)]
    }

    /// Adds (α M + β K(u) + γ D(u)) v, N.
    pub fn add_damping_times(&self, rates: DampingRates<T>, u: &[[T; 3]], v: &[[T; 3]], product: &mut [[T; 3]]) {
        self.add_rayleigh_times(rates, u, v, product);
        self.add_dampers_times(rates.forces, u, v, product);
    }

    /// Adds (α M + β K(u)) v, N.
    fn add_rayleigh_times(&self, rates: DampingRates<T>, u: &[[T; 3]], v: &[[T; 3]], product: &mut [[T; 3]]) {
        if rates.mass != T::zero() || rates.stiffness != T::zero() {
            self.profile.damping.time(|| {
                self.mass.add_times(rates.mass, v, product);
                if rates.stiffness != T::zero() {
                    self.add_stiffness_times(rates.stiffness, u, v, product);
                }
            });
        }
    }

    /// Adds `factor` D(u) v of the forces that damp motions, N.
    pub fn add_dampers_times(&self, factor: T, u: &[[T; 3]], v: &[[T; 3]], product: &mut [[T; 3]]) {
        for (potential, timer) in self.forces.active().filter(|(potential, _)| potential.has_damping()) {
            timer.time(|| potential.add_damping_times(factor, u, v, product));
        }
    }

    /// Adds β K(u) + γ D(u), N/m.
    pub fn add_damping_matrix(
        &self,
        rates: DampingRates<T>,
        u: &[[T; 3]],
        kind: HessianKind,
        values: &mut [Block<T, 3>],
    ) {
        if rates.stiffness != T::zero() {
            self.add_stiffness(rates.stiffness, u, kind, values);
        }
        self.add_damping_matrices_of_forces(rates.forces, u, values);
    }

    /// Adds `factor` D(u) of the forces that damp motions, N/m.
    pub fn add_damping_matrices_of_forces(&self, factor: T, u: &[[T; 3]], values: &mut [Block<T, 3>]) {
        for (potential, timer) in self.forces.active().filter(|(potential, _)| potential.has_damping()) {
            timer.time(|| potential.add_damping_matrix(factor, u, values));
        }
    }
}
