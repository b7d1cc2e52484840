//! Systems of equations with known solutions, in single and in double precision. Each test is skipped, with one line, where there is no adapter.

use std::sync::Arc;

use fem_gpu::{BlockPattern, ConjugateGradients, Device, Number, Outcome, Solved};

/// A device, or a line that says why the test is skipped.
fn device() -> Option<Arc<Device>> {
    Device::open().map_err(|error| println!("skipped: {error}")).ok()
}

/// Tests on a device are skipped without one. Under CI (the variable `CI` is set) this test fails then, unless `FEM_NO_DEVICE` is set.
#[test]
fn under_ci_there_is_a_device() {
    let may_be_missing = std::env::var_os("CI").is_none() || std::env::var_os("FEM_NO_DEVICE").is_some();
    if let (Err(error), false) = (Device::open(), may_be_missing) {
        panic!("{error}; install a driver such as mesa-vulkan-drivers, or set FEM_NO_DEVICE=1");
    }
}

/// A lattice of nodes joined with their neighbours by springs of various stiffness, each node with one to the ground.
struct Lattice {
    pattern: BlockPattern,
    values: Vec<[[f64; 3]; 3]>,
    diagonal: Vec<usize>,
}

impl Lattice {
    fn new(n: usize, ground: f64) -> Self {
        let (mut starts, mut columns, mut values, mut diagonal) = (vec![0], Vec::new(), Vec::new(), Vec::new());
        for row in 0..n * n * n {
            let place = [row % n, row / n % n, row / (n * n)];
            let mut sum = [[0.0; 3]; 3];
            (0..3).for_each(|i| sum[i][i] = ground);
            let mut blocks = Vec::new();
            for (axis, size) in [1, n, n * n].into_iter().enumerate() {
                for (is_there, other) in [(place[axis] > 0, row.wrapping_sub(size)), (place[axis] + 1 < n, row + size)]
                {
                    if !is_there {
                        continue;
                    }
                    let stiffness = 1.0 + ((row.min(other) * 7 + axis) % 11) as f64;
                    // Along the axis, and a tenth across it.
                    let block: [[f64; 3]; 3] = std::array::from_fn(|i| {
                        std::array::from_fn(|j| match (i == j, i == axis) {
                            (true, true) => stiffness,
                            (true, false) => 0.1 * stiffness,
                            _ => 0.03 * stiffness,
                        })
                    });
                    (0..9).for_each(|k| sum[k / 3][k % 3] += block[k / 3][k % 3]);
                    blocks.push((other, block.map(|row| row.map(|entry| -entry))));
                }
            }
            blocks.push((row, sum));
            blocks.sort_by_key(|(column, _)| *column);
            for (column, block) in blocks {
                if column == row {
                    diagonal.push(values.len());
                }
                columns.push(column as u32);
                values.push(block);
            }
            starts.push(columns.len() as u32);
        }
        Self { pattern: BlockPattern { starts, columns }, values, diagonal }
    }

    fn product(&self, x: &[f64]) -> Vec<f64> {
        let rows = self.pattern.rows();
        let mut y = vec![0.0; 3 * rows];
        for row in 0..rows {
            for block in self.pattern.starts[row] as usize..self.pattern.starts[row + 1] as usize {
                let column = 3 * self.pattern.columns[block] as usize;
                for (i, entries) in self.values[block].iter().enumerate() {
                    y[3 * row + i] += (0..3).map(|j| entries[j] * x[column + j]).sum::<f64>();
                }
            }
        }
        y
    }

    fn solve<T: Number>(&self, device: &Arc<Device>, b: &[f64], tolerance: f64) -> (Solved, Vec<T>) {
        let mut solver = ConjugateGradients::<T>::new(device, &self.pattern, None).unwrap();
        solver.set_matrix(|block| self.values[block]).unwrap();
        solver.solve(b.iter().copied(), tolerance, 1000).unwrap()
    }
}

