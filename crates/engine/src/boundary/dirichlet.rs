//! Nodes that do not move by themselves: held where they are, or led as the scene says, wholly or in some directions.

use nalgebra::Vector3;

use crate::model::numbering::Numbering;
use crate::number::Real;
use crate::sparse::{Block, Pattern, Stored};
use fem_scene::{Body, DirichletCondition, Motion};

/// What holds a body. The engine's nodes from `free` on are held wholly.
#[derive(Clone, Debug, Default)]
pub struct DirichletConditions {
    /// First node that is held wholly.
    pub free: usize,
    /// Nodes below `free` that are held in some directions.
    partly: Vec<(usize, [bool; 3])>,
    /// The scene's conditions, in the engine's numbers of the nodes.
    conditions: Vec<DirichletCondition>,
}

/// Which nodes of the mesh are held wholly; they come last in the engine's order.
pub fn fully_constrained_nodes(body: &Body) -> Vec<bool> {
    let mut directions = vec![[false; 3]; body.shape.mesh.vertices.len()];
    for condition in &body.dirichlet {
        for &node in &condition.nodes {
            for (held, holds) in directions[node].iter_mut().zip(condition.components) {
                *held |= holds;
            }
        }
    }
    directions.into_iter().map(|held| held == [true; 3]).collect()
}

impl DirichletConditions {
    /// What the scene holds, in the engine's order.
    pub fn new(body: &Body, order: &Numbering) -> Self {
        let engine = |condition: &DirichletCondition| DirichletCondition {
            nodes: condition.nodes.iter().map(|&node| order.engine_node[node] as usize).collect(),
            ..condition.clone()
        };
        let conditions: Vec<_> = body.dirichlet.iter().map(engine).collect();
        let mut directions = vec![[false; 3]; order.free];
        for condition in &conditions {
            for &node in condition.nodes.iter().filter(|&&node| node < order.free) {
                for (held, holds) in directions[node].iter_mut().zip(condition.components) {
                    *held |= holds;
                }
            }
        }
        let partly = directions.into_iter().enumerate().filter(|(_, held)| *held != [false; 3]).collect();
        Self { free: order.free, partly, conditions }
    }

    /// Whether nothing is held at all.
    pub fn is_nothing(&self, nodes: usize) -> bool {
        self.free == nodes && self.partly.is_empty()
    }

    /// The scene's conditions, in the engine's numbers of the nodes.
    pub fn conditions(&self) -> &[DirichletCondition] {
        &self.conditions
    }

    /// Conditions with a prescribed motion.
    pub fn motions(&self) -> impl Iterator<Item = (&DirichletCondition, &Motion)> {
        self.conditions.iter().filter_map(|condition| Some((condition, condition.motion.as_ref()?)))
    }

    /// Nodes of `[fixed]`; `None` where the scene has none.
    pub fn fixed(&self) -> Option<&[usize]> {
        self.conditions.iter().find(|condition| condition.motion.is_none()).map(|condition| &condition.nodes[..])
    }

    /// Whether some nodes are led.
    pub fn leads(&self) -> bool {
        self.motions().next().is_some()
    }

    /// Sets the entries of held directions to zero.
    pub fn clear<T: Real>(&self, x: &mut [[T; 3]]) {
        x[self.free..].fill([T::default(); 3]);
        for &(node, held) in &self.partly {
            for i in 0..3 {
                if held[i] {
                    x[node][i] = T::default();
                }
            }
        }
    }

    /// Copies the entries of held directions.
    pub fn copy<T: Real>(&self, from: &[[T; 3]], to: &mut [[T; 3]]) {
        to[self.free..].copy_from_slice(&from[self.free..]);
        for &(node, held) in &self.partly {
            for i in (0..3).filter(|&i| held[i]) {
                to[node][i] = from[node][i];
            }
        }
    }

    /// Keeps the entries of held directions, and sets the others to zero.
    pub fn keep<T: Real>(&self, x: &mut [[T; 3]]) {
        let mut partly = self.partly.iter().peekable();
        for (node, x) in x[..self.free].iter_mut().enumerate() {
            let held = partly.next_if(|(held, _)| *held == node).map_or([false; 3], |(_, held)| *held);
            *x = std::array::from_fn(|i| if held[i] { x[i] } else { T::default() });
        }
    }

    /// Writes the step that held directions make, and leaves the others: none, or to where a motion leads them when `fraction(motion)` of it is done.
    pub fn lead<T: Real>(
        &self,
        rest: &[Vector3<f64>],
        fraction: impl Fn(&Motion) -> f64,
        start: &[[T; 3]],
        step: &mut [[T; 3]],
    ) {
        self.clear(step);
        for (condition, motion) in self.motions() {
            let fraction = fraction(motion);
            for &node in &condition.nodes {
                let target = motion.position(&rest[node], fraction) - rest[node];
                for i in 0..3 {
                    if condition.components[i] {
                        step[node][i] = T::of(target[i] - start[node][i].as_f64());
                    }
                }
            }
        }
    }

    /// Takes held directions out of a matrix: zero beside the diagonal, the diagonal's own size on it.
    pub fn take_out<T: Real>(&self, pattern: &Pattern, values: &mut [Block<T, 3>]) {
        for &(node, held) in &self.partly {
            for block in pattern.row(node) {
                let column = pattern.columns[block] as usize;
                clear_rows(&mut values[block], held, column == node);
                let mirrored = pattern.stored == Stored::Full;
                if column != node
                    && mirrored
                    && let Some(block) = pattern.find(column, node)
                {
                    clear_columns(&mut values[block], held);
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

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let nodes: usize = self.conditions.iter().map(|condition| size_of_val(&condition.nodes[..])).sum();
        size_of_val(&self.partly[..]) + nodes
    }
}

fn clear_rows<T: Real>(block: &mut Block<T, 3>, held: [bool; 3], is_diagonal: bool) {
    for i in 0..3 {
        for j in 0..3 {
            if (held[i] || (is_diagonal && held[j])) && !(is_diagonal && i == j) {
                block[i][j] = T::default();
            }
        }
    }
}

fn clear_columns<T: Real>(block: &mut Block<T, 3>, held: [bool; 3]) {
    for row in block {
        for j in 0..3 {
            if held[j] {
                row[j] = T::default();
            }
        }
    }
}
