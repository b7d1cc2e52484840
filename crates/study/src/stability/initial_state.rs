//! Initial states, random and not.

use fem_engine::simulator::Simulator;
use nalgebra::Vector3;
use rand::rngs::ChaCha8Rng;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};

/// Random numbers: ChaCha with eight rounds (D. J. Bernstein, ChaCha, a variant of Salsa20, 2008). A seed gives the same numbers on
/// every machine.
pub struct Random(ChaCha8Rng);

impl Random {
    /// The generator of a seed.
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// Uniform in [−1, 1)³.
    pub fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| 2.0 * self.0.random::<f64>() - 1.0)
    }

    /// Uniform on the unit sphere.
    pub fn direction(&mut self) -> Vector3<f64> {
        loop {
            let v = self.vector();
            let length = v.norm();
            if (0.1..=1.0).contains(&length) {
                return v / length;
            }
        }
    }

    /// A permutation of 0 … n − 1.
    pub fn permutation(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        order.shuffle(&mut self.0);
        order
    }
}

/// Moves free nodes to the positions that `place` gives, with zero velocity.
pub fn place(simulation: &mut Simulator<f64>, mut place: impl FnMut(&Vector3<f64>) -> Vector3<f64>) {
    place_moving(simulation, |X| (place(X), Vector3::zeros()));
}

/// Moves free nodes to positions, m, and sets their velocities, m/s.
pub fn place_moving(
    simulation: &mut Simulator<f64>,
    mut place: impl FnMut(&Vector3<f64>) -> (Vector3<f64>, Vector3<f64>),
) {
    let system = simulation.system();
    let free = |node: usize| (system.numbering.engine_node[node] as usize) < system.free();
    let mut displacements = Vec::new();
    let mut velocities = Vec::new();
    for (node, X) in system.shape.mesh.vertices().iter().enumerate() {
        let (x, v) = if free(node) { place(X) } else { (*X, Vector3::zeros()) };
        displacements.push((x - X).into());
        velocities.push(v.into());
    }
    simulation.set_state(&displacements, &velocities);
}

/// Largest displacement of a node, relative to the body's length.
pub fn distance_from_rest(simulation: &Simulator<f64>) -> f64 {
    let u = simulation.state().u.iter().map(|u| Vector3::from(*u).norm());
    u.fold(0.0, f64::max) / simulation.system().length
}

/// Largest speed of a node, body lengths per second.
pub fn largest_speed(simulation: &Simulator<f64>) -> f64 {
    let speeds = simulation.state().v.iter().map(|v| Vector3::from(*v).norm());
    speeds.fold(0.0, f64::max) / simulation.system().length
}

/// Position of a node from its undeformed one.
pub type Tangle = fn(&mut Random, &Vector3<f64>) -> Vector3<f64>;

/// Initial positions about the centre of a box of 2 × 1 × 1 m.
pub const TANGLES: [(&str, Tangle); 5] = [
    ("random positions", |random, _| CENTRE + Vector3::new(1.0, 0.5, 0.5).component_mul(&random.vector())),
    ("reflected", |_, X| Vector3::new(X.x, 1.0 - X.y, X.z)),
    ("flattened to a plane", |random, X| Vector3::new(X.x, X.y, 0.5) + 1e-3 * random.vector()),
    ("squashed to 2 % of its height", |random, X| Vector3::new(X.x, X.y, 0.02 * X.z) + 1e-3 * random.vector()),
    ("collapsed to a point", |random, _| CENTRE + 1e-3 * random.vector()),
];

/// The centre of that box.
pub const CENTRE: Vector3<f64> = Vector3::new(1.0, 0.5, 0.5);
