//! Functions in this process.

use std::any::Any;
use std::panic::{self, AssertUnwindSafe};

use grader_child::{Force, Functions, Gradient, Hessian, Objective, Solve, Stiffness, plain_functions};
use nalgebra::{DVector, Matrix3, Matrix4, Matrix4x3, SMatrix, SVector, Vector3, Vector4};
use nalgebra_sparse::CsrMatrix;

use super::{Answer, Implementation, Trouble};

/// Functions that are linked with this process; only trusted ones, or a student's own on the student's own machine.
pub struct Local(pub Functions);

fn caught<T>(call: impl FnOnce() -> T) -> Answer<T> {
    panic::catch_unwind(AssertUnwindSafe(call)).map_err(|panic| trouble(&*panic))
}

fn trouble(panic: &(dyn Any + Send)) -> Trouble {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    match text {
        Some(text) if text.starts_with("not yet implemented") => Trouble::Missing,
        text => Trouble::Panicked { message: text.unwrap_or_default().to_owned(), place: String::new() },
    }
}

macro_rules! calls {
    ($($number:literal $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        impl Implementation for Local {
            $(fn $name(&self, $($argument: $type),*) -> Answer<$result> {
                caught(|| (self.0.$name)($($argument),*))
            })*

            fn quadrature_of_number(
                &self,
                V: &[Vector3<f64>],
                element: &[usize; 4],
                volume: f64,
                integrand: &dyn Fn(&Vector3<f64>) -> f64,
            ) -> Answer<f64> {
                caught(|| (self.0.quadrature_of_number)(V, element, volume, integrand))
            }

            fn quadrature_of_vector(
                &self,
                V: &[Vector3<f64>],
                element: &[usize; 4],
                volume: f64,
                integrand: &dyn Fn(&Vector3<f64>) -> DVector<f64>,
            ) -> Answer<DVector<f64>> {
                caught(|| (self.0.quadrature_of_vector)(V, element, volume, integrand))
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
                caught(|| (self.0.linearly_implicit_euler)(q, qdot, dt, mass, force, stiffness, solve))
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
                caught(|| (self.0.newtons_method)(x0, f, g, H, solve, max_steps))
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
                caught(|| (self.0.implicit_euler)(q, qdot, dt, mass, energy, force, stiffness, solve))
            }
        }
    };
}
plain_functions!(calls);
