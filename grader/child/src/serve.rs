//! The loop that calls a submission's functions: one call, one answer, until the other side closes.

use std::any::Any;
use std::backtrace::Backtrace;
use std::cell::RefCell;
use std::hint::black_box;
use std::panic::{self, AssertUnwindSafe, Location};
use std::process;
use std::sync::Mutex;

use nalgebra::{DVector, Matrix3, Matrix4, Vector3, Vector4};
use nalgebra_sparse::CsrMatrix;

use crate::simulation::simulate;
use crate::socket::{self, Socket};
use crate::standard;
use crate::wire::{self, Argument, LONGEST_MESSAGE, Wire, bytes, kind, read};
use crate::{Exercise, Functions, GivenSolve, course_functions};

/// Answers calls that arrive on the parent's socket until the parent closes it.
///
/// The answers are sent through the same socket, which is separate from the submission's standard output.
pub fn serve(functions: &Functions, solve: GivenSolve) {
    let Ok(socket) = socket::parent() else { process::exit(3) };
    let parent = Parent(RefCell::new(socket));
    remember_where_panics_happen();
    parent.send(kind::READY, &[]);
    loop {
        let (called, body) = parent.receive();
        let answered = panic::catch_unwind(AssertUnwindSafe(|| match called {
            kind::REPEAT => repeat(functions, &parent, &body),
            kind::SIMULATE => read(&body).map(|scene| bytes(&simulate(functions, &scene, solve))),
            _ => answer(functions, &parent, exercise(called)?, &body),
        }));
        match answered {
            Ok(Some(answer)) => parent.send(kind::RETURNED, &answer),
            // The parent speaks another version, or a submission has read from the socket.
            Ok(None) => process::exit(4),
            Err(panic) => parent.send(kind::PANICKED, &bytes(&(message(&*panic), place()))),
        }
    }
}

/// The other end of the socket. The process ends when it closes.
struct Parent(RefCell<Socket>);

impl Parent {
    fn send(&self, kind: u8, body: &[u8]) {
        if wire::send(&mut *self.0.borrow_mut(), kind, body).is_err() {
            process::exit(0);
        }
    }

    fn receive(&self) -> (u8, Vec<u8>) {
        wire::receive(&mut *self.0.borrow_mut()).unwrap_or_else(|_| process::exit(0))
    }

    /// Has the parent evaluate a closure.
    fn ask<T: Wire>(&self, closure: u8, arguments: &[u8]) -> T {
        self.send(kind::CLOSURE + closure, arguments);
        match self.receive() {
            (kind::ANSWER, body) => read(&body).unwrap_or_else(|| process::exit(4)),
            _ => process::exit(4),
        }
    }
}

static PLACE: Mutex<String> = Mutex::new(String::new());

fn remember_where_panics_happen() {
    panic::set_hook(Box::new(|info| {
        // Windows divides paths in its own way.
        let place = |location: &Location| format!("{}:{}", location.file().replace('\\', "/"), location.line());
        let place = info.location().map(place).unwrap_or_default();
        // A library panics in its own file. The line that called it is the author's.
        let own = own_place(&place).or_else(|| {
            let calls = Backtrace::force_capture().to_string();
            calls.lines().find_map(|line| own_place(line.trim_start().strip_prefix("at ")?))
        });
        if let Ok(mut kept) = PLACE.lock() {
            *kept = own.unwrap_or(place);
        }
    }));
}

/// `src/NAME.rs:LINE` at the end of a path with a line and perhaps a column, if it is in the file of an exercise.
fn own_place(path: &str) -> Option<String> {
    let path = path.replace('\\', "/");
    let (folder, file) = path.rsplit_once('/')?;
    let mut parts = file.split(':');
    let (name, line) = (parts.next()?.strip_suffix(".rs")?, parts.next()?);
    let is_in_src = folder == "src" || folder.ends_with("/src");
    (is_in_src && Exercise::from_name(name).is_some()).then(|| format!("src/{name}.rs:{line}"))
}

fn place() -> String {
    // A macro may claim any file.
    PLACE.lock().map(|place| wire::start(&place, LONGEST_MESSAGE).to_owned()).unwrap_or_default()
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    wire::start(text.unwrap_or("a panic without a message"), LONGEST_MESSAGE).to_owned()
}

macro_rules! plain {
    ($functions:ident $called:ident $input:ident $name:ident($($argument:ident: $type:ty),*)) => {
        if $called == Exercise::$name {
            $(let $argument = <<$type as Argument>::Stored as Wire>::get($input)?;)*
            let function = $functions.$name;
            return Some(Box::new(move || {
                bytes(&black_box(function($(<$type as Argument>::lend(black_box(&$argument))),*)))
            }));
        }
    };
}

