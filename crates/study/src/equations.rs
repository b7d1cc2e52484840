//! The equations of motion that are left when a body is cut into elements, M ü = f(u, u̇, t): what a reference in time solves.
//!
//! Forces are the engine's, since the equations are the same whoever solves them. The mass is the consistent one (or the lumped
//! one that the scene asks for), put together anew here and factorised exactly.

use fem_engine::forces::acting::Acting;
use fem_engine::forces::pulls::{AnchorSpring, Pulls};
use fem_engine::model::system::System;
use fem_engine::solvers::SolverChoice;
use fem_mesh::volumes;
use fem_scene::{Body, Scene};

use super::ldl::Ldl;
use super::led::moves;
use fem_engine::materials::Material;

/// A body's equations of motion, in the engine's order of nodes.
pub struct Equations {
    /// The body.
    pub system: System<f64>,
    /// Of the nodes that are free in some direction.
    masses: Vec<MassFactor>,
    drag_stiffness: f64,
    /// Whether nodes are led along a motion; then [`lead`](Self::lead) goes before [`accelerations`](Self::accelerations).
    pub is_led: bool,
}

/// Nodes, the factor of their mass, and the directions that it is for.
type MassFactor = (Vec<usize>, Ldl, [bool; 3]);

/// What evaluations write to.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    springs: Vec<AnchorSpring<f64>>,
    force: Vec<[f64; 3]>,
    right: Vec<[f64; 3]>,
    /// Accelerations of led directions, zero elsewhere, m/s²; empty where nothing is led.
    pub led: Vec<[f64; 3]>,
}

impl Equations {
    /// Of a scene; says why, where there are none.
    pub fn new(scene: &Scene, body: Body) -> Result<Self, String> {
        let material = Material::<f64>::new(&scene.material).ok_or("the material lacks its moduli")?;
        let system = System::new(scene, body, material, SolverChoice::Cholesky);
        let masses = masses(scene, &system)?;
        let drag_stiffness = scene.drag.as_ref().map_or(0.0, |drag| drag.stiffness);
        let is_led = scene.prescribed.iter().any(moves);
        Ok(Self { system, masses, drag_stiffness, is_led })
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.system.nodes()
    }

    /// `a = M⁻¹ f(u, v, t)`, zero in held directions, m/s².
    pub fn accelerations(&self, u: &[[f64; 3]], v: &[[f64; 3]], time: f64, a: &mut [[f64; 3]], scratch: &mut Scratch) {
        let system = &self.system;
        let Scratch { springs, force, led, .. } = scratch;
        force.resize(self.nodes(), [0.0; 3]);
        Pulls { system, hand: None, stiffness: self.drag_stiffness }.at(time, springs);
        system.gradient(u, system.acting(springs), force);
        force.as_flattened_mut().iter_mut().for_each(|force| *force = -*force);
        system.add_pressures(1.0, u, force);
        if let Some(damping) = &system.damping {
            system.mass.add_times(-damping.alpha, v, force);
            system.add_stiffness_times(-damping.beta, u, v, force);
        }
        if !led.is_empty() {
            system.mass.add_times(-1.0, led, force);
        }
        self.divide_by_mass(scratch, a);
    }

    /// Velocities that the momentum −M `change` gives to nodes that are free, m/s; zero in held directions.
    pub fn momentum_to_velocity(&self, change: &[[f64; 3]], v: &mut [[f64; 3]], scratch: &mut Scratch) {
        scratch.force.clear();
        scratch.force.resize(self.nodes(), [0.0; 3]);
        self.system.mass.add_times(-1.0, change, &mut scratch.force);
        self.divide_by_mass(scratch, v);
    }

