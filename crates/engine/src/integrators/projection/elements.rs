//! Constraints of elements, coloured, side by side in SIMD lanes.

use std::ops::Range;

use super::batch::{Batch, batch, factor};
use super::kernel::CorrectionsOf;
use super::rule::Sweep;
use crate::integrators::relaxation::{BATCHES_FOR_THREADS, CHUNK, color_constraints, shape};
use crate::model::system::System;
use fem_elements::materials::Law;
use fem_elements::number::{Lanes, Number};
use fem_elements::solids::LawWork;
use fem_elements::tensor::zero;
use fem_elements::threads::over_parts_of_two;
use fem_solvers::Real;

/// The elements of one material, colour after colour.
pub(super) struct Elements<T: Real, const N: usize> {
    material: usize,
    /// Nodes of each element, lane after lane.
    corners: Vec<[u32; N]>,
    batches: Vec<Batch<T, N>>,
    /// Batches of each colour.
    colors: Vec<Range<usize>>,
    /// Corrections of the nodes of one colour, m.
    moves: Vec<[[T::Lanes; 3]; N]>,
}

/// Constraints of either kind of elements.
pub(super) trait Group<T: Real>: Send {
    /// Takes the inverse masses of the nodes.
    fn set_masses(&mut self, inverse_masses: &[[T; 3]]);

    /// Sets the multipliers to zero: a step starts.
    fn begin_step(&mut self);

    /// Corrects the nodes of all elements, colour after colour.
    fn sweep(&mut self, system: &System<T>, sweep: Sweep, u: &mut [[T; 3]]);
}

impl<T: Real, const N: usize> Elements<T, N> {
    /// The constraints of those elements of the mesh that have a material.
    pub fn new(system: &System<T>, material: usize, elements: &[[usize; N]]) -> Self {
        let numbers = system.elements.numbers(material);
        let corners = system.numbering.elements(numbers.iter().map(|&number| &elements[number]));
        let mut new =
            Self { material, corners: Vec::new(), batches: Vec::new(), colors: Vec::new(), moves: Vec::new() };
        for color in color_constraints(system.nodes(), &corners) {
            let first = new.batches.len();
            for chosen in color.chunks(T::WIDTH) {
                let of_lane = |lane: usize| chosen.get(lane).map(|&element| element as usize);
                let shape = |lane: usize| {
                    let element = of_lane(lane)?;
                    let factor = system.elements.factor(numbers[element]);
                    Some(shape(system, &corners[element], factor))
                };
                let shapes: Vec<_> = (0..T::WIDTH).map(shape).collect();
                new.batches.push(batch::<T, N>(&shapes));
                // Lanes without an element repeat the first one, with zero volume.
                new.corners.extend((0..T::WIDTH).map(|lane| corners[of_lane(lane).unwrap_or(chosen[0] as usize)]));
            }
            new.colors.push(first..new.batches.len());
        }
        let most = new.colors.iter().map(|color| color.len()).max().unwrap_or(0);
        new.moves = vec![[[T::Lanes::zero(); 3]; N]; most];
        new
    }
}

impl<T: Real, const N: usize> Group<T> for Elements<T, N> {
    fn set_masses(&mut self, inverse_masses: &[[T; 3]]) {
        for (batch, corners) in self.batches.iter_mut().zip(self.corners.chunks_exact(T::WIDTH)) {
            for a in 0..N {
                for i in 0..3 {
                    batch.inverse_masses[a][i] = T::lanes(|lane| inverse_masses[corners[lane][a] as usize][i]);
                }
            }
            for i in 0..3 {
                batch.factors[i] = factor(batch, i);
            }
        }
    }

    fn begin_step(&mut self) {
        self.batches.iter_mut().for_each(|batch| batch.multiplier = zero());
    }

    fn sweep(&mut self, system: &System<T>, sweep: Sweep, u: &mut [[T; 3]]) {
        let solids = &system.elements;
        solids.law_in_lanes(self.material).run(ColorsOf { elements: self, sweep, u });
    }
}

/// A sweep over the elements of one material, with its law.
struct ColorsOf<'a, T: Real, const N: usize> {
    elements: &'a mut Elements<T, N>,
    sweep: Sweep,
    u: &'a mut [[T; 3]],
}

impl<T: Real, const N: usize> LawWork<T> for ColorsOf<'_, T, N> {
    type Output = ();

    fn run<L: Lanes<Element = T>>(self, law: &dyn Law<L>, allows_inversion: bool) {
        let Self { elements: Elements { corners, batches, colors, moves, .. }, sweep, u } = self;
        for color in colors.iter() {
            let corners = &corners[color.start * T::WIDTH..color.end * T::WIDTH];
            let (batches, moves) = (&mut batches[color.clone()], &mut moves[..color.len()]);
            let places = &*u;
            let correct = |first: usize, batches: &mut [_], moves: &mut [_]| {
                let corners = &corners[first * T::WIDTH..(first + batches.len()) * T::WIDTH];
                L::vectorize(CorrectionsOf { law, allows_inversion, sweep, batches, moves, corners, u: places });
            };
            if batches.len() < BATCHES_FOR_THREADS {
                correct(0, batches, moves);
            } else {
                over_parts_of_two((batches, &mut *moves), CHUNK, &correct);
            }
            for (moves, corners) in moves.iter().zip(corners.chunks_exact(T::WIDTH)) {
                for (lane, corners) in corners.iter().enumerate() {
                    for (a, &node) in corners.iter().enumerate() {
                        for i in 0..3 {
                            u[node as usize][i] += T::each(&moves[a][i])[lane];
                        }
                    }
                }
            }
        }
    }
}
