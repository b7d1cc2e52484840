//! Draws the pictures of `data/pictures`: `cargo run --release -p fem-mesh-tests --example draw_pictures -- FOLDER`.
//!
//! Each shape is a function that tells whether a point is inside; the coverage of a pixel is the mean over 16 × 16 points. Paint is a
//! function of the point too, and goes on around the shape, so that no other colour shows at its outline. The armadillo is that of
//! `data/own`, seen from the front. The pictures are opaque on a transparent ground; the letter is dark on a light one.

use std::f64::consts::{PI, TAU};
use std::fs::File;
use std::path::Path;

use fem_mesh::SurfaceMesh;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{RgbImage, Rgba, RgbaImage};
use nalgebra::{Vector2, Vector3};

/// Points along the side of a pixel, for shapes and for paint.
const SAMPLES: usize = 16;
const PAINT_SAMPLES: usize = 4;

type Shape<'a> = &'a dyn Fn(Vector2<f64>) -> bool;
type Paint<'a> = &'a dyn Fn(Vector2<f64>) -> Color;

/// Red, green and blue, sRGB, from 0 to 255.
type Color = Vector3<f64>;

/// Grey values of the ground and of the shape, between which a pixel at the outline is rounded.
type Greys = [f64; 2];
const OPAQUE: Greys = [0.0, 255.0];
const BLACK_ON_WHITE: Greys = [255.0, 0.0];
const GREY_ON_GREY: Greys = [230.0, 40.0];

fn main() {
    let folder = std::env::args().nth(1).expect("give the folder");
    let save = |name: &str, picture: RgbaImage| {
        let file = File::create(Path::new(&folder).join(name)).expect("the folder exists");
        let encoder = PngEncoder::new_with_quality(file, CompressionType::Best, FilterType::Adaptive);
        picture.write_with_encoder(encoder).expect("the disk has space");
    };
    save("donut.png", opaque([256, 256], &donut, OPAQUE, &donut_paint));
    save("triangle.png", opaque([280, 260], &|x| is_in_polygon(&TRIANGLE, x), BLACK_ON_WHITE, &triangle_paint));
    save("square.png", opaque([256, 256], &square, GREY_ON_GREY, &square_paint));
    save("gear.png", opaque([400, 400], &gear, OPAQUE, &|_| color(30, 90, 160)));
    save("bunny.png", opaque([360, 480], &bunny, OPAQUE, &bunny_paint));
    coloured([320, 400], &letter).save(Path::new(&folder).join("letter.png")).expect("the folder exists");
    let surface = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/own/armadillo_own_37k.obj");
    let surface = fem_mesh::read_surface(&surface).expect("the own armadillo is there");
    let view = View::of(&surface, 360);
    let paint = |x| armadillo_paint(&view, x);
    save("armadillo.png", opaque([view.width as u32, 360], &|x| view.at(x).is_some(), BLACK_ON_WHITE, &paint));
}

/// Mean over the points of a pixel, counted from the lower left.
fn mean<const N: usize>([i, j]: [u32; 2], value: impl Fn(Vector2<f64>) -> Color) -> Color {
    let points = (0..N * N).map(|k| [k % N, k / N].map(|k| (k as f64 + 0.5) / N as f64));
    let sum: Color = points.map(|[x, y]| value(Vector2::new(f64::from(i) + x, f64::from(j) + y))).sum();
    sum / (N * N) as f64
}

/// Part of a pixel that a shape covers.
fn coverage(shape: Shape, pixel: [u32; 2]) -> f64 {
    mean::<SAMPLES>(pixel, |x| Color::repeat(f64::from(u8::from(shape(x))))).x
}

/// Returns true if the shape reaches into a pixel or its neighbours.
fn is_near(shape: Shape, pixel: [u32; 2]) -> bool {
    let corner = Vector2::from(pixel.map(f64::from));
    (0..49).any(|k| shape(corner + Vector2::new(f64::from(k % 7), f64::from(k / 7)) * 0.5 - Vector2::repeat(1.0)))
}

/// A painted shape. Its opacity is the coverage that the mesher finds in a picture of two greys, with its roundings: meshes of the
/// pictures, which were grey at first, stay what they are.
fn opaque([width, height]: [u32; 2], shape: Shape, [ground, inside]: Greys, paint: Paint) -> RgbaImage {
    RgbaImage::from_fn(width, height, |i, j| {
        let pixel = [i, height - 1 - j];
        let grey = (ground + coverage(shape, pixel) * (inside - ground)).round();
        let opacity = 255.0 * ((ground - grey) / (ground - inside));
        if !is_near(shape, pixel) {
            return Rgba([0; 4]);
        }
        let [red, green, blue] = mean::<PAINT_SAMPLES>(pixel, paint).map(|value| value.round() as u8).into();
        Rgba([red, green, blue, opacity.round() as u8])
    })
}

