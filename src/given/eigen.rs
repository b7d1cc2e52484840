//! Negative eigenvalues of small symmetric matrices, with their eigenvectors.
//!
//! The general method (Householder's tridiagonal form, then the QL method: B. Parlett, The Symmetric Eigenvalue Problem,
//! SIAM 1998, chapters 7 and 8), reduced to the needs of a projection: arrays on the stack, no ordering, and eigenvectors of
//! negative eigenvalues only. It is several times faster than a general routine, and a simulation calls it for every
//! element of every Newton step.

/// Calls `visit(λ, v)` for every eigenvalue λ < −`tolerance` · ‖A‖ with its eigenvector of length one.
///
/// `rows  (N×N)` symmetric, of which the lower triangle is read. Visits no eigenvalue of a matrix that is not finite.
pub(super) fn visit_negative<const N: usize>(
    rows: &[[f64; N]; N],
    tolerance: f64,
    mut visit: impl FnMut(f64, &[f64; N]),
) {
    let mut tridiagonal = Tridiagonal::new(rows);
    let threshold = -tolerance * tridiagonal.norm();
    let wanted = tridiagonal.eigenvalues_below(threshold);
    if wanted == 0 {
        return;
    }
    let mut vectors = identity();
    let found = tridiagonal.diagonalize(&mut vectors, threshold, wanted);
    for (&eigenvalue, vector) in tridiagonal.diagonal[..found].iter().zip(&mut vectors) {
        if eigenvalue < threshold {
            tridiagonal.transform_back(vector);
            visit(eigenvalue, vector);
        }
    }
}

/// `Qᵀ A Q = T`, T tridiagonal and Q a product of reflections.
struct Tridiagonal<const N: usize> {
    diagonal: [f64; N],
    /// `off_diagonal[i]` couples i and i + 1; the last one is not used.
    off_diagonal: [f64; N],
    /// `reflectors[k]` is the normal u of the reflection `1 − u uᵀ`, |u|² = 2, or zero where none was needed.
    reflectors: [[f64; N]; N],
}

impl<const N: usize> Tridiagonal<N> {
    fn new(lower: &[[f64; N]; N]) -> Self {
        let mut rows = *lower;
        for i in 0..N {
            for j in i + 1..N {
                rows[i][j] = lower[j][i];
            }
        }
        let mut reflectors = [[0.0; N]; N];
        for k in 0..N.saturating_sub(2) {
            reflectors[k] = reflector(&rows[k], k + 1);
            reflect(&mut rows, &reflectors[k], k);
        }
        let mut tridiagonal = Self { diagonal: [0.0; N], off_diagonal: [0.0; N], reflectors };
        for i in 0..N {
            tridiagonal.diagonal[i] = rows[i][i];
            tridiagonal.off_diagonal[i] = if i + 1 < N { rows[i][i + 1] } else { 0.0 };
        }
        tridiagonal
    }

    /// Largest row sum of absolute values, a bound of all eigenvalues.
    fn norm(&self) -> f64 {
        let before = |i: usize| if i == 0 { 0.0 } else { self.off_diagonal[i - 1].abs() };
        let row_sum = |i: usize| before(i) + self.diagonal[i].abs() + self.off_diagonal[i].abs();
        (0..N).map(row_sum).fold(0.0, f64::max)
    }

    /// Sturm's count: the pivots of `T − x` have as many signs below zero as T has eigenvalues below x.
    #[inline]
    fn eigenvalues_below(&self, x: f64) -> usize {
        let mut count = 0;
        let mut pivot = 1.0;
        for i in 0..N {
            let e = if i == 0 { 0.0 } else { self.off_diagonal[i - 1] };
            pivot = self.diagonal[i] - x - e * e / pivot;
            if pivot == 0.0 {
                pivot = f64::MIN_POSITIVE;
            }
            count += usize::from(pivot < 0.0);
        }
        count
    }

    /// Turns the beginning of T into eigenvalues, and the rows of `vectors` into their eigenvectors, by QL steps with
    /// implicit shifts, until `wanted` eigenvalues below `threshold` are found. Returns the number of all eigenvalues found:
    /// 0 if it does not converge, which happens only if T is not finite.
    fn diagonalize(&mut self, vectors: &mut [[f64; N]; N], threshold: f64, mut wanted: usize) -> usize {
        const MAX_STEPS: usize = 60;
        for first in 0..N {
            for step in 0.. {
                let last = self.end_of_block(first);
                if last == first {
                    break;
                }
                if step == MAX_STEPS {
                    return 0;
                }
                // Eigenvalues come out roughly in the order of their distance from the first shift, and those that are
                // wanted are small.
                let shift = if step == 0 && first == 0 { 0.0 } else { self.shift(first) };
                self.ql_step(first, last, shift, vectors);
            }
            wanted -= usize::from(self.diagonal[first] < threshold);
            if wanted == 0 {
                return first + 1;
            }
        }
        N
    }

