//! Draws the pictures of `data/pictures`: `cargo run --release -p fem-mesh --features pictures --example draw_pictures -- FOLDER`.
//!
//! Each shape is a function that tells whether a point is inside; the coverage of a pixel is the mean over 16 × 16 points. The armadillo is
//! the silhouette of the one in `data/own`. Some pictures are opaque on a transparent ground, others dark on a light one.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use fem_mesh::SurfaceMesh;
use image::{GrayImage, Luma, RgbImage, Rgba, RgbaImage};
use nalgebra::Vector2;

/// Points along the side of a pixel.
const SAMPLES: usize = 16;

type Shape<'a> = &'a dyn Fn(Vector2<f64>) -> bool;

fn main() {
    let folder = std::env::args().nth(1).expect("give the folder");
    let at = |name: &str| Path::new(&folder).join(name);
    opaque([256, 256], &donut).save(at("donut.png")).expect("the folder exists");
    dark([280, 260], &|x| is_in_polygon(&TRIANGLE, x), 0, 255).save(at("triangle.png")).expect("as above");
    dark([256, 256], &|x| x.x > 27.3 && x.x < 228.7 && x.y > 27.3 && x.y < 228.7, 40, 230)
        .save(at("square.png"))
        .expect("as above");
    coloured([320, 400], &letter).save(at("letter.png")).expect("as above");
    opaque([400, 400], &gear).save(at("gear.png")).expect("as above");
    opaque([360, 480], &bunny).save(at("bunny.png")).expect("as above");
    let surface = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/own/armadillo_own_37k.obj");
    let surface = fem_mesh::read_surface(&surface).expect("the own armadillo is there");
    let (width, mask) = silhouette(&surface, 360);
    let is_inside = |x: Vector2<f64>| {
        let [i, j] = [x.x, x.y].map(|x| (x * SAMPLES as f64) as usize);
        mask.get(j * width * SAMPLES + i).is_some_and(|inside| *inside)
    };
    dark([width, 360], &is_inside, 0, 255).save(at("armadillo.png")).expect("as above");
}

/// Part of a pixel, counted from the lower left, that a shape covers.
fn coverage(shape: Shape, i: u32, j: u32) -> f64 {
    let points = (0..SAMPLES * SAMPLES).map(|k| [k % SAMPLES, k / SAMPLES].map(|k| (k as f64 + 0.5) / SAMPLES as f64));
    let inside = points.filter(|[x, y]| shape(Vector2::new(f64::from(i) + x, f64::from(j) + y))).count();
    inside as f64 / (SAMPLES * SAMPLES) as f64
}

fn opaque([width, height]: [u32; 2], shape: Shape) -> RgbaImage {
    RgbaImage::from_fn(width, height, |i, j| {
        Rgba([30, 90, 160, (255.0 * coverage(shape, i, height - 1 - j)).round() as u8])
    })
}

fn dark([width, height]: [usize; 2], shape: Shape, dark: u8, light: u8) -> GrayImage {
    GrayImage::from_fn(width as u32, height as u32, |i, j| {
        let share = coverage(shape, i, height as u32 - 1 - j);
        Luma([(f64::from(light) + share * (f64::from(dark) - f64::from(light))).round() as u8])
    })
}

fn coloured([width, height]: [u32; 2], shape: Shape) -> RgbImage {
    RgbImage::from_fn(width, height, |i, j| {
        let share = coverage(shape, i, height - 1 - j);
        image::Rgb(
            [[250.0, 120.0], [246.0, 20.0], [235.0, 40.0]].map(|[light, dark]| (light + share * (dark - light)) as u8),
        )
    })
}

/// Corners of a triangle with angles of 60°, 75° and 45°.
const TRIANGLE: [[f64; 2]; 3] = [[20.4, 25.7], [258.6, 25.7], [107.6, 176.7]];

fn is_in_polygon(corners: &[[f64; 2]], x: Vector2<f64>) -> bool {
    (0..corners.len()).all(|i| {
        let [a, b] = [corners[i], corners[(i + 1) % corners.len()]].map(Vector2::from);
        (b - a).perp(&(x - a)) > 0.0
    })
}

fn donut(x: Vector2<f64>) -> bool {
    let radius = (x - Vector2::new(128.3, 127.8)).norm();
    (48.0..112.0).contains(&radius)
}

