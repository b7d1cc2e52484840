//! A trial: one call of one function on known input, and the observed answer.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix4, Vector3, Vector4};
use nalgebra_sparse::CsrMatrix;

use super::systems::{Objective, System};

/// Input of the functions of one deformed element.
#[derive(Clone, Debug)]
pub struct Elastic {
    pub q: DVector<f64>,
    pub V: Vec<Vector3<f64>>,
    pub element: [usize; 4],
    pub volume: f64,
    pub C: f64,
    pub D: f64,
}

/// Input of the functions of a deformed mesh.
#[derive(Clone, Debug)]
pub struct Mesh {
    pub q: DVector<f64>,
    pub V: Vec<Vector3<f64>>,
    pub T: Vec<[usize; 4]>,
    pub v0: Vec<f64>,
    pub C: f64,
    pub D: f64,
}

/// Input of `pick_nearest_vertices`.
#[derive(Clone, Debug)]
pub struct Pick {
    pub win: Vector3<f64>,
    pub view: Matrix4<f32>,
    pub proj: Matrix4<f32>,
    pub viewport: Vector4<f32>,
    pub V: Vec<Vector3<f64>>,
    pub F: Vec<[usize; 3]>,
    pub radius: f64,
}

/// Input of an integrator.
#[derive(Clone, Debug)]
pub struct Step {
    pub system: System,
    pub q: DVector<f64>,
    pub qdot: DVector<f64>,
    pub dt: f64,
}

/// An integrand c₀ + c₁ X + c₂ Y + c₃ Z + c₄ X Y with one component or several.
#[derive(Clone, Debug)]
pub struct Integrand {
    /// Coefficients c₀ … c₄ of each component.
    pub terms: Vec<[f64; 5]>,
}

/// The arguments of a call.
#[derive(Clone, Debug)]
pub enum Input {
    /// Shape functions and their gradients.
    Shape { V: Vec<Vector3<f64>>, element: [usize; 4], x: Vector3<f64> },
    /// Energy density and its derivatives.
    Density { F: Matrix3<f64>, C: f64, D: f64 },
    /// Kinetic energy of an element.
    Kinetic { qdot: DVector<f64>, element: [usize; 4], density: f64, volume: f64 },
    /// An integral over an element.
    Quadrature { V: Vec<Vector3<f64>>, element: [usize; 4], volume: f64, integrand: Integrand },
    /// Elastic energy of an element and its derivatives.
    Elastic(Elastic),
    /// A spring.
    Spring { q0: Vector3<f64>, q1: Vector3<f64>, l0: f64, stiffness: f64 },
    /// Mass matrix of an element.
    ElementMass { density: f64, volume: f64 },
    /// Mass matrix of a mesh.
    MeshMass { q_size: usize, T: Vec<[usize; 4]>, density: f64, v0: Vec<f64> },
    /// Assembled force and stiffness.
    Mesh(Mesh),
    /// Display vertices in a mesh.
    Skinning { V: Vec<Vector3<f64>>, T: Vec<[usize; 4]>, V_skin: Vec<Vector3<f64>> },
    /// Constrained vertices.
    Fixed { q_size: usize, indices: Vec<usize> },
    /// A pixel and what it shows.
    Pick(Pick),
    /// A step of an integrator.
    Step(Step),
    /// Newton's method.
    Minimum { objective: Objective, start: DVector<f64>, max_steps: usize },
}

/// One call on known input.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The function that is called.
    pub function: &'static str,
    /// Name of the kind of input.
    pub name: &'static str,
    /// The input is a limiting case, which a formula alone does not cover.
    pub edge: bool,
    /// The arguments.
    pub input: Input,
    /// Size of the terms that the numbers are added up from, one for each number; the last one stands for all that follow.
    pub scales: Vec<f64>,
}

/// The observed answer of a call.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observed {
    /// Rows and columns.
    pub shape: [usize; 2],
    /// Row by row.
    pub numbers: Vec<f64>,
    /// Number of calls of each closure.
    pub calls: Vec<(&'static str, usize)>,
    /// Norm of the gradient that is left, relative to that at the start.
    pub residual: Option<f64>,
}

/// Limit of the size of an answer, far above that of any right one.
const MOST_ENTRIES: usize = 1 << 20;

impl Observed {
    /// A list of numbers.
    pub fn vector(numbers: Vec<f64>) -> Self {
        Self { shape: [numbers.len(), 1], numbers, ..Self::default() }
    }

    /// A matrix, given by its entries.
    pub fn matrix(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let numbers = (0..rows * columns).map(|k| entry(k / columns, k % columns)).collect();
        Self { shape: [rows, columns], numbers, ..Self::default() }
    }

    /// A sparse matrix, whether or not it stores its zeros.
    pub fn sparse(matrix: &CsrMatrix<f64>) -> Self {
        let shape = [matrix.nrows(), matrix.ncols()];
        // A submission may return a matrix of any size; one so large is wrong, and is not written out.
        let small = shape[0].checked_mul(shape[1]).is_some_and(|entries| entries <= MOST_ENTRIES);
        if !small {
            return Self { shape, ..Self::default() };
        }
        let dense = DMatrix::from(matrix);
        Self::matrix(dense.nrows(), dense.ncols(), |i, j| dense[(i, j)])
    }

    /// The entry in a row and a column.
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        self.numbers[row * self.shape[1] + column]
    }
}

impl Trial {
    /// The size that the number at `index` is judged against.
    pub fn scale(&self, index: usize) -> f64 {
        self.scales.get(index).or(self.scales.last()).copied().unwrap_or(1.0)
    }
}