macro_rules! with_closures {
    ($($row:tt)*) => {};
}

macro_rules! calls {
    ($($kind:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        /// The call of a function that takes no closure, with its arguments.
        fn plain(functions: &Functions, called: Exercise, input: &mut &[u8]) -> Option<Box<dyn Fn() -> Vec<u8>>> {
            $($kind! { functions called input $name($($argument: $type),*) })*
            None
        }
    };
}
course_functions!(calls);

/// The function with this number.
fn exercise(number: u8) -> Option<Exercise> {
    Exercise::ALL.get(usize::from(number)).copied()
}

/// Makes one call, closures answered by the parent.
fn answer(functions: &Functions, parent: &Parent, called: Exercise, body: &[u8]) -> Option<Vec<u8>> {
    let mut input = body;
    let two = |a: &DVector<f64>, b: &DVector<f64>| [bytes(a), bytes(b)].concat();
    let solve = |A: &CsrMatrix<f64>, b: &DVector<f64>| parent.ask(4, &[bytes(A), bytes(b)].concat());
    let force = |q: &DVector<f64>, v: &DVector<f64>| parent.ask(2, &two(q, v));
    let stiffness = |q: &DVector<f64>, v: &DVector<f64>| parent.ask(3, &two(q, v));
    let objective = |x: &DVector<f64>| parent.ask(1, &bytes(x));
    match called {
        Exercise::quadrature_single_point => {
            let (V, element, volume): (Vec<Vector3<f64>>, _, _) =
                (Wire::get(&mut input)?, Wire::get(&mut input)?, Wire::get(&mut input)?);
            let integrand = |X: &Vector3<f64>| parent.ask(0, &bytes(X));
            Some(bytes(&(functions.quadrature_single_point)(&V, &element, volume, &integrand)))
        }
        Exercise::linearly_implicit_euler => {
            let (mut q, mut qdot, dt, mass) = step(&mut input)?;
            (functions.linearly_implicit_euler)(&mut q, &mut qdot, dt, &mass, &force, &stiffness, &solve);
            Some(two(&q, &qdot))
        }
        Exercise::implicit_euler => {
            let (mut q, mut qdot, dt, mass) = step(&mut input)?;
            (functions.implicit_euler)(&mut q, &mut qdot, dt, &mass, &objective, &force, &stiffness, &solve);
            Some(two(&q, &qdot))
        }
        Exercise::newtons_method => {
            let mut x: DVector<f64> = Wire::get(&mut input)?;
            let max_steps = Wire::get(&mut input)?;
            let gradient = |x: &DVector<f64>| parent.ask(2, &bytes(x));
            let hessian = |x: &DVector<f64>| parent.ask(3, &bytes(x));
            let f = (functions.newtons_method)(&mut x, &objective, &gradient, &hessian, &solve, max_steps);
            Some(bytes(&(x, f)))
        }
        _ => plain(functions, called, &mut input).map(|call| call()),
    }
}

type Step = (DVector<f64>, DVector<f64>, f64, CsrMatrix<f64>);

fn step(input: &mut &[u8]) -> Option<Step> {
    Some((Wire::get(input)?, Wire::get(input)?, Wire::get(input)?, Wire::get(input)?))
}

/// Makes the call that follows many times, so that the time of communication does not count. Functions that take closures
/// work on a problem of their own here.
fn repeat(functions: &Functions, parent: &Parent, body: &[u8]) -> Option<Vec<u8>> {
    let times: u64 = read(body)?;
    let (called, body) = parent.receive();
    let called = exercise(called)?;
    let call = plain(functions, called, &mut &body[..]).or_else(|| standard::load(*functions, called))?;
    let mut last = Vec::new();
    for _ in 0..times {
        last = call();
    }
    Some(last)
}

#[cfg(test)]
mod tests {
    use super::own_place;

    #[test]
    fn the_authors_line_is_found_in_every_form_of_a_path_and_a_librarys_is_not() {
        let own = Some("src/psi_neo_hookean.rs:7".to_owned());
        for path in ["src/psi_neo_hookean.rs:7", "./src/psi_neo_hookean.rs:7:5", "/tmp/a/src\\psi_neo_hookean.rs:7:5"] {
            assert_eq!(own_place(path), own, "{path}");
        }
        for path in ["/x/nalgebra/src/base/ops.rs:7:5", "/x/mysrc/psi_neo_hookean.rs:7", "src/psi_neo_hookean.rs", ""] {
            assert_eq!(own_place(path), None, "{path}");
        }
    }
}