/// A capital B: a stem and two bowls with their holes.
fn letter(x: Vector2<f64>) -> bool {
    let bowl = |bottom: f64, top: f64, right: f64, x: Vector2<f64>| {
        let (radius, middle) = (0.5 * (top - bottom), 0.5 * (top + bottom));
        let in_box = x.x > 60.0 && x.x < right - radius && x.y > bottom && x.y < top;
        in_box || (x - Vector2::new(right - radius, middle)).norm() < radius
    };
    let outer = bowl(30.0, 220.0, 280.0, x) || bowl(200.0, 370.0, 255.0, x);
    let lower_hole = x.x > 116.0 && bowl(82.0, 172.0, 222.0, x);
    let upper_hole = x.x > 116.0 && bowl(246.0, 322.0, 202.0, x);
    outer && !lower_hole && !upper_hole
}

/// Twelve teeth with straight flanks, and a bore.
fn gear(x: Vector2<f64>) -> bool {
    let x = x - Vector2::new(200.0, 200.0);
    let radius = x.norm();
    let pitch = TAU / 12.0;
    let in_tooth = (x.y.atan2(x.x).rem_euclid(pitch) - 0.5 * pitch).abs();
    // Half of a tooth's width falls from 0.30 of the pitch at its foot to 0.16 at its tip.
    let share = (radius - 150.0) / 36.0;
    let is_tooth = radius < 186.0 && in_tooth < pitch * (0.30 - 0.14 * share);
    (radius < 150.0 || is_tooth) && radius > 55.0
}

/// A sitting rabbit in profile: ellipses with their centre, half axes and turn.
fn bunny(x: Vector2<f64>) -> bool {
    const PARTS: [[f64; 5]; 8] = [
        [165.0, 130.0, 112.0, 100.0, 0.1],
        [225.0, 215.0, 62.0, 80.0, -0.35],
        [255.0, 285.0, 62.0, 50.0, -0.25],
        [225.0, 382.0, 22.0, 78.0, 0.16],
        [270.0, 378.0, 21.0, 76.0, -0.22],
        [62.0, 95.0, 34.0, 32.0, 0.0],
        [265.0, 62.0, 58.0, 30.0, 0.05],
        [165.0, 52.0, 95.0, 30.0, 0.0],
    ];
    PARTS.iter().any(|&[cx, cy, a, b, turn]| {
        let d = x - Vector2::new(cx, cy);
        let (sine, cosine) = (turn * PI / 2.0).sin_cos();
        let [u, v] = [cosine * d.x + sine * d.y, cosine * d.y - sine * d.x];
        (u / a).powi(2) + (v / b).powi(2) < 1.0
    })
}

/// A surface seen along −z, as a mask of sample points, with its width in pixels.
fn silhouette(surface: &SurfaceMesh, height: usize) -> (usize, Vec<bool>) {
    let margin = 16.0;
    let bound =
        |pick: fn(f64, f64) -> f64, start: f64, axis: usize| surface.vertices.iter().map(|x| x[axis]).fold(start, pick);
    let [left, bottom] = [0, 1].map(|axis| bound(f64::min, f64::INFINITY, axis));
    let [right, top] = [0, 1].map(|axis| bound(f64::max, f64::NEG_INFINITY, axis));
    let scale = (height as f64 - 2.0 * margin) / (top - bottom);
    let width = ((right - left) * scale + 2.0 * margin).ceil() as usize;
    let mut mask = vec![false; width * height * SAMPLES * SAMPLES];
    for element in &surface.elements {
        let place = |vertex: usize| {
            let x = surface.vertices[vertex];
            (Vector2::new(x.x - left, x.y - bottom) * scale + Vector2::repeat(margin)) * SAMPLES as f64
        };
        let corners = element.map(place);
        let low = corners.iter().fold(Vector2::repeat(f64::INFINITY), |low, x| low.inf(x));
        let high = corners.iter().fold(Vector2::zeros(), |high: Vector2<f64>, x| high.sup(x));
        for j in low.y as usize..=high.y as usize {
            for i in low.x as usize..=high.x as usize {
                let at = Vector2::new(i as f64 + 0.5, j as f64 + 0.5);
                let sides = [0, 1, 2].map(|k| (corners[(k + 1) % 3] - corners[k]).perp(&(at - corners[k])));
                if sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0) {
                    mask[j * width * SAMPLES + i] = true;
                }
            }
        }
    }
    (width, mask)
}
