//! Test matrices: K + M/dt² of a clamped beam of linear elasticity, 4 m × 1 m × 1 m.

use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};

use fem_elements::Real;
use fem_elements::sparse::{Pattern, Stored};
use fem_mesh::{TetrahedralMesh, box_mesh};
use fem_solvers::numbering::{Numbering, Ordering};

/// Young's modulus in Pa, Poisson's ratio, density in kg/m³.
const MATERIAL: (f64, f64, f64) = (6e5, 0.4, 1000.0);

/// A beam's mesh in the engine's numbering.
pub struct Beam {
    pub pattern: Arc<Pattern>,
    /// Positions of the free nodes, m.
    pub rest: Vec<[f64; 3]>,
    vertices: Vec<Vector3<f64>>,
    elements: Vec<[u32; 4]>,
}

impl Beam {
    /// A beam with its face x = 0 constrained.
    pub fn new(cells_per_unit: usize, stored: Stored) -> Self {
        Self::constrained_where(cells_per_unit, stored, |x| x.x == 0.0)
    }

    pub fn constrained_where(cells_per_unit: usize, stored: Stored, is_in: impl Fn(&Vector3<f64>) -> bool) -> Self {
        Self::of_mesh(box_mesh([4.0, 1.0, 1.0], cells_per_unit, fem_mesh::Pattern::Alternating).unwrap(), stored, is_in)
    }

    /// A beam of so many cells along and across, with this position for each point of the box 1 m × 1 m × 1 m, and its end x = 0 of the box
    /// constrained.
    pub fn mapped([along, across]: [usize; 2], stored: Stored, map: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let mut mesh =
            box_mesh([along as f64, across as f64, across as f64], 1, fem_mesh::Pattern::Alternating).unwrap();
        let sizes = Vector3::new(along as f64, across as f64, across as f64);
        let boxed: Vec<_> = mesh.vertices.iter().map(|x| x.component_div(&sizes)).collect();
        let is_end: std::collections::HashSet<_> =
            boxed.iter().filter(|x| x.x == 0.0).map(|x| map((*x).into()).map(f64::to_bits)).collect();
        mesh.vertices = boxed.into_iter().map(|x| map(x.into()).into()).collect();
        Self::of_mesh(mesh, stored, |x| is_end.contains(&[x.x, x.y, x.z].map(f64::to_bits)))
    }

    fn of_mesh(mesh: TetrahedralMesh, stored: Stored, is_in: impl Fn(&Vector3<f64>) -> bool) -> Self {
        let constrained: Vec<bool> = mesh.vertices.iter().map(is_in).collect();
        let numbering = Numbering::new(Ordering::FillReducing, &mesh.vertices, &mesh.elements, &constrained);
        let elements = numbering.elements(&mesh.elements);
        let vertices: Vec<_> = numbering.mesh_node.iter().map(|&node| mesh.vertices[node as usize]).collect();
        let rest = vertices[..numbering.free].iter().map(|x| [x.x, x.y, x.z]).collect();
        Self { pattern: Arc::new(Pattern::new(numbering.free, &elements, stored)), rest, vertices, elements }
    }

    /// K + M/dt² for dt = 0.01 s.
    pub fn values<T: Real>(&self) -> Vec<[[T; 3]; 3]> {
        self.scaled(|_| 1.0, 1e4)
    }

    /// Σ factor(element) K + masses M.
    pub fn scaled<T: Real>(&self, factor: impl Fn(usize) -> f64, masses: f64) -> Vec<[[T; 3]; 3]> {
        let mut values = vec![[[0.0; 3]; 3]; self.pattern.blocks()];
        for (number, element) in self.elements.iter().enumerate() {
            let x = element.map(|node| self.vertices[node as usize]);
            let (gradients, volume) = shape(&x);
            for (a, &row) in element.iter().enumerate() {
                for (b, &column) in element.iter().enumerate() {
                    let stiffness = stiffness(&gradients[a], &gradients[b]) * (volume * factor(number));
                    let mass = MATERIAL.2 * volume * masses * if a == b { 0.1 } else { 0.05 };
                    self.add(&mut values, [row, column], &(stiffness + Matrix3::identity() * mass));
                }
            }
        }
        values.into_iter().map(|block: [[f64; 3]; 3]| block.map(|row| row.map(T::of))).collect()
    }

    /// A x for a matrix A with these blocks.
    pub fn times<T: Real>(&self, values: &[[[T; 3]; 3]], x: &[[T; 3]]) -> Vec<[T; 3]> {
        let (pattern, mut y) = (&self.pattern, vec![[T::default(); 3]; x.len()]);
        for row in 0..pattern.rows() {
            for block in pattern.row(row) {
                let column = pattern.columns[block] as usize;
                for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
                    y[row][i] += values[block][i][j] * x[column][j];
                    if pattern.stored == Stored::Lower && row != column {
                        y[column][j] += values[block][i][j] * x[row][i];
                    }
                }
            }
        }
        y
    }

    fn add(&self, values: &mut [[[f64; 3]; 3]], [row, column]: [u32; 2], entry: &Matrix3<f64>) {
        let rows = self.pattern.rows() as u32;
        if row >= rows || column >= rows {
            return;
        }
        let Some(block) = self.pattern.find(row as usize, column as usize) else { return };
        for i in 0..3 {
            for j in 0..3 {
                values[block][i][j] += entry[(i, j)];
            }
        }
    }
}

/// Gradients of the four shape functions, and the volume.
fn shape(x: &[Vector3<f64>; 4]) -> ([Vector3<f64>; 4], f64) {
    let edges = Matrix3::from_columns(&[x[1] - x[0], x[2] - x[0], x[3] - x[0]]);
    let inverse = fem_elements::tensor::inverse(&edges);
    let rows = [0, 1, 2].map(|row| inverse.row(row).transpose());
    ([-(rows[0] + rows[1] + rows[2]), rows[0], rows[1], rows[2]], edges.determinant() / 6.0)
}

/// λ a bᵀ + μ (b aᵀ + a·b 1): the stiffness block of two nodes with shape function gradients a and b, per volume.
fn stiffness(a: &Vector3<f64>, b: &Vector3<f64>) -> Matrix3<f64> {
    let (young, poisson, _) = MATERIAL;
    let (lambda, mu) = (young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson)));
    lambda * a * b.transpose() + mu * (b * a.transpose() + Matrix3::identity() * a.dot(b))
}

/// Random numbers in −1..1 from a seed (Marsaglia's xorshift).
pub fn random<T: Real>(nodes: usize, seed: u64) -> Vec<[T; 3]> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut number = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        T::of((state >> 11) as f64 / (1u64 << 52) as f64 - 1.0)
    };
    (0..nodes).map(|_| [number(), number(), number()]).collect()
}
