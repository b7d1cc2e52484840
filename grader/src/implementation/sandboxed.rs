//! Functions in a process of their own, behind a sandbox.

use std::cell::{Cell, RefCell};
use std::io;
use std::rc::Rc;
use std::time::{Duration, Instant};

use grader_child::simulation::Scene;
use grader_child::wire::{Argument, Wire, bytes, kind, read};
use grader_child::{Exercise, Force, Gradient, Hessian, Integrand, Objective, Solve, Stiffness, course_functions};
use nalgebra::{DVector, Matrix3, Matrix4, Matrix4x3, SMatrix, SVector, Vector3, Vector4};
use nalgebra_sparse::CsrMatrix;

use super::budget::Budget;
use super::places::Places;
use super::protocol::{self, Closures};
use super::{Answer, Implementation, Trouble};
use crate::sandbox::Running;

/// A program with a submission's functions. It is started for its first call, and again after it has ended.
pub struct Sandboxed {
    start: Box<dyn Fn() -> io::Result<Running>>,
    running: RefCell<Option<Running>>,
    limit: Duration,
    /// True once a process has ended or timed out in this check: it is not called again in the same check.
    given_up: Cell<bool>,
    /// Number of time-outs of the present function.
    time_outs: Cell<usize>,
    budget: Rc<Budget>,
    /// The lines at which it can panic.
    places: Places,
    /// Time spent waiting for answers of the present process.
    waited: Cell<Duration>,
}

/// After so many time-outs the remaining checks of a function are not waited for.
const MOST_TIME_OUTS: usize = 3;

impl Sandboxed {
    /// A program that `start` starts; each call must be answered within `limit`.
    pub fn new(start: impl Fn() -> io::Result<Running> + 'static, limit: Duration) -> Self {
        Self {
            start: Box::new(start),
            running: RefCell::new(None),
            limit,
            given_up: Cell::new(false),
            time_outs: Cell::new(0),
            budget: Rc::new(Budget::unlimited()),
            places: Places::default(),
            waited: Cell::new(Duration::ZERO),
        }
    }

    /// The same, with a budget for all calls together, and with places of panics restricted to the lines of its files.
    pub fn within(self, budget: Rc<Budget>, places: Places) -> Self {
        Self { budget, places, ..self }
    }

    /// Forgets earlier trouble. The next function is called in a new process, so that threads and panic hooks of the previous function
    /// cannot answer for it.
    pub fn next_function(&self) {
        self.end(&mut self.running.borrow_mut());
        self.time_outs.set(0);
        self.budget.next_function();
        self.next_check();
    }

    /// Lets a function that has ended its process or timed out answer the next check, unless it has timed out too often.
    pub fn next_check(&self) {
        self.given_up.set(self.time_outs.get() >= MOST_TIME_OUTS);
        self.budget.next_check();
    }

    /// Duration of a series of calls of a function with these arguments, s.
    ///
    /// # Errors
    /// The reason if the function does not answer.
    pub fn seconds(&self, function: Exercise, body: &[u8], times: u64) -> Answer<f64> {
        let frames = [(kind::REPEAT, bytes(&times)), (function as u8, body.to_vec())];
        let begin = Instant::now();
        self.frames(&frames, self.limit, &mut |_, _| None)?;
        Ok(begin.elapsed().as_secs_f64())
    }

    /// Processor time of the same in a process of its own, s, its start included. Other programs that keep the machine busy do not
    /// count in it. Outside of a sandbox, the duration of the calls.
    ///
    /// # Errors
    /// The reason if the function does not answer.
    pub fn processor_seconds(&self, function: Exercise, body: &[u8], times: u64) -> Answer<f64> {
        self.end(&mut self.running.borrow_mut());
        let passed = self.seconds(function, body, times)?;
        let used = self.end(&mut self.running.borrow_mut());
        Ok(if used.is_zero() { passed } else { used.as_secs_f64() })
    }

    /// Positions of a whole simulation, and its run time, s.
    ///
    /// # Errors
    /// The reason if no answer comes within `limit`.
    pub fn simulate(&self, scene: &Scene, limit: Duration) -> Answer<(Vec<DVector<f64>>, f64)> {
        let begin = Instant::now();
        let body = self.frames(&[(kind::SIMULATE, bytes(scene))], limit, &mut |_, _| None)?;
        let passed = begin.elapsed().as_secs_f64();
        read(&body).map(|positions| (positions, passed)).ok_or(Trouble::Malformed)
    }

    fn call<T: Wire>(&self, function: Exercise, body: Vec<u8>, closures: Closures) -> Answer<T> {
        let answer = self.frames(&[(function as u8, body)], self.limit, closures)?;
        read(&answer).ok_or(Trouble::Malformed)
    }

    fn frames(&self, frames: &[(u8, Vec<u8>)], limit: Duration, closures: Closures) -> Answer<Vec<u8>> {
        if self.given_up.get() {
            return Err(Trouble::GivenUp);
        }
        if let Some(allowed) = self.budget.over() {
            return Err(Trouble::TimedOut(allowed));
        }
        let limit = limit.min(self.budget.left());
        let mut place = self.running.borrow_mut();
        let begin = Instant::now();
        let answer = match self.alive(&mut place, limit) {
            Ok(running) => protocol::call(running, frames, limit, closures),
            Err(trouble) => Err(trouble),
        };
        self.spend(begin.elapsed());
        let answer = answer.map_err(|trouble| match (self.places.checked(trouble), self.budget.over()) {
            (Trouble::TimedOut(_), Some(allowed)) => Trouble::TimedOut(allowed),
            (trouble, _) => trouble,
        });
        if let Err(trouble) = &answer
            && !matches!(trouble, Trouble::Panicked { .. } | Trouble::Missing)
        {
            self.end(&mut place);
            self.given_up.set(true);
            self.time_outs.set(self.time_outs.get() + usize::from(matches!(trouble, Trouble::TimedOut(_))));
        }
        answer
    }

