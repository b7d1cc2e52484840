//! The 22 functions as data: one table of function pointers, and the list of signatures that everything else is made from.

use nalgebra::{DVector, Matrix3, Matrix4, Matrix4x3, SMatrix, SVector, Vector3, Vector4};
use nalgebra_sparse::CsrMatrix;

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

/// Hands the signatures of the 18 functions that take no closure to the macro `$then`. A call travels under its number.
#[macro_export]
macro_rules! plain_functions {
    ($then:ident) => {
        $then! {
            0 phi_linear_tetrahedron(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Vector4<f64>;
            1 dphi_linear_tetrahedron_dX(V: &[Vector3<f64>], element: &[usize; 4], X: &Vector3<f64>) -> Matrix4x3<f64>;
            2 psi_neo_hookean(F: &Matrix3<f64>, C: f64, D: f64) -> f64;
            3 dpsi_neo_hookean_dF(F: &Matrix3<f64>, C: f64, D: f64) -> SVector<f64, 9>;
            4 d2psi_neo_hookean_dF2(F: &Matrix3<f64>, C: f64, D: f64) -> SMatrix<f64, 9, 9>;
            5 T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64;
            6 V_linear_tetrahedron(q: &DVector<f64>, V: &[Vector3<f64>], element: &[usize; 4], volume: f64, C: f64, D: f64) -> f64;
            7 dV_linear_tetrahedron_dq(q: &DVector<f64>, V: &[Vector3<f64>], element: &[usize; 4], volume: f64, C: f64, D: f64) -> SVector<f64, 12>;
            8 d2V_linear_tetrahedron_dq2(q: &DVector<f64>, V: &[Vector3<f64>], element: &[usize; 4], volume: f64, C: f64, D: f64) -> SMatrix<f64, 12, 12>;
            9 V_spring_particle_particle(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> f64;
            10 dV_spring_particle_particle_dq(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> SVector<f64, 6>;
            11 mass_matrix_linear_tetrahedron(density: f64, volume: f64) -> SMatrix<f64, 12, 12>;
            12 mass_matrix_mesh(q_size: usize, T: &[[usize; 4]], density: f64, v0: &[f64]) -> CsrMatrix<f64>;
            13 assemble_forces(q: &DVector<f64>, V: &[Vector3<f64>], T: &[[usize; 4]], v0: &[f64], C: f64, D: f64) -> DVector<f64>;
            14 assemble_stiffness(q: &DVector<f64>, V: &[Vector3<f64>], T: &[[usize; 4]], v0: &[f64], C: f64, D: f64) -> CsrMatrix<f64>;
            15 build_skinning_matrix(V: &[Vector3<f64>], T: &[[usize; 4]], V_skin: &[Vector3<f64>]) -> CsrMatrix<f64>;
            16 fixed_point_constraints(q_size: usize, indices: &[usize]) -> CsrMatrix<f64>;
            17 pick_nearest_vertices(win: &Vector3<f64>, view: &Matrix4<f32>, proj: &Matrix4<f32>, viewport: &Vector4<f32>, V: &[Vector3<f64>], F: &[[usize; 3]], radius: f64) -> Vec<usize>;
        }
    };
}

macro_rules! table {
    ($($number:literal $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        /// One implementation of the 22 functions.
        #[derive(Clone, Copy)]
        #[allow(clippy::type_complexity)] // the course's signatures
        pub struct Functions {
            $(#[doc = concat!("`", stringify!($name), "`")] pub $name: fn($($type),*) -> $result,)*
            /// `quadrature_single_point` of a number.
            pub quadrature_of_number: fn(&[Vector3<f64>], &[usize; 4], f64, &dyn Fn(&Vector3<f64>) -> f64) -> f64,
            /// `quadrature_single_point` of a vector.
            pub quadrature_of_vector:
                fn(&[Vector3<f64>], &[usize; 4], f64, &dyn Fn(&Vector3<f64>) -> DVector<f64>) -> DVector<f64>,
            /// `linearly_implicit_euler`
            pub linearly_implicit_euler:
                fn(&mut DVector<f64>, &mut DVector<f64>, f64, &CsrMatrix<f64>, Force, Stiffness, Solve),
            /// `newtons_method`
            pub newtons_method: fn(&mut DVector<f64>, Objective, Gradient, Hessian, Solve, usize) -> f64,
            /// `implicit_euler`
            pub implicit_euler:
                fn(&mut DVector<f64>, &mut DVector<f64>, f64, &CsrMatrix<f64>, Objective, Force, Stiffness, Solve),
        }

        /// A table in which every function panics: what a program without a function answers when asked for it.
        pub const NOTHING: Functions = Functions {
            $($name: |$(_: $type),*| panic!("not part of this program"),)*
            quadrature_of_number: |_, _, _, _| panic!("not part of this program"),
            quadrature_of_vector: |_, _, _, _| panic!("not part of this program"),
            linearly_implicit_euler: |_, _, _, _, _, _, _| panic!("not part of this program"),
            newtons_method: |_, _, _, _, _, _| panic!("not part of this program"),
            implicit_euler: |_, _, _, _, _, _, _, _| panic!("not part of this program"),
        };
    };
}
plain_functions!(table);
