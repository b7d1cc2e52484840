//! Notes which functions a check asks beside the one that it judges.

use std::cell::RefCell;
use std::collections::BTreeSet;

use grader_child::{Force, Gradient, Hessian, Integrand, Objective, Solve, Stiffness, course_functions};
use nalgebra::{DVector, Matrix3, Matrix4, Matrix4x3, SMatrix, SVector, Vector3, Vector4};
use nalgebra_sparse::CsrMatrix;

use crate::implementation::{Answer, Implementation, Trouble};

/// An implementation that notes the names of the functions that are called.
pub struct Recorded<'a> {
    inner: &'a dyn Implementation,
    /// Functions that are not called, because they do not answer in time.
    slow: &'a BTreeSet<&'static str>,
    asked: RefCell<BTreeSet<&'static str>>,
}

impl<'a> Recorded<'a> {
    /// Calls `inner`, but never the functions `slow`.
    pub fn new(inner: &'a dyn Implementation, slow: &'a BTreeSet<&'static str>) -> Self {
        Self { inner, slow, asked: RefCell::default() }
    }

    /// The functions that have been called since the last call of this method.
    pub fn take(&self) -> BTreeSet<&'static str> {
        self.asked.take()
    }
}

macro_rules! calls {
    ($($kind:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        impl Implementation for Recorded<'_> {
            fn begin_check(&self) {
                self.inner.begin_check();
            }

            $(fn $name(&self, $($argument: $type),*) -> Answer<$result> {
                self.asked.borrow_mut().insert(stringify!($name));
                if self.slow.contains(stringify!($name)) {
                    return Err(Trouble::GivenUp);
                }
                self.inner.$name($($argument),*)
            })*
        }
    };
}
course_functions!(calls);
