//! Nodes under a click.

use nalgebra::{Point3, Vector3, Vector4};

use fem_model::simulation::{Click, Shape};

/// Nodes within [`Shape::pick_radius`] of the first point of the boundary under a click, ascending; empty if the click misses it.
/// `x` are the positions of the nodes now, m.
pub fn nodes_under(click: &Click, x: &[Vector3<f64>], shape: &Shape) -> Vec<usize> {
    let Some((origin, direction)) = ray(click) else { return Vec::new() };
    let hits = shape.boundary.iter().filter_map(|face| hit(&origin, &direction, face.map(|node| x[node])));
    let first = hits.fold(f64::INFINITY, f64::min);
    if !first.is_finite() {
        return Vec::new();
    }
    let point = origin + first * direction;
    let radius = shape.pick_radius(x);
    (0..x.len()).filter(|&node| (x[node] - point).norm() <= radius).collect()
}

/// Line of sight through a pixel: its points on the near plane and on the far plane.
fn ray(click: &Click) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let from_clip = (click.proj.cast::<f64>() * click.view.cast::<f64>()).lu().try_inverse()?;
    let viewport = click.viewport.cast::<f64>();
    let x = 2.0 * (click.win.x - viewport.x) / viewport.z - 1.0;
    let y = 2.0 * (click.win.y - viewport.y) / viewport.w - 1.0;
    let at = |depth: f64| Point3::from_homogeneous(from_clip * Vector4::new(x, y, depth, 1.0));
    let (near, far) = (at(-1.0)?, at(1.0)?);
    Some((near.coords, far - near))
}

/// Distance along a ray to a triangle, in lengths of its direction: Möller and Trumbore, Fast, Minimum Storage Ray/Triangle
/// Intersection (1997).
fn hit(origin: &Vector3<f64>, direction: &Vector3<f64>, [a, b, c]: [Vector3<f64>; 3]) -> Option<f64> {
    let (ab, ac, to_origin) = (b - a, c - a, origin - a);
    let (p, q) = (direction.cross(&ac), to_origin.cross(&ab));
    let determinant = ab.dot(&p);
    let (u, v, t) = (to_origin.dot(&p) / determinant, direction.dot(&q) / determinant, ac.dot(&q) / determinant);
    // A tolerance, so that there are no gaps between triangles. NaN, of a ray in the triangle's plane, fails.
    let slack = 1e-12;
    (u >= -slack && v >= -slack && u + v <= 1.0 + slack && t >= 0.0 && t.is_finite()).then_some(t)
}
