//! Picking with the mouse.

use nalgebra::{Matrix4, Vector3, Vector4};

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    wrong!(pick_nearest_vertices, ["radius for its square"], |win, view, proj, viewport, V, F, radius| {
        near(V, first(win, view, proj, viewport, V, F), |d| d * d <= radius)
    }),
    wrong!(pick_nearest_vertices, ["radius doubled"], |win, view, proj, viewport, V, F, radius| {
        near(V, first(win, view, proj, viewport, V, F), |d| d <= 2.0 * radius)
    }),
    wrong!(pick_nearest_vertices, ["descending"], |win, view, proj, viewport, V, F, radius| {
        let mut found = right!(pick_nearest_vertices(win, view, proj, viewport, V, F, radius));
        found.reverse();
        found
    }),
    wrong!(pick_nearest_vertices, ["first triangle of the list"], |win, view, proj, viewport, V, F, radius| {
        let (o, d) = ray(win, view, proj, viewport);
        let point = F.iter().find_map(|t| hit(&o, &d, V, t)).map(|t| o + d * t);
        near(V, point, |d| d <= radius)
    }),
    wrong!(pick_nearest_vertices, ["sorted by distance"], |win, view, proj, viewport, V, F, radius| {
        let point = first(win, view, proj, viewport, V, F);
        let mut found = near(V, point, |d| d <= radius);
        if let Some(p) = point {
            found.sort_by(|&a, &b| (V[a] - p).norm().total_cmp(&(V[b] - p).norm()));
        }
        found
    }),
    wrong!(pick_nearest_vertices, ["only the surface"], |win, view, proj, viewport, V, F, radius| {
        let mut found = right!(pick_nearest_vertices(win, view, proj, viewport, V, F, radius));
        found.retain(|vertex| F.iter().any(|t| t.contains(vertex)));
        found
    }),
    wrong!(
        pick_nearest_vertices,
        ["distance from the middle of the triangle"],
        |win, view, proj, viewport, V, F, radius| {
            let (o, d) = ray(win, view, proj, viewport);
            let nearest = F.iter().filter_map(|t| Some((hit(&o, &d, V, t)?, t))).min_by(|a, b| a.0.total_cmp(&b.0));
            let middle = nearest.map(|(_, t)| (V[t[0]] + V[t[1]] + V[t[2]]) / 3.0);
            near(V, middle, |d| d <= radius)
        }
    ),
    wrong!(pick_nearest_vertices, ["matrices transposed"], |win, view, proj, viewport, V, F, radius| {
        right!(pick_nearest_vertices(win, &view.transpose(), &proj.transpose(), viewport, V, F, radius))
    }),
    wrong!(pick_nearest_vertices, ["pixels from 0 to 2", "empty"], |win, view, proj, viewport, V, F, radius| {
        let x = Vector3::new(win.x * 2.0, win.y * 2.0, win.z);
        right!(pick_nearest_vertices(&x, view, proj, viewport, V, F, radius))
    }),
];

fn near(V: &[Vector3<f64>], point: Option<Vector3<f64>>, counts: impl Fn(f64) -> bool) -> Vec<usize> {
    let Some(point) = point else { return Vec::new() };
    (0..V.len()).filter(|&vertex| counts((V[vertex] - point).norm())).collect()
}

fn first(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
) -> Option<Vector3<f64>> {
    let (o, d) = ray(win, view, proj, viewport);
    F.iter().filter_map(|t| hit(&o, &d, V, t)).min_by(f64::total_cmp).map(|t| o + d * t)
}

fn ray(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
) -> (Vector3<f64>, Vector3<f64>) {
    let back = (proj.cast::<f64>() * view.cast::<f64>()).try_inverse().unwrap_or_default();
    let v = viewport.cast::<f64>();
    let (x, y) = (2.0 * (win.x - v[0]) / v[2] - 1.0, 2.0 * (win.y - v[1]) / v[3] - 1.0);
    let [near, far] = [-1.0, 1.0].map(|z| back * Vector4::new(x, y, z, 1.0)).map(|p| p.xyz() / p.w);
    (near, far - near)
}

fn hit(o: &Vector3<f64>, d: &Vector3<f64>, V: &[Vector3<f64>], t: &[usize; 3]) -> Option<f64> {
    let [a, b, c] = t.map(|vertex| V[vertex]);
    let n = (b - a).cross(&(c - a));
    let along = (a - o).dot(&n) / d.dot(&n);
    let p = o + d * along;
    let inside = |a: Vector3<f64>, b: Vector3<f64>| (b - a).cross(&(p - a)).dot(&n) >= -1e-12 * n.norm_squared();
    (along >= 0.0 && along.is_finite() && inside(a, b) && inside(b, c) && inside(c, a)).then_some(along)
}