    /// a = M⁻¹ force.
    fn divide_by_mass(&self, Scratch { force, right, .. }: &mut Scratch, a: &mut [[f64; 3]]) {
        a.fill([0.0; 3]);
        for (nodes, factor, directions) in &self.masses {
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

    /// The fastest rate about rest, 1/s: that of the fastest vibration, by the power method on M⁻¹ K, a little too small; or, where
    /// that is faster, that of its decay, α + β ω².
    pub fn fastest(&self) -> f64 {
        let (n, mut scratch) = (self.nodes(), Scratch::default());
        let rest = vec![[0.0; 3]; n];
        // Rough, so that all modes take part, and the same on every machine.
        let mut d: Vec<[f64; 3]> =
            (0..n).map(|i| [0, 1, 2].map(|c| ((7 * i + 3 * c) as f64 * 1.618_034).fract() - 0.5)).collect();
        self.system.held.clear(&mut d);
        let mut square = 0.0;
        for _ in 0..POWERS {
            scratch.force.clear();
            scratch.force.resize(n, [0.0; 3]);
            self.system.add_stiffness_times(1.0, &rest, &d, &mut scratch.force);
            if let Some((_, node)) = &self.system.drag {
                for i in 0..3 {
                    scratch.force[*node][i] += self.drag_stiffness * d[*node][i];
                }
            }
            let mut next = vec![[0.0; 3]; n];
            self.divide_by_mass(&mut scratch, &mut next);
            let size = |x: &[[f64; 3]]| x.as_flattened().iter().map(|x| x * x).sum::<f64>().sqrt();
            square = size(&next) / size(&d).max(f64::MIN_POSITIVE);
            let over = 1.0 / size(&next).max(f64::MIN_POSITIVE);
            d = next.into_iter().map(|x| x.map(|x| over * x)).collect();
        }
        let decay = self.system.damping.as_ref().map_or(0.0, |damping| damping.alpha + damping.beta * square);
        square.sqrt().max(decay)
    }

    /// Kinetic and potential energy, J.
    pub fn energies(&self, u: &[[f64; 3]], v: &[[f64; 3]], time: f64) -> (f64, f64) {
        let mut springs = Vec::new();
        Pulls { system: &self.system, hand: None, stiffness: self.drag_stiffness }.at(time, &mut springs);
        let acting = Acting { pulls: &springs, load: self.system.dead_load.as_deref() };
        (self.system.mass.kinetic_energy(v), self.system.potential(u, acting).value)
    }
}

/// Multiplications of the power method.
const POWERS: usize = 60;

/// Directions that are free at the same nodes share a factor.
fn masses(scene: &Scene, system: &System<f64>) -> Result<Vec<MassFactor>, String> {
    let mut is_free = vec![[1.0; 3]; system.nodes()];
    system.held.clear(&mut is_free);
    let free = |axis: usize| (0..system.nodes()).filter(|&node| is_free[node][axis] > 0.0).collect::<Vec<_>>();
    let lists = [free(0), free(1), free(2)];
    let mut masses: Vec<MassFactor> = Vec::new();
    for (axis, nodes) in lists.into_iter().enumerate() {
        if let Some((_, _, directions)) = masses.iter_mut().find(|(known, ..)| *known == nodes) {
            directions[axis] = true;
            continue;
        }
        let factor = Ldl::new(&mass(scene, system, &nodes)).ok_or("the mass is not positive definite")?;
        masses.push((nodes, factor, std::array::from_fn(|i| i == axis)));
    }
    Ok(masses)
}

/// ∫ ρ φ_i φ_j of these nodes by columns, upper triangle, or its row sums.
fn mass(scene: &Scene, system: &System<f64>, nodes: &[usize]) -> Vec<Vec<(usize, f64)>> {
    let mesh = &system.shape.mesh;
    let mut place = vec![usize::MAX; mesh.vertices.len()];
    for (i, &node) in nodes.iter().enumerate() {
        place[system.order.mesh_node[node] as usize] = i;
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
    for (element, volume) in mesh.elements.iter().zip(volumes(mesh)) {
        let share = scene.material.density * volume / 20.0;
        for (a, &row) in element.iter().enumerate() {
            for (b, &column) in element.iter().enumerate() {
                let mass = if a == b { 2.0 * share } else { share };
                let column = if scene.mass.lumped { row } else { column };
                add(place[row], place[column], mass);
            }
        }
    }
    columns
}
