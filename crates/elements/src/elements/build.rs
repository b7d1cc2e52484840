//! Builds batches of elements from a mesh.

use std::ops::Range;

use crate::number::Number;
use fem_model::element::Element;
use nalgebra::{SMatrix, Vector3};

use super::{Batch, Chunk, Elements};
use crate::number::Float;
use crate::sparse::Pattern;

/// Smallest and largest number of nodes of a chunk: with the smallest, few elements lie between chunks. Beyond eight chunks their
/// size grows before their number, because the cuts across a body would lie closer and closer together.
const CHUNK: (usize, usize) = (2048, 16_384);

/// A target beyond every block.
pub(super) const NONE: u32 = u32::MAX;

/// Gradients of the shape functions of all nodes but the first at a quadrature point, 1/m, and the volume that belongs to it, m³ (area
/// in the plane, m²).
type Shape<const D: usize, const E: usize> = ([[f64; D]; E], f64);

/// The shape by the number of an element, that of its quadrature point, and its nodes in ascending order.
type ShapeOf<'a, const D: usize, const E: usize, const N: usize> = &'a dyn Fn(usize, usize, &[u32; N]) -> Shape<D, E>;

impl<T: Float, const D: usize, const E: usize, const N: usize> Elements<T, D, E, N> {
    /// Simplices with corners and positions in the order of the rows of `pattern`; nodes beyond its rows have forces but no
    /// stiffness. Without rows the elements have forces alone, until [`set_pattern`](Self::set_pattern).
    pub fn new(positions: &[Vector3<f64>], elements: &[[u32; N]], pattern: &Pattern) -> Self {
        Self::stiffened(positions, elements, &[], pattern)
    }

    /// The same with a factor on the energy of each element; `factors` is empty where all are 1.
    pub fn stiffened(positions: &[Vector3<f64>], elements: &[[u32; N]], factors: &[f64], pattern: &Pattern) -> Self {
        assert_eq!([N, E], [D + 1, D], "a simplex in {D} dimensions has {} corners", D + 1);
        let shape = |element: usize, _: usize, corners: &[u32; N]| {
            let (inverse, volume) = simplex::<D, N>(corners, positions, factors.get(element).copied().unwrap_or(1.0));
            (std::array::from_fn(|e| std::array::from_fn(|j| inverse[(e, j)])), volume)
        };
        Self::of_shapes(positions.len(), elements, pattern, &shape)
    }

    /// Elements of any order with their nodes in the order of the mesh. Each becomes an element for each of its quadrature points: with `P` of
    /// them, element P e + k is point k of element e. Points of quadratic tetrahedra share one sum. `factors` is as for [`stiffened`](Self::stiffened), one for each element.
    pub fn at_points(
        kind: &Element,
        positions: &[Vector3<f64>],
        elements: &[[u32; N]],
        factors: &[f64],
        pattern: &Pattern,
    ) -> Self {
        let count = kind.points.len();
        // Points that are not added up before they are scattered.
        let apart = count / Self::POINTS;
        let copies: Vec<[u32; N]> = elements.iter().flat_map(|&nodes| std::iter::repeat_n(nodes, apart)).collect();
        let shape = |copy: usize, point: usize, ascending: &[u32; N]| {
            let nodes = &elements[copy / apart];
            let factor = factors.get(copy / apart).copied().unwrap_or(1.0);
            let (inverse, volume) = simplex::<D, N>(nodes, positions, factor);
            let gradients = kind.gradients(&of_corners(&inverse), kind.points[copy % apart + point]);
            let of_node = |node: u32| nodes.iter().position(|&other| other == node).map_or([0.0; D], |i| gradients[i]);
            (std::array::from_fn(|e| of_node(ascending[e + 1])), volume / count as f64)
        };
        Self::of_shapes(positions.len(), &copies, pattern, &shape)
    }

    /// Prepares the assembly of matrices with another pattern: finds the block of each pair of nodes.
    pub fn set_pattern(&mut self, pattern: &Pattern) {
        for chunk in &mut self.chunks {
            chunk.set_pattern(pattern);
        }
    }

    /// Elements with the shapes that `shape` gives for the number of an element, that of its quadrature point, and its nodes in ascending order.
    fn of_shapes(nodes: usize, elements: &[[u32; N]], pattern: &Pattern, shape: ShapeOf<D, E, N>) -> Self {
        let chunks = chunk_ranges(nodes).map(|nodes| chunk(nodes, elements, pattern, shape)).collect();
        Self { chunks, count: elements.len() * Self::POINTS }
    }
}

fn chunk_ranges(nodes: usize) -> impl Iterator<Item = Range<usize>> {
    let chunks = (nodes / CHUNK.0).clamp(1, 8).max(nodes / CHUNK.1);
    (0..chunks).map(move |i| nodes * i / chunks..nodes * (i + 1) / chunks)
}

