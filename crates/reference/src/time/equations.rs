//! The semi-discrete equations of motion M ü = f(u, u̇, t), which a reference in time integrates.
//!
//! Forces are the engine's. The mass is assembled and factorised here, by code that the engine's integrators do not use.

use std::f64::consts::TAU;

use fem_engine::forces::Moment;
use fem_engine::simulator::double::{self, System};
use fem_engine::solvers::SolverChoice;
use fem_model::{Body, LoadCurve, Motion};
use nalgebra::Vector3;

use super::mass::MassInverse;

/// Displacements, m, and velocities, m/s, of all nodes.
pub type Phase = [Vec<[f64; 3]>; 2];

/// A body's equations of motion, in the engine's numbering of nodes.
pub struct Equations {
    /// The body.
    pub system: System,
    mass: MassInverse,
    has_prescribed_motion: bool,
    /// Velocities at the start, m/s.
    initial_velocity: Vec<[f64; 3]>,
    /// Times at which an external load has a kink or a jump, s.
    kinks: Vec<f64>,
}

/// Working memory of an evaluation.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    force: Vec<[f64; 3]>,
    right: Vec<[f64; 3]>,
    /// Accelerations of prescribed directions, zero elsewhere, m/s²; empty without prescribed motion.
    prescribed: Vec<[f64; 3]>,
}

impl Equations {
    /// Builds the equations of a scene. The error is the reason why the scene has none.
    pub fn new(body: Body) -> Result<Self, String> {
        if body.dirichlet.iter().any(|condition| condition.until.is_some()) {
            return Err("nodes become free at a time, which the reference in time does not compute".to_owned());
        }
        if body.contact.is_some() {
            return Err("[[planes]] make motions with impacts, which the reference in time does not compute".to_owned());
        }
        if body.plasticity.is_some() {
            return Err("the material flows, which the reference in time does not compute".to_owned());
        }
        let kinks = kinks(&body);
        let system = double::system(body.clone(), SolverChoice::Cholesky);
        let mass = MassInverse::new(&body, &system)?;
        let has_prescribed_motion = system.dirichlet.motions().any(|(_, motion)| moves(motion));
        let initial_velocity = initial_velocity(&body.initial_velocity, &system);
        Ok(Self { system, mass, has_prescribed_motion, initial_velocity, kinks })
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.system.nodes()
    }

    /// The undeformed body with its initial velocity.
    pub fn start(&self) -> Phase {
        [vec![[0.0; 3]; self.nodes()], self.initial_velocity.clone()]
    }

    /// a = M⁻¹ f(u, v, t), m/s², zero in constrained directions. With prescribed motion, [`prescribe`](Self::prescribe) must
    /// come first.
    pub fn accelerations(&self, u: &[[f64; 3]], v: &[[f64; 3]], time: f64, a: &mut [[f64; 3]], scratch: &mut Scratch) {
        let Scratch { force, prescribed, right } = scratch;
        force.resize(self.nodes(), [0.0; 3]);
        double::force(&self.system, u, v, Moment::at(time), force);
        if !prescribed.is_empty() {
            self.system.mass.add_times(-1.0, prescribed, force);
        }
        self.mass.apply(force, a, right);
    }

    /// Times between which prescribed motions and loads are smooth, including 0 and the horizon, s. A displacement that jumps is an
    /// error.
    pub fn jumps(&self, horizon: f64) -> Result<Vec<f64>, String> {
        let mut jumps = vec![0.0, horizon];
        jumps.extend(&self.kinks);
        for (_, motion) in self.system.dirichlet.motions().filter(|(_, motion)| moves(motion)) {
            match &motion.curve {
                Some(curve) if !curve.has_jumps() && curve.factor(0.0) == 0.0 => jumps.extend(curve.kinks()),
                Some(_) | None => {
                    let reason = "[[prescribed]] without `over`, or with a curve that jumps, moves nodes at once, which no time \
                                  step resolves";
                    return Err(reason.to_owned());
                }
            }
        }
        jumps.retain(|time| (0.0..=horizon).contains(time));
        jumps.sort_by(f64::total_cmp);
        jumps.dedup();
        Ok(jumps)
    }

    /// Sets prescribed displacements and velocities at a time, s, of the interval between two jumps that starts at `begin`.
    pub fn prescribe(&self, begin: f64, time: f64, [u, v]: &mut Phase, scratch: &mut Scratch) {
        if !self.has_prescribed_motion {
            return;
        }
        scratch.prescribed.resize(self.nodes(), [0.0; 3]);
        for (condition, motion) in self.system.dirichlet.motions() {
            for &node in &condition.nodes {
                let rest = &self.system.rest[node];
                let [x, velocity, acceleration] = kinematics(motion, rest, begin, time);
                for i in (0..3).filter(|&i| condition.components[i]) {
                    u[node][i] = x[i] - rest[i];
                    v[node][i] = velocity[i];
                    scratch.prescribed[node][i] = acceleration[i];
                }
            }
        }
    }

