//! Nodes that are led along a motion, in the equations of motion: exactly where, how fast and with which acceleration the scene
//! leads them, and what the others feel of it through the mass that they share.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::equations::{Equations, Scratch};
use fem_scene::Prescribed;

/// Displacements, m, and velocities, m/s.
pub type Phase = [Vec<[f64; 3]>; 2];

impl Equations {
    /// When led nodes may change their velocity at once, from 0 to the horizon and with both, s. Says why there is no solution
    /// where they change their place.
    pub fn jumps(&self, horizon: f64) -> Result<Vec<f64>, String> {
        let mut jumps = vec![0.0, horizon];
        for (motion, _) in self.system.held.motions().iter().filter(|(motion, _)| moves(motion)) {
            let Some(over) = motion.over else {
                return Err("[[prescribed]] without `over` moves nodes at once, which no time step resolves".to_owned());
            };
            jumps.extend((over < horizon).then_some(over));
        }
        jumps.sort_by(f64::total_cmp);
        jumps.dedup();
        Ok(jumps)
    }

    /// Puts led directions where they are at a time, s, of the piece between two jumps that began at `begin`.
    pub fn lead(&self, begin: f64, time: f64, [u, v]: &mut Phase, scratch: &mut Scratch) {
        if !self.is_led {
            return;
        }
        scratch.led.resize(self.nodes(), [0.0; 3]);
        for (motion, nodes) in self.system.held.motions() {
            let holds = motion.holds();
            for &node in nodes {
                let [x, velocity, acceleration] = led(motion, &self.system.rest[node], begin, time);
                for i in (0..3).filter(|&i| holds[i]) {
                    u[node][i] = x[i] - self.system.rest[node][i];
                    v[node][i] = velocity[i];
                    scratch.led[node][i] = acceleration[i];
                }
            }
        }
    }

    /// Begins a piece: where led nodes change their velocity at once, the others change theirs so that their momentum, with what
    /// they share of the mass, stays: M_ff Δv_f = −M_fl Δv_l.
    pub fn kick(&self, begin: f64, now: &mut Phase, scratch: &mut Scratch) {
        if !self.is_led {
            return;
        }
        let before = now[1].clone();
        self.lead(begin, begin, now, scratch);
        let change: Vec<[f64; 3]> =
            now[1].iter().zip(&before).map(|(after, before)| std::array::from_fn(|i| after[i] - before[i])).collect();
        let mut others = vec![[0.0; 3]; change.len()];
        self.momentum_to_velocity(&change, &mut others, scratch);
        for (v, change) in now[1].iter_mut().zip(others) {
            (0..3).for_each(|i| v[i] += change[i]);
        }
    }
}

/// Whether it leads anywhere.
pub fn moves(motion: &Prescribed) -> bool {
    motion.rotation.as_ref().is_some_and(|rotation| rotation.turns != 0.0)
        || motion.displacement.is_some_and(|displacement| displacement != [0.0; 3])
}