    /// The last index that negligible off-diagonal entries do not cut off from `first`.
    #[inline]
    fn end_of_block(&self, first: usize) -> usize {
        let is_cut = |&i: &usize| {
            let size = self.diagonal[i].abs() + self.diagonal[i + 1].abs();
            self.off_diagonal[i].abs() <= f64::EPSILON * size
        };
        (first..N - 1).find(is_cut).unwrap_or(N - 1)
    }

    /// Wilkinson's shift: the eigenvalue of the first two rows that is nearer to the first entry.
    #[inline]
    fn shift(&self, first: usize) -> f64 {
        let (d, e) = (&self.diagonal, &self.off_diagonal);
        let half_gap = (d[first + 1] - d[first]) / (2.0 * e[first]);
        d[first] - e[first] / (half_gap + (half_gap * half_gap + 1.0).sqrt().copysign(half_gap))
    }

    /// One QL step on the block `first..=last`: a chase of plane rotations from its end to its start.
    #[inline]
    fn ql_step(&mut self, first: usize, last: usize, shift: f64, vectors: &mut [[f64; N]; N]) {
        let (d, e) = (&mut self.diagonal, &mut self.off_diagonal);
        let (mut g, mut sine, mut cosine, mut correction) = (d[last] - shift, 1.0, 1.0, 0.0);
        for i in (first..last).rev() {
            let (f, b) = (sine * e[i], cosine * e[i]);
            let r = (f * f + g * g).sqrt();
            e[i + 1] = r;
            if r == 0.0 {
                // The block has fallen apart on the way; the next step starts with the upper piece.
                d[i + 1] -= correction;
                e[last] = 0.0;
                return;
            }
            (sine, cosine) = (f / r, g / r);
            g = d[i + 1] - correction;
            let t = (d[i] - g) * sine + 2.0 * cosine * b;
            correction = sine * t;
            d[i + 1] = g + correction;
            g = cosine * t - b;
            rotate(vectors, i, sine, cosine);
        }
        d[first] -= correction;
        e[first] = g;
        e[last] = 0.0;
    }

    /// Transforms an eigenvector of T into one of A.
    #[inline]
    fn transform_back(&self, vector: &mut [f64; N]) {
        for u in self.reflectors[..N.saturating_sub(2)].iter().rev() {
            let along = dot(u, vector);
            for i in 0..N {
                vector[i] -= along * u[i];
            }
        }
    }
}

#[inline]
fn identity<const N: usize>() -> [[f64; N]; N] {
    let mut rows = [[0.0; N]; N];
    for (i, row) in rows.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    rows
}

#[inline]
fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    let mut sum = 0.0;
    for i in 0..N {
        sum += a[i] * b[i];
    }
    sum
}

/// Normal of the reflection that turns the entries of `row` from `start` on into one entry at `start`.
fn reflector<const N: usize>(row: &[f64; N], start: usize) -> [f64; N] {
    let mut u = [0.0; N];
    u[start..].copy_from_slice(&row[start..]);
    let scale = u.iter().fold(0.0, |scale: f64, entry| scale.max(entry.abs()));
    if scale < f64::MIN_POSITIVE {
        return [0.0; N];
    }
    let inverse = 1.0 / scale;
    for entry in &mut u {
        *entry *= inverse;
    }
    let norm = dot(&u, &u).sqrt();
    u[start] += norm.copysign(u[start]);
    // |u|² = 2 norm |u[start]| by now.
    let factor = 1.0 / (norm * u[start].abs()).sqrt();
    u.map(|entry| entry * factor)
}

/// `(1 − u uᵀ) A (1 − u uᵀ)`; rows before `first` are tridiagonal already and stay.
#[inline]
fn reflect<const N: usize>(rows: &mut [[f64; N]; N], u: &[f64; N], first: usize) {
    // A is symmetric, so A u is a sum of its rows, which needs no sum across a vector.
    let mut p = [0.0; N];
    for i in first + 1..N {
        for j in 0..N {
            p[j] += u[i] * rows[i][j];
        }
    }
    let half = 0.5 * dot(&p, u);
    for i in 0..N {
        p[i] -= half * u[i];
    }
    for i in first..N {
        let (p_i, u_i) = (p[i], u[i]);
        for j in 0..N {
            rows[i][j] -= p_i * u[j] + u_i * p[j];
        }
    }
}

/// Rotates rows i and i + 1 into each other.
#[inline]
fn rotate<const N: usize>(rows: &mut [[f64; N]; N], i: usize, sine: f64, cosine: f64) {
    let (upper, lower) = rows.split_at_mut(i + 1);
    for (a, b) in upper[i].iter_mut().zip(&mut lower[0]) {
        (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
    }
}