fn coloured([width, height]: [u32; 2], shape: Shape) -> RgbImage {
    RgbImage::from_fn(width, height, |i, j| {
        let share = coverage(shape, [i, height - 1 - j]);
        image::Rgb(
            [[250.0, 120.0], [246.0, 20.0], [235.0, 40.0]].map(|[light, dark]| (light + share * (dark - light)) as u8),
        )
    })
}

fn color(red: u8, green: u8, blue: u8) -> Color {
    Color::new(red.into(), green.into(), blue.into())
}

/// A mixture, of the first colour for a share of 0 or less and of the second one for 1 or more.
fn mixed(first: Color, second: Color, share: f64) -> Color {
    first.lerp(&second, share.clamp(0.0, 1.0))
}

/// Returns true within a distance from the line between two points.
fn is_on_line(x: Vector2<f64>, a: [f64; 2], b: [f64; 2], distance: f64) -> bool {
    let [a, b] = [a, b].map(Vector2::from);
    let share = ((x - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
    (x - a.lerp(&b, share)).norm() < distance
}

/// An ellipse: its centre, half axes and turn, in right angles.
type Ellipse = [f64; 5];

/// Squared distance from the centre of an ellipse, 1 on its outline.
fn in_ellipse([cx, cy, a, b, turn]: Ellipse, x: Vector2<f64>) -> f64 {
    let d = x - Vector2::new(cx, cy);
    let (sine, cosine) = (turn * PI / 2.0).sin_cos();
    let [u, v] = [cosine * d.x + sine * d.y, cosine * d.y - sine * d.x];
    (u / a).powi(2) + (v / b).powi(2)
}

fn disc(cx: f64, cy: f64, radius: f64) -> Ellipse {
    [cx, cy, radius, radius, 0.0]
}

/// The colour of the last ellipse that a point lies in, or else another one.
fn layers(x: Vector2<f64>, below: Color, above: &[(Ellipse, Color)]) -> Color {
    let top = above.iter().rev().find(|(ellipse, _)| in_ellipse(*ellipse, x) < 1.0);
    top.map_or(below, |(_, color)| *color)
}

/// Corners of a triangle with angles of 60°, 75° and 45°.
const TRIANGLE: [[f64; 2]; 3] = [[20.4, 25.7], [258.6, 25.7], [107.6, 176.7]];

fn is_in_polygon(corners: &[[f64; 2]], x: Vector2<f64>) -> bool {
    (0..corners.len()).all(|i| {
        let [a, b] = [corners[i], corners[(i + 1) % corners.len()]].map(Vector2::from);
        (b - a).perp(&(x - a)) > 0.0
    })
}

/// A colour for each corner, and twelve stripes along each side.
fn triangle_paint(x: Vector2<f64>) -> Color {
    let [a, b, c] = TRIANGLE.map(Vector2::from);
    let area = (b - a).perp(&(c - a));
    let shares = [(c - b).perp(&(x - b)), (a - c).perp(&(x - c)), (b - a).perp(&(x - a))].map(|part| part / area);
    let corners = [color(222, 66, 58), color(44, 116, 196), color(250, 196, 60)];
    let gradient: Color = corners.iter().zip(shares).map(|(color, share)| color * share.clamp(0.0, 1.0)).sum();
    let is_line = shares.iter().any(|share| (12.0 * share + 0.04).rem_euclid(1.0) < 0.08);
    let is_stripe = (12.0 * shares[2]).rem_euclid(2.0) < 1.0;
    let striped = mixed(gradient, color(255, 255, 255), if is_stripe { 0.25 } else { 0.0 });
    mixed(striped, color(40, 30, 30), if is_line { 0.6 } else { 0.0 })
}

/// Ends of the square along both axes.
const SQUARE: [f64; 2] = [27.3, 228.7];

fn square(x: Vector2<f64>) -> bool {
    let is_within = |x: f64| x > SQUARE[0] && x < SQUARE[1];
    is_within(x.x) && is_within(x.y)
}

/// A board of ten by ten fields with lines between them, a cross in the middle and a colour in each corner.
fn square_paint(x: Vector2<f64>) -> Color {
    let place = x.map(|x| 10.0 * (x - SQUARE[0]) / (SQUARE[1] - SQUARE[0]));
    let [i, j] = [place.x, place.y].map(|x| x.floor().clamp(0.0, 9.0) as usize);
    let field = match [i, j] {
        [0, 0] => color(214, 70, 60),
        [9, 0] => color(58, 148, 86),
        [9, 9] => color(58, 104, 190),
        [0, 9] => color(238, 186, 52),
        _ if (i + j).is_multiple_of(2) => color(96, 158, 168),
        _ => color(247, 240, 222),
    };
    let is_cross = place.iter().any(|x| (x - 5.0).abs() < 0.1);
    let is_line = place.iter().any(|x| (x - x.round()).abs() < 0.035);
    match (is_cross, is_line) {
        (true, _) => color(190, 52, 44),
        (_, true) => color(52, 66, 72),
        _ => field,
    }
}

fn donut(x: Vector2<f64>) -> bool {
    let radius = (x - DONUT).norm();
    (48.0..112.0).contains(&radius)
}

const DONUT: Vector2<f64> = Vector2::new(128.3, 127.8);

/// Dough with icing and sprinkles, lit from the upper left.
fn donut_paint(x: Vector2<f64>) -> Color {
    let d = x - DONUT;
    let (radius, angle) = (d.norm(), d.y.atan2(d.x));
    let across = (radius - 80.0) / 32.0; // -1 at the hole, 1 at the rim
    let light = -across * (angle - 0.75 * PI).cos(); // the hole's far side faces the light
    let outer = 99.0 + 4.0 * (5.0 * angle + 0.7).sin() + 2.5 * (11.0 * angle).sin();
    let inner = 59.0 + 2.0 * (7.0 * angle).sin();
    if !(inner..outer).contains(&radius) {
        let dough = mixed(color(226, 172, 104), color(168, 106, 50), across * across);
        return mixed(dough, color(120, 70, 30), 0.35 * light);
    }
    let sprinkles =
        [color(255, 250, 240), color(255, 214, 64), color(74, 176, 220), color(110, 196, 98), color(120, 62, 40)];
    for k in 0..64 {
        let (turn, share) = (2.399963 * f64::from(k), (f64::from(k) + 0.5) / 64.0);
        let centre =
            DONUT + (65.0_f64.powi(2) + share * (93.0_f64.powi(2) - 65.0_f64.powi(2))).sqrt() * direction(turn);
        let half = 4.0 * direction(1.7 * f64::from(k));
        if is_on_line(x, (centre - half).into(), (centre + half).into(), 1.8) {
            return sprinkles[k as usize % sprinkles.len()];
        }
    }
    let edge = f64::min(radius - inner, outer - radius);
    let icing = mixed(color(206, 82, 132), color(242, 128, 172), edge / 5.0);
    let icing = mixed(icing, color(150, 50, 100), 0.3 * light);
    let shine = 1.0 - ((radius - 90.0) / 4.0).powi(2) - ((angle - 0.75 * PI) / 0.45).powi(2);
    mixed(icing, color(255, 225, 238), 0.8 * shine)
}

fn direction(angle: f64) -> Vector2<f64> {
    Vector2::new(angle.cos(), angle.sin())
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

/// A sitting rabbit in profile: body, chest, head, ears, tail, paw and foot.
const BUNNY: [Ellipse; 8] = [
    [165.0, 130.0, 112.0, 100.0, 0.1],
    [225.0, 215.0, 62.0, 80.0, -0.35],
    [255.0, 285.0, 62.0, 50.0, -0.25],
    [225.0, 382.0, 22.0, 78.0, 0.16],
    [270.0, 378.0, 21.0, 76.0, -0.22],
    [62.0, 95.0, 34.0, 32.0, 0.0],
    [265.0, 62.0, 58.0, 30.0, 0.05],
    [165.0, 52.0, 95.0, 30.0, 0.0],
];

fn bunny(x: Vector2<f64>) -> bool {
    BUNNY.iter().any(|part| in_ellipse(*part, x) < 1.0)
}

/// Fur that is darker towards the outline of each part, and a face.
fn bunny_paint(x: Vector2<f64>) -> Color {
    let [body, chest, head, back_ear, front_ear, tail, paw, foot] = BUNNY;
    let (fur, shade, white, pink) =
        (color(186, 146, 110), color(112, 80, 58), color(246, 240, 232), color(236, 168, 168));
    let haunch = [128.0, 112.0, 72.0, 66.0, 0.1];
    let parts = [
        (tail, white),
        (body, fur),
        (foot, fur),
        (chest, fur),
        (haunch, fur),
        (paw, fur),
        (back_ear, fur),
        (front_ear, fur),
        (head, fur),
    ];
    let top = parts.iter().rev().find(|(part, _)| in_ellipse(*part, x) < 1.0);
    let furry = top.map_or(shade, |(part, color)| mixed(*color, shade, 0.7 * in_ellipse(*part, x).powi(4)));
    let belly = 1.0 - in_ellipse([232.0, 150.0, 40.0, 78.0, -0.15], x);
    let furry = mixed(furry, white, 0.9 * belly);
    let whiskers = [262.0, 254.0, 246.0].map(|y| is_on_line(x, [296.0, 262.0], [250.0, y], 0.9));
    let toes = [286.0, 301.0].map(|cx| is_on_line(x, [cx, 60.0], [cx + 4.0, 46.0], 1.2));
    let mouth =
        is_on_line(x, [309.0, 264.0], [304.0, 254.0], 1.1) || is_on_line(x, [304.0, 254.0], [292.0, 251.0], 1.1);
    if whiskers.contains(&true) || toes.contains(&true) || mouth {
        return color(84, 56, 44);
    }
    layers(
        x,
        furry,
        &[
            ([227.0, 384.0, 11.0, 60.0, 0.16], pink),
            ([271.0, 380.0, 11.0, 58.0, -0.22], pink),
            (disc(278.0, 297.0, 9.5), color(246, 240, 232)),
            (disc(279.0, 296.5, 7.5), color(46, 28, 22)),
            (disc(282.0, 300.0, 2.4), color(255, 255, 255)),
            ([308.0, 270.0, 5.5, 6.0, 0.0], color(214, 110, 120)),
        ],
    )
}

/// A surface seen along −z: depth and light of the nearest triangle at each sample point.
struct View {
    /// Pixels.
    width: usize,
    samples: Vec<Option<(f64, f64)>>,
}

impl View {
    fn of(surface: &SurfaceMesh, height: usize) -> Self {
        let margin = 16.0;
        let bound = |pick: fn(f64, f64) -> f64, start: f64, axis: usize| {
            surface.vertices.iter().map(|x| x[axis]).fold(start, pick)
        };
        let [left, bottom] = [0, 1].map(|axis| bound(f64::min, f64::INFINITY, axis));
        let [right, top] = [0, 1].map(|axis| bound(f64::max, f64::NEG_INFINITY, axis));
        let scale = (height as f64 - 2.0 * margin) / (top - bottom);
        let width = ((right - left) * scale + 2.0 * margin).ceil() as usize;
        let mut samples: Vec<Option<(f64, f64)>> = vec![None; width * height * SAMPLES * SAMPLES];
        let lamp = Vector3::new(-0.45, 0.6, 0.66);
        for element in &surface.elements {
            let places = element.map(|vertex| surface.vertices[vertex]);
            let place = |x: Vector3<f64>| {
                (Vector2::new(x.x - left, x.y - bottom) * scale + Vector2::repeat(margin)) * SAMPLES as f64
            };
            let corners = places.map(place);
            let normal = (places[1] - places[0]).cross(&(places[2] - places[0])).normalize();
            let (depth, light) = (places.iter().map(|x| x.z).sum::<f64>() / 3.0, normal.dot(&lamp));
            let low = corners.iter().fold(Vector2::repeat(f64::INFINITY), |low, x| low.inf(x));
            let high = corners.iter().fold(Vector2::zeros(), |high: Vector2<f64>, x| high.sup(x));
            for j in low.y as usize..=high.y as usize {
                for i in low.x as usize..=high.x as usize {
                    let at = Vector2::new(i as f64 + 0.5, j as f64 + 0.5);
                    let sides = [0, 1, 2].map(|k| (corners[(k + 1) % 3] - corners[k]).perp(&(at - corners[k])));
                    let sample = &mut samples[j * width * SAMPLES + i];
                    let is_inside = sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0);
                    if is_inside && sample.is_none_or(|(before, _)| before < depth) {
                        *sample = Some((depth, light));
                    }
                }
            }
        }
        View { width, samples }
    }

    /// Depth and light at a place in the picture, or `None` beside the surface.
    fn at(&self, x: Vector2<f64>) -> Option<(f64, f64)> {
        let [i, j] = [x.x, x.y].map(|x| (x * SAMPLES as f64) as usize);
        self.samples.get(j * self.width * SAMPLES + i).copied().flatten()
    }
}

/// Skin with bands of armour, lit from the upper left, and a face.
fn armadillo_paint(view: &View, x: Vector2<f64>) -> Color {
    let middle = 0.5 * view.width as f64;
    let aside = Vector2::new((x.x - middle).abs(), x.y);
    let light = view.at(x).map_or(0.3, |(_, light)| light);
    let is_face = in_ellipse([0.0, 284.0, 34.0, 33.0, 0.0], aside) < 1.0;
    let is_band = !is_face && (x.y + 0.004 * aside.x * aside.x).rem_euclid(13.0) < 2.6;
    let base = match is_band {
        true => color(84, 64, 50),
        false => color(172, 138, 104),
    };
    let lit = mixed(base * 0.45, base * 1.25, light).map(|value| value.min(255.0));
    let eye = disc(14.0, 292.0, 6.0);
    layers(
        aside,
        lit,
        &[
            (eye, color(246, 240, 226)),
            (disc(13.0, 292.0, 3.5), color(30, 22, 18)),
            (disc(0.0, 268.0, 5.0), color(70, 40, 36)),
        ],
    )
}
