//! Sizes of elements inside a picture: short edges where the contour is curved or the region thin, growing with the distance from there.

use nalgebra::Vector2;

use super::Picture;

/// Cells of the grid along the longer side of the picture.
const CELLS: f64 = 160.0;

/// Lengths of edges on a grid, linear in its cells; all in pixels.
#[derive(Clone, Debug)]
pub struct SizeField {
    spacing: f64,
    /// Growth of the edges' length with the distance.
    growth: f64,
    nodes: [usize; 2],
    sizes: Vec<f64>,
}

impl SizeField {
    /// A field without bounds over a picture, in which sizes grow with the distance by no more than `growth`.
    pub fn over(picture: &Picture, growth: f64) -> Self {
        let longer = picture.width.max(picture.height) as f64;
        let spacing = (longer / CELLS).max(1.0);
        let nodes = [picture.width, picture.height].map(|side| (side as f64 / spacing).ceil() as usize + 2);
        Self { spacing, growth, nodes, sizes: vec![f64::INFINITY; nodes[0] * nodes[1]] }
    }

    /// Bounds the size around a point.
    pub fn bound(&mut self, x: Vector2<f64>, size: f64) {
        let [i, j] = self.cell(x);
        for node in [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]] {
            let distance = (self.place(node) - x).norm();
            let index = self.index(node);
            self.sizes[index] = self.sizes[index].min(size + self.growth * distance);
        }
    }

    /// Lets sizes grow from node to node by no more than the growth allows, in two sweeps: Borgefors, Distance Transformations in Digital
    /// Images (1986).
    pub fn spread(&mut self) {
        let [columns, rows] = self.nodes;
        let (straight, diagonal) = (self.growth * self.spacing, self.growth * self.spacing * 2.0_f64.sqrt());
        for sweep in 0..2 {
            let turn = if sweep == 0 { -1 } else { 1 };
            let steps = [(1, 0, straight), (1, 1, diagonal), (0, 1, straight), (-1, 1, diagonal)];
            let near = steps.map(|(x, y, step)| (turn * (y * columns as isize + x), step));
            for node in 0..columns * rows {
                let node = if sweep == 0 { node } else { columns * rows - 1 - node };
                let (i, j) = (node % columns, node / columns);
                let mut size = self.sizes[node];
                if (1..columns - 1).contains(&i) && (1..rows - 1).contains(&j) {
                    for (to, step) in near {
                        size = size.min(self.sizes[node.wrapping_add_signed(to)] + step);
                    }
                } else {
                    for (x, y, step) in steps {
                        let (i, j) = (i as isize + turn * x, j as isize + turn * y);
                        if (0..columns as isize).contains(&i) && (0..rows as isize).contains(&j) {
                            size = size.min(self.sizes[j as usize * columns + i as usize] + step);
                        }
                    }
                }
                self.sizes[node] = size;
            }
        }
    }

    /// The size at a point, at most `largest`.
    pub fn at(&self, x: Vector2<f64>, largest: f64) -> f64 {
        let [i, j] = self.cell(x);
        let [u, v] = [x.x / self.spacing - i as f64, x.y / self.spacing - j as f64].map(|u| u.clamp(0.0, 1.0));
        let size = |i: usize, j: usize| self.sizes[j * self.nodes[0] + i].min(largest);
        (1.0 - v) * ((1.0 - u) * size(i, j) + u * size(i + 1, j))
            + v * ((1.0 - u) * size(i, j + 1) + u * size(i + 1, j + 1))
    }

    /// The sizes inside the region, each with the number of equilateral triangles of size 1 that cover its part of the region.
    pub fn inside(&self, picture: &Picture) -> Vec<[f64; 2]> {
        let share = self.spacing * self.spacing / 255.0 * 4.0 / 3.0_f64.sqrt();
        let mut sizes = Vec::new();
        for j in 0..self.nodes[1] {
            for i in 0..self.nodes[0] {
                let place = self.place([i, j]);
                let coverage = picture.at(place.x as isize, place.y as isize);
                if coverage > 0 {
                    sizes.push([self.sizes[j * self.nodes[0] + i], f64::from(coverage) * share]);
                }
            }
        }
        sizes
    }

    fn cell(&self, x: Vector2<f64>) -> [usize; 2] {
        let cell = |x: f64, nodes: usize| ((x / self.spacing).max(0.0) as usize).min(nodes - 2);
        [cell(x.x, self.nodes[0]), cell(x.y, self.nodes[1])]
    }

    fn place(&self, [i, j]: [usize; 2]) -> Vector2<f64> {
        Vector2::new(i as f64, j as f64) * self.spacing
    }

    fn index(&self, [i, j]: [usize; 2]) -> usize {
        j * self.nodes[0] + i
    }
}

/// Number of equilateral triangles of the sizes inside a region, at most `largest`, that cover it.
pub fn count(inside: &[[f64; 2]], largest: f64) -> f64 {
    inside.iter().map(|&[size, share]| share / size.min(largest).powi(2)).sum()
}
