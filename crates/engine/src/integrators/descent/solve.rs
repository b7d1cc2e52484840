//! Newton's step of each node of a batch.

use nalgebra::{Matrix3, Vector3};
use pulp::{Simd, WithSimd};

use super::sums::{Sums, UPPER};
use fem_elements::number::Float;
use fem_elements::number::{Lanes, Number, constant};
use fem_elements::tensor::{inverse, symmetric_eigen};

/// Smallest pivot of a block that is solved as it is, as a part of its diagonal entry.
const SMALLEST_PIVOT: f64 = 1e-5;

/// Change of the strain of the elements up to which a step needs no line search.
const SHORT: f64 = 0.1;

/// Steps of the nodes of a batch.
#[derive(Clone, Copy)]
pub(super) struct Steps<L> {
    /// m
    pub step: [L; 3],
    /// True in lanes whose step needs a line search on the energy.
    pub is_doubtful: bool,
}

/// Inertia of the nodes of batches.
#[derive(Clone, Copy)]
pub(super) struct Inertia<'a, T: Float> {
    /// Masses of each batch, kg; zero in constrained directions.
    pub masses: &'a [[T::Lanes; 3]],
    /// 1/Δt², 1/s².
    pub over_dt2: f64,
    /// Displacements that inertia and dead loads alone would give, m.
    pub inertial: &'a [[T; 3]],
}

/// Adds inertia to the sums of batches of one colour, and finds the steps of their nodes.
pub(super) struct StepsOf<'a, L: Lanes> {
    pub inertia: Inertia<'a, L::Element>,
    pub lanes: &'a [u32],
    pub u: &'a [[L::Element; 3]],
    pub sums: &'a mut [Sums<<L::Element as Float>::Lanes>],
    pub steps: &'a mut [Steps<<L::Element as Float>::Lanes>],
}

impl<L: Lanes> WithSimd for StepsOf<'_, L> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { inertia: Inertia { masses, over_dt2, inertial }, lanes, u, sums, steps } = self;
        let (one, over_dt2) = (L::one(), constant::<L>(over_dt2));
        steps.iter_mut().for_each(|steps| steps.is_doubtful = false);
        for (i, lanes) in lanes.chunks_exact(L::LANES).enumerate() {
            let (batch, part) = (i / L::PARTS, i % L::PARTS);
            let (stored, steps, masses) = (&mut sums[batch], &mut steps[batch], &masses[batch]);
            let mut sums = Sums::<L>::load(stored, part);
            let mut weights = [one; 3];
            for i in 0..3 {
                weights[i] = over_dt2 * one.load(&masses[i], part);
                let mut moved = L::zero();
                for (lane, &node) in lanes.iter().enumerate() {
                    moved.as_mut_slice()[lane] = u[node as usize][i] - inertial[node as usize][i];
                }
                sums.gradient[i] = weights[i].times_plus(moved, sums.gradient[i]);
                sums.block[i] += weights[i];
            }
            constrain(&weights, &mut sums);
            let (mut step, is_definite) = solved(&sums);
            steps.is_doubtful |= !is_definite;
            if !is_definite {
                make_definite(&weights, &mut sums);
                step = solved(&sums).0;
            }
            let length2 = step[2].times_plus(step[2], step[1].times_plus(step[1], step[0] * step[0]));
            steps.is_doubtful |= !L::all((length2 * sums.sharpness).le(constant(SHORT * SHORT)));
            sums.store(stored, part);
            for i in 0..3 {
                step[i].store(&mut steps.step[i], part);
            }
        }
    }
}

/// Replaces rows and columns of constrained directions, which have no weight, by those of the identity.
#[inline(always)]
fn constrain<L: Lanes>(weights: &[L; 3], sums: &mut Sums<L>) {
    let zero = L::zero();
    let free = [weights[0].gt(zero), weights[1].gt(zero), weights[2].gt(zero)];
    for i in 0..3 {
        sums.gradient[i] = sums.gradient[i].select(free[i], zero);
    }
    for (entry, (i, k)) in UPPER.into_iter().enumerate() {
        let otherwise = if i == k { L::one() } else { zero };
        sums.block[entry] = sums.block[entry].select(free[i] & free[k], otherwise);
    }
}

/// −A⁻¹ g by A = L D Lᵀ, and whether A is definite enough in every lane.
#[inline(always)]
fn solved<L: Lanes>(sums: &Sums<L>) -> ([L; 3], bool) {
    let ([a, d, f, b, c, e], g) = (sums.block, sums.gradient);
    let least = constant::<L>(SMALLEST_PIVOT);
    let over_a = L::one() / a;
    let (of_b, of_c) = (b * over_a, c * over_a);
    let second = d - of_b * b;
    let coupling = e - of_b * c;
    let over_second = L::one() / second;
    let of_coupling = coupling * over_second;
    let third = f - of_c * c - of_coupling * coupling;
    let is_definite = a.gt(L::zero()) & second.gt(least * d.abs()) & third.gt(least * f.abs());
    let y1 = g[1] - of_b * g[0];
    let y2 = g[2] - of_c * g[0] - of_coupling * y1;
    let z = y2 / third;
    let y = y1 * over_second - of_coupling * z;
    let x = g[0] * over_a - of_b * y - of_c * z;
    ([-x, -y, -z], L::all(is_definite))
}

/// Replaces the eigenvalues of blocks that are not definite by their magnitudes, and by the inertia of the node where that is larger.
#[inline(never)] // rare
fn make_definite<L: Lanes>(weights: &[L; 3], sums: &mut Sums<L>) {
    for lane in 0..L::LANES {
        let entry = |k: usize| sums.block[k].lane(lane).as_f64();
        let [a, d, f, b, c, e] = [0, 1, 2, 3, 4, 5].map(entry);
        let A = Matrix3::new(a, b, c, b, d, e, c, e, f);
        // NaN if the displacements are not finite: the check of the state ends the step.
        if !A.iter().all(|entry| entry.is_finite()) {
            continue;
        }
        let weights = Vector3::from([0, 1, 2].map(|i| weights[i].lane(lane).as_f64()));
        let eigen = symmetric_eigen(A);
        let largest = eigen.eigenvalues.amax();
        if eigen.eigenvalues.min() > 10.0 * SMALLEST_PIVOT * largest {
            continue;
        }
        let least = f64::max(weights.max(), 20.0 * SMALLEST_PIVOT * largest);
        let values = eigen.eigenvalues.map(|value| value.abs().max(least));
        let A = eigen.eigenvectors * Matrix3::from_diagonal(&values) * eigen.eigenvectors.transpose();
        for (k, (i, j)) in UPPER.into_iter().enumerate() {
            sums.block[k].set_lane(lane, <L::Element as Float>::of(A[(i, j)]));
        }
    }
}

/// The inverse of a node's block in its free directions, m/N; zero in constrained ones.
pub(super) fn inverse_block<T: Float>(sums: &Sums<T::Lanes>, masses: &[T::Lanes; 3], lane: usize) -> Matrix3<f64> {
    let [a, d, f, b, c, e] = sums.block.map(|entry| entry.lane(lane).as_f64());
    let free = masses.map(|mass| if mass.lane(lane) > T::default() { 1.0 } else { 0.0 });
    let inverse = inverse(&Matrix3::new(a, b, c, b, d, e, c, e, f));
    Matrix3::from_fn(|i, j| inverse[(i, j)] * free[i] * free[j])
}