/// Place, velocity and acceleration of a node; X is its place at rest.
fn led(motion: &Prescribed, X: &Vector3<f64>, begin: f64, time: f64) -> [Vector3<f64>; 3] {
    let over = motion.over.unwrap_or(f64::INFINITY);
    let fraction = if over.is_finite() { motion.fraction(time) } else { 0.0 };
    let place = motion.position(X, fraction);
    if begin >= over {
        return [place, Vector3::zeros(), Vector3::zeros()];
    }
    let displacement = Vector3::from(motion.displacement.unwrap_or_default());
    let (mut velocity, mut acceleration) = (displacement / over, Vector3::zeros());
    if let Some(rotation) = &motion.rotation {
        let rate = Vector3::ith(rotation.axis as usize, TAU * rotation.turns / over);
        let arm = place - fraction * displacement - Vector3::from(rotation.center);
        velocity += rate.cross(&arm);
        acceleration = rate.cross(&rate.cross(&arm));
    }
    [place, velocity, acceleration]
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use nalgebra::Vector3;

    use super::led;
    use crate::equations::Equations;
    use crate::reference::reference;
    use fem_scene::{body, parse};

    fn equations(rest: &str) -> Equations {
        let text = format!(
            "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [2, 1, 1], cells_per_unit = 1 }}\n[material]\nmodel = \"linear\"\n\
             young = 1e-9\npoisson = 0.0\ndensity = 1000.0\n[time]\ndt = 0.01\nintegrator = \"verlet\"\n{rest}"
        );
        let scene = parse(&text, Path::new("folder/name.toml")).unwrap();
        let body = body(&scene, Path::new("no data")).unwrap();
        Equations::new(&scene, body).unwrap()
    }

    const PULLED: &str = "[fixed]\nnodes = [0, 1, 2, 3, 6, 7, 8, 9, 10, 11]\n[[springs]]\nnodes = [4, 5]\nstiffness = 1e4\n\
         [[prescribed]]\nnodes = [4]\ndisplacement = [0.2, 0, 0]\nover = 1.0\n";

    /// u of a node of frequency ω on a spring whose other end begins to move at V, and which begins at v: V t + (v − V)/ω sin ωt.
    fn towed(omega: f64, V: f64, v: f64, t: f64) -> [f64; 2] {
        [V * t + (v - V) / omega * (omega * t).sin(), V + (v - V) * (omega * t).cos()]
    }

    #[test]
    fn a_node_is_towed_as_the_sine_says_and_swings_when_the_tow_stops() {
        let equations = equations(&format!("[mass]\nlumped = true\n{PULLED}"));
        let omega = equations.fastest();
        let found = reference(&equations, 1.0, 60.0).unwrap();
        let [u, v] = towed(omega, 0.2, 0.0, 1.0);
        assert!((found.q[15] - 2.0 - u).abs() < 1e-9 && (found.qdot[15] - v).abs() < 1e-7, "{found:?}");
        let later = reference(&equations, 1.7, 60.0).unwrap();
        let (c, s) = ((omega * 0.7).cos(), (omega * 0.7).sin());
        let expected = 0.2 + (u - 0.2) * c + v / omega * s;
        assert!((later.q[15] - 2.0 - expected).abs() < 1e-9, "{} {expected}", later.q[15] - 2.0);
    }

    #[test]
    fn a_node_that_shares_mass_with_a_led_one_is_kicked_back() {
        let equations = equations(PULLED);
        let (node, led) =
            (equations.system.order.engine_node[5] as usize, equations.system.order.engine_node[4] as usize);
        let mass = |from: usize| {
            let (mut unit, mut force) = (vec![[0.0; 3]; 12], vec![[0.0; 3]; 12]);
            unit[from][0] = 1.0;
            equations.system.mass.add_times(1.0, &unit, &mut force);
            force[node][0]
        };
        let [u, _] = towed(equations.fastest(), 0.2, -0.2 * mass(led) / mass(node), 0.5);
        let found = reference(&equations, 0.5, 60.0).unwrap();
        assert!(mass(led) > 0.1 * mass(node));
        assert!((found.q[15] - 2.0 - u).abs() < 1e-9, "{} {u}", found.q[15] - 2.0);
    }

    #[test]
    fn velocities_and_accelerations_are_those_of_the_places() {
        let equations = equations(
            "[[prescribed]]\nnodes = [4]\ndisplacement = [0.2, -0.1, 0.4]\nover = 2.0\n\
             rotation = { axis = \"y\", center = [0.3, 0.1, 0.2], turns = 0.7 }\n",
        );
        let motion = &equations.system.held.motions()[0].0;
        let at = |time: f64| led(motion, &Vector3::new(1.0, 2.0, -1.0), 0.0, time);
        let (h, [_, v, a]) = (1e-4, at(0.8));
        let (before, after) = (at(0.8 - h), at(0.8 + h));
        assert!(((after[0] - before[0]) / (2.0 * h) - v).norm() < 1e-6);
        assert!(((after[1] - before[1]) / (2.0 * h) - a).norm() < 1e-6);
        assert_eq!(led(motion, &Vector3::new(1.0, 2.0, -1.0), 2.0, 2.5)[1], Vector3::zeros());
    }

    #[test]
    fn nodes_that_are_moved_at_once_have_no_reference() {
        let equations = equations("[[prescribed]]\nnodes = [4]\ndisplacement = [0.2, 0, 0]\n");
        assert!(reference(&equations, 1.0, 60.0).unwrap_err().contains("over"));
    }
}
