//! The start of a motion near an obstacle.
//!
//! The barrier is infinite at the plane, and large near it: a body that touched the plane would be thrown off, with an energy that grows
//! without bound as steps become shorter. So a plane that is nearer than the distance at which its barrier bears the body's load stands
//! back until it has this distance, less than d̂: the body starts in balance, and no energy is released.

use fem_model::Body;
use nalgebra::Vector3;

use super::barrier::Barrier;
use super::planes::Planes;
use crate::forces::{Moment, dead_load};
use fem_solvers::numbering::Numbering;

/// Halvings of the interval of the distance: down to rounding errors.
const HALVINGS: usize = 100;

/// The obstacles of a body at the start.
pub struct Obstacles {
    /// The planes, moved back where the body is too near.
    pub planes: Planes,
    /// Their barrier.
    pub barrier: Barrier,
    /// The planes that stand back from the scene's.
    pub stands: Vec<Stand>,
}

/// A plane that stands back from the body at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Number of the plane.
    pub plane: usize,
    /// How far from the scene's place, m.
    pub distance: f64,
    /// Force of its barrier at the start, N.
    pub force: f64,
    /// Energy of its barrier at the start, J.
    pub energy: f64,
}

impl Obstacles {
    /// The obstacles of a body; `None` if the scene has none.
    pub fn new(body: &Body, numbering: &Numbering) -> Option<Self> {
        let (planes, barrier) = (Planes::new(body, numbering)?, Barrier::new(body, numbering)?);
        let mut obstacles = Self { planes, barrier, stands: Vec::new() };
        if body.contact.as_ref()?.may_stand_back {
            let load = dead_load::build::<f64>(body, numbering).and_then(|load| load.resultant(Moment::at(0.0)));
            let load = Vector3::from(load.unwrap_or_default());
            for plane in 0..obstacles.planes.planes.len() {
                obstacles.stand_back(plane, load);
            }
        }
        Some(obstacles)
    }

    /// Moves a plane back from a body that is nearer than the distance at which the barrier bears its part of a load, N.
    fn stand_back(&mut self, plane: usize, load: Vector3<f64>) {
        let Self { planes, barrier, stands } = self;
        let u = vec![[0.0f64; 3]; planes.nodes()];
        let gaps = planes.gaps(plane, &u, 0.0).enumerate();
        let nodes = gaps.map(|(node, gap)| (gap, barrier.area(plane, node)));
        let nodes: Vec<_> = nodes.filter(|(gap, area)| *area > 0.0 && *gap < barrier.distance).collect();
        let nearest = nodes.iter().map(|(gap, _)| *gap).fold(barrier.distance, f64::min);
        let load = f64::max(0.0, -planes.planes[plane].normal.dot(&load));
        let force = |back: f64| -> f64 { nodes.iter().map(|(gap, area)| barrier.force(*area, gap + back)).sum() };
        if nodes.is_empty() || (nearest > 0.0 && force(0.0) <= load) {
            return;
        }
        // The force falls from infinity to zero between these distances.
        let (mut lower, mut upper) = (f64::max(0.0, -nearest), barrier.distance - nearest);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (lower + upper);
            *(if force(middle) > load { &mut lower } else { &mut upper }) = middle;
        }
        let energy = nodes.iter().map(|(gap, area)| barrier.energy(*area, gap + upper)).sum();
        // The sum of no forces is −0, which 0 makes 0.
        stands.push(Stand { plane, distance: upper, force: force(upper) + 0.0, energy });
        planes.stand_back(plane, upper);
    }
}
