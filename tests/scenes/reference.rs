//! A second, independent implementation of implicit Euler: dense matrices, derivatives by dual numbers and
//! finite differences, no projection, no line search. Slow, and only for bodies of a few elements.

use std::ops::{Add, Mul, Sub};

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

/// A number and its derivative in one direction.
#[derive(Clone, Copy)]
struct Dual {
    value: f64,
    slope: f64,
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

fn constant(value: f64) -> Dual {
    Dual { value, slope: 0.0 }
}

impl Dual {
    fn power(self, exponent: f64) -> Self {
        let value = self.value.powf(exponent);
        Self { value, slope: exponent * value / self.value * self.slope }
    }
}

/// A spring of zero rest length from a node to a fixed point.
pub struct AnchorSpring {
    pub node: usize,
    pub stiffness: f64,
    pub target: Vector3<f64>,
}

/// A body with its material, gravity and fixed nodes.
pub struct Model {
    pub V: Vec<Vector3<f64>>,
    pub T: Vec<[usize; 4]>,
    pub C: f64,
    pub D: f64,
    pub density: f64,
    pub gravity: Vector3<f64>,
    pub fixed: Vec<usize>,
}

/// Inverse of the edge matrix, and volume.
fn rest_shape(V: &[Vector3<f64>], [a, b, c, d]: [usize; 4]) -> (Matrix3<f64>, f64) {
    let edges = Matrix3::from_columns(&[V[b] - V[a], V[c] - V[a], V[d] - V[a]]);
    (edges.try_inverse().unwrap(), edges.determinant() / 6.0)
}

impl Model {
    /// ∫ C (J^(−2/3) I − 3) + D (J − 1)² over an element, times the dual numbers' rules.
    fn elastic(&self, x: &[Dual], element: [usize; 4]) -> Dual {
        let (inverse, volume) = rest_shape(&self.V, element);
        let mut F = [[constant(0.0); 3]; 3];
        for (i, row) in F.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                for k in 0..3 {
                    let edge = x[3 * element[k + 1] + i] - x[3 * element[0] + i];
                    *entry = *entry + edge * constant(inverse[(k, j)]);
                }
            }
        }
        let minor = |a: usize, b: usize| F[1][a] * F[2][b] - F[1][b] * F[2][a];
        let J = F[0][0] * minor(1, 2) - F[0][1] * minor(0, 2) + F[0][2] * minor(0, 1);
        let I = F.iter().flatten().fold(constant(0.0), |sum, &entry| sum + entry * entry);
        let shear = constant(self.C) * (J.power(-2.0 / 3.0) * I - constant(3.0));
        let change = J - constant(1.0);
        constant(volume) * (shear + constant(self.D) * change * change)
    }

    /// Elastic energy and springs; the weight is linear and comes in with the mass.
    fn potential(&self, x: &[Dual], springs: &[AnchorSpring]) -> Dual {
        let elastic = self.T.iter().fold(constant(0.0), |sum, &element| sum + self.elastic(x, element));
        springs.iter().fold(elastic, |sum, spring| {
            (0..3).fold(sum, |sum, i| {
                let stretch = x[3 * spring.node + i] - constant(spring.target[i]);
                sum + constant(0.5 * spring.stiffness) * stretch * stretch
            })
        })
    }

    /// ∂V/∂x, one direction after the other.
    fn gradient(&self, x: &DVector<f64>, springs: &[AnchorSpring]) -> DVector<f64> {
        let slope = |i: usize| {
            let seeded: Vec<_> =
                x.iter().enumerate().map(|(k, &value)| Dual { value, slope: f64::from(k == i) }).collect();
            self.potential(&seeded, springs).slope
        };
        DVector::from_fn(x.len(), |i, _| slope(i))
    }

    /// Consistent mass: ρ v/10 on the diagonal of an element, ρ v/20 beside it.
    fn mass(&self) -> DMatrix<f64> {
        let mut M = DMatrix::zeros(3 * self.V.len(), 3 * self.V.len());
        for &element in &self.T {
            let share = self.density * rest_shape(&self.V, element).1 / 20.0;
            for (a, b) in element.iter().flat_map(|&a| element.map(|b| (a, b))) {
                for i in 0..3 {
                    M[(3 * a + i, 3 * b + i)] += if a == b { 2.0 * share } else { share };
                }
            }
        }
        M
    }

    fn is_free(&self, coordinate: usize) -> bool {
        !self.fixed.contains(&(coordinate / 3))
    }

    /// The velocity at the end of a step of implicit Euler from (q, v), by Newton's method until the update is round-off.
    pub fn step(&self, q: &mut DVector<f64>, v: &mut DVector<f64>, dt: f64, springs: &[AnchorSpring]) {
        let M = self.mass();
        let weight = &M * DVector::from_fn(q.len(), |i, _| self.gravity[i % 3]);
        let residual = |u: &DVector<f64>| {
            let r = &M * (u - &*v) + (self.gradient(&(&*q + u * dt), springs) - &weight) * dt;
            DVector::from_fn(r.len(), |i, _| if self.is_free(i) { r[i] } else { u[i] })
        };
        let mut u = v.clone();
        for _ in 0..30 {
            let update = self.jacobian(&u, residual).lu().solve(&residual(&u)).unwrap();
            u -= &update;
            if update.amax() <= 1e-13 * (1.0 + u.amax()) {
                q.axpy(dt, &u, 1.0);
                *v = u;
                return;
            }
        }
        panic!("the reference has not converged");
    }

    /// By central differences; an error in it costs iterations, not accuracy.
    fn jacobian(&self, u: &DVector<f64>, residual: impl Fn(&DVector<f64>) -> DVector<f64>) -> DMatrix<f64> {
        let h = 1e-5;
        let column = |i: usize| {
            let step = DVector::from_fn(u.len(), |k, _| if k == i { h } else { 0.0 });
            (residual(&(u + &step)) - residual(&(u - &step))) / (2.0 * h)
        };
        DMatrix::from_columns(&(0..u.len()).map(column).collect::<Vec<_>>())
    }
}
