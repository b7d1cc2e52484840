//! A lattice of equilateral triangles, and its triangulation within a region.
//!
//! Row r of the lattice lies at (r + ½) √3/2 h, and its sites at (c + ¼) h in even rows, (c + ¾) h in odd ones. The triangles between two rows are numbered by
//! the row below and their first column; each stands on the row below, or hangs from the row above:
//!
//! | | standing | hanging |
//! |---|---|---|
//! | even r | (r, c), (r, c+1), (r+1, c) | (r, c+1), (r+1, c+1), (r+1, c) |
//! | odd r | (r, c), (r, c+1), (r+1, c+1) | (r, c), (r+1, c+1), (r+1, c) |
//!
//! Sites keep away from the boundary by a whole h, and the circumradius is 0.577 h. So no point of the boundary lies in the circumscribed circle of a
//! triangle of the lattice, all of them are Delaunay, and only what is between the lattice and the boundary has to be triangulated.

use nalgebra::Vector2;

use crate::generate::delaunay::triangulate_with;
use crate::generate::triangulation::{OUTSIDE, Triangulation};

/// Triangles around a site inside the lattice.
const AROUND: u8 = 6;

/// A triangle of the lattice: row below, first column, and whether it hangs.
type Cell = (usize, usize, bool);

/// Sites of a lattice, and its triangles.
pub struct Lattice {
    /// Distance of neighbouring sites.
    spacing: f64,
    /// Sites in a row.
    columns: usize,
    is_site: Vec<bool>,
    triangles: Vec<Cell>,
}

impl Lattice {
    /// The lattice over a rectangle, with sites where the condition holds.
    pub fn new([width, height]: [f64; 2], spacing: f64, is_site: impl Fn(Vector2<f64>) -> bool) -> Self {
        let [columns, rows] = [width / spacing, height / (row_height() * spacing)].map(|count| count as usize);
        let is_site =
            (0..rows * columns).map(|site| is_site(place(site / columns, site % columns) * spacing)).collect();
        let mut new = Self { spacing, columns, is_site, triangles: Vec::new() };
        for row in 0..rows.saturating_sub(1) {
            for column in 0..columns.saturating_sub(1) {
                for hangs in [false, true] {
                    let cell = (row, column, hangs);
                    if new.corners(cell).iter().all(|&site| new.is_site[site]) {
                        new.triangles.push(cell);
                    }
                }
            }
        }
        new
    }

    /// The sites of a triangle, counter-clockwise.
    fn corners(&self, (row, column, hangs): Cell) -> [usize; 3] {
        let site = |up: usize, right: usize| (row + up) * self.columns + column + right;
        match (row % 2 == 0, hangs) {
            (true, false) => [site(0, 0), site(0, 1), site(1, 0)],
            (true, true) => [site(0, 1), site(1, 1), site(1, 0)],
            (false, false) => [site(0, 0), site(0, 1), site(1, 1)],
            (false, true) => [site(0, 0), site(1, 1), site(1, 0)],
        }
    }

    /// Returns true if a point lies in a triangle of the lattice.
    fn covers(&self, x: Vector2<f64>) -> bool {
        let up = x.y / (row_height() * self.spacing) - 0.5;
        if !(up >= 0.0) {
            return false;
        }
        let row = up as usize;
        let along = x.x / self.spacing - shift(row) - 0.5 * up.fract();
        let hangs = along.rem_euclid(1.0) > 1.0 - up.fract();
        let column = along.floor() + f64::from(u8::from(hangs && row % 2 == 1));
        // The last row and column stand on no triangle.
        let is_within =
            column >= 0.0 && (column as usize) + 1 < self.columns && row + 1 < self.is_site.len() / self.columns;
        is_within && self.corners((row, column as usize, hangs)).iter().all(|&site| self.is_site[site])
    }

    /// The Delaunay triangulation of the region inside polygons and of the sites, which lie in it, a whole spacing from the polygons. Vertices
    /// are those of the polygons, one after the other, and then the sites. Returns nothing if polygons cross or touch.
    pub fn triangulate(&self, polygons: &[Vec<Vector2<f64>>]) -> Option<Triangulation> {
        let mut around = vec![0; self.is_site.len()];
        for &cell in &self.triangles {
            self.corners(cell).iter().for_each(|&site| around[site] += 1);
        }
        let first = polygons.iter().map(Vec::len).sum::<usize>();
        // Sites within the lattice follow those of its rim.
        let rows = self.is_site.len() / self.columns.max(1);
        let in_rows = (0..rows).flat_map(|row| (0..self.columns).map(move |column| (row, column)));
        // Rows run forth and back, so that each point is near the one before.
        let forth_and_back = in_rows
            .map(|(row, column)| row * self.columns + if row % 2 == 0 { column } else { self.columns - 1 - column });
        let (inner, rim): (Vec<usize>, Vec<usize>) =
            forth_and_back.filter(|&site| self.is_site[site]).partition(|&site| around[site] == AROUND);
        let at = |&site: &usize| place(site / self.columns, site % self.columns) * self.spacing;
        let points: Vec<_> = rim.iter().map(at).collect();
        let mut band = triangulate_with(polygons, &points).ok()?;
        band.points.extend(inner.iter().map(at));
        let mut vertices = vec![OUTSIDE; self.is_site.len()];
        rim.iter().chain(&inner).zip(first as u32..).for_each(|(&site, vertex)| vertices[site] = vertex);
        self.join(band, first, &vertices).or_else(|| {
            let points: Vec<_> = rim.iter().chain(&inner).map(at).collect();
            triangulate_with(polygons, &points).ok()
        })
    }

    /// Replaces the triangles of a triangulation of the boundary and the rim that lie within the lattice by those of the lattice. Returns nothing
    /// if they do not fit together.
    fn join(&self, band: Triangulation, first: usize, vertices: &[u32]) -> Option<Triangulation> {
        let is_covered = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|vertex| band.points[vertex as usize]);
            corners.iter().all(|&vertex| vertex as usize >= first) && self.covers((a + b + c) / 3.0)
        };
        let own = self.triangles.iter().map(|&cell| self.corners(cell).map(|site| vertices[site]));
        let beside = band.triangles.iter().copied().filter(|corners| !is_covered(corners));
        let triangles = own.chain(beside).collect();
        let joined = Triangulation::new(band.points, triangles, &[]).ok()?;
        // Each side of the polygons is one of the boundary, and there are no others.
        let boundary = joined.neighbours.iter().flatten().filter(|&&neighbour| neighbour == OUTSIDE).count();
        (boundary == first).then_some(joined)
    }
}

/// Distance of the rows over that of the sites.
fn row_height() -> f64 {
    0.75_f64.sqrt()
}

/// Place of the first site of a row, over the distance of the sites.
fn shift(row: usize) -> f64 {
    if row.is_multiple_of(2) { 0.25 } else { 0.75 }
}

/// Place of a site in a lattice of spacing 1.
fn place(row: usize, column: usize) -> Vector2<f64> {
    Vector2::new(column as f64 + shift(row), (row as f64 + 0.5) * row_height())
}
