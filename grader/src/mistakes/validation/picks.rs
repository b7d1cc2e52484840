//! Picking with the mouse.

use nalgebra::{Matrix4, Vector3, Vector4};

use super::super::Mistake;

type Point = Vector3<f64>;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // The nearest triangle is that with the nearest centroid to the eye.
    wrong!(
        pick_nearest_vertices,
        ["nearest triangle by its centroid", "last hit"],
        |win, view, proj, viewport, V, F, radius| {
            let (o, d) = ray(win, view, proj, viewport);
            let middle = |t: &[usize; 3]| ((V[t[0]] + V[t[1]] + V[t[2]]) / 3.0 - o).norm();
            let mut hits: Vec<_> = F.iter().filter_map(|t| Some((t, hit(&o, &d, V, t)?))).collect();
            hits.sort_by(|a, b| middle(b.0).total_cmp(&middle(a.0)));
            within(V, hits.first().map(|h| o + d * h.1), radius)
        }
    ),
    // The first hit of the ray's line, behind the eye too, by its absolute value.
    wrong!(pick_nearest_vertices, ["behind the eye", "last hit"], |win, view, proj, viewport, V, F, radius| {
        let (o, d) = ray(win, view, proj, viewport);
        let (near, far) = (o + d * 0.5, d * 0.5);
        let hits = F.iter().filter_map(|t| hit_line(&near, &far, V, t));
        within(V, hits.min_by(|a, b| a.abs().total_cmp(&b.abs())).map(|t| near + far * t), radius)
    }),
    wrong!(pick_nearest_vertices, ["mirrored"], |win, view, proj, viewport, V, F, radius| {
        let x = 2.0 * f64::from(viewport[0]) + f64::from(viewport[2]) - win.x;
        right!(pick_nearest_vertices(&Vector3::new(x, win.y, win.z), view, proj, viewport, V, F, radius))
    }),
    wrong!(pick_nearest_vertices, ["width and height swapped"], |win, view, proj, viewport, V, F, radius| {
        let swapped = Vector4::new(viewport[0], viewport[1], viewport[3], viewport[2]);
        right!(pick_nearest_vertices(win, view, proj, &swapped, V, F, radius))
    }),
    wrong!(pick_nearest_vertices, ["view left out"], |win, _, proj, viewport, V, F, radius| {
        right!(pick_nearest_vertices(win, &Matrix4::identity(), proj, viewport, V, F, radius))
    }),
    // A box instead of a ball.
    wrong!(
        pick_nearest_vertices,
        ["box for the ball", "largest coordinate for the distance"],
        |win, view, proj, viewport, V, F, radius| {
            let (o, d) = ray(win, view, proj, viewport);
            let t = F.iter().filter_map(|t| hit(&o, &d, V, t)).min_by(f64::total_cmp);
            t.map_or(Vec::new(), |t| (0..V.len()).filter(|&a| (V[a] - o - d * t).amax() <= radius).collect())
        }
    ),
    // Faces are indices of triangles: the corners of every triangle with a corner within the radius.
    wrong!(
        pick_nearest_vertices,
        ["whole triangles", "corners of the triangles near"],
        |win, view, proj, viewport, V, F, radius| {
            let found = right!(pick_nearest_vertices(win, view, proj, viewport, V, F, radius));
            let mut all: Vec<usize> =
                F.iter().filter(|t| t.iter().any(|a| found.contains(a))).flatten().copied().collect();
            all.extend(found);
            all.sort_unstable();
            all.dedup();
            all
        }
    ),
    wrong!(pick_nearest_vertices, ["radius left out"], |win, view, proj, viewport, V, F, _| {
        right!(pick_nearest_vertices(win, view, proj, viewport, V, F, 1e9))
    }),
    wrong!(pick_nearest_vertices, ["square of the radius"], |win, view, proj, viewport, V, F, radius| {
        right!(pick_nearest_vertices(win, view, proj, viewport, V, F, radius * radius))
    }),
];

fn within(V: &[Point], point: Option<Point>, radius: f64) -> Vec<usize> {
    point.map_or(Vec::new(), |p| (0..V.len()).filter(|&a| (V[a] - p).norm() <= radius).collect())
}

fn ray(win: &Point, view: &Matrix4<f32>, proj: &Matrix4<f32>, viewport: &Vector4<f32>) -> (Point, Point) {
    let back = (proj.cast::<f64>() * view.cast::<f64>()).try_inverse().unwrap_or_default();
    let v = viewport.cast::<f64>();
    let (x, y) = ((win.x - v[0]) / v[2] * 2.0 - 1.0, (win.y - v[1]) / v[3] * 2.0 - 1.0);
    let [near, far] = [-1.0, 1.0].map(|z| back * Vector4::new(x, y, z, 1.0)).map(|p| p.xyz() / p.w);
    (near, far - near)
}

fn hit(o: &Point, d: &Point, V: &[Point], t: &[usize; 3]) -> Option<f64> {
    hit_line(o, d, V, t).filter(|t| *t >= 0.0)
}

fn hit_line(o: &Point, d: &Point, V: &[Point], t: &[usize; 3]) -> Option<f64> {
    let [a, b, c] = t.map(|vertex| V[vertex]);
    let n = (b - a).cross(&(c - a));
    let along = (a - o).dot(&n) / d.dot(&n);
    let p = o + d * along;
    let inside = |a: Point, b: Point| (b - a).cross(&(p - a)).dot(&n) >= -1e-12 * n.norm_squared();
    (along.is_finite() && inside(a, b) && inside(b, c) && inside(c, a)).then_some(along)
}
