//! Builds batches of elements from a mesh.

use std::ops::Range;

use nalgebra::{SMatrix, Vector3};
use simba::simd::SimdValue;

use super::{Batch, Chunk, Elements};
use crate::number::Real;
use crate::sparse::Pattern;

/// Smallest and largest number of nodes of a chunk: with the smallest, few elements lie between chunks. Beyond eight chunks their
/// size grows before their number, because the cuts across a body would lie closer and closer together.
const CHUNK: (usize, usize) = (4096, 16_384);

/// A target beyond every block.
pub(super) const NONE: u32 = u32::MAX;

impl<T: Real, const D: usize, const N: usize> Elements<T, D, N> {
    /// Elements with corners and positions in the order of the rows of `pattern`; nodes beyond its rows have forces but no
    /// stiffness.
    pub fn new(positions: &[Vector3<f64>], elements: &[[u32; N]], pattern: &Pattern) -> Self {
        Self::stiffened(positions, elements, &[], pattern)
    }

    /// The same with a factor on the energy of each element; `factors` is empty where all are 1.
    pub fn stiffened(positions: &[Vector3<f64>], elements: &[[u32; N]], factors: &[f64], pattern: &Pattern) -> Self {
        assert_eq!(N, D + 1, "a simplex in {D} dimensions has {} corners", D + 1);
        let chunk = |nodes| chunk(nodes, positions, elements, factors, pattern);
        let chunks = chunk_ranges(positions.len()).map(chunk).collect();
        Self { chunks, count: elements.len() }
    }
}

fn chunk_ranges(nodes: usize) -> impl Iterator<Item = Range<usize>> {
    let chunks = (nodes / CHUNK.0).clamp(1, 8).max(nodes / CHUNK.1);
    (0..chunks).map(move |i| nodes * i / chunks..nodes * (i + 1) / chunks)
}

fn chunk<T: Real, const D: usize, const N: usize>(
    nodes: Range<usize>,
    positions: &[Vector3<f64>],
    elements: &[[u32; N]],
    factors: &[f64],
    pattern: &Pattern,
) -> Chunk<T, D, N> {
    let rows = nodes.start.min(pattern.rows())..nodes.end.min(pattern.rows());
    let blocks = pattern.starts[rows.start]..pattern.starts[rows.end];
    let touches = |element: &[u32; N]| element.iter().any(|&node| nodes.contains(&(node as usize)));
    let all = 0..elements.len() as u32;
    let mut chosen: Vec<u32> = all.filter(|&element| touches(&elements[element as usize])).collect();
    // Neighbours in memory are neighbours in space, as far as the numbers of nodes are.
    chosen.sort_by_key(|&element| elements[element as usize].iter().min().copied());

    let mut corners: Vec<[u32; N]> = chosen.iter().map(|&element| ascending(elements[element as usize])).collect();
    let mut targets: Vec<_> = corners.iter().map(|corners| target(corners, &rows, blocks.start, pattern)).collect();
    let factor = |&element: &u32| factors.get(element as usize).copied().unwrap_or(1.0);
    let shape = |(corners, element)| shape(corners, positions, factor(element));
    let shapes: Vec<_> = corners.iter().zip(&chosen).map(shape).collect();
    let owned: Vec<bool> = corners
        .iter()
        .map(|corners| corners.iter().min().is_some_and(|&least| nodes.contains(&(least as usize))))
        .collect();
    let batches =
        (0..chosen.len().div_ceil(T::WIDTH)).map(|i| batch(i * T::WIDTH, &shapes, &owned)).collect::<Vec<_>>();

    let filling = batches.len() * T::WIDTH - chosen.len();
    corners.extend(std::iter::repeat_n([nodes.start as u32; N], filling));
    targets.extend(std::iter::repeat_n([[NONE; N]; N], filling));
    Chunk { nodes, blocks, corners, targets, batches, elements: chosen }
}

fn target<const N: usize>(
    corners: &[u32; N],
    rows: &Range<usize>,
    first_block: usize,
    pattern: &Pattern,
) -> [[u32; N]; N] {
    corners.map(|row| {
        corners.map(|column| {
            let block = rows.contains(&(row as usize)).then(|| pattern.find(row as usize, column as usize)).flatten();
            block.map_or(NONE, |block| (block - first_block) as u32)
        })
    })
}

/// Inverse of the edge matrix, and volume times a factor: energies, forces and stiffnesses are proportional to it.
fn shape<const D: usize, const N: usize>(
    corners: &[u32; N],
    positions: &[Vector3<f64>],
    factor: f64,
) -> (SMatrix<f64, D, D>, f64) {
    let x = |corner: usize| positions[corners[corner] as usize];
    let edges = SMatrix::<f64, D, D>::from_fn(|i, e| x(e + 1)[i] - x(0)[i]);
    let (inverse, determinant) = inverse_and_determinant(&edges);
    (inverse, factor * determinant.abs() / (1..=D).product::<usize>() as f64)
}

/// Corners in the order of their numbers, so that the same pairs of all elements lie in the lower half of a matrix: a branch that
/// goes another way for every element costs more than what it saves. F and the volume's size do not depend on the order.
fn ascending<const N: usize>(mut corners: [u32; N]) -> [u32; N] {
    corners.sort_unstable();
    corners
}

/// By cofactors in three dimensions and two. Meshes are checked before: the determinant is not zero.
fn inverse_and_determinant<const D: usize>(a: &SMatrix<f64, D, D>) -> (SMatrix<f64, D, D>, f64) {
    let mut embedded = nalgebra::Matrix3::identity();
    embedded.view_mut((0, 0), (D, D)).copy_from(a);
    let determinant = embedded.determinant();
    let cofactors = crate::tensor::cofactor(&crate::tensor::from_fn(|i, j| embedded[(i, j)]));
    (SMatrix::from_fn(|i, j| cofactors[j][i] / determinant), determinant)
}

fn batch<T: Real, const D: usize>(first: usize, shapes: &[(SMatrix<f64, D, D>, f64)], owned: &[bool]) -> Batch<T, D> {
    let volume = |lane: usize| shapes.get(first + lane).map_or(0.0, |shape| shape.1);
    let inverse = |lane: usize, e: usize, j: usize| shapes.get(first + lane).map_or(0.0, |shape| shape.0[(e, j)]);
    let counts = |lane: usize| owned.get(first + lane).copied().unwrap_or(false);
    let mut batch = Batch {
        inverse: [[T::Lanes::splat(T::default()); D]; D],
        volume: T::lanes(|lane| T::of(volume(lane))),
        counted: T::lanes(|lane| T::of(if counts(lane) { volume(lane) } else { 0.0 })),
    };
    for e in 0..D {
        for j in 0..D {
            batch.inverse[e][j] = T::lanes(|lane| T::of(inverse(lane, e, j)));
        }
    }
    batch
}
