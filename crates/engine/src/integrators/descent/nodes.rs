//! Nodes in the order of their colours, one in each SIMD lane.

use std::ops::Range;

use fem_elements::number::Number;
use fem_solvers::Real;

/// Batches of nodes without a common element, colour after colour.
pub(super) struct NodeBatches<T: Real> {
    /// Node of each lane. Lanes without a node of their own repeat the first of their batch, and move no node.
    pub lanes: Vec<u32>,
    /// Number of nodes in each batch.
    pub filled: Vec<usize>,
    /// Batches of each colour.
    pub colors: Vec<Range<usize>>,
    /// Masses, kg; zero in constrained directions, and in lanes without a node.
    pub masses: Vec<[T::Lanes; 3]>,
    /// Batch and lane of each node.
    pub places: Vec<(u32, u32)>,
}

impl<T: Real> NodeBatches<T> {
    /// Batches of these colours. Nodes of a batch have numbers of elements that are as similar as can be: a batch takes as long as the
    /// node with the most.
    pub fn new(nodes: usize, colors: Vec<Vec<u32>>, elements_of: &[usize]) -> Self {
        let mut new = Self {
            lanes: Vec::new(),
            filled: Vec::new(),
            colors: Vec::new(),
            masses: Vec::new(),
            places: vec![(0, 0); nodes],
        };
        for mut color in colors {
            let first = new.filled.len();
            color.sort_by_key(|&node| std::cmp::Reverse(elements_of[node as usize]));
            for chosen in color.chunks(T::WIDTH) {
                for (lane, &node) in chosen.iter().enumerate() {
                    new.places[node as usize] = (new.filled.len() as u32, lane as u32);
                }
                new.lanes.extend((0..T::WIDTH).map(|lane| chosen.get(lane).copied().unwrap_or(chosen[0])));
                new.filled.push(chosen.len());
            }
            new.colors.push(first..new.filled.len());
        }
        new.masses = vec![[T::Lanes::zero(); 3]; new.filled.len()];
        new
    }

    /// Takes the masses of the nodes from their inverses, which are zero in constrained directions.
    pub fn set_masses(&mut self, inverse_masses: &[[T; 3]]) {
        for (batch, masses) in self.masses.iter_mut().enumerate() {
            let (lanes, filled) = (&self.lanes[batch * T::WIDTH..], self.filled[batch]);
            for i in 0..3 {
                masses[i] = T::lanes(|lane| {
                    let inverse = if lane < filled { inverse_masses[lanes[lane] as usize][i] } else { T::default() };
                    if inverse > T::default() { T::one() / inverse } else { T::default() }
                });
            }
        }
    }

    /// Most batches of a colour.
    pub fn largest_color(&self) -> usize {
        self.colors.iter().map(|color| color.len()).max().unwrap_or(0)
    }

    /// Nodes of a batch.
    pub fn of_batch(&self, batch: usize) -> &[u32] {
        &self.lanes[batch * T::WIDTH..][..self.filled[batch]]
    }
}
