//! Dirichlet conditions: nodes that are fixed or follow a prescribed motion, in all directions or in some.
//!
//! Fully constrained nodes come last in the engine's numbering and have no rows in any matrix. Partly constrained nodes, and those
//! that become free at a time, keep their rows; their constrained degrees of freedom are eliminated from the matrix. A release
//! therefore changes neither the numbering nor the pattern of the matrix. Nodes of a flat body are constrained along z at all times.

use fem_model::{Body, DirichletCondition, Motion, is_before};
use nalgebra::Vector3;

use crate::forces::Moment;
use fem_elements::sparse::{Block, Pattern, Stored};
use fem_elements::vector::{scale, triple};
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// The Dirichlet conditions of a body. Nodes have the engine's numbers; those from `free` on are fully constrained at all times.
#[derive(Clone, Debug, Default)]
pub struct DirichletConditions {
    /// First fully constrained node.
    pub free: usize,
    /// Nodes below `free` with their constrained directions, ascending.
    partly: Vec<(usize, [bool; 3])>,
    /// Directions in which every node is constrained: z for a flat body.
    everywhere: [bool; 3],
    conditions: Vec<DirichletCondition>,
    /// True for each condition that applies now.
    applies: Vec<bool>,
}

/// Returns for each node of the mesh whether it is constrained in all directions at all times.
pub fn fully_constrained_nodes(body: &Body) -> Vec<bool> {
    let mut directions = vec![body.shape.mesh.fixed_directions(); body.shape.mesh.vertices().len()];
    constrain(body.dirichlet.iter().filter(|condition| condition.until.is_none()), &mut directions);
    directions.into_iter().map(|constrained| constrained == [true; 3]).collect()
}

fn constrain<'a>(conditions: impl Iterator<Item = &'a DirichletCondition>, directions: &mut [[bool; 3]]) {
    for condition in conditions {
        for &node in &condition.nodes {
            let constrained = directions[node];
            directions[node] = triple(|i| constrained[i] || condition.components[i]);
        }
    }
}

impl DirichletConditions {
    /// The conditions of a body in the engine's numbering.
    pub fn new(body: &Body, numbering: &Numbering) -> Self {
        let engine_nodes = |condition: &DirichletCondition| DirichletCondition {
            nodes: condition.nodes.iter().map(|&node| numbering.engine_node[node] as usize).collect(),
            ..condition.clone()
        };
        let conditions: Vec<_> = body.dirichlet.iter().map(engine_nodes).collect();
        let applies = vec![true; conditions.len()];
        let everywhere = body.shape.mesh.fixed_directions();
        let mut new = Self { free: numbering.free, partly: Vec::new(), everywhere, conditions, applies };
        new.find_partly_constrained(body.shape.mesh.vertices().len());
        new
    }

    /// Updates the conditions that apply at a time, s. Returns whether any of them has changed.
    pub fn apply_at(&mut self, time: f64, nodes: usize) -> bool {
        let applies = |condition: &DirichletCondition| condition.until.is_none_or(|until| is_before(time, until));
        // A step without a release allocates nothing.
        if self.conditions().all(|(condition, before)| applies(condition) == before) {
            return false;
        }
        self.applies = self.conditions.iter().map(applies).collect();
        self.find_partly_constrained(nodes);
        true
    }

    fn find_partly_constrained(&mut self, nodes: usize) {
        let mut directions = vec![self.everywhere; nodes];
        constrain(self.applying(), &mut directions);
        directions.truncate(self.free);
        let directions = directions.into_iter().enumerate();
        self.partly = directions.filter(|(_, constrained)| *constrained != [false; 3]).collect();
    }

    /// The conditions that apply now.
    fn applying(&self) -> impl Iterator<Item = &DirichletCondition> {
        self.conditions.iter().zip(&self.applies).filter_map(|(condition, applies)| applies.then_some(condition))
    }

    /// Returns true if no node is constrained now. A flat body without conditions is free in its plane.
    pub fn is_empty(&self) -> bool {
        self.applying().all(|condition| condition.nodes.is_empty())
    }

    /// The directions in which a node is constrained now.
    pub fn constrained(&self, node: usize) -> [bool; 3] {
        match self.partly.binary_search_by_key(&node, |(partly, _)| *partly) {
            Ok(place) => self.partly[place].1,
            Err(_) => [node >= self.free; 3],
        }
    }

    /// Returns true if every node is constrained in a direction.
    pub fn is_constrained_everywhere(&self, direction: usize) -> bool {
        self.everywhere[direction]
    }

    /// Every condition with the engine's numbers of its nodes, and whether it applies now.
    pub fn conditions(&self) -> impl Iterator<Item = (&DirichletCondition, bool)> {
        self.conditions.iter().zip(self.applies.iter().copied())
    }

    /// The conditions that prescribe a motion now.
    pub fn motions(&self) -> impl Iterator<Item = (&DirichletCondition, &Motion)> {
        self.applying().filter_map(|condition| Some((condition, condition.motion.as_ref()?)))
    }

