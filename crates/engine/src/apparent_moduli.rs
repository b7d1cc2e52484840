//! The apparent elastic moduli of a mass-spring body at small strain, measured on its undeformed springs.
//!
//! The nodes of the boundary follow a uniform strain and the others are in equilibrium: kinematic uniform boundary conditions, Huet,
//! Application of variational concepts to size effects in elastic heterogeneous bodies (1990). Their energies give a
//! stiffness tensor. It lies below that of springs which all follow the strain, as these would have Cauchy's symmetry, and above that of
//! an infinite body of the same springs.

use std::f64::consts::PI;

use fem_model::{Body, DirichletCondition, ForceFields};
use nalgebra::{DMatrix, DVector, Vector3};

use crate::forces::{HessianKind, mass_spring};
use crate::model::system::System;
use fem_elements::vector::{axpy, dot};
use fem_solvers::{Preconditioner, SolverChoice};

/// Number of nodes up to which one factor is cheaper than iterations for each strain.
const DIRECT: usize = 20_000;

/// Relative residual of the equilibrium of the nodes inside.
const TOLERANCE: f64 = 1e-10;

/// Directions in which Young's modulus is compared.
const DIRECTIONS: usize = 400;

/// Elastic moduli of a body at small strain. Those of a flat body are of its plane: a bar in it has the modulus E and contracts by ν.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ApparentModuli {
    /// Young's modulus E of the isotropic mean (Voigt) of the measured stiffness, Pa.
    pub young: f64,
    /// Poisson's ratio of the same.
    pub poisson: f64,
    /// Smallest and largest Young's modulus of bars in single directions, Pa.
    pub young_of_directions: [f64; 2],
    /// Young's modulus if all nodes followed the strain, Pa; Poisson's ratio would be 1/4, or 1/3 in the plane.
    pub affine_young: f64,
    /// Number of nodes inside, which the measurement relaxes.
    pub inside: usize,
}

/// Measures the moduli of a mass-spring body; `None` for a body of elastic elements. Returns an error if its stiffness cannot be factored.
pub fn apparent_moduli(body: &Body) -> Result<Option<ApparentModuli>, String> {
    if !body.material.is_mass_spring() {
        return Ok(None);
    }
    let dimension = body.shape.mesh.dimension();
    let system = System::<f64>::new(with_fixed_boundary(body), None, choice(body.shape.mesh.vertices().len()));
    let strains = strains(dimension);
    let moved = relaxed(&system, &strains)?;
    let volume: f64 = body.shape.mesh.volumes().iter().sum();
    let undeformed = vec![[0.0; 3]; system.nodes()];
    let mut stiffness = DMatrix::zeros(moved.len(), moved.len());
    for (k, u) in moved.iter().enumerate() {
        let mut force = undeformed.clone();
        system.add_stiffness_times(1.0, &undeformed, u, &mut force);
        for (l, other) in moved.iter().enumerate() {
            stiffness[(k, l)] = dot(&force, other) / volume;
        }
    }
    let (young, poisson) = isotropic_mean(&stiffness);
    let shear = mass_spring::shear_modulus(body);
    Ok(Some(ApparentModuli {
        young,
        poisson,
        young_of_directions: young_of_directions(&stiffness)?,
        // E = 2 G (1 + ν), and Cauchy's relations give ν = 1/(d + 1) in d dimensions.
        affine_young: shear * ((2 * (dimension + 2)) as f64 / (dimension + 1) as f64),
        inside: system.free(),
    }))
}

/// The springs alone, with all nodes of the boundary fixed.
fn with_fixed_boundary(body: &Body) -> Body {
    let mesh = &body.shape.mesh;
    let mut is_outside = vec![false; mesh.vertices().len()];
    body.shape.faces().into_iter().flatten().for_each(|node| is_outside[node] = true);
    let boundary = DirichletCondition {
        name: "boundary".to_owned(),
        nodes: (0..is_outside.len()).filter(|&node| is_outside[node]).collect(),
        components: [true; 3],
        motion: None,
        until: None,
    };
    Body {
        gravity: None,
        body_force: None,
        dirichlet: vec![boundary],
        initial_velocity: Vec::new(),
        tractions: Vec::new(),
        nodal_forces: Vec::new(),
        pressures: Vec::new(),
        fields: ForceFields::default(),
        fibres: Vec::new(),
        springs: Vec::new(),
        contact: None,
        drag: None,
        damping: None,
        ..body.clone()
    }
}

fn choice(nodes: usize) -> SolverChoice {
    match nodes {
        0..=DIRECT => SolverChoice::Cholesky,
        _ => SolverChoice::Pcg(Preconditioner::Multigrid),
    }
}

