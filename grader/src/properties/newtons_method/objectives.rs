//! Functions to minimise, with a record of their evaluations by Newton's method.

use std::cell::{Cell, RefCell};

use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use nalgebra_sparse::CsrMatrix;

use super::super::Course;
use super::super::bodies::{by_elimination, sparse};
use super::super::outcome::{Mistake, holds, long};

const MOST_KEPT: usize = 10_000;

type Number = Box<dyn Fn(&DVector<f64>) -> f64>;
type Vector = Box<dyn Fn(&DVector<f64>) -> DVector<f64>>;
type Matrix = Box<dyn Fn(&DVector<f64>) -> DMatrix<f64>>;

pub struct Objective {
    pub f: Number,
    pub g: Vector,
    pub H: Matrix,
}

/// The calls of the closures in order.
#[derive(Clone, Debug)]
pub enum Asked {
    Value(DVector<f64>),
    Hessian,
    /// The solution.
    Solve(DVector<f64>),
}

pub struct NewtonRun {
    pub x: DVector<f64>,
    pub f: f64,
    pub asked: Vec<Asked>,
}

impl NewtonRun {
    pub fn hessians(&self) -> usize {
        self.asked.iter().filter(|asked| matches!(asked, Asked::Hessian)).count()
    }

    pub fn directions(&self) -> Vec<&DVector<f64>> {
        let solves = self.asked.iter();
        solves.filter_map(|asked| if let Asked::Solve(d) = asked { Some(d) } else { None }).collect()
    }

    /// The points at which f was evaluated after each direction.
    pub fn trials(&self) -> Vec<Vec<&DVector<f64>>> {
        let mut trials = Vec::new();
        for asked in &self.asked {
            match asked {
                Asked::Solve(..) => trials.push(Vec::new()),
                Asked::Value(x) => trials.iter_mut().next_back().into_iter().for_each(|list| list.push(x)),
                Asked::Hessian => {}
            }
        }
        trials
    }
}

impl Objective {
    pub fn new(
        f: impl Fn(&DVector<f64>) -> f64 + 'static,
        g: impl Fn(&DVector<f64>) -> DVector<f64> + 'static,
        H: impl Fn(&DVector<f64>) -> DMatrix<f64> + 'static,
    ) -> Self {
        Self { f: Box::new(f), g: Box::new(g), H: Box::new(H) }
    }

    /// ½ (x − bottom)ᵀ H (x − bottom).
    pub fn quadratic(H: DMatrix<f64>, bottom: DVector<f64>) -> Self {
        let (H_of_f, H_of_g, bottom_of_f) = (H.clone(), H.clone(), bottom.clone());
        let f = move |x: &DVector<f64>| 0.5 * (x - &bottom_of_f).dot(&(&H_of_f * (x - &bottom_of_f)));
        Self::new(f, move |x| &H_of_g * (x - &bottom), move |_| H.clone())
    }

    /// Runs Newton's method from `start`. Evaluations are recorded up to a number far above that of any check.
    pub fn minimise(&self, course: &Course, start: &[f64], max_steps: usize) -> Result<NewtonRun, Mistake> {
        let (n, asked, misfits) = (start.len(), RefCell::new(Vec::new()), Cell::new(0));
        let note = |what| {
            let mut asked = asked.borrow_mut();
            if asked.len() < MOST_KEPT {
                asked.push(what);
            }
        };
        let fits = |fits: bool| {
            misfits.set(misfits.get() + usize::from(!fits));
            fits
        };
        let value = |x: &DVector<f64>| {
            if !fits(x.len() == n) {
                return f64::NAN;
            }
            note(Asked::Value(x.clone()));
            (self.f)(x)
        };
        let gradient =
            |x: &DVector<f64>| if fits(x.len() == n) { (self.g)(x) } else { DVector::from_element(n, f64::NAN) };
        let hessian = |x: &DVector<f64>| {
            note(Asked::Hessian);
            if fits(x.len() == n) { sparse(&(self.H)(x)) } else { CsrMatrix::zeros(n, n) }
        };
        let solve = |A: &CsrMatrix<f64>, b: &DVector<f64>| {
            let d = by_elimination(A, b);
            if fits((A.nrows(), A.ncols(), b.len()) == (n, n, n)) {
                note(Asked::Solve(d.clone()));
            }
            d
        };
        let mut x = DVector::from_column_slice(start);
        let f = course.subject.newtons_method(&mut x, &value, &gradient, &hessian, &solve, max_steps)?;
        holds("f, g, H and solve are called with vectors as long as x0", misfits.get() == 0)?;
        Ok(NewtonRun { x: long(n, x)?, f, asked: asked.take() })
    }
}

/// ½ |x|² + 3.
pub fn bowl() -> Objective {
    Objective::new(|x| 0.5 * x.norm_squared() + 3.0, |x| x.clone(), |x| DMatrix::identity(x.len(), x.len()))
}

/// (1 − x)² + 100 (y − x²)².
pub fn rosenbrock() -> Objective {
    Objective::new(
        |x| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2),
        |x| {
            let off_valley = x[1] - x[0] * x[0];
            dvector![-2.0 * (1.0 - x[0]) - 400.0 * x[0] * off_valley, 200.0 * off_valley]
        },
        // The term −400 (y − x²) is left out where it would make the matrix indefinite.
        |x| {
            let curved = 2.0 + 800.0 * x[0] * x[0] - 400.0 * (x[1] - x[0] * x[0]).min(0.0);
            dmatrix![curved, -400.0 * x[0]; -400.0 * x[0], 200.0]
        },
    )
}

/// sqrt(1 + x²).
pub fn overshooting() -> Objective {
    Objective::new(
        |x| (1.0 + x[0] * x[0]).sqrt(),
        |x| dvector![x[0] / (1.0 + x[0] * x[0]).sqrt()],
        |x| dmatrix![(1.0 + x[0] * x[0]).powf(-1.5)],
    )
}

/// x − ln x for x > 0, with its minimum at 1; `outside` elsewhere.
pub fn log_barrier(outside: f64) -> Objective {
    Objective::new(
        move |x| if x[0] > 0.0 { x[0] - x[0].ln() } else { outside },
        |x| dvector![1.0 - 1.0 / x[0]],
        |x| dmatrix![1.0 / (x[0] * x[0])],
    )
}

/// ½ (x² + 1e12 y²).
pub fn ill_conditioned() -> Objective {
    Objective::quadratic(dmatrix![1.0, 0.0; 0.0, 1e12], dvector![0.0, 0.0])
}

/// ½ `unit` x² with twice its Hessian, so that each direction goes half the way to 0.
pub fn halving(unit: f64) -> Objective {
    let f = move |x: &DVector<f64>| 0.5 * unit * x[0] * x[0];
    Objective::new(f, move |x| x * unit, move |_| dmatrix![2.0 * unit])
}

/// ½ x² with a Hessian slightly too small or large, so that each direction leaves `factor` of the way.
pub fn shrinking(factor: f64) -> Objective {
    Objective::new(|x| 0.5 * x[0] * x[0], |x| x.clone(), move |_| dmatrix![1.0 / (1.0 - factor)])
}

/// A line along which the slope at the start is −1 and the direction goes 1 far; f is `value(t)`, apart from that.
pub fn line(value: impl Fn(f64) -> f64 + 'static) -> Objective {
    Objective::new(move |x| value(x[0]), |_| dvector![-1.0], |_| dmatrix![1.0])
}
