//! Springs between nodes and drag springs at the nodes of a colour.

use super::nodes::NodeBatches;
use super::search::{Change, magnitude};
use super::sums::{Sums, UPPER};
use crate::forces::HessianKind;
use crate::forces::drag::DragSprings;
use crate::forces::springs::Spring;
use fem_elements::number::Number;
use fem_solvers::Real;

/// The springs of a body, with the places of their ends.
pub(super) struct Links<T: Real> {
    springs: Vec<Spring<T>>,
    /// Ends of the springs in each colour.
    ends: Vec<Vec<End>>,
    /// Node of each drag spring, and the displacement at which it is at rest, m.
    drag: Vec<(usize, [T; 3])>,
    /// Stiffness of the drag springs, N/m.
    stiffness: T,
}

/// An end of a spring.
#[derive(Clone, Copy)]
struct End {
    spring: usize,
    batch: usize,
    lane: usize,
    /// 1 at the second node, −1 at the first.
    sign: f64,
}

impl<T: Real> Links<T> {
    /// The springs at the nodes of these batches.
    pub fn new(springs: Vec<Spring<T>>, nodes: &NodeBatches<T>) -> Self {
        let mut ends = vec![Vec::new(); nodes.colors.len()];
        for (spring, of) in springs.iter().enumerate() {
            for (node, sign) in of.ends().into_iter().zip([-1.0, 1.0]) {
                let (batch, lane) = nodes.places[node];
                let (batch, lane) = (batch as usize, lane as usize);
                if let Some(color) = nodes.colors.iter().position(|color| color.contains(&batch)) {
                    ends[color].push(End { spring, batch, lane, sign });
                }
            }
        }
        Self { springs, ends, drag: Vec::new(), stiffness: T::default() }
    }

    /// Takes the drag springs at the end of a step, s.
    pub fn begin_step(&mut self, drag: &DragSprings, end: f64) {
        self.stiffness = T::of(drag.interaction.stiffness);
        self.drag.clear();
        self.drag.extend(drag.springs(end));
    }

    /// Adds gradients and blocks at the nodes of a colour.
    pub fn add_sums(&self, nodes: &NodeBatches<T>, color: usize, u: &[[T; 3]], sums: &mut [Sums<T::Lanes>]) {
        let range = &nodes.colors[color];
        for &End { spring, batch, lane, sign } in &self.ends[color] {
            let spring = &self.springs[spring];
            let now = spring.now(u);
            let H = spring.hessian(u, HessianKind::Projected);
            let mut gradient = [T::default(); 3];
            let mut sharpness = T::default();
            if now.length > T::default() {
                let tension = T::of(sign) * spring.stiffness * now.stretch / now.length;
                gradient = now.d.map(|d| tension * d);
                sharpness = T::one() / (now.length * now.length);
            }
            add(&mut sums[batch - range.start], lane, gradient, |i, k| H[i][k], sharpness);
        }
        for &(node, target) in &self.drag {
            let (batch, lane) = nodes.places[node];
            if range.contains(&(batch as usize)) {
                let k = self.stiffness;
                let gradient = [0, 1, 2].map(|i| k * (u[node][i] - target[i]));
                let block = |i: usize, j: usize| if i == j { k } else { T::default() };
                add(&mut sums[batch as usize - range.start], lane as usize, gradient, block, T::default());
            }
        }
    }

    /// Adds the changes of the energy as the nodes of some batches of a colour move.
    pub fn add_changes(
        &self,
        nodes: &NodeBatches<T>,
        color: usize,
        batches: &[usize],
        u: &mut [[T; 3]],
        changes: &mut [Change<T>],
    ) {
        let find = |batch: usize| batches.iter().position(|&other| other == batch);
        for &End { spring, batch, lane, .. } in &self.ends[color] {
            let Some(place) = find(batch) else { continue };
            let (spring, node) = (&self.springs[spring], nodes.of_batch(batch)[lane] as usize);
            let energy = |u: &[[T; 3]]| {
                let stretch = spring.now(u).stretch;
                T::of(0.5) * spring.stiffness * stretch * stretch
            };
            let (before, start, step) = (energy(u), u[node], changes[place].in_lane(lane));
            u[node] = [0, 1, 2].map(|i| start[i] + step[i]);
            let after = energy(u);
            u[node] = start;
            changes[place].add(lane, after - before, after + before);
        }
        for &(node, target) in &self.drag {
            let (batch, lane) = nodes.places[node];
            let Some(place) = find(batch as usize) else { continue };
            let step = changes[place].in_lane(lane as usize);
            for i in 0..3 {
                let change = self.stiffness * (u[node][i] - target[i] + T::of(0.5) * step[i]) * step[i];
                changes[place].add(lane as usize, change, magnitude(change));
            }
        }
    }
}

/// Adds to the sums of one lane.
fn add<T: Real>(
    sums: &mut Sums<T::Lanes>,
    lane: usize,
    gradient: [T; 3],
    block: impl Fn(usize, usize) -> T,
    sharpness: T,
) {
    let increase = |lanes: &mut T::Lanes, by: T| lanes.set_lane(lane, lanes.lane(lane) + by);
    for i in 0..3 {
        increase(&mut sums.gradient[i], gradient[i]);
    }
    for (entry, (i, k)) in UPPER.into_iter().enumerate() {
        increase(&mut sums.block[entry], block(i, k));
    }
    if sharpness > sums.sharpness.lane(lane) {
        sums.sharpness.set_lane(lane, sharpness);
    }
}
