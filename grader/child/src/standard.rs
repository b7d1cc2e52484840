//! Standard loads of the functions that take closures: a chain of springs, solved by elimination in one sweep.

use nalgebra::{DVector, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use crate::wire::bytes;
use crate::{Exercise, Functions};

const LENGTH: usize = 120;
const DT: f64 = 0.01;
const MASS: f64 = 0.1;
const SPRING: f64 = 200.0;
/// Hardening of a spring, so that Newton's method needs more than one step.
const HARDENING: f64 = 2e4;

/// A call of a function on the chain, or of the integral on the unit tetrahedron; `None` if the function takes no closure.
pub fn load(functions: Functions, called: Exercise) -> Option<Box<dyn Fn() -> Vec<u8>>> {
    let V = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    let start: DVector<f64> = DVector::from_fn(LENGTH, |i, _| 0.05 * (i as f64).sin());
    let rest: DVector<f64> = DVector::zeros(LENGTH);
    let mass = tridiagonal(LENGTH, |_| 0.0, |_| MASS);
    Some(match called {
        Exercise::quadrature_single_point => Box::new(move || {
            let integrand = |X: &Vector3<f64>| DVector::from_element(1, X.x + 2.0 * X.y * X.z);
            bytes(&(functions.quadrature_single_point)(&V, &[0, 1, 2, 3], 1.0 / 6.0, &integrand))
        }),
        Exercise::linearly_implicit_euler => Box::new(move || {
            let (mut q, mut v) = (start.clone(), rest.clone());
            let (force, K) =
                (|q: &DVector<f64>, _: &DVector<f64>| force(q), |q: &DVector<f64>, _: &DVector<f64>| stiffness(q));
            (functions.linearly_implicit_euler)(&mut q, &mut v, DT, &mass, &force, &K, &sweep);
            bytes(&(q, v))
        }),
        Exercise::implicit_euler => Box::new(move || {
            let (mut q, mut v) = (start.clone(), rest.clone());
            let (force, K) =
                (|q: &DVector<f64>, _: &DVector<f64>| force(q), |q: &DVector<f64>, _: &DVector<f64>| stiffness(q));
            let energy = |v: &DVector<f64>| 0.5 * MASS * v.norm_squared() + energy(&(&start + v * DT));
            (functions.implicit_euler)(&mut q, &mut v, DT, &mass, &energy, &force, &K, &sweep);
            bytes(&(q, v))
        }),
        Exercise::newtons_method => Box::new(move || {
            let mut x = start.clone();
            let f = (functions.newtons_method)(&mut x, &energy, &|x| -force(x), &|x| stiffness(x) * -1.0, &sweep, 20);
            bytes(&(x, f))
        }),
        _ => return None,
    })
}

/// Stretch of each spring, m; the first one hangs from a wall.
fn stretches(q: &DVector<f64>) -> impl Iterator<Item = f64> + '_ {
    (0..q.len()).map(|i| if i == 0 { q[0] } else { q[i] - q[i - 1] })
}

fn energy(q: &DVector<f64>) -> f64 {
    stretches(q).map(|s| 0.5 * SPRING * s * s + 0.25 * HARDENING * s.powi(4)).sum()
}

fn force(q: &DVector<f64>) -> DVector<f64> {
    let mut f = DVector::zeros(q.len());
    for (i, s) in stretches(q).enumerate() {
        let tension = SPRING * s + HARDENING * s.powi(3);
        f[i] -= tension;
        if i > 0 {
            f[i - 1] += tension;
        }
    }
    f
}

fn stiffness(q: &DVector<f64>) -> CsrMatrix<f64> {
    let k: Vec<f64> = stretches(q).map(|s| SPRING + 3.0 * HARDENING * s * s).collect();
    let next = |i: usize| k.get(i + 1).copied().unwrap_or(0.0);
    tridiagonal(q.len(), next, |i| -k[i] - next(i))
}

/// A symmetric matrix: `beside(i)` couples i and i + 1.
fn tridiagonal(size: usize, beside: impl Fn(usize) -> f64, diagonal: impl Fn(usize) -> f64) -> CsrMatrix<f64> {
    let mut entries = CooMatrix::new(size, size);
    for i in 0..size {
        entries.push(i, i, diagonal(i));
        if i + 1 < size {
            entries.push(i, i + 1, beside(i));
            entries.push(i + 1, i, beside(i));
        }
    }
    CsrMatrix::from(&entries)
}

/// Solves a tridiagonal system. Entries of A outside the three diagonals are not read.
fn sweep(A: &CsrMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let entry = |i: usize, j: usize| A.get_entry(i, j).map_or(0.0, |entry| entry.into_value());
    let (n, mut x) = (b.len(), b.clone());
    let mut pivots = vec![0.0; n];
    for i in 0..n {
        pivots[i] = entry(i, i);
        if i > 0 {
            let factor = entry(i, i - 1) / pivots[i - 1];
            pivots[i] -= factor * entry(i - 1, i);
            x[i] -= factor * x[i - 1];
        }
    }
    for i in (0..n).rev() {
        if i + 1 < n {
            x[i] -= entry(i, i + 1) * x[i + 1];
        }
        x[i] /= pivots[i];
    }
    x
}
