//! Damping: −(α M + β K) v with a K of either form, and the forces that damp motions themselves, such as the dampers of springs.
//!
//! In the form `kelvin_voigt` K is the material part of the stiffness: no velocities of a rigid motion strain the elements, and springs are
//! damped along themselves. In Rayleigh's form it is the stiffness itself, whose part from the stress turns with no rotation.

use fem_model::{Damping, DampingForm, Timer};

use super::state::State;
use super::system::{INTERNAL, System};
use crate::forces::{Damped, HessianKind};
use fem_elements::sparse::Block;
use fem_elements::vector::{axpy, dot, set_zero};
use fem_solvers::Real;

/// Part of the minimum of det F that displacements must keep where damping takes its matrix.
const KEPT: f64 = 0.5;

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
    pub fn new(damping: Option<&Damping>, factor: f64) -> Self {
        let (alpha, beta) = damping.map_or((0.0, 0.0), |damping| (damping.alpha, damping.beta));
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
        self.forces.active().any(|(potential, _)| potential.damped().is_some())
    }

    /// Returns true if the damping of elements is their stiffness times β: that of Rayleigh's form without plastic flow, and that of linear laws.
    /// Elements that flow are damped by their elastic stiffness, for at the yield surface rounding errors choose between the two.
    pub fn damps_by_stiffness(&self) -> bool {
        let is_rayleigh = self.damping_form() == DampingForm::Rayleigh;
        self.elements.is_linear() || is_rayleigh && self.elements.plasticity().is_none()
    }

    /// Returns true if stiffness-proportional damping has a matrix that turns with the body.
    pub fn has_viscosity(&self) -> bool {
        let is_meant = |damping: Damping| damping.beta > 0.0 && damping.form == DampingForm::KelvinVoigt;
        self.damping.is_some_and(is_meant) && (self.has_dampers() || !self.elements.is_linear())
    }

    /// Writes the displacements after `ahead` seconds with constant velocities, m, at which a step takes its damping matrix; those of now where an
    /// element without a stress for det F ≤ 0 would lose half of its det F.
    pub fn extrapolate(&self, (u, v): (&[[T; 3]], &[[T; 3]]), ahead: f64, damping_at: &mut [[T; 3]]) {
        damping_at.copy_from_slice(u);
        axpy(ahead, v, damping_at);
        let [before, after] = [u, &*damping_at].map(|u| self.elements.min_det_F_of_barriers(u).0);
        // NaN fails the comparison; without such elements both are infinite.
        if !(after >= T::of(KEPT) * before) {
            damping_at.copy_from_slice(u);
        }
    }

    /// The same half a step of `dt` seconds ahead, for viscosity in implicit Euler and its linearization: the increment of a rotation strains nothing
    /// there, and strains the body at the start by half the square of its angle.
    pub fn extrapolate_half(&self, start: (&[[T; 3]], &[[T; 3]]), dt: f64, damping_at: &mut [[T; 3]]) {
        self.extrapolate(start, 0.5 * dt, damping_at);
    }

    /// Writes the displacements at which a step of implicit Euler or its linearization takes its damping matrix, m.
    pub fn damping_displacements(&self, before: &State<T>, dt: f64, damping_at: &mut Vec<[T; 3]>) {
        damping_at.clone_from(&before.u);
        if self.has_viscosity() {
            self.extrapolate_half((&before.u, &before.v), dt, damping_at);
        }
    }

    /// Adds `factor` times the product of d with the Hessian of the springs between the body's nodes, N.
    pub(super) fn add_internal_hessian_times(&self, factor: T, u: &[[T; 3]], d: &[[T; 3]], product: &mut [[T; 3]]) {
        for (potential, _) in self.forces.active().filter(|(potential, _)| potential.is_internal()) {
            potential.add_hessian_times(factor, u, INTERNAL, d, product);
        }
    }

    fn damping_form(&self) -> DampingForm {
        self.damping.map_or(DampingForm::default(), |damping| damping.form)
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

    /// vᵀ (α M + β K(u)) v and vᵀ D(u) v, W if `v` are velocities. `product` is overwritten.
    pub fn damping_powers(&self, u: &[[T; 3]], v: &[[T; 3]], product: &mut Vec<[T; 3]>) -> [f64; 2] {
        let rates = DampingRates::new(self.damping.as_ref(), 1.0);
        set_zero(product, v.len());
        self.add_rayleigh_times(rates, u, v, product);
        let rayleigh = if self.damping.is_some() { dot(product, v) } else { 0.0 };
        if !self.has_dampers() {
            return [rayleigh, 0.0];
        }
        product.fill([T::default(); 3]);
        self.add_dampers_times(rates.forces, u, v, product);
        [rayleigh, dot(product, v)]
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
                    self.add_stiffness_damping_times(rates.stiffness, u, v, product);
                }
            });
        }
    }

    /// Adds β K(u) v, N. In Kelvin–Voigt's form the springs' part is one of their dampers.
    fn add_stiffness_damping_times(&self, beta: T, u: &[[T; 3]], v: &[[T; 3]], product: &mut [[T; 3]]) {
        if self.damps_by_stiffness() {
            self.elements.add_stiffness_times(beta, u, v, product);
        } else {
            self.elements.add_damping_times(self.damping_form(), beta, u, v, product);
        }
        if self.damping_form() == DampingForm::Rayleigh {
            self.add_internal_hessian_times(beta, u, v, product);
        }
    }

    /// Adds `factor` D(u) v of the forces that damp motions, N.
    pub fn add_dampers_times(&self, factor: T, u: &[[T; 3]], v: &[[T; 3]], product: &mut [[T; 3]]) {
        for (damped, timer) in self.dampers() {
            timer.time(|| damped.add_damping_times(factor, u, v, product));
        }
    }

    /// Adds the part of β K(u) + γ D(u) that is no multiple of the elements' stiffness, N/m.
    pub fn add_damping_matrix(
        &self,
        rates: DampingRates<T>,
        u: &[[T; 3]],
        kind: HessianKind,
        values: &mut [Block<T, 3>],
    ) {
        let form = self.damping_form();
        if rates.stiffness != T::zero() && !self.damps_by_stiffness() {
            let timer = &self.profile.stiffness;
            let is_projected = kind == HessianKind::Projected;
            timer.time(|| self.elements.add_damping_matrix(form, is_projected, rates.stiffness, u, values));
        }
        if form == DampingForm::Rayleigh {
            self.add_internal_hessian(rates.stiffness, u, kind, values);
        }
        self.add_damping_matrices_of_forces(rates.forces, u, values);
    }

    /// Adds `factor` D(u) of the forces that damp motions, N/m.
    fn add_damping_matrices_of_forces(&self, factor: T, u: &[[T; 3]], values: &mut [Block<T, 3>]) {
        for (damped, timer) in self.dampers() {
            timer.time(|| damped.add_damping_matrix(factor, u, values));
        }
    }

    fn dampers(&self) -> impl Iterator<Item = (&dyn Damped<T>, &Timer)> {
        self.forces.active().filter_map(|(potential, timer)| Some((potential.damped()?, timer)))
    }
}
