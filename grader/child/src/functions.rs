//! The 22 functions of the course: one list of their names, order and signatures, which generates every other list.

use nalgebra::{DVector, Matrix3, Matrix4, Matrix4x3, SMatrix, SVector, Vector3, Vector4};
use nalgebra_sparse::CsrMatrix;

/// Integrand of an integral over an element, as a vector of any length.
pub type Integrand<'a> = &'a dyn Fn(&Vector3<f64>) -> DVector<f64>;
/// Value of a function of many variables.
pub type Objective<'a> = &'a dyn Fn(&DVector<f64>) -> f64;
/// Gradient of such a function.
pub type Gradient<'a> = &'a dyn Fn(&DVector<f64>) -> DVector<f64>;
/// Hessian of such a function.
pub type Hessian<'a> = &'a dyn Fn(&DVector<f64>) -> CsrMatrix<f64>;
/// Force at (q, v), N.
pub type Force<'a> = &'a dyn Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>;
/// Stiffness at (q, v), N/m.
pub type Stiffness<'a> = &'a dyn Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>;
/// Solution x of A x = b.
pub type Solve<'a> = &'a dyn Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>;

/// `given::solve`: the program is linked with it, this crate is not.
pub type GivenSolve = fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>;

/// The list: hands the functions in teaching order to the macro `$then`, after the tokens `$first`.
///
/// Each row starts with `plain`, or with `with_closures` if an argument is a closure, so that a macro of that name can treat the
/// two kinds differently. The generic `quadrature_single_point` is called with vectors.
#[macro_export]
macro_rules! course_functions {
    ($($then:ident)::+ $(=> $($first:tt)*)?) => {
        $($then)::+! { $($($first)*)?
            plain phi_linear_tetrahedron(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Vector4<f64>;
            plain dphi_linear_tetrahedron_dX(V: &[Vector3<f64>], element: &[usize; 4], X: &Vector3<f64>) -> Matrix4x3<f64>;
            plain psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64;
            plain dpsi_neo_hookean_dF(F: &Matrix3<f64>, C: f64, D: f64) -> SVector<f64, 9>;
            plain d2psi_neo_hookean_dF2(F: &Matrix3<f64>, C: f64, D: f64) -> SMatrix<f64, 9, 9>;
            plain T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64;
            with_closures quadrature_single_point(V: &[Vector3<f64>], element: &[usize; 4], volume: f64, integrand: Integrand) -> DVector<f64>;
            plain V_linear_tetrahedron(q: &DVector<f64>, V: &[Vector3<f64>], element: &[usize; 4], volume: f64, C: f64, D: f64) -> f64;
            plain dV_linear_tetrahedron_dq(q: &DVector<f64>, V: &[Vector3<f64>], element: &[usize; 4], volume: f64, C: f64, D: f64) -> SVector<f64, 12>;
            plain d2V_linear_tetrahedron_dq2(q: &DVector<f64>, V: &[Vector3<f64>], element: &[usize; 4], volume: f64, C: f64, D: f64) -> SMatrix<f64, 12, 12>;
            plain V_spring_particle_particle(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> f64;
            plain dV_spring_particle_particle_dq(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> SVector<f64, 6>;
            plain mass_matrix_linear_tetrahedron(density: f64, volume: f64) -> SMatrix<f64, 12, 12>;
            plain mass_matrix_mesh(q_size: usize, T: &[[usize; 4]], density: f64, v0: &[f64]) -> CsrMatrix<f64>;
            plain assemble_forces(q: &DVector<f64>, V: &[Vector3<f64>], T: &[[usize; 4]], v0: &[f64], C: f64, D: f64) -> DVector<f64>;
            plain assemble_stiffness(q: &DVector<f64>, V: &[Vector3<f64>], T: &[[usize; 4]], v0: &[f64], C: f64, D: f64) -> CsrMatrix<f64>;
            plain build_skinning_matrix(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> CsrMatrix<f64>;
            plain fixed_point_constraints(q_size: usize, indices: &[usize]) -> CsrMatrix<f64>;
            plain pick_nearest_vertices(win: &Vector3<f64>, view: &Matrix4<f32>, proj: &Matrix4<f32>, viewport: &Vector4<f32>, V: &[Vector3<f64>], F: &[[usize; 3]], radius: f64) -> Vec<usize>;
            with_closures linearly_implicit_euler(q: &mut DVector<f64>, qdot: &mut DVector<f64>, dt: f64, mass: &CsrMatrix<f64>, force: Force, stiffness: Stiffness, solve: Solve) -> ();
            with_closures newtons_method(x0: &mut DVector<f64>, f: Objective, g: Gradient, H: Hessian, solve: Solve, max_steps: usize) -> f64;
            with_closures implicit_euler(q: &mut DVector<f64>, qdot: &mut DVector<f64>, dt: f64, mass: &CsrMatrix<f64>, energy: Objective, force: Force, stiffness: Stiffness, solve: Solve) -> ();
        }
    };
}

macro_rules! define {
    ($($kind:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        /// One of the functions. Its value is its index in teaching order, which identifies it in calls.
        #[allow(non_camel_case_types)]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Exercise {
            $(#[doc = concat!("See `include-docs/", stringify!($name), ".md`.")] $name,)*
        }

        impl Exercise {
            /// All functions in teaching order.
            pub const ALL: [Self; 22] = [$(Self::$name),*];

            /// Name of the function.
            pub const fn name(self) -> &'static str {
                NAMES[self as usize]
            }

            /// The function of this name.
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|exercise| exercise.name() == name)
            }
        }

        /// Names of the functions in teaching order.
        pub const NAMES: [&str; 22] = [$(stringify!($name)),*];

        /// One implementation of the 22 functions.
        #[derive(Clone, Copy)]
        #[allow(clippy::type_complexity)] // the course's signatures
        pub struct Functions {
            $(#[doc = concat!("`", stringify!($name), "`")] pub $name: fn($($type),*) -> $result,)*
        }

        /// An implementation in which every function panics like the handout's: a program starts from it and replaces those that
        /// it has.
        pub const UNWRITTEN: Functions = Functions {
            $($name: |$(_: $type),*| panic!("not yet implemented"),)*
        };
    };
}
course_functions!(define);

/// The [`Functions`] of a crate that holds the 22 functions under their names.
#[macro_export]
macro_rules! functions_of {
    ($course:ident) => {
        $crate::course_functions! { $crate::functions_from => $course }
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! functions_from {
    ($course:ident $($kind:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        $crate::Functions { $($name: |$($argument),*| $course::$name($($argument),*)),* }
    };
}
