//! Where bodies start: numbers that look random and are the same in every run.

use nalgebra::Vector3;

use fem_engine::simulator::Simulator;

/// Evenly spread numbers: SplitMix64 by Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators (2014).
pub struct Random(u64);

impl Random {
    /// The numbers that belong to a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next one, in [−1, 1).
    pub fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Three of them.
    pub fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.number())
    }

    /// Of length 1, every direction as likely.
    pub fn direction(&mut self) -> Vector3<f64> {
        loop {
            let v = self.vector();
            let length = v.norm();
            if (0.1..=1.0).contains(&length) {
                return v / length;
            }
        }
    }

    /// 0 … n − 1 in some order: Fisher and Yates (1938).
    pub fn permutation(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        for i in (1..n).rev() {
            let j = (self.bits() % (i as u64 + 1)) as usize;
            order.swap(i, j);
        }
        order
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

/// Moves the nodes that nothing holds wholly to where `place` says, without velocity.
pub fn place(simulation: &mut Simulator<f64>, mut place: impl FnMut(&Vector3<f64>) -> Vector3<f64>) {
    place_moving(simulation, |X| (place(X), Vector3::zeros()));
}

/// The same with a velocity, m/s.
pub fn place_moving(
    simulation: &mut Simulator<f64>,
    mut place: impl FnMut(&Vector3<f64>) -> (Vector3<f64>, Vector3<f64>),
) {
    let system = simulation.system();
    let free = |node: usize| (system.numbering.engine_node[node] as usize) < system.free();
    let mut displacements = Vec::new();
    let mut velocities = Vec::new();
    for (node, X) in system.shape.mesh.vertices.iter().enumerate() {
        let (x, v) = if free(node) { place(X) } else { (*X, Vector3::zeros()) };
        displacements.push((x - X).into());
        velocities.push(v.into());
    }
    simulation.set_state(&displacements, &velocities);
}

/// Largest distance of a node from where it is at rest, in lengths of the body.
pub fn distance_from_rest(simulation: &Simulator<f64>) -> f64 {
    let u = simulation.state().u.iter().map(|u| Vector3::from(*u).norm());
    u.fold(0.0, f64::max) / simulation.system().length
}