/// Some numbers of about one, of norm one together.
fn right_hand_side(rows: usize) -> Vec<f64> {
    let b: Vec<f64> = (0..3 * rows).map(|k| ((k * 37 % 101) as f64 - 50.0) / 50.0).collect();
    let norm = norm(&b);
    b.iter().map(|b| b / norm).collect()
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// ‖b − A x‖ in double precision.
fn residual<T: Number>(lattice: &Lattice, b: &[f64], x: &[T]) -> f64 {
    let x: Vec<f64> = x.iter().map(|x| x.as_f64()).collect();
    norm(&lattice.product(&x).iter().zip(b).map(|(y, b)| b - y).collect::<Vec<_>>())
}

#[test]
fn a_system_is_solved_in_single_precision_to_its_rounding_error() {
    let Some(device) = device() else { return };
    let lattice = Lattice::new(13, 0.1);
    let b = right_hand_side(lattice.pattern.rows());
    let (solved, x) = lattice.solve::<f32>(&device, &b, 1e-5);
    let residual = residual(&lattice, &b, &x);
    println!("{}: {} iterations, residual {residual:e}", device.adapter(), solved.iterations);
    assert_eq!(solved.outcome, Outcome::Converged);
    assert!(solved.residual <= 1e-5 && residual < 3e-5 && solved.iterations < 60, "{solved:?}, {residual:e}");
}

#[test]
fn a_system_is_solved_in_double_precision_to_twelve_digits() {
    let Some(device) = device().filter(|device| device.has_double_precision()) else { return };
    let lattice = Lattice::new(9, 0.1);
    let b = right_hand_side(lattice.pattern.rows());
    let (solved, x) = lattice.solve::<f64>(&device, &b, 1e-13);
    let residual = residual(&lattice, &b, &x);
    println!("{} iterations, residual {residual:e}", solved.iterations);
    assert_eq!(solved.outcome, Outcome::Converged);
    assert!(residual < 2e-13, "{residual:e}");
}

#[test]
fn a_tolerance_beyond_the_number_type_ends_at_its_rounding_error() {
    let Some(device) = device() else { return };
    let lattice = Lattice::new(9, 1e-3);
    let b = right_hand_side(lattice.pattern.rows());
    let (solved, x) = lattice.solve::<f32>(&device, &b, 1e-30);
    assert!([Outcome::Stagnated, Outcome::Converged].contains(&solved.outcome), "{solved:?}");
    let residual = residual(&lattice, &b, &x);
    assert!(residual > 1e-9 && residual < 1e-4, "{residual:e}");
}

#[test]
fn a_matrix_that_is_not_positive_definite_is_told() {
    let Some(device) = device() else { return };
    let mut lattice = Lattice::new(7, 0.1);
    let middle = lattice.diagonal[171];
    lattice.values[middle][1][1] = -100.0;
    let b = right_hand_side(lattice.pattern.rows());
    let (solved, _) = lattice.solve::<f32>(&device, &b, 1e-5);
    assert_eq!(solved.outcome, Outcome::NegativeCurvature, "{solved:?}");
}

#[test]
fn a_number_that_is_not_finite_is_told() {
    let Some(device) = device() else { return };
    let mut lattice = Lattice::new(5, 0.1);
    lattice.values[40][0][0] = f64::NAN;
    let b = right_hand_side(lattice.pattern.rows());
    let (solved, _) = lattice.solve::<f32>(&device, &b, 1e-5);
    assert_eq!(solved.outcome, Outcome::NotFinite, "{solved:?}");
}

#[test]
fn a_device_that_is_lost_fails_with_its_name() {
    let Some(device) = device() else { return };
    device.lose();
    let error = ConjugateGradients::<f32>::new(&device, &Lattice::new(3, 0.1).pattern, None).err().unwrap();
    assert!(error.to_string().contains(device.adapter()), "{error}");
    assert!(error.to_string().contains("lost"), "{error}");
}
