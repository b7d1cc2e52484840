//! Wrong functions as students write them, each with the names that a teacher would give to the mistake. They measure the
//! quality of the diagnosis, which does not use them.

use grader_child::Functions;

/// Calls one of the 22 functions of the course's solution.
macro_rules! right {
    ($name:ident($($argument:expr),* $(,)?)) => {
        ($crate::reference::REFERENCE.$name)($($argument),*)
    };
}

/// A [`Mistake`]: the function, the names that fit, and the wrong body.
macro_rules! wrong {
    ($name:ident, [$($diagnosis:literal),*], $body:expr $(,)?) => {
        Mistake {
            function: stringify!($name),
            names: &[$($diagnosis),*],
            functions: grader_child::Functions { $name: $body, ..$crate::reference::REFERENCE },
        }
    };
}

mod blind;
mod by_hand;
mod final_validation;
#[allow(clippy::needless_range_loop, clippy::manual_range_contains, clippy::collapsible_if)]
// loops as students write them
mod repositories;
mod tests;
mod training;
mod validation;

/// One wrong function.
pub struct Mistake {
    /// The function that is wrong.
    pub function: &'static str,
    /// Names that a teacher would accept.
    pub names: &'static [&'static str],
    /// The course's solution with this mistake in it.
    pub functions: Functions,
}
