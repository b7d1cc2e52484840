//! Sizes of elements inside a picture: short edges where the contour is curved or the region thin, growing with the distance from there.

use std::collections::VecDeque;

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

    /// Bounds the size at the nodes around a point.
    pub fn bound(&mut self, x: Vector2<f64>, size: f64) {
        for (node, size) in self.bounds(x, size) {
            self.sizes[node] = self.sizes[node].min(size);
        }
    }

    /// Bounds of the nodes around a point.
    fn bounds(&self, x: Vector2<f64>, size: f64) -> [(usize, f64); 4] {
        let [i, j] = self.cell(x);
        [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]].map(|node| {
            let distance = (self.place(node) - x).norm();
            (self.index(node), size + self.growth * distance)
        })
    }

    /// Bounds the size around a point of a field that has been spread, up to where it reaches `largest`.
    pub fn bound_around(&mut self, x: Vector2<f64>, size: f64, largest: f64) {
        let mut queue = VecDeque::from(self.bounds(x, size));
        let [columns, rows] = self.nodes.map(|side| side as isize);
        while let Some((node, size)) = queue.pop_front() {
            if !(size < self.sizes[node].min(largest)) {
                continue;
            }
            self.sizes[node] = size;
            let (i, j) = (node as isize % columns, node as isize / columns);
            for (di, dj) in [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)] {
                let (i, j) = (i + di, j + dj);
                if (0..columns).contains(&i) && (0..rows).contains(&j) {
                    let step = self.growth * self.spacing * f64::from((di * di + dj * dj) as i32).sqrt();
                    queue.push_back(((j * columns + i) as usize, size + step));
                }
            }
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

    /// The nodes inside the region.
    pub fn inside(&self, picture: &Picture) -> Vec<Inside> {
        let share = self.spacing * self.spacing / 255.0 * 4.0 / 3.0_f64.sqrt();
        let mut sizes = Vec::new();
        for j in 0..self.nodes[1] {
            for i in 0..self.nodes[0] {
                let place = self.place([i, j]);
                let coverage = picture.at(place.x as isize, place.y as isize);
                if coverage > 0 {
                    let size = self.sizes[j * self.nodes[0] + i];
                    sizes.push(Inside { density: 1.0 / (size * size), share: f64::from(coverage) * share });
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

/// A node inside a region.
#[derive(Clone, Copy, Debug)]
pub struct Inside {
    /// 1/size²; 0 where sizes have no bound.
    density: f64,
    /// Number of equilateral triangles of size 1 that cover the node's part of the region.
    share: f64,
}

impl Inside {
    /// Number of triangles where sizes are below 1/√density, and the sum of the other shares, which have that density.
    pub fn sums(inside: &[Self], density: f64) -> (f64, f64) {
        inside.iter().fold((0.0, 0.0), |(fixed, slope), node| {
            let is_fixed = node.density > density;
            (
                fixed + if is_fixed { node.share * node.density } else { 0.0 },
                slope + if is_fixed { 0.0 } else { node.share },
            )
        })
    }

    /// Number of equilateral triangles of the sizes inside a region, at most `largest`, that cover it.
    pub fn count(inside: &[Self], largest: f64) -> f64 {
        let density = 1.0 / (largest * largest);
        let (fixed, slope) = Self::sums(inside, density);
        fixed + density * slope
    }
}
