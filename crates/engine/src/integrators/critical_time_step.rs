//! The critical time step of explicit methods, from the fastest vibration of the undeformed body.

use fem_model::{Integrator as IntegratorKind, NewmarkParameters};
use nalgebra::Complex;

use super::MassInverse;
use crate::forces::Moment;
use crate::model::damping::DampingRates;
use crate::model::system::System;
use fem_elements::vector::dot;
use fem_solvers::Real;
use fem_solvers::lanczos::{irregular, largest_eigenvalue};

/// Relative change of an eigenvalue at which Lanczos's method ends, and its largest number of iterations.
const ACCURACY: (f64, usize) = (1e-5, 96);

/// The longest stable time step of a method for small vibrations about the undeformed body, s; a lower bound of it where dampers
/// of springs are not in proportion to the stiffness. Zero for a method that is unstable at any time step, `None` for a method that is stable at
/// any, which most implicit ones are, and for bodies without stiffness.
pub fn critical_time_step<T: Real>(
    kind: IntegratorKind,
    newmark: NewmarkParameters,
    system: &System<T>,
) -> Option<f64> {
    let is_conditional = kind == IntegratorKind::Newmark && !newmark.is_unconditionally_stable();
    if !kind.is_explicit() && !is_conditional {
        return None;
    }
    let omega = largest_frequency(system)?;
    let ratio = damping_ratio(system, omega);
    let limit = match kind {
        // Central differences with the damping force of the step before: Belytschko, Liu, Moran, Nonlinear Finite Elements for
        // Continua and Structures (2000), §6.2.
        IntegratorKind::SemiImplicitEuler => 2.0 * ((1.0 + ratio * ratio).sqrt() - ratio),
        // With the damping force of a predicted velocity, the amplification factor −1 is at z² + 8 ξ z = 4, z = ω dt.
        IntegratorKind::Verlet => 2.0 * ((1.0 + 4.0 * ratio * ratio).sqrt() - 2.0 * ratio),
        IntegratorKind::ExplicitEuler => limit_of_taylor_method(1, ratio),
        IntegratorKind::Rk2 => limit_of_taylor_method(2, ratio),
        IntegratorKind::Rk4 => limit_of_taylor_method(4, ratio),
        IntegratorKind::Newmark => limit_of_newmark(newmark, ratio),
        _ => return None,
    };
    Some(limit / omega)
}

/// The largest stable ω dt of Newmark's method with 2β < γ for a vibration with damping ratio ξ: Hughes, The Finite Element Method (1987),
/// equation 9.1.13.
fn limit_of_newmark(NewmarkParameters { beta, gamma }: NewmarkParameters, ratio: f64) -> f64 {
    let (damping, short) = (ratio * (gamma - 0.5), 0.5 * gamma - beta);
    (damping + (short + damping * damping).sqrt()) / short
}

/// The largest stable ω dt for a vibration with damping ratio ξ of a method whose amplification factor is the Taylor polynomial of
/// e^z of so high a degree, z = ω dt (−ξ ± √(ξ² − 1)); zero if there is none.
fn limit_of_taylor_method(degree: u32, ratio: f64) -> f64 {
    if ratio == 0.0 && degree <= 2 {
        return 0.0;
    }
    let root = Complex::new(ratio * ratio - 1.0, 0.0).sqrt();
    let is_stable = |limit: f64| {
        [root, -root].into_iter().all(|root| {
            let z = (root - ratio) * limit;
            // Horner's rule: 1 + z (1 + z/2 (1 + z/3 (…))).
            let amplification = (1..=degree).rev().fold(Complex::new(1.0, 0.0), |sum, k| sum * z / f64::from(k) + 1.0);
            amplification.norm() <= 1.0
        })
    };
    // Every such region of stability lies within |z| < 4.
    let (mut stable, mut unstable) = (0.0, 4.0);
    for _ in 0..40 {
        let middle = 0.5 * (stable + unstable);
        if is_stable(middle) { stable = middle } else { unstable = middle }
    }
    stable
}

/// Part of the critical damping of the fastest vibration, ξ = (α/ω + β ω)/2, and with dampers of springs an upper bound of it.
fn damping_ratio<T: Real>(system: &System<T>, omega: f64) -> f64 {
    let (alpha, mut beta) = system.damping.map_or((0.0, 0.0), |damping| (damping.alpha, damping.beta));
    let mut rates = DampingRates { mass: T::zero(), stiffness: T::zero(), forces: T::one() };
    if system.has_dampers() && system.has_viscosity() {
        // The springs' part of β is one of their dampers.
        rates.stiffness = T::of(std::mem::take(&mut beta));
    }
    0.5 * (alpha / omega + beta * omega) + 0.5 * fastest_damper(system, rates) / omega
}

/// The largest angular frequency of the undeformed body, 1/s; `None` where it has no stiffness.
fn largest_frequency<T: Real>(system: &System<T>) -> Option<f64> {
    let square = largest_ratio(system, |undeformed, x, product| {
        system.add_stiffness_times(T::one(), undeformed, x, product);
        system.add_external_hessian_times(undeformed, Moment::at(0.0), x, product);
    });
    square.map(f64::sqrt)
}

/// The largest xᵀ D x / xᵀ M x of the undeformed body with dampers, 1/s: twice the product ξ ω of a vibration is at most that.
fn fastest_damper<T: Real>(system: &System<T>, rates: DampingRates<T>) -> f64 {
    if !system.has_dampers() {
        return 0.0;
    }
    let rate = largest_ratio(system, |undeformed, x, product| {
        system.add_damping_times(rates, undeformed, x, product);
    });
    rate.unwrap_or(0.0)
}

/// The largest eigenvalue of M⁻¹ A, for a symmetric A whose product with a vector `add_times` adds at the undeformed body. `None` where A is zero.
fn largest_ratio<T: Real>(system: &System<T>, add_times: impl Fn(&[[T; 3]], &[[T; 3]], &mut [[T; 3]])) -> Option<f64> {
    let zero = || vec![[T::default(); 3]; system.nodes()];
    let (undeformed, mut force, mut mass_times) = (zero(), zero(), zero());
    let mut inverse = MassInverse::new(&system.mass);
    let mut apply = |x: &[[T; 3]], product: &mut [[T; 3]]| {
        force.fill([T::default(); 3]);
        add_times(&undeformed, x, &mut force);
        let square = dot(x, &force);
        inverse.solve(system, &mut force, product).ok().map(|()| square)
    };
    let mut mass_norm = |x: &[[T; 3]]| {
        mass_times.fill([T::default(); 3]);
        system.add_mass_times(T::one(), x, &mut mass_times);
        dot(x, &mass_times).sqrt()
    };
    let mut start = irregular(system.nodes());
    system.dirichlet.clear_constrained(&mut start);
    let square = largest_eigenvalue(start, ACCURACY, &mut apply, &mut mass_norm)?;
    // NaN and zero fail the comparison: all nodes are constrained, or the stiffness is zero.
    (square > 0.0 && square.is_finite()).then_some(square)
}
