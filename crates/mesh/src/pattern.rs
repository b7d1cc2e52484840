//! How the cubes of a box and the squares of a rectangle are cut.

use serde::Deserialize;

/// How the cubes of a box, or the squares of a rectangle, are cut. Either way the mesh of twice the cells refines that of the cells.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// Neighbours are mirror images, so that the diagonals of eight cubes, or four squares, meet in a node. The mesh is symmetric under
    /// the mirror plane across each axis with an even number of cells; an odd number leaves one layer over.
    // Todd 1976, The Computation of Fixed Points and Applications: the triangulation J₁.
    #[default]
    Alternating,
    /// All diagonals point the same way, so that a bent beam also moves sideways: the rule of scenes from before this key.
    // Kuhn 1960, Some combinatorial lemmas in topology.
    Kuhn,
}

impl Pattern {
    /// Returns along which axes a cell is mirrored.
    pub(super) fn mirrored<const D: usize>(self, cell: [usize; D]) -> [bool; D] {
        cell.map(|index| self == Self::Alternating && index % 2 == 1)
    }
}

/// The nodes of a cell's corners. Bit d of a corner's number is 1 on the far side of axis d, or on the near one if the cell is mirrored;
/// `strides` are the differences of node numbers along the axes.
pub(super) fn corners<const D: usize, const C: usize>(
    cell: [usize; D],
    mirrored: [bool; D],
    strides: [usize; D],
) -> [usize; C] {
    let along = |corner: usize, d: usize| (cell[d] + usize::from((corner >> d & 1 == 1) != mirrored[d])) * strides[d];
    std::array::from_fn(|corner| (0..D).map(|d| along(corner, d)).sum())
}

/// Returns true if mirroring turns elements inside out.
pub(super) fn turns<const D: usize>(mirrored: [bool; D]) -> bool {
    mirrored.iter().filter(|&&is| is).count() % 2 == 1
}
