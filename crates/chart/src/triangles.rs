//! Triangles in space, seen from one direction.

use maud::html;

use crate::Picture;
use crate::svg::points;

/// A point in space.
type Point = [f64; 3];

/// Width and height of the drawing, pixels.
const SIZE: f64 = 696.0;

/// Side of the raster that decides which triangles are seen.
const RASTER: usize = 1024;

/// Shades between the darkest and the lightest triangle.
const SHADES: usize = 32;

/// Largest number of triangles that are drawn: more triangles would be smaller than a pixel and would make a file of many megabytes.
const MOST: usize = 60_000;

/// Triangles in space with their edges, seen from above and the right; if all lie in one plane of constant z, seen from above. A depth
/// buffer leaves hidden ones out. Returns `None` if there is no triangle with finite corners, or over 60 000 are seen.
pub fn triangles(label: &str, triangles: &[[Point; 3]]) -> Option<Picture> {
    triangles_in_frame(label, triangles, &[])
}

/// The same, with these points inside the drawing too, so that drawings with the same points have the same scale.
pub fn triangles_in_frame(label: &str, triangles: &[[Point; 3]], frame: &[Point]) -> Option<Picture> {
    let finite: Vec<[Point; 3]> =
        triangles.iter().filter(|corners| corners.iter().flatten().all(|x| x.is_finite())).copied().collect();
    let view = View::of(&finite, frame)?;
    let placed: Vec<[Point; 3]> = finite.iter().map(|corners| corners.map(|x| view.place(x))).collect();
    let mut seen = visible(&placed);
    if seen.len() > MOST {
        return None;
    }
    let depth = |&i: &usize| placed[i].iter().map(|x| x[2]).sum::<f64>();
    seen.sort_by(|a, b| depth(a).total_cmp(&depth(b)).then(a.cmp(b)));
    let inner = html! {
        g stroke="#1b222c" stroke-width=(if seen.len() > 8000 { 0.15 } else { 0.5 }) stroke-linejoin="round" {
            @for i in seen {
                polygon fill=(shade(&placed[i])) points=(points(placed[i].iter().map(|x| (x[0], x[1])))) {}
            }
        } "\n"
    };
    Some(Picture { size: (SIZE, view.height), label: label.to_owned(), inner, legend: Vec::new() })
}

/// A direction of view, with the scale that fills the drawing.
struct View {
    axes: [Point; 3],
    least: [f64; 2],
    scale: f64,
    height: f64,
}

impl View {
    fn of(triangles: &[[Point; 3]], frame: &[Point]) -> Option<Self> {
        let corners = || triangles.iter().flatten().chain(frame);
        let [first, ..] = *triangles.first()?;
        let is_plane = corners().all(|x| x[2] == first[2]);
        let axes = if is_plane {
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        } else {
            // Right, up and towards the eye; y is up, as in the window.
            let (a, b) = (0.55_f64, 0.35_f64);
            let towards = [a.sin() * b.cos(), b.sin(), a.cos() * b.cos()];
            [[a.cos(), 0.0, -a.sin()], [-a.sin() * b.sin(), b.cos(), -a.cos() * b.sin()], towards]
        };
        let range = |axis: usize| {
            let values = corners().map(|x| dot(axes[axis], *x));
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
        };
        let ((left, right), (low, high)) = (range(0), range(1));
        let margin = 4.0;
        let size = (right - left).max(high - low);
        let scale = if size > 0.0 { (SIZE - 2.0 * margin) / size } else { 1.0 };
        let height = (high - low) * scale + 2.0 * margin;
        let across = 0.5 * (SIZE / scale - (right - left));
        Some(Self { axes, least: [left - across, high + margin / scale], scale, height })
    }

    /// Pixels to the right and down, and towards the eye.
    fn place(&self, x: Point) -> Point {
        let [right, up, near] = self.axes.map(|axis| dot(axis, x));
        [(right - self.least[0]) * self.scale, (self.least[1] - up) * self.scale, near * self.scale]
    }
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Triangles that are in front in some pixel of the raster.
fn visible(triangles: &[[Point; 3]]) -> Vec<usize> {
    let pixel = RASTER as f64 / SIZE;
    let mut front = vec![(f64::NEG_INFINITY, u32::MAX); RASTER * RASTER];
    for (i, corners) in triangles.iter().enumerate() {
        let corners = corners.map(|x| [x[0] * pixel, x[1] * pixel, x[2]]);
        cover(&corners, |column, row, depth| {
            let cell = &mut front[row * RASTER + column];
            if depth > cell.0 {
                *cell = (depth, i as u32);
            }
        });
    }
    let mut seen: Vec<usize> =
        front.into_iter().filter(|cell| cell.1 != u32::MAX).map(|cell| cell.1 as usize).collect();
    seen.sort_unstable();
    seen.dedup();
    seen
}

/// Calls a function with the pixels whose centres a triangle covers, and the depth there.
fn cover([a, b, c]: &[Point; 3], mut call: impl FnMut(usize, usize, f64)) {
    let twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if twice_area == 0.0 {
        return;
    }
    let range = |axis: usize| {
        let (low, high) = (a[axis].min(b[axis]).min(c[axis]), a[axis].max(b[axis]).max(c[axis]));
        (low.max(0.0) as usize)..((high + 1.0).max(0.0) as usize).min(RASTER)
    };
    for row in range(1) {
        for column in range(0) {
            let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
            let part = |p: &Point, q: &Point| ((q[0] - p[0]) * (y - p[1]) - (x - p[0]) * (q[1] - p[1])) / twice_area;
            let (u, v, w) = (part(b, c), part(c, a), part(a, b));
            if u >= 0.0 && v >= 0.0 && w >= 0.0 {
                call(column, row, u * a[2] + v * b[2] + w * c[2]);
            }
        }
    }
}

/// The colour of a triangle: lighter the more it faces the eye. The side does not matter.
fn shade([a, b, c]: &[Point; 3]) -> String {
    let (u, v) = ([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let facing = (normal[2].abs() / dot(normal, normal).sqrt().max(f64::MIN_POSITIVE)).min(1.0);
    let light = 0.45 + 0.55 * (facing * SHADES as f64).round() / SHADES as f64;
    let [red, green, blue] = [158.0, 196.0, 240.0].map(|channel: f64| (channel * light) as u8);
    format!("#{red:02x}{green:02x}{blue:02x}")
}
