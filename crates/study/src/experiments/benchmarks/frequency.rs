//! The first frequencies of bending of a cantilever: S. Timoshenko's beam in the form of T. C. Huang, The Effect of Rotatory Inertia and of Shear Deformation
//! on the Frequency and Normal Mode Equations of Uniform Beams (1961).

use std::path::Path;
use std::time::Instant;

use fem_engine::simulator::double::{add_stiffness, system};
use fem_engine::solvers::SolverChoice;
use fem_model::{Body, Elastic, Law, Material};
use nalgebra::{Cholesky, DMatrix, Vector3};

use super::case::{Level, Mapped, Quantity, part, supported};
use crate::study::{Part, Result};

/// Length of the beam of 1 × 1 m, m.
const LENGTH: f64 = 20.0;
/// Young's modulus, Pa, Poisson's ratio, and density, kg/m³.
const ELASTIC: Elastic = Elastic { young: 1e6, poisson: 0.3 };
const DENSITY: f64 = 1000.0;

/// The first three.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let names = ["first (rad/s)", "second (rad/s)", "third (rad/s)"];
    let of: Vec<Quantity> = (names.into_iter().zip(timoshenko()))
        .map(|(name, reference)| Quantity { name, reference, tolerance: 5e-3, source: "Timoshenko's beam" })
        .collect();
    let text = "A beam of 20 × 1 × 1 m, of which one half lies beside the symmetry plane of its bending, E = 1 MPa, ν = 0.3. The smallest eigenvalues of stiffness and \
                consistent mass, by iterations of a subspace. The fixed end cannot contract, which makes the solid stiffer than the beam.";
    part(("beam-frequency", text), &of, (&[20, 40, 60], 2), quick, solve)
}

fn solve(cells: usize) -> Result<Level> {
    let across = cells / 10;
    let mapped =
        Mapped::cube([cells, across, across.div_ceil(2)], |x| x.component_mul(&Vector3::new(LENGTH, 1.0, 0.5)))?;
    let material = Material::new(Law::Linear(ELASTIC), DENSITY);
    let body = supported(mapped.mesh, material, &mapped.places, |place| {
        let is_end = place.x == 0.0;
        [is_end, is_end, is_end || place.z == 0.0]
    })?;
    let start = Instant::now();
    let values = frequencies(body)?;
    Ok(Level { nodes: mapped.places.len(), values: values[..3].to_vec(), seconds: start.elapsed().as_secs_f64() })
}

/// Vectors of the subspace, twice as many as are wanted.
const VECTORS: usize = 6;

/// The smallest angular frequencies of a body, of which the first half is accurate, rad/s: K. J. Bathe and E. L. Wilson, Solution Methods for Large
/// Eigenvalue Problems in Structural Mechanics (1973).
fn frequencies(body: Body) -> Result<Vec<f64>> {
    let system = system(body, SolverChoice::Cholesky);
    let (nodes, free) = (system.nodes(), system.free());
    let mut values = vec![[[0.0; 3]; 3]; system.pattern.blocks()];
    add_stiffness(&system, &vec![[0.0; 3]; nodes], &mut values);
    system.dirichlet.eliminate(&system.pattern, &mut values);
    let mut solver = system.solver(SolverChoice::Cholesky);
    solver.prepare(&values).map_err(|breakdown| format!("{breakdown:?}"))?;
    let mass_times = |x: &DMatrix<f64>| {
        let mut product = DMatrix::zeros(3 * nodes, VECTORS);
        for (x, product) in x.as_slice().chunks_exact(3 * nodes).zip(product.as_mut_slice().chunks_exact_mut(3 * nodes))
        {
            let product = product.as_chunks_mut().0;
            system.add_mass_times(1.0, x.as_chunks().0, product);
            system.dirichlet.clear_constrained(product);
        }
        product
    };
    let mut forces = mass_times(&DMatrix::from_fn(3 * nodes, VECTORS, |i, mode| (0.7 * (i * (mode + 1)) as f64).sin()));
    let mut squares = vec![0.0; VECTORS];
    for _ in 0..100 {
        // K X = M X₀, then the modes of the subspace of X.
        let mut x = DMatrix::zeros(3 * nodes, VECTORS);
        for (x, force) in x.as_mut_slice().chunks_exact_mut(3 * nodes).zip(forces.as_slice().chunks_exact(3 * nodes)) {
            solver.apply(&force.as_chunks().0[..free], &mut x.as_chunks_mut().0[..free]);
        }
        let (next, modes) = modes(x.tr_mul(&forces), x.tr_mul(&mass_times(&x)))?;
        if (0..VECTORS / 2).all(|mode| (next[mode] - squares[mode]).abs() < 1e-9 * next[mode]) {
            return Ok(next.into_iter().map(f64::sqrt).collect());
        }
        (forces, squares) = (mass_times(&(x * modes)), next);
    }
    Err("the iterations of the subspace have not converged".into())
}

/// The eigenvalues of a stiffness and a mass, ascending, and the eigenvectors, in any order.
fn modes(stiffness: DMatrix<f64>, mass: DMatrix<f64>) -> Result<(Vec<f64>, DMatrix<f64>)> {
    let dependent = "the vectors of the subspace depend on each other";
    let lower = Cholesky::new(mass).ok_or(dependent)?.l();
    let by_lower = |A: DMatrix<f64>| lower.solve_lower_triangular(&A).ok_or(dependent);
    let eigen = by_lower(by_lower(0.5 * (&stiffness + stiffness.transpose()))?.transpose())?.symmetric_eigen();
    let mut squares: Vec<f64> = eigen.eigenvalues.iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    Ok((squares, lower.tr_solve_lower_triangular(&eigen.eigenvectors).ok_or(dependent)?))
}

/// The roots b = ω L² √(ρA/(E I)) of Huang's equation of a cantilever, as angular frequencies, rad/s, with Cowper's coefficient of shear.
fn timoshenko() -> [f64; 3] {
    let Elastic { young, poisson } = ELASTIC;
    let shear = 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson) / (2.0 * (1.0 + poisson));
    let inertia = 1.0 / 12.0;
    // r² and s² of the reference.
    let [r, s] = [inertia / LENGTH.powi(2), inertia / (shear * LENGTH.powi(2))];
    let equation = |b: f64| {
        let root = ((r - s).powi(2) + 4.0 / (b * b)).sqrt();
        let [alpha, beta] = [(0.5 * (root - r - s)).sqrt() * b, (0.5 * (root + r + s)).sqrt() * b];
        2.0 + (b * b * (r - s).powi(2) + 2.0) * alpha.cosh() * beta.cos()
            - b * (r + s) / (1.0 - b * b * r * s).sqrt() * alpha.sinh() * beta.sin()
    };
    // Near those of Euler and Bernoulli, from which rotatory inertia and shear take some per cent.
    [3.516, 22.03, 61.70].map(|euler| {
        let (mut low, mut high) = (0.8 * euler, 1.02 * euler);
        let sign = equation(low).signum();
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if equation(middle) * sign > 0.0 { low = middle } else { high = middle }
        }
        low / LENGTH.powi(2) * (young * inertia / DENSITY).sqrt()
    })
}