    fn spend(&self, time: Duration) {
        self.budget.spend(time);
        self.waited.set(self.waited.get() + time);
    }

    /// Ends the process, if there is one, and returns its processor time. Threads may have used more than was waited for.
    fn end(&self, place: &mut Option<Running>) -> Duration {
        let Some(mut running) = place.take() else { return Duration::ZERO };
        let used = running.kill();
        self.budget.spend(used.saturating_sub(self.waited.get()));
        self.waited.set(Duration::ZERO);
        used
    }

    fn alive<'a>(&self, place: &'a mut Option<Running>, limit: Duration) -> Answer<&'a mut Running> {
        match place {
            Some(running) => Ok(running),
            None => {
                let mut started =
                    (self.start)().map_err(|error| Trouble::Crashed(format!("cannot be started: {error}")))?;
                protocol::greet(&mut started, limit)?;
                Ok(place.insert(started))
            }
        }
    }
}

/// Appends one argument.
type Append<'a> = &'a dyn Fn(&mut Vec<u8>);

/// The arguments of a call, one after the other.
fn body(arguments: &[Append]) -> Vec<u8> {
    let mut out = Vec::new();
    arguments.iter().for_each(|append| append(&mut out));
    out
}

macro_rules! plain {
    ($name:ident($($argument:ident: $type:ty),*) -> $result:ty) => {
        fn $name(&self, $($argument: $type),*) -> Answer<$result> {
            let body = body(&[$(&|out| Argument::append(&$argument, out)),*]);
            self.call(Exercise::$name, body, &mut |_, _| None)
        }
    };
}

// Each of them is written out below.
macro_rules! with_closures {
    ($($row:tt)*) => {};
}

macro_rules! calls {
    ($($kind:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        impl Implementation for Sandboxed {
            fn begin_check(&self) {
                self.next_check();
            }

            $($kind! { $name($($argument: $type),*) -> $result })*

            fn quadrature_single_point(
                &self,
                V: &[Vector3<f64>],
                element: &[usize; 4],
                volume: f64,
                integrand: Integrand,
            ) -> Answer<DVector<f64>> {
                let body = bytes(&(V.to_vec(), (*element, volume)));
                let mut closures = |_: u8, X: &[u8]| Some(bytes(&integrand(&read(X)?)));
                self.call(Exercise::quadrature_single_point, body, &mut closures)
            }

            fn linearly_implicit_euler(
                &self,
                q: &mut DVector<f64>,
                qdot: &mut DVector<f64>,
                dt: f64,
                mass: &CsrMatrix<f64>,
                force: Force,
                stiffness: Stiffness,
                solve: Solve,
            ) -> Answer<()> {
                let none = |_: &DVector<f64>| f64::NAN;
                let body = step(q, qdot, dt, mass);
                let mut closures = |which: u8, input: &[u8]| integrator(which, input, &none, force, stiffness, solve);
                (*q, *qdot) = self.call(Exercise::linearly_implicit_euler, body, &mut closures)?;
                Ok(())
            }

            fn newtons_method(
                &self,
                x0: &mut DVector<f64>,
                f: Objective,
                g: Gradient,
                H: Hessian,
                solve: Solve,
                max_steps: usize,
            ) -> Answer<f64> {
                let body = bytes(&(x0.clone(), max_steps));
                let mut closures = |which: u8, input: &[u8]| match which {
                    1 => Some(bytes(&f(&read(input)?))),
                    2 => Some(bytes(&g(&read(input)?))),
                    3 => Some(bytes(&H(&read(input)?))),
                    4 => solved(input, solve),
                    _ => None,
                };
                let (x, value) = self.call(Exercise::newtons_method, body, &mut closures)?;
                *x0 = x;
                Ok(value)
            }

            fn implicit_euler(
                &self,
                q: &mut DVector<f64>,
                qdot: &mut DVector<f64>,
                dt: f64,
                mass: &CsrMatrix<f64>,
                energy: Objective,
                force: Force,
                stiffness: Stiffness,
                solve: Solve,
            ) -> Answer<()> {
                let body = step(q, qdot, dt, mass);
                let mut closures = |which: u8, input: &[u8]| integrator(which, input, energy, force, stiffness, solve);
                (*q, *qdot) = self.call(Exercise::implicit_euler, body, &mut closures)?;
                Ok(())
            }
        }
    };
}
course_functions!(calls);

fn step(q: &DVector<f64>, qdot: &DVector<f64>, dt: f64, mass: &CsrMatrix<f64>) -> Vec<u8> {
    bytes(&((q.clone(), qdot.clone()), (dt, mass.clone())))
}

/// A submission may call a closure with vectors of any length. A call with a wrong length is not answered.
fn integrator(
    which: u8,
    input: &[u8],
    energy: Objective,
    force: Force,
    stiffness: Stiffness,
    solve: Solve,
) -> Option<Vec<u8>> {
    let state = || read::<(DVector<f64>, DVector<f64>)>(input);
    match which {
        1 => Some(bytes(&energy(&read(input)?))),
        2 => state().map(|(q, v)| bytes(&force(&q, &v))),
        3 => state().map(|(q, v)| bytes(&stiffness(&q, &v))),
        4 => solved(input, solve),
        _ => None,
    }
}

fn solved(input: &[u8], solve: Solve) -> Option<Vec<u8>> {
    let (A, b): (CsrMatrix<f64>, DVector<f64>) = read(input)?;
    (A.nrows() == A.ncols() && A.nrows() == b.len()).then(|| bytes(&solve(&A, &b)))
}