    /// Starts an interval: a jump Δv_p of prescribed velocities gives free nodes an impulse through the consistent mass,
    /// M_ff Δv_f = −M_fp Δv_p.
    pub fn jump(&self, begin: f64, now: &mut Phase, scratch: &mut Scratch) {
        if !self.has_prescribed_motion {
            return;
        }
        let before = now[1].clone();
        self.prescribe(begin, begin, now, scratch);
        let change: Vec<[f64; 3]> =
            now[1].iter().zip(&before).map(|(after, before)| std::array::from_fn(|i| after[i] - before[i])).collect();
        scratch.force.clear();
        scratch.force.resize(self.nodes(), [0.0; 3]);
        self.system.mass.add_times(-1.0, &change, &mut scratch.force);
        let mut free = vec![[0.0; 3]; self.nodes()];
        self.mass.apply(&scratch.force, &mut free, &mut scratch.right);
        for (v, change) in now[1].iter_mut().zip(free) {
            (0..3).for_each(|i| v[i] += change[i]);
        }
    }

    /// The fastest rate about the undeformed state, 1/s: the highest natural frequency by power iteration on M⁻¹ K, which
    /// converges from below, or the decay rate α + β ω² if that is larger.
    pub fn fastest(&self) -> f64 {
        let (n, mut scratch) = (self.nodes(), Scratch::default());
        let rest = vec![[0.0; 3]; n];
        // A rough start contains all modes, and is the same on every machine.
        let mut d: Vec<[f64; 3]> =
            (0..n).map(|i| [0, 1, 2].map(|c| ((7 * i + 3 * c) as f64 * 1.618_034).fract() - 0.5)).collect();
        self.system.dirichlet.clear_constrained(&mut d);
        let mut square = 0.0;
        for _ in 0..POWER_ITERATIONS {
            scratch.force.clear();
            scratch.force.resize(n, [0.0; 3]);
            double::add_stiffness_times(&self.system, &rest, &d, &mut scratch.force);
            for (force, _) in self.system.forces.active().filter(|(force, _)| !force.is_internal()) {
                force.add_hessian_times(1.0, &rest, Moment::at(0.0), &d, &mut scratch.force);
            }
            let mut next = vec![[0.0; 3]; n];
            self.mass.apply(&scratch.force, &mut next, &mut scratch.right);
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
        (self.system.mass.kinetic_energy(v), double::potential(&self.system, u, Moment::at(time)).value)
    }
}

/// Velocities of the mesh's nodes in the engine's numbering, zero in constrained directions, m/s.
fn initial_velocity(of_mesh: &[Vector3<f64>], system: &System) -> Vec<[f64; 3]> {
    let of_node = |&node: &u32| of_mesh.get(node as usize).copied().unwrap_or_default().into();
    let mut velocities: Vec<[f64; 3]> = system.numbering.mesh_node.iter().map(of_node).collect();
    system.dirichlet.clear_constrained(&mut velocities);
    velocities
}

/// Times at which an external load of the body has a kink or a jump, s.
fn kinks(body: &Body) -> Vec<f64> {
    let of_volume = body.gravity_curve.iter().chain(&body.body_force_curve);
    let dead = body.tractions.iter().filter_map(|traction| traction.curve.as_ref());
    let nodal = body.nodal_forces.iter().filter_map(|load| load.curve.as_ref());
    let followers = body.pressures.iter().filter_map(|pressure| pressure.curve.as_ref());
    of_volume.chain(dead).chain(nodal).chain(followers).flat_map(LoadCurve::kinks).collect()
}

/// Products with M⁻¹ K.
const POWER_ITERATIONS: usize = 60;

/// Returns true if the motion is not at rest.
fn moves(motion: &Motion) -> bool {
    motion.rotation.as_ref().is_some_and(|rotation| rotation.turns != 0.0) || motion.displacement != Vector3::zeros()
}

/// Position, m, velocity, m/s, and acceleration, m/s², at a time, s, of a node with the undeformed position X. `begin` is the start of
/// the interval between two velocity jumps that holds `time`.
fn kinematics(motion: &Motion, X: &Vector3<f64>, begin: f64, time: f64) -> [Vector3<f64>; 3] {
    let Some(curve) = &motion.curve else { return [*X, Vector3::zeros(), Vector3::zeros()] };
    let fraction = curve.factor(time);
    // Between two kinks the curve is linear: its rate at the end of the interval is that at its begin.
    let [rate, change] = curve.derivatives(if curve.kinks().is_empty() { time } else { begin });
    let place = motion.position(X, fraction);
    let displacement = motion.displacement;
    let (mut first, mut second) = (displacement, Vector3::zeros());
    if let Some(rotation) = &motion.rotation {
        let angle = TAU * rotation.turns * rotation.axis.into_inner();
        let arm = place - fraction * displacement - rotation.center;
        first += angle.cross(&arm);
        second = angle.cross(&angle.cross(&arm));
    }
    [place, rate * first, rate * rate * second + change * first]
}
