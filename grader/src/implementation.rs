//! Implementations of the 22 functions: in this process, in a sandboxed child, deliberately wrong ones. A property is written once
//! and applied to all of them.

pub mod budget;
mod local;
pub mod places;
mod protocol;
pub mod sandboxed;

use std::fmt;
use std::time::Duration;

use grader_child::{Force, Gradient, Hessian, Integrand, Objective, Solve, Stiffness, course_functions};
use nalgebra::{DVector, Matrix3, Matrix4, Matrix4x3, SMatrix, SVector, Vector3, Vector4};
use nalgebra_sparse::CsrMatrix;

pub use local::Local;

/// Reason why a function does not answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Trouble {
    /// The function is missing or is still the handout's `todo!`.
    Missing,
    /// The function panicked.
    Panicked {
        /// The message. It may hold the inputs of a check, so only the instructor sees it.
        message: String,
        /// File and line.
        place: String,
    },
    /// The process of the submission ended: by itself, by an overflow of the stack, by a signal.
    Crashed(String),
    /// The submission took longer than this.
    TimedOut(Duration),
    /// The answer is not valid: wrong number of bytes, inconsistent sparse matrix.
    Malformed,
    /// The function was not called again after earlier trouble in the same check, or after too many time-outs.
    GivenUp,
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing => f.write_str("the function is not written yet"),
            Self::Panicked { place, .. } if place.starts_with("src/") => write!(f, "the function panicked at {place}"),
            Self::Panicked { .. } => f.write_str("the function panicked"),
            Self::Crashed(how) => write!(f, "the program with the function ended: {how}"),
            Self::TimedOut(limit) => write!(f, "no answer within {:.0} s", limit.as_secs_f64()),
            Self::Malformed => f.write_str("the answer is not of the promised type"),
            Self::GivenUp => f.write_str("not called again after the earlier failure"),
        }
    }
}

/// The answer of a function, or the reason why there is none.
pub type Answer<T> = Result<T, Trouble>;

macro_rules! methods {
    ($($kind:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        /// The 22 functions as the grader calls them. The generic `quadrature_single_point` is called with vectors.
        #[allow(clippy::too_many_arguments)] // the course's signatures
        pub trait Implementation {
            /// Begins a check: an earlier panic, crash or time-out affects only the check in which it happened.
            fn begin_check(&self) {}

            $(
                #[doc = concat!("See the page of `", stringify!($name), "`.")]
                #[allow(missing_docs)]
                fn $name(&self, $($argument: $type),*) -> Answer<$result>;
            )*
        }
    };
}
course_functions!(methods);