fn chunk<T: Float, const D: usize, const E: usize, const N: usize>(
    nodes: Range<usize>,
    elements: &[[u32; N]],
    pattern: &Pattern,
    shape: ShapeOf<D, E, N>,
) -> Chunk<T, D, E, N> {
    let touches = |element: &[u32; N]| element.iter().any(|&node| nodes.contains(&(node as usize)));
    let all = 0..elements.len() as u32;
    let mut chosen: Vec<u32> = all.filter(|&element| touches(&elements[element as usize])).collect();
    // Neighbours in memory are neighbours in space, as far as the numbers of nodes are.
    chosen.sort_by_key(|&element| elements[element as usize].iter().min().copied());

    let points = Elements::<T, D, E, N>::POINTS;
    let count = chosen.len();
    // Copies of the last element, without volume, fill the last batch.
    let filling = count.next_multiple_of(T::WIDTH) - count;
    chosen.extend(chosen.last().map(|&last| std::iter::repeat_n(last, filling)).into_iter().flatten());
    let corners: Vec<[u32; N]> = chosen.iter().map(|&element| ascending(elements[element as usize])).collect();
    let batch = |i: usize| {
        let of_lane = |lane: usize| {
            let place = i / points * T::WIDTH + lane;
            let (gradients, volume) = shape(chosen[place] as usize, i % points, &corners[place]);
            (gradients, if place < count { volume } else { 0.0 })
        };
        let is_counted = |lane: usize| nodes.contains(&(corners[i / points * T::WIDTH + lane][0] as usize));
        batch::<T, D, E>(&(0..T::WIDTH).map(of_lane).collect::<Vec<_>>(), &is_counted)
    };
    let batches: Vec<_> = (0..corners.len() / T::WIDTH * points).map(batch).collect();
    let number = |i: usize, lane: usize| chosen[i / points * T::WIDTH + lane] * points as u32 + (i % points) as u32;
    let numbers = (0..batches.len()).flat_map(|i| (0..T::WIDTH).map(move |lane| (i, lane)));
    let numbers = numbers.map(|(i, lane)| number(i, lane)).collect();
    let mut chunk = Chunk { nodes, count, blocks: 0..0, corners, targets: Vec::new(), batches, elements: numbers };
    if pattern.rows() > 0 {
        chunk.set_pattern(pattern);
    }
    chunk
}

impl<T: Float, const D: usize, const E: usize, const N: usize> Chunk<T, D, E, N> {
    fn set_pattern(&mut self, pattern: &Pattern) {
        let rows = self.nodes.start.min(pattern.rows())..self.nodes.end.min(pattern.rows());
        self.blocks = pattern.starts[rows.start]..pattern.starts[rows.end];
        let corners = self.corners[..self.count].iter();
        self.targets = corners.map(|corners| target(corners, &rows, self.blocks.start, pattern)).collect();
        // Elements without volume fill the last batch.
        self.targets.resize(self.corners.len(), [[NONE; N]; N]);
    }
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
fn simplex<const D: usize, const N: usize>(
    corners: &[u32; N],
    positions: &[Vector3<f64>],
    factor: f64,
) -> (SMatrix<f64, D, D>, f64) {
    let x = |corner: usize| positions[corners[corner] as usize];
    let edges = SMatrix::<f64, D, D>::from_fn(|i, e| x(e + 1)[i] - x(0)[i]);
    let (inverse, determinant) = inverse_and_determinant(&edges);
    (inverse, factor * determinant.abs() / (1..=D).product::<usize>() as f64)
}

/// Gradients of the barycentric coordinates of a simplex, 1/m, from the inverse of its edge matrix.
fn of_corners<const D: usize>(inverse: &SMatrix<f64, D, D>) -> Vec<[f64; D]> {
    let others = (0..D).map(|e| std::array::from_fn(|j| inverse[(e, j)]));
    let first = std::array::from_fn(|j| (1..D).fold(-inverse[(0, j)], |sum, e| sum - inverse[(e, j)]));
    std::iter::once(first).chain(others).collect()
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

fn batch<T: Float, const D: usize, const E: usize>(
    shapes: &[Shape<D, E>],
    is_counted: &dyn Fn(usize) -> bool,
) -> Batch<T::Lanes, D, E> {
    let volume = |lane: usize| T::of(shapes[lane].1);
    let mut batch = Batch {
        gradients: [[T::Lanes::zero(); D]; E],
        volume: T::lanes(volume),
        counted: T::lanes(|lane| if is_counted(lane) { volume(lane) } else { T::default() }),
    };
    for e in 0..E {
        for j in 0..D {
            batch.gradients[e][j] = T::lanes(|lane| T::of(shapes[lane].0[e][j]));
        }
    }
    batch
}
