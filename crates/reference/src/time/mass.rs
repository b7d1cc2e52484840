//! The inverse mass matrix of the reference, factorised exactly.

use fem_engine::simulator::double::System;
use fem_model::element::shares::lumped_mass_shares;
use fem_model::{Body, BodyMesh};

use super::ldl::Ldl;
use crate::space::points::points;

/// Factors of the mass matrix: directions that are free at the same nodes share one.
pub(super) struct MassInverse(Vec<Factor>);

struct Factor {
    /// Nodes that are free in these directions, in the engine's numbering.
    nodes: Vec<usize>,
    factor: Ldl,
    directions: [bool; 3],
}

impl MassInverse {
    /// Factorises the consistent mass, or the lumped one if the body has that.
    pub fn new(body: &Body, system: &System) -> Result<Self, String> {
        let mut is_free = vec![[1.0; 3]; system.nodes()];
        system.dirichlet.clear_constrained(&mut is_free);
        let mut factors: Vec<Factor> = Vec::new();
        for axis in 0..3 {
            let nodes: Vec<usize> = (0..system.nodes()).filter(|&node| is_free[node][axis] > 0.0).collect();
            if let Some(known) = factors.iter_mut().find(|known| known.nodes == nodes) {
                known.directions[axis] = true;
                continue;
            }
            let factor = Ldl::new(&mass(body, system, &nodes)).ok_or("the mass is not positive definite")?;
            factors.push(Factor { nodes, factor, directions: std::array::from_fn(|i| i == axis) });
        }
        Ok(Self(factors))
    }

    /// a = M⁻¹ force, zero in constrained directions. `right` is working memory.
    pub fn apply(&self, force: &[[f64; 3]], a: &mut [[f64; 3]], right: &mut Vec<[f64; 3]>) {
        a.fill([0.0; 3]);
        for Factor { nodes, factor, directions } in &self.0 {
            right.clear();
            right.extend(nodes.iter().map(|&node| force[node]));
            factor.solve(right);
            for (&node, right) in nodes.iter().zip(&*right) {
                for i in (0..3).filter(|&i| directions[i]) {
                    a[node][i] = right[i];
                }
            }
        }
    }
}

/// ∫ φ_i φ_j over an element of unit volume, row by row, by a rule of degree 7.
fn shares(mesh: &BodyMesh) -> Vec<f64> {
    let points = points(mesh);
    let nodes = points[0].values.len();
    let entry = |i: usize, j: usize| points.iter().map(|at| at.weight * at.values[i] * at.values[j]).sum();
    (0..nodes * nodes).map(|k| entry(k / nodes, k % nodes)).collect()
}

/// ∫ ρ φ_i φ_j of these nodes, or the lumped mass: the upper triangle by columns, kg.
fn mass(body: &Body, system: &System, nodes: &[usize]) -> Vec<Vec<(usize, f64)>> {
    let mesh = &system.shape.mesh;
    let mut place = vec![usize::MAX; mesh.vertices().len()];
    for (i, &node) in nodes.iter().enumerate() {
        place[system.numbering.mesh_node[node] as usize] = i;
    }
    let mut columns: Vec<Vec<(usize, f64)>> = (0..nodes.len()).map(|i| vec![(i, 0.0)]).collect();
    let mut add = |row: usize, column: usize, mass: f64| {
        if row > column || column == usize::MAX {
            return;
        }
        match columns[column].iter_mut().find(|(i, _)| *i == row) {
            Some((_, sum)) => *sum += mass,
            None => columns[column].push((row, mass)),
        }
    };
    let (shares, lumped) = (shares(mesh), lumped_mass_shares(mesh.element()));
    for (number, (corners, volume)) in mesh.corners().zip(mesh.volumes()).enumerate() {
        let mass = body.material.density * body.density_factors.get(number).copied().unwrap_or(1.0) * volume;
        for (a, &row) in corners.iter().enumerate() {
            if body.lumped_mass {
                add(place[row], place[row], mass * lumped[a]);
                continue;
            }
            for (b, &column) in corners.iter().enumerate() {
                add(place[row], place[column], mass * shares[a * corners.len() + b]);
            }
        }
    }
    columns
}
