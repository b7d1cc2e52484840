//! Dirichlet conditions: nodes that are fixed, or that follow a prescribed motion.

use std::collections::HashSet;
use std::f64::consts::TAU;

use nalgebra::{Rotation3, Unit, Vector3};

use crate::{LoadCurve, Refusal};

/// Prescribed coordinates of some nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct DirichletCondition {
    /// The scene's table: `fixed`, or such as `prescribed[0]`.
    pub name: String,
    /// Nodes, ascending and without repeats.
    pub nodes: Vec<usize>,
    /// True for each of x, y and z that is prescribed.
    pub components: [bool; 3],
    /// Prescribed motion; `None` if the nodes keep their undeformed positions.
    pub motion: Option<Motion>,
    /// Time from which the nodes are free, s; `None` if they never are.
    pub until: Option<f64>,
}

/// A rotation followed by a displacement, a part of which is reached at each time.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Displacement of the full motion, m; a velocity, m/s, where the curve is an integral over time.
    pub displacement: Vector3<f64>,
    /// Rotation before the displacement.
    pub rotation: Option<Rotation>,
    /// Part of the motion that is reached, a ramp for `over`; `None` if the full motion applies from the first step on.
    pub curve: Option<LoadCurve>,
}

/// A rotation about a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotation {
    /// Direction of the line.
    pub axis: Unit<Vector3<f64>>,
    /// A point of the line, m.
    pub center: Vector3<f64>,
    /// Full turns, counter-clockwise seen against `axis`.
    pub turns: f64,
}

impl Motion {
    /// A displacement, m, at once; in `static` with the load steps.
    pub fn by(displacement: [f64; 3]) -> Self {
        Self { displacement: displacement.into(), rotation: None, curve: None }
    }

    /// Fraction of the full motion that is reached at a time, s.
    pub fn fraction(&self, time: f64) -> f64 {
        self.curve.as_ref().map_or(1.0, |curve| curve.factor(time))
    }

    /// That fraction and its first and second derivative (1/s, 1/s²) at a part of the time step from `begin` to `end`, s; see
    /// [`LoadCurve::in_step`].
    pub fn fraction_in_step(&self, step: [f64; 2], part: f64) -> [f64; 3] {
        self.curve.as_ref().map_or([1.0, 0.0, 0.0], |curve| curve.in_step(step, part))
    }

    /// Position of a node at a fraction of the motion, m. `X` is its undeformed position, m.
    ///
    /// x = c + R(2π · turns · fraction) (X − c) + fraction · displacement
    pub fn position(&self, X: &Vector3<f64>, fraction: f64) -> Vector3<f64> {
        let rotated = self.rotation.as_ref().map_or(*X, |rotation| {
            let angle = TAU * rotation.turns * fraction;
            rotation.center + Rotation3::from_axis_angle(&rotation.axis, angle) * (X - rotation.center)
        });
        rotated + fraction * self.displacement
    }

    /// First and second derivative of [`position`](Self::position) by the fraction s, m:
    /// dx/ds = ω × (R (X − c)) + displacement and d²x/ds² = ω × (ω × (R (X − c))), ω = 2π · turns · axis.
    pub fn derivatives(&self, X: &Vector3<f64>, fraction: f64) -> [Vector3<f64>; 2] {
        let Some(rotation) = &self.rotation else { return [self.displacement, Vector3::zeros()] };
        let omega = TAU * rotation.turns * rotation.axis.into_inner();
        let arm = Rotation3::from_axis_angle(&rotation.axis, TAU * rotation.turns * fraction) * (X - rotation.center);
        let first = omega.cross(&arm);
        [first + self.displacement, omega.cross(&first)]
    }
}

/// Refuses a coordinate of a body of so many nodes that two conditions prescribe.
pub fn check_disjoint(conditions: &[DirichletCondition], nodes: usize) -> Result<(), Refusal> {
    let (fixed, prescribed): (Vec<_>, Vec<_>) = conditions.iter().partition(|condition| condition.motion.is_none());
    let fixed: HashSet<usize> = fixed.iter().flat_map(|condition| &condition.nodes).copied().collect();
    let mut owner = vec![[None; 3]; nodes];
    for condition in prescribed {
        for &node in &condition.nodes {
            if fixed.contains(&node) {
                let text = format!("moves node {node}, which [fixed] constrains; name each node in one of the two");
                return Err(Refusal::new(&condition.name, text));
            }
            for axis in (0..3).filter(|&axis| condition.components[axis]) {
                if let Some(other) = owner[node][axis].replace(&condition.name) {
                    let axis = ["x", "y", "z"][axis];
                    let text = format!("moves {axis} of node {node}, and so does {other}; name each coordinate once");
                    return Err(Refusal::new(&condition.name, text));
                }
            }
        }
    }
    Ok(())
}
