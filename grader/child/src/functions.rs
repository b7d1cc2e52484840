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

/// Hands the signatures of the 18 functions that take no closure to the macro `$then`, and behind them what else is given. A call
/// travels under its number.
#[macro_export]
macro_rules! plain_functions {
    ($then:ident $($more:tt)*) => {
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
            $($more)*
        }
    };
}

/// The same with those that take closures. `quadrature_single_point`, which is generic, is asked for numbers and for vectors.
#[macro_export]
macro_rules! all_functions {
    ($then:ident) => {
        $crate::plain_functions! { $then
            18 quadrature_of_number(V: &[Vector3<f64>], element: &[usize; 4], volume: f64, integrand: &dyn Fn(&Vector3<f64>) -> f64) -> f64;
            19 quadrature_of_vector(V: &[Vector3<f64>], element: &[usize; 4], volume: f64, integrand: &dyn Fn(&Vector3<f64>) -> DVector<f64>) -> DVector<f64>;
            20 linearly_implicit_euler(q: &mut DVector<f64>, qdot: &mut DVector<f64>, dt: f64, mass: &CsrMatrix<f64>, force: Force, stiffness: Stiffness, solve: Solve) -> ();
            21 newtons_method(x0: &mut DVector<f64>, f: Objective, g: Gradient, H: Hessian, solve: Solve, max_steps: usize) -> f64;
            22 implicit_euler(q: &mut DVector<f64>, qdot: &mut DVector<f64>, dt: f64, mass: &CsrMatrix<f64>, energy: Objective, force: Force, stiffness: Stiffness, solve: Solve) -> ();
        }
    };
}

/// The table of a crate that holds the 22 functions under their names.
#[macro_export]
macro_rules! functions_of {
    ($course:ident) => {
        $crate::Functions {
            phi_linear_tetrahedron: $course::phi_linear_tetrahedron,
            dphi_linear_tetrahedron_dX: $course::dphi_linear_tetrahedron_dX,
            psi_neo_hookean: $course::psi_neo_hookean,
            dpsi_neo_hookean_dF: $course::dpsi_neo_hookean_dF,
            d2psi_neo_hookean_dF2: $course::d2psi_neo_hookean_dF2,
            T_linear_tetrahedron: $course::T_linear_tetrahedron,
            V_linear_tetrahedron: $course::V_linear_tetrahedron,
            dV_linear_tetrahedron_dq: $course::dV_linear_tetrahedron_dq,
            d2V_linear_tetrahedron_dq2: $course::d2V_linear_tetrahedron_dq2,
            V_spring_particle_particle: $course::V_spring_particle_particle,
            dV_spring_particle_particle_dq: $course::dV_spring_particle_particle_dq,
            mass_matrix_linear_tetrahedron: $course::mass_matrix_linear_tetrahedron,
            mass_matrix_mesh: $course::mass_matrix_mesh,
            assemble_forces: $course::assemble_forces,
            assemble_stiffness: $course::assemble_stiffness,
            build_skinning_matrix: $course::build_skinning_matrix,
            fixed_point_constraints: $course::fixed_point_constraints,
            pick_nearest_vertices: $course::pick_nearest_vertices,
            quadrature_of_number: |V, element, volume, f| $course::quadrature_single_point(V, element, volume, f),
            quadrature_of_vector: |V, element, volume, f| $course::quadrature_single_point(V, element, volume, f),
            linearly_implicit_euler: |q, qdot, dt, mass, force, stiffness, solve| {
                $course::linearly_implicit_euler(q, qdot, dt, mass, force, stiffness, solve)
            },
            newtons_method: |x0, f, g, H, solve, max_steps| $course::newtons_method(x0, f, g, H, solve, max_steps),
            implicit_euler: |q, qdot, dt, mass, energy, force, stiffness, solve| {
                $course::implicit_euler(q, qdot, dt, mass, energy, force, stiffness, solve)
            },
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
        }

        /// A table in which every function panics like the handout's: what a program without a function answers when asked for it.
        pub const NOTHING: Functions = Functions {
            $($name: |$(_: $type),*| panic!("not yet implemented"),)*
        };
    };
}
all_functions!(table);