    /// Returns true if a condition prescribes a motion.
    pub fn has_motion(&self) -> bool {
        self.motions().next().is_some()
    }

    /// Sets the constrained entries to zero.
    pub fn clear_constrained<T: Real>(&self, x: &mut [[T; 3]]) {
        x[self.free..].fill([T::default(); 3]);
        for &(node, constrained) in &self.partly {
            for i in (0..3).filter(|&i| constrained[i]) {
                x[node][i] = T::default();
            }
        }
    }

    /// Multiplies the constrained entries.
    pub fn scale_constrained<T: Real>(&self, factor: f64, x: &mut [[T; 3]]) {
        scale(factor, &mut x[self.free..]);
        for &(node, constrained) in &self.partly {
            for i in (0..3).filter(|&i| constrained[i]) {
                x[node][i] *= T::of(factor);
            }
        }
    }

    /// Sets the free entries to zero.
    pub fn clear_free<T: Real>(&self, x: &mut [[T; 3]]) {
        let mut partly = self.partly.iter().peekable();
        for (node, x) in x[..self.free].iter_mut().enumerate() {
            let constrained =
                partly.next_if(|(partly, _)| *partly == node).map_or([false; 3], |(_, directions)| *directions);
            *x = triple(|i| if constrained[i] { x[i] } else { T::default() });
        }
    }

    /// Copies the constrained entries.
    pub fn copy_constrained<T: Real>(&self, from: &[[T; 3]], to: &mut [[T; 3]]) {
        to[self.free..].copy_from_slice(&from[self.free..]);
        for &(node, constrained) in &self.partly {
            for i in (0..3).filter(|&i| constrained[i]) {
                to[node][i] = from[node][i];
            }
        }
    }

    /// Overwrites the constrained entries of an increment with the difference between the prescribed displacements at a moment and the
    /// displacements `start`, m. `rest` are the undeformed positions, m.
    pub fn prescribe<T: Real>(
        &self,
        rest: &[Vector3<f64>],
        moment: Moment,
        start: &[[T; 3]],
        increment: &mut [[T; 3]],
    ) {
        self.clear_constrained(increment);
        for (DirichletCondition { nodes, components, .. }, motion) in self.motions() {
            let fraction = moment.factor(motion.curve.as_ref());
            for &node in nodes {
                let target = motion.position(&rest[node], fraction) - rest[node];
                for i in (0..3).filter(|&i| components[i]) {
                    increment[node][i] = T::of(target[i] - start[node][i].as_f64());
                }
            }
        }
    }

    /// Eliminates the constrained degrees of freedom from a matrix: zero beside the diagonal, the diagonal entry as it is. Flat bodies
    /// have no stiffness along z; the entry there becomes the mean of the others.
    pub fn eliminate<T: Real>(&self, pattern: &Pattern, values: &mut [Block<T, 3>]) {
        for &(node, constrained) in &self.partly {
            for block in pattern.row(node) {
                let column = pattern.columns[block] as usize;
                clear_rows(&mut values[block], constrained, column == node);
                if column == node && self.everywhere[2] {
                    fill_z(&mut values[block]);
                }
                let is_mirrored = pattern.stored == Stored::Full;
                if column != node
                    && is_mirrored
                    && let Some(block) = pattern.find(column, node)
                {
                    clear_columns(&mut values[block], constrained);
                }
            }
        }
        if pattern.stored == Stored::Lower && !self.partly.is_empty() {
            self.clear_lower_columns(pattern, values);
        }
    }

    fn clear_lower_columns<T: Real>(&self, pattern: &Pattern, values: &mut [Block<T, 3>]) {
        let column_of = |block: usize| pattern.columns[block] as usize;
        for row in 0..pattern.rows() {
            for block in pattern.row(row).filter(|&block| column_of(block) != row) {
                if let Ok(place) = self.partly.binary_search_by_key(&column_of(block), |(node, _)| *node) {
                    clear_columns(&mut values[block], self.partly[place].1);
                }
            }
        }
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        let nodes: usize = self.conditions.iter().map(|condition| size_of_val(&condition.nodes[..])).sum();
        size_of_val(&self.partly[..]) + nodes
    }
}

fn clear_rows<T: Real>(block: &mut Block<T, 3>, constrained: [bool; 3], is_diagonal: bool) {
    for i in 0..3 {
        for j in 0..3 {
            if (constrained[i] || (is_diagonal && constrained[j])) && !(is_diagonal && i == j) {
                block[i][j] = T::default();
            }
        }
    }
}

/// Gives a diagonal block an entry along z of the size of the others, so that the matrix is not singular.
fn fill_z<T: Real>(block: &mut Block<T, 3>) {
    let mean = T::of(0.5 * (block[0][0].as_f64().abs() + block[1][1].as_f64().abs()));
    block[2][2] = if mean > T::default() { mean } else { T::one() };
}

fn clear_columns<T: Real>(block: &mut Block<T, 3>, constrained: [bool; 3]) {
    for row in block {
        for j in (0..3).filter(|&j| constrained[j]) {
            row[j] = T::default();
        }
    }
}
