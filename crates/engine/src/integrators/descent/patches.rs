//! Patches: the elements of a material around each node of a batch, side by side in SIMD lanes.

use std::ops::Range;

use super::kernel::{ChangesOf, SumsOf};
use super::nodes::NodeBatches;
use super::search::Change;
use super::slot::Slot;
use super::sums::Sums;

use crate::integrators::relaxation::{BATCHES_FOR_THREADS, CHUNK, cliques_of_nodes, shape};
use crate::model::system::System;
use fem_elements::materials::Law;
use fem_elements::number::{Lanes, Number};
use fem_elements::solids::LawWork;
use fem_elements::threads::over_parts;
use fem_solvers::Real;

/// The elements of one material around all nodes.
pub(super) struct Patches<T: Real, const E: usize> {
    material: usize,
    slots: Vec<Slot<T, E>>,
    /// The other nodes of each element, lane after lane.
    others: Vec<[u32; E]>,
    /// First slot of each batch of nodes, and the number of all slots.
    starts: Vec<usize>,
}

/// Patches of either kind of elements.
pub(super) trait Group<T: Real>: Send + Sync {
    /// Adds gradient and block of the elements' energy to the sums of the batches of a colour.
    fn add_sums(
        &self,
        system: &System<T>,
        nodes: &NodeBatches<T>,
        color: &Range<usize>,
        u: &[[T; 3]],
        sums: &mut [Sums<T::Lanes>],
    );

    /// Adds the changes of the elements' energy at these batches as their nodes move.
    fn add_changes(
        &self,
        system: &System<T>,
        nodes: &NodeBatches<T>,
        batches: &[usize],
        u: &[[T; 3]],
        changes: &mut [Change<T>],
    );
}

impl<T: Real, const E: usize> Patches<T, E> {
    /// Patches of those elements of the mesh that have a material.
    pub fn new<const N: usize>(
        system: &System<T>,
        material: usize,
        elements: &[[usize; N]],
        nodes: &NodeBatches<T>,
    ) -> Self {
        assert_eq!(N, E + 1, "an element around a node has {E} other nodes");
        let numbers = system.elements.numbers(material);
        let corners = system.numbering.elements(numbers.iter().map(|&number| &elements[number]));
        let shapes: Vec<_> =
            corners.iter().zip(&numbers).map(|(c, &number)| shape(system, c, system.elements.factor(number))).collect();
        let (first, around) = cliques_of_nodes(system.nodes(), &corners);
        let mut new = Self { material, slots: Vec::new(), others: Vec::new(), starts: vec![0] };
        for batch in 0..nodes.filled.len() {
            let of_batch = nodes.of_batch(batch);
            let elements_of = |lane: usize| match of_batch.get(lane) {
                Some(&node) => &around[first[node as usize]..first[node as usize + 1]],
                None => &[],
            };
            let most = (0..T::WIDTH).map(|lane| elements_of(lane).len()).max().unwrap_or(0);
            for slot in 0..most {
                let mut stored: Slot<T, E> = Slot { gradients: [[T::Lanes::zero(); 3]; E], volume: T::Lanes::zero() };
                for lane in 0..T::WIDTH {
                    let node = nodes.lanes[batch * T::WIDTH + lane];
                    let Some(&element) = elements_of(lane).get(slot) else {
                        new.others.push([node; E]);
                        continue;
                    };
                    let (corners, shape) = (&corners[element as usize], &shapes[element as usize]);
                    let mut others = [0; E];
                    for (e, a) in (0..N).filter(|&a| corners[a] != node).enumerate() {
                        others[e] = corners[a];
                        for j in 0..3 {
                            stored.gradients[e][j].set_lane(lane, T::of(shape.gradients[a][j]));
                        }
                    }
                    stored.volume.set_lane(lane, T::of(shape.volume));
                    new.others.push(others);
                }
                new.slots.push(stored);
            }
            new.starts.push(new.slots.len());
        }
        new
    }
}

impl<T: Real, const E: usize> Group<T> for Patches<T, E> {
    fn add_sums(
        &self,
        system: &System<T>,
        nodes: &NodeBatches<T>,
        color: &Range<usize>,
        u: &[[T; 3]],
        sums: &mut [Sums<T::Lanes>],
    ) {
        system.elements.law_in_lanes(self.material).run(SumsOfColor { patches: self, nodes, color, u, sums });
    }

    fn add_changes(
        &self,
        system: &System<T>,
        nodes: &NodeBatches<T>,
        batches: &[usize],
        u: &[[T; 3]],
        changes: &mut [Change<T>],
    ) {
        system.elements.law_in_lanes(self.material).run(ChangesOfBatches { patches: self, nodes, batches, u, changes });
    }
}

/// The sums of a colour, with the law of a material.
struct SumsOfColor<'a, T: Real, const E: usize> {
    patches: &'a Patches<T, E>,
    nodes: &'a NodeBatches<T>,
    color: &'a Range<usize>,
    u: &'a [[T; 3]],
    sums: &'a mut [Sums<T::Lanes>],
}

impl<T: Real, const E: usize> LawWork<T> for SumsOfColor<'_, T, E> {
    type Output = ();

    fn run<L: Lanes<Element = T>>(self, law: &dyn Law<L>, allows_inversion: bool) {
        let Self { patches: Patches { slots, others, starts, .. }, nodes, color, u, sums } = self;
        let add = |first: usize, sums: &mut [Sums<T::Lanes>]| {
            let first = color.start + first;
            let starts = &starts[first..=first + sums.len()];
            let lanes = &nodes.lanes[first * T::WIDTH..][..sums.len() * T::WIDTH];
            L::vectorize(SumsOf { law, allows_inversion, slots, others, starts, lanes, u, sums });
        };
        if sums.len() < BATCHES_FOR_THREADS {
            add(0, sums);
        } else {
            over_parts(sums, CHUNK, &add);
        }
    }
}

/// Changes of the energy at some batches, with the law of a material.
struct ChangesOfBatches<'a, T: Real, const E: usize> {
    patches: &'a Patches<T, E>,
    nodes: &'a NodeBatches<T>,
    batches: &'a [usize],
    u: &'a [[T; 3]],
    changes: &'a mut [Change<T>],
}

impl<T: Real, const E: usize> LawWork<T> for ChangesOfBatches<'_, T, E> {
    type Output = ();

    fn run<L: Lanes<Element = T>>(self, law: &dyn Law<L>, allows_inversion: bool) {
        let Self { patches: Patches { slots, others, starts, .. }, nodes, batches, u, changes } = self;
        for (&batch, change) in batches.iter().zip(changes) {
            let (slots, lanes) = (&slots[starts[batch]..starts[batch + 1]], &nodes.lanes[batch * T::WIDTH..]);
            let others = &others[starts[batch] * T::WIDTH..];
            L::vectorize(ChangesOf { law, allows_inversion, slots, others, lanes, u, change });
        }
    }
}
