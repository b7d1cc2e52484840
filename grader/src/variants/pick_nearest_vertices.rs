//! Mistakes in `pick_nearest_vertices`.

use finite_elements_3d as solved;
use nalgebra::{Matrix4, Vector3, Vector4};

use super::Variant;

/// The mistakes that are known.
pub const VARIANTS: &[Variant] = &[
    variant!(
        pick_nearest_vertices,
        "upside down",
        "Pixels are counted from the lower left here, not from the top.",
        |win, view, proj, viewport, V, F, radius| {
            let height = f64::from(viewport[3]);
            let turned = Vector3::new(win.x, 2.0 * f64::from(viewport[1]) + height - win.y, win.z);
            solved::pick_nearest_vertices(&turned, view, proj, viewport, V, F, radius)
        }
    ),
    variant!(
        pick_nearest_vertices,
        "corner of the viewport left out",
        "Right where the picture fills the window. Where does the picture begin otherwise?",
        |win, view, proj, viewport, V, F, radius| {
            let at_origin = Vector4::new(0.0, 0.0, viewport[2], viewport[3]);
            solved::pick_nearest_vertices(win, view, proj, &at_origin, V, F, radius)
        }
    ),
    variant!(
        pick_nearest_vertices,
        "clip depth 0 to 1",
        "Triangles close to the eye are missed: which depth does the near plane have in OpenGL?",
        |win, view, proj, viewport, V, F, radius| {
            pick(line(win, view, proj, viewport, 0.0), V, F, radius, |t| t >= 0.0, Choice::First)
        }
    ),
    variant!(
        pick_nearest_vertices,
        "matrices in the wrong order",
        "A point first goes to the eye and then to the screen. Which matrix stands next to the point?",
        |win, view, proj, viewport, V, F, radius| {
            solved::pick_nearest_vertices(win, proj, view, viewport, V, F, radius)
        }
    ),
    variant!(
        pick_nearest_vertices,
        "no perspective division",
        "Right for parallel projection only: a point has four coordinates on the way, and the fourth means something.",
        |win, view, proj, viewport, V, F, radius| {
            let ends = clip_ends(win, view, proj, viewport, -1.0);
            pick(ends.map(|end| end.xyz()), V, F, radius, |t| t >= 0.0, Choice::First)
        }
    ),
    variant!(
        pick_nearest_vertices,
        "all hits instead of the first",
        "What lies behind the first hit is hidden, and a mouse does not take hold of it.",
        |win, view, proj, viewport, V, F, radius| {
            pick(line(win, view, proj, viewport, -1.0), V, F, radius, |t| t >= 0.0, Choice::All)
        }
    ),
    variant!(
        pick_nearest_vertices,
        "last hit",
        "The hit that is farthest away was taken. Which one does the eye see?",
        |win, view, proj, viewport, V, F, radius| {
            pick(line(win, view, proj, viewport, -1.0), V, F, radius, |t| t >= 0.0, Choice::Last)
        }
    ),
    variant!(
        pick_nearest_vertices,
        "behind the eye",
        "A triangle behind the eye was hit. The line of sight begins somewhere.",
        |win, view, proj, viewport, V, F, radius| {
            pick(line(win, view, proj, viewport, -1.0), V, F, radius, |_| true, Choice::First)
        }
    ),
    variant!(
        pick_nearest_vertices,
        "no radius",
        "The corners of the triangle that was hit were returned. The page asks for the vertices within the radius.",
        |win, view, proj, viewport, V, F, _| {
            let [origin, end] = line(win, view, proj, viewport, -1.0);
            let first = F.iter().filter_map(|triangle| Some((hit(&origin, &(end - origin), V, triangle)?, triangle)));
            let first = first.filter(|(t, _)| *t >= 0.0).min_by(|a, b| a.0.total_cmp(&b.0));
            let mut corners = first.map_or(Vec::new(), |(_, triangle)| triangle.to_vec());
            corners.sort_unstable();
            corners
        }
    ),
    variant!(
        pick_nearest_vertices,
        "only the nearest vertex",
        "One vertex was returned. The page asks for all vertices within the radius.",
        |win, view, proj, viewport, V, F, radius| {
            let [origin, end] = line(win, view, proj, viewport, -1.0);
            let Some(t) = hits(&origin, &(end - origin), V, F, |t| t >= 0.0).into_iter().reduce(f64::min) else {
                return Vec::new();
            };
            let distance = |vertex: &usize| (V[*vertex] - origin - (end - origin) * t).norm();
            let nearest = (0..V.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
            nearest.filter(|vertex| distance(vertex) <= radius).into_iter().collect()
        }
    ),
    variant!(
        pick_nearest_vertices,
        "distance to the line of sight",
        "Vertices on the far side were taken too: measure from the point that was hit.",
        |win, view, proj, viewport, V, F, radius| {
            let [origin, end] = line(win, view, proj, viewport, -1.0);
            let direction = (end - origin).normalize();
            if hits(&origin, &(end - origin), V, F, |t| t >= 0.0).is_empty() {
                return Vec::new();
            }
            (0..V.len()).filter(|&vertex| (V[vertex] - origin).cross(&direction).norm() <= radius).collect()
        }
    ),
    variant!(
        pick_nearest_vertices,
        "only from the front",
        "A triangle counts from both of its sides.",
        |win, view, proj, viewport, V, F, radius| {
            let [origin, end] = line(win, view, proj, viewport, -1.0);
            let faces_us = |triangle: &&[usize; 3]| {
                let [a, b, c] = triangle.map(|vertex| V[vertex]);
                (b - a).cross(&(c - a)).dot(&(end - origin)) < 0.0
            };
            let front: Vec<[usize; 3]> = F.iter().filter(faces_us).copied().collect();
            solved::pick_nearest_vertices(win, view, proj, viewport, V, &front, radius)
        }
    ),
];

/// Which of the hits have neighbours.
enum Choice {
    First,
    Last,
    All,
}

/// Two points on the line of sight, the first with the given clip depth, before the division.
fn clip_ends(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    near: f64,
) -> [Vector4<f64>; 2] {
    let back = (proj.cast::<f64>() * view.cast::<f64>()).try_inverse().unwrap_or_default();
    let viewport = viewport.cast::<f64>();
    let x = 2.0 * (win.x - viewport[0]) / viewport[2] - 1.0;
    let y = 2.0 * (win.y - viewport[1]) / viewport[3] - 1.0;
    [near, 1.0].map(|depth| back * Vector4::new(x, y, depth, 1.0))
}

fn line(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    near: f64,
) -> [Vector3<f64>; 2] {
    clip_ends(win, view, proj, viewport, near).map(|end| end.xyz() / end.w)
}

fn pick(
    [origin, end]: [Vector3<f64>; 2],
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
    radius: f64,
    counts: impl Fn(f64) -> bool,
    choice: Choice,
) -> Vec<usize> {
    let hits = hits(&origin, &(end - origin), V, F, counts);
    let chosen: Vec<f64> = match choice {
        Choice::First => hits.into_iter().reduce(f64::min).into_iter().collect(),
        Choice::Last => hits.into_iter().reduce(f64::max).into_iter().collect(),
        Choice::All => hits,
    };
    let near = |vertex: &usize| chosen.iter().any(|t| (V[*vertex] - origin - (end - origin) * *t).norm() <= radius);
    (0..V.len()).filter(near).collect()
}

fn hits(
    origin: &Vector3<f64>,
    direction: &Vector3<f64>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
    counts: impl Fn(f64) -> bool,
) -> Vec<f64> {
    F.iter().filter_map(|triangle| hit(origin, direction, V, triangle)).filter(|&t| counts(t)).collect()
}

fn hit(origin: &Vector3<f64>, direction: &Vector3<f64>, V: &[Vector3<f64>], triangle: &[usize; 3]) -> Option<f64> {
    let [a, b, c] = triangle.map(|vertex| V[vertex]);
    let (p, q) = (direction.cross(&(c - a)), (origin - a).cross(&(b - a)));
    let determinant = (b - a).dot(&p);
    let (u, v) = ((origin - a).dot(&p) / determinant, direction.dot(&q) / determinant);
    let inside = u >= -1e-12 && v >= -1e-12 && u + v <= 1.0 + 1e-12;
    Some((c - a).dot(&q) / determinant).filter(|t| inside && t.is_finite())
}
