//! Problems for the functions that take closures: bodies for the integrators, functions to minimise for Newton's method.

use grader_child::algebra::by_elimination;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use nalgebra_sparse::CsrMatrix;

/// Point masses on springs.
#[derive(Clone, Debug)]
pub struct System {
    /// kg
    pub mass: DMatrix<f64>,
    /// N/m; the linear part of the springs.
    pub springs: DMatrix<f64>,
    /// N/m³; the tension grows with the cube of each coordinate.
    pub hardening: f64,
    /// N, everywhere the same.
    pub load: DVector<f64>,
    /// N s/m; against the velocity.
    pub damping: f64,
    /// J; a wall at zero that the first coordinate never reaches. 0 means none.
    pub wall: f64,
    /// Factor of the force: 1, or another number to imitate a mistake.
    pub force_factor: f64,
    /// The same for the stiffness.
    pub stiffness_factor: f64,
}

impl System {
    /// Force at (q, v), N.
    pub fn force(&self, q: &DVector<f64>, v: &DVector<f64>) -> DVector<f64> {
        // A submission may pass vectors of any length.
        if q.len() != self.load.len() || v.len() != self.load.len() {
            return DVector::from_element(self.load.len(), f64::NAN);
        }
        let mut f = &self.load - &self.springs * q - q.map(|x| self.hardening * x.powi(3)) - v * self.damping;
        if self.wall > 0.0 {
            f[0] += self.wall / q[0];
        }
        f * self.force_factor
    }

    /// Its derivative with respect to q, N/m.
    pub fn stiffness(&self, q: &DVector<f64>) -> CsrMatrix<f64> {
        if q.len() != self.load.len() {
            return CsrMatrix::from(&DMatrix::from_element(self.load.len(), self.load.len(), f64::NAN));
        }
        let mut K = -&self.springs - DMatrix::from_diagonal(&q.map(|x| 3.0 * self.hardening * x * x));
        if self.wall > 0.0 {
            K[(0, 0)] -= self.wall / (q[0] * q[0]);
        }
        CsrMatrix::from(&(K * self.stiffness_factor))
    }

    /// Potential energy, J.
    pub fn potential(&self, q: &DVector<f64>) -> f64 {
        if q.len() != self.load.len() {
            return f64::NAN;
        }
        let springs = 0.5 * q.dot(&(&self.springs * q)) + 0.25 * self.hardening * q.map(|x| x.powi(4)).sum();
        let wall = match self.wall {
            0.0 => 0.0,
            _ if q[0] <= 0.0 => return f64::INFINITY,
            strength => -strength * q[0].ln(),
        };
        springs - self.load.dot(q) + wall
    }
}

/// A function to minimise.
#[derive(Clone, Debug)]
pub enum Objective {
    /// ½ (x − bottom)ᵀ H (x − bottom)
    Quadratic { H: DMatrix<f64>, bottom: DVector<f64> },
    /// sqrt(1 + x²): from afar a full step goes too far.
    Overshooting,
    /// x − ln x for x > 0, the given value elsewhere.
    Barrier { outside: f64 },
    /// ½ |x|² with a Hessian of the wrong sign: every direction points uphill.
    Uphill,
    /// ½ x² with twice its Hessian: each direction goes half the way.
    Halving,
}

impl Objective {
    /// Number of variables.
    fn size(&self) -> usize {
        match self {
            Self::Quadratic { bottom, .. } => bottom.len(),
            Self::Uphill => 2,
            Self::Overshooting | Self::Barrier { .. } | Self::Halving => 1,
        }
    }

    /// Value.
    pub fn value(&self, x: &DVector<f64>) -> f64 {
        // A submission may pass vectors of any length.
        if x.len() != self.size() {
            return f64::NAN;
        }
        match self {
            Self::Quadratic { H, bottom } => 0.5 * (x - bottom).dot(&(H * (x - bottom))),
            Self::Overshooting => (1.0 + x[0] * x[0]).sqrt(),
            Self::Barrier { outside } if x[0].is_nan() || x[0] <= 0.0 => *outside,
            Self::Barrier { .. } => x[0] - x[0].ln(),
            Self::Uphill | Self::Halving => 0.5 * x.norm_squared(),
        }
    }

    /// Gradient.
    pub fn gradient(&self, x: &DVector<f64>) -> DVector<f64> {
        if x.len() != self.size() {
            return DVector::from_element(self.size(), f64::NAN);
        }
        match self {
            Self::Quadratic { H, bottom } => H * (x - bottom),
            Self::Overshooting => dvector![x[0] / (1.0 + x[0] * x[0]).sqrt()],
            Self::Barrier { .. } => dvector![1.0 - 1.0 / x[0]],
            Self::Uphill | Self::Halving => x.clone(),
        }
    }

    /// Hessian.
    pub fn hessian(&self, x: &DVector<f64>) -> CsrMatrix<f64> {
        if x.len() != self.size() {
            return CsrMatrix::from(&DMatrix::from_element(self.size(), self.size(), f64::NAN));
        }
        let H = match self {
            Self::Quadratic { H, .. } => H.clone(),
            Self::Overshooting => dmatrix![(1.0 + x[0] * x[0]).powf(-1.5)],
            Self::Barrier { .. } => dmatrix![1.0 / (x[0] * x[0])],
            Self::Uphill => DMatrix::identity(x.len(), x.len()) * -1.0,
            Self::Halving => DMatrix::identity(x.len(), x.len()) * 2.0,
        };
        CsrMatrix::from(&H)
    }
}

/// Unknowns of the largest system that any right answer needs, and some.
const LARGEST: usize = 50;

/// Gaussian elimination with pivots; NaN where the matrix is singular, does not fit or is too large to be right.
pub fn solve(A: &CsrMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let nothing = || DVector::from_element(b.len(), f64::NAN);
    if A.nrows() != b.len() || A.ncols() != b.len() || b.len() > LARGEST {
        return nothing();
    }
    by_elimination(A, b).unwrap_or_else(nothing)
}
