//! Distance constraints: springs of XPBD, and edges of PBD.

use super::rule::{Rule, Sweep};
use crate::forces::HessianKind;
use crate::forces::springs::Spring;
use crate::integrators::relaxation::color_constraints;
use fem_elements::vector::{dot3, triple};
use fem_solvers::Real;

/// Distance constraints in the order of their colours, each with its multiplier.
pub(super) struct Distances<T> {
    springs: Vec<Spring<T>>,
    /// The force of a spring on its second node, N; or in the first entry a multiplier, m.
    multipliers: Vec<[T; 3]>,
}

impl<T: Real> Distances<T> {
    /// The constraints of these springs.
    pub fn new(nodes: usize, springs: &[Spring<T>]) -> Self {
        let ends: Vec<_> = springs.iter().map(|spring| spring.nodes).collect();
        let springs: Vec<_> =
            color_constraints(nodes, &ends).concat().into_iter().map(|number| springs[number as usize]).collect();
        Self { multipliers: vec![[T::default(); 3]; springs.len()], springs }
    }

    /// Sets the multipliers to zero: a step starts.
    pub fn begin_step(&mut self) {
        self.multipliers.fill([T::default(); 3]);
    }

    /// Corrects the nodes of all constraints.
    pub fn sweep(&mut self, sweep: Sweep, inverse_masses: &[[T; 3]], u: &mut [[T; 3]]) {
        for (spring, multiplier) in self.springs.iter().zip(&mut self.multipliers) {
            let [a, b] = spring.ends();
            let (of_a, of_b) = (inverse_masses[a], inverse_masses[b]);
            let both: [T; 3] = triple(|i| of_a[i] + of_b[i]);
            let change = match sweep.rule {
                Rule::Stress => by_force(spring, multiplier, both.map(|w| T::of(sweep.dt2) * w), u),
                Rule::Energy => by_length(spring, multiplier, both, T::of(sweep.dt2), u),
                Rule::Volume { stiffness } => by_stiffness(spring, both, T::of(stiffness), u),
            };
            let factor = if sweep.rule.has_force() { T::of(sweep.dt2) } else { T::one() };
            for i in 0..3 {
                u[a][i] += factor * of_a[i] * change[i];
                u[b][i] -= factor * of_b[i] * change[i];
            }
        }
    }
}

/// Computes the change z of the tensile force p, so that p + z is the spring's force after the change: with w the inverse masses
/// times Δt² of each coordinate, (1 + H W) z = f − p, written as (1 + √W H √W) y = √W (f − p), z = f − p − H √W y.
fn by_force<T: Real>(spring: &Spring<T>, force: &mut [T; 3], w: [T; 3], u: &[[T; 3]]) -> [T; 3] {
    let now = spring.now(u);
    if now.length == T::default() {
        return [T::default(); 3];
    }
    let tension = spring.stiffness * now.stretch / now.length;
    let H = spring.hessian(u, HessianKind::Projected);
    let root = w.map(|w| w.sqrt());
    let residual: [T; 3] = triple(|i| tension * now.d[i] - force[i]);
    let A =
        nalgebra::Matrix3::from_fn(|i, j| root[i] * H[i][j] * root[j] + if i == j { T::one() } else { T::default() });
    let right = nalgebra::Vector3::from_fn(|i, _| root[i] * residual[i]);
    let Some(factor) = A.cholesky() else { return [T::default(); 3] };
    let y = factor.solve(&right);
    let change: [T; 3] = triple(|i| residual[i] - (0..3).map(|j| H[i][j] * root[j] * y[j]).sum::<T>());
    *force = triple(|i| force[i] + change[i]);
    change
}

/// The change of k Δλ n with C = |d| − l, n = d/|d| and Δλ = −(C + λ)/(1 + k w Δt²): XPBD, algorithm 1, with λ k in place of λ.
fn by_length<T: Real>(spring: &Spring<T>, multiplier: &mut [T; 3], w: [T; 3], dt2: T, u: &[[T; 3]]) -> [T; 3] {
    let Some((n, stretch, along)) = direction(spring, w, u) else { return [T::default(); 3] };
    let change = -(stretch + multiplier[0]) / (T::one() + spring.stiffness * dt2 * along);
    multiplier[0] += change;
    n.map(|n| -(spring.stiffness * change * n))
}

/// The part `stiffness` of the correction that brings the length to that at rest: Müller et al. 2007, equation 10.
fn by_stiffness<T: Real>(spring: &Spring<T>, w: [T; 3], stiffness: T, u: &[[T; 3]]) -> [T; 3] {
    match direction(spring, w, u) {
        Some((n, stretch, along)) if along > T::default() => n.map(|n| stiffness * stretch / along * n),
        _ => [T::default(); 3],
    }
}

/// The unit vector of a spring, its stretch (m), and the sum of the inverse masses of its ends along it; `None` where both ends meet.
fn direction<T: Real>(spring: &Spring<T>, w: [T; 3], u: &[[T; 3]]) -> Option<([T; 3], T, T)> {
    let now = spring.now(u);
    if now.length == T::default() {
        return None;
    }
    let n = now.d.map(|d| d / now.length);
    let along = T::of(dot3(&n, &triple(|i| w[i] * n[i])));
    Some((n, now.stretch, along))
}
