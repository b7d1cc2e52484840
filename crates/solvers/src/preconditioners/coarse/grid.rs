//! A regular grid over the body with trilinear functions. Only cells that contain nodes exist.

use std::array::from_fn;

use super::super::lower_half::LowerHalf;

/// Edge length of a cell, in mean distances of neighbouring nodes.
const EDGE: f64 = 4.0;

/// Largest number of cells along an axis.
const MAX_CELLS: f64 = 1e6;

/// Cells, and the positions of the nodes in them.
pub struct Grid {
    /// Position of each node.
    pub nodes: Vec<CellPoint>,
    /// Numbers of the eight corners of each cell; the last axis varies fastest.
    pub cells: Vec<[u32; 8]>,
    /// Positions of the corners, in cells.
    pub corners: Vec<[f64; 3]>,
}

/// The cell of a node, and its coordinates in the cell, 0 to 1.
#[derive(Clone, Copy)]
pub struct CellPoint {
    pub cell: u32,
    pub at: [f32; 3],
}

impl Grid {
    /// A grid over these positions, m, with cells some node distances wide, or wider, so that there are at most so many corners. `matrix` tells
    /// which nodes are neighbours.
    pub fn with_most_corners(matrix: &LowerHalf, rest: &[[f64; 3]], most: usize) -> Self {
        let mut edge = EDGE;
        loop {
            let grid = Self::new(matrix, rest, edge);
            if grid.corners.len() <= most.max(8) {
                return grid;
            }
            edge *= 1.25;
        }
    }

    /// A grid with cells `edge` node distances wide.
    fn new(matrix: &LowerHalf, rest: &[[f64; 3]], edge: f64) -> Self {
        let rest = &rest[..matrix.rows()];
        let lower: [f64; 3] = from_fn(|i| rest.iter().fold(f64::INFINITY, |lower, x| lower.min(x[i])));
        let upper: [f64; 3] = from_fn(|i| rest.iter().fold(f64::NEG_INFINITY, |upper, x| upper.max(x[i])));
        let edge = edge * mean_distance(matrix, rest);
        let extent: [f64; 3] = from_fn(|i| upper[i] - lower[i]);
        // The extent of a single node, or of a flat body along its normal, is zero.
        let counts =
            extent.map(|extent| if extent > 0.0 { (extent / edge).round().clamp(1.0, MAX_CELLS) } else { 1.0 });
        let along =
            |x: &[f64; 3], i: usize| if extent[i] > 0.0 { (x[i] - lower[i]) / extent[i] * counts[i] } else { 0.0 };
        let lattice = |x: &[f64; 3]| -> [u32; 3] { from_fn(|i| along(x, i).floor().min(counts[i] - 1.0) as u32) };
        let mut cells: Vec<[u32; 3]> = rest.iter().map(lattice).collect();
        let coordinates = |(x, cell): (&[f64; 3], &[u32; 3])| from_fn(|i| (along(x, i) - f64::from(cell[i])) as f32);
        let at: Vec<[f32; 3]> = rest.iter().zip(&cells).map(coordinates).collect();
        let of_node = cells.clone();
        let numbers = |sorted: &[[u32; 3]], cell: &[u32; 3]| sorted.binary_search(cell).unwrap_or_default() as u32;
        sort_unique(&mut cells);
        let mut corners: Vec<[u32; 3]> = cells.iter().flat_map(corners).collect();
        sort_unique(&mut corners);
        Self {
            nodes: of_node.iter().zip(at).map(|(cell, at)| CellPoint { cell: numbers(&cells, cell), at }).collect(),
            cells: cells.iter().map(|cell| self::corners(cell).map(|corner| numbers(&corners, &corner))).collect(),
            corners: corners.iter().map(|corner| corner.map(f64::from)).collect(),
        }
    }

    /// Bytes without the corners' positions.
    pub fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice()) + size_of_val(self.cells.as_slice())
    }

    /// Renumbers the corners.
    pub fn renumber(&mut self, numbers: &[u32]) {
        self.cells.as_flattened_mut().iter_mut().for_each(|corner| *corner = numbers[*corner as usize]);
    }
}

impl CellPoint {
    /// Values of the trilinear functions of the cell's corners.
    #[inline(always)]
    pub fn weights(&self) -> [f32; 8] {
        let [x, y, z] = self.at;
        let (low, high) = ((1.0 - x) * (1.0 - y), (1.0 - x) * y);
        let (far_low, far_high) = (x * (1.0 - y), x * y);
        [low, high, far_low, far_high]
            .map(|part| [part * (1.0 - z), part * z])
            .as_flattened()
            .try_into()
            .unwrap_or_default()
    }
}

fn sort_unique(cells: &mut Vec<[u32; 3]>) {
    cells.sort_unstable();
    cells.dedup();
}

/// Grid coordinates of the corners of a cell.
fn corners(cell: &[u32; 3]) -> [[u32; 3]; 8] {
    from_fn(|corner| from_fn(|axis| cell[axis] + (corner as u32 >> (2 - axis) & 1)))
}

/// Mean distance of neighbouring nodes, m; 1 for a single node.
fn mean_distance(matrix: &LowerHalf, rest: &[[f64; 3]]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for row in 0..matrix.rows() {
        for block in matrix.row(row) {
            let (a, b) = (rest[row], rest[matrix.columns[block] as usize]);
            sum += (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
            count += 1.0;
        }
    }
    if count > 0.0 { sum / count } else { 1.0 }
}