/// The displacement gradients of strains of one unit each, in Voigt's order: xx, yy, zz, yz, xz, xy; xx, yy, xy in the plane.
fn strains(dimension: usize) -> Vec<[[f64; 3]; 3]> {
    const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [1, 2], [0, 2], [0, 1]];
    let strain = |&[i, j]: &[usize; 2]| {
        let mut strain = [[0.0; 3]; 3];
        strain[i][j] += 0.5;
        strain[j][i] += 0.5;
        strain
    };
    PAIRS.iter().filter(|[i, j]| *i < dimension && *j < dimension).map(strain).collect()
}

/// The displacements of all nodes for each strain, m.
fn relaxed(system: &System<f64>, strains: &[[[f64; 3]; 3]]) -> Result<Vec<Vec<[f64; 3]>>, String> {
    let undeformed = vec![[0.0; 3]; system.nodes()];
    let uniform = |strain: &[[f64; 3]; 3]| -> Vec<[f64; 3]> {
        system.rest.iter().map(|X| strain.map(|row| Vector3::from(row).dot(X))).collect()
    };
    let mut moved: Vec<_> = strains.iter().map(uniform).collect();
    if system.free() == 0 {
        return Ok(moved);
    }
    let mut values = vec![[[0.0; 3]; 3]; system.pattern.blocks()];
    system.add_stiffness(1.0, &undeformed, HessianKind::Exact, &mut values);
    system.dirichlet.eliminate(&system.pattern, &mut values);
    let mut solver = system.solver(choice(system.nodes()));
    let failed = |cause: fem_model::simulation::Breakdown| format!("the nodes inside have no equilibrium: {cause}");
    solver.prepare(&values).map_err(failed)?;
    for u in &mut moved {
        let (mut force, mut change) = (undeformed.clone(), undeformed.clone());
        system.add_stiffness_times(-1.0, &undeformed, u, &mut force);
        system.dirichlet.clear_constrained(&mut force);
        solver.solve(&values, &force, &mut change, TOLERANCE).map_err(failed)?;
        system.dirichlet.clear_constrained(&mut change);
        axpy(1.0, &change, u);
    }
    Ok(moved)
}

/// E and ν of the isotropic mean of a stiffness tensor over all directions (Voigt), from its two invariants: bulk modulus K and shear
/// modulus G, E = 9KG/(3K + G) and ν = (3K − 2G)/(6K + 2G); in the plane E = 4KG/(K + G) and ν = (K − G)/(K + G).
fn isotropic_mean(C: &DMatrix<f64>) -> (f64, f64) {
    let d = if C.nrows() == 3 { 2 } else { 3 };
    let (mut along, mut beside) = (0.0, 0.0);
    for i in 0..d {
        along += C[(i, i)];
        beside += (0..d).filter(|&j| j != i).map(|j| C[(i, j)]).sum::<f64>();
    }
    let shear: f64 = (d..C.nrows()).map(|i| C[(i, i)]).sum();
    if d == 2 {
        let (K, G) = ((along + beside) / 4.0, (along - beside + 4.0 * shear) / 8.0);
        (4.0 * K * G / (K + G), (K - G) / (K + G))
    } else {
        let (K, G) = ((along + beside) / 9.0, (2.0 * along - beside + 6.0 * shear) / 30.0);
        (9.0 * K * G / (3.0 * K + G), (3.0 * K - 2.0 * G) / (6.0 * K + 2.0 * G))
    }
}

/// Smallest and largest E(n) = 1/(s·C⁻¹ s) with the stress s = n⊗n, Nye, Physical Properties of Crystals (1985), ch. VIII.
fn young_of_directions(C: &DMatrix<f64>) -> Result<[f64; 2], String> {
    let compliance = C.clone().lu().try_inverse().ok_or("the springs do not resist every strain")?;
    let young = |n: [f64; 3]| {
        let [x, y, z] = n;
        let s = match C.nrows() {
            3 => DVector::from_column_slice(&[x * x, y * y, x * y]),
            _ => DVector::from_column_slice(&[x * x, y * y, z * z, y * z, x * z, x * y]),
        };
        1.0 / s.dot(&(&compliance * &s))
    };
    let all = (0..DIRECTIONS).map(|k| young(direction(k, C.nrows() == 3)));
    Ok(all.fold([f64::INFINITY, 0.0], |[least, most], young| [young.min(least), young.max(most)]))
}

/// Directions that cover half a circle, or half a sphere by the golden angle.
fn direction(k: usize, is_in_plane: bool) -> [f64; 3] {
    let part = k as f64 / DIRECTIONS as f64;
    if is_in_plane {
        let (sin, cos) = (PI * part).sin_cos();
        return [cos, sin, 0.0];
    }
    let (z, angle) = (1.0 - part, PI * (3.0 - 5f64.sqrt()) * k as f64);
    let radius = (1.0 - z * z).sqrt();
    [radius * angle.cos(), radius * angle.sin(), z]
}
