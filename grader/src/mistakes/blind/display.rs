//! Skinning and picking.

use finite_elements_3d as solved;
use nalgebra::{Matrix4, Vector3, Vector4};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::super::Mistake;

/// The mistakes of this set.
pub const MISTAKES: &[Mistake] = &[
    // columns 0 to 3
    wrong!(build_skinning_matrix, ["local for global indices"], |V, T, V_skin| {
        skinning(V, V_skin, |x| {
            let (_, w) = weights_of(V, T, x).unwrap_or_else(|| least_missed(V, T, x));
            (0..4).map(|a| (a, w[a])).collect()
        })
    }),
    // points outside have an empty row
    wrong!(build_skinning_matrix, ["empty row outside"], |V, T, V_skin| {
        skinning(V, V_skin, |x| match weights_of(V, T, x) {
            Some((e, w)) => (0..4).map(|a| (T[e][a], w[a])).collect(),
            None => Vec::new(),
        })
    }),
    // weights clamped and normalised
    wrong!(build_skinning_matrix, ["clamped"], |V, T, V_skin| {
        skinning(V, V_skin, |x| {
            let (e, w) = weights_of(V, T, x).unwrap_or_else(|| least_missed(V, T, x));
            let w = w.map(|v| v.max(0.0));
            (0..4).map(|a| (T[e][a], w[a] / w.sum())).collect()
        })
    }),
    // outside: the element with the nearest vertex
    wrong!(build_skinning_matrix, ["nearest vertex outside"], |V, T, V_skin| {
        skinning(V, V_skin, |x| {
            let (e, w) = weights_of(V, T, x).unwrap_or_else(|| {
                let distance = |e: &usize| T[*e].iter().map(|&v| (V[v] - x).norm()).fold(f64::INFINITY, f64::min);
                let e = (0..T.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
                (e, solved::phi_linear_tetrahedron(V, &T[e], x))
            });
            (0..4).map(|a| (T[e][a], w[a])).collect()
        })
    }),
    // columns sorted, weights not
    wrong!(build_skinning_matrix, ["sorted vertices"], |V, T, V_skin| {
        skinning(V, V_skin, |x| {
            let (e, w) = weights_of(V, T, x).unwrap_or_else(|| least_missed(V, T, x));
            let mut columns = T[e];
            columns.sort();
            (0..4).map(|a| (columns[a], w[a])).collect()
        })
    }),
    // pixels counted from the top
    wrong!(pick_nearest_vertices, ["upside down"], |win, view, proj, viewport, V, F, radius| {
        let (o, d, hits) = pick_hits(&Picking { flip: true, ..RIGHT }, win, view, proj, viewport, V, F);
        hits.into_iter().reduce(f64::min).map_or(Vec::new(), |t| within(V, o + d * t, radius))
    }),
    // distance to the ray
    wrong!(pick_nearest_vertices, ["distance to the line of sight"], |win, view, proj, viewport, V, F, radius| {
        let (o, d, hits) = pick_hits(&RIGHT, win, view, proj, viewport, V, F);
        if hits.is_empty() {
            return Vec::new();
        }
        (0..V.len()).filter(|&i| (V[i] - o).cross(&d.normalize()).norm() <= radius).collect()
    }),
    // the first hit in the list, not the nearest
    wrong!(pick_nearest_vertices, ["first triangle of the list"], |win, view, proj, viewport, V, F, radius| {
        let (o, d, hits) = pick_hits(&RIGHT, win, view, proj, viewport, V, F);
        hits.first().map_or(Vec::new(), |t| within(V, o + d * *t, radius))
    }),
    // back faces culled
    wrong!(pick_nearest_vertices, ["only from the front"], |win, view, proj, viewport, V, F, radius| {
        let (o, d, hits) = pick_hits(&Picking { both_sides: false, ..RIGHT }, win, view, proj, viewport, V, F);
        hits.into_iter().reduce(f64::min).map_or(Vec::new(), |t| within(V, o + d * t, radius))
    }),
    // distance measured from the nearest vertex and not from the hit
    wrong!(pick_nearest_vertices, ["distance from the nearest vertex"], |win, view, proj, viewport, V, F, radius| {
        let (o, d, hits) = pick_hits(&RIGHT, win, view, proj, viewport, V, F);
        hits.into_iter().reduce(f64::min).map_or(Vec::new(), |t| {
            let near = within(V, o + d * t, f64::INFINITY);
            let closest = near
                .into_iter()
                .min_by(|&a, &b| (V[a] - o - d * t).norm().total_cmp(&(V[b] - o - d * t).norm()))
                .unwrap();
            within(V, V[closest], radius)
        })
    }),
    // width of the viewport for its height
    wrong!(pick_nearest_vertices, ["width for height"], |win, view, proj, viewport, V, F, radius| {
        let (o, d, hits) = pick_hits(&Picking { width: true, ..RIGHT }, win, view, proj, viewport, V, F);
        hits.into_iter().reduce(f64::min).map_or(Vec::new(), |t| within(V, o + d * t, radius))
    }),
    // squared distance compared with the radius
    wrong!(pick_nearest_vertices, ["radius for its square"], |win, view, proj, viewport, V, F, radius| {
        let (o, d, hits) = pick_hits(&RIGHT, win, view, proj, viewport, V, F);
        hits.into_iter()
            .reduce(f64::min)
            .map_or(Vec::new(), |t| (0..V.len()).filter(|&i| (V[i] - o - d * t).norm_squared() <= radius).collect())
    }),
];

fn weights_of(V: &[Vector3<f64>], T: &[[usize; 4]], x: &Vector3<f64>) -> Option<(usize, Vector4<f64>)> {
    (0..T.len()).map(|e| (e, solved::phi_linear_tetrahedron(V, &T[e], x))).find(|(_, w)| w.min() >= -1e-6)
}
fn least_missed(V: &[Vector3<f64>], T: &[[usize; 4]], x: &Vector3<f64>) -> (usize, Vector4<f64>) {
    let all = (0..T.len()).map(|e| (e, solved::phi_linear_tetrahedron(V, &T[e], x)));
    all.max_by(|a, b| a.1.min().total_cmp(&b.1.min())).unwrap()
}
fn skinning(
    V: &[Vector3<f64>],
    V_skin: &[Vector3<f64>],
    row: impl Fn(&Vector3<f64>) -> Vec<(usize, f64)>,
) -> CsrMatrix<f64> {
    let mut N = CooMatrix::new(V_skin.len(), V.len());
    for (i, x) in V_skin.iter().enumerate() {
        for (vertex, weight) in row(x) {
            N.push(i, vertex, weight);
        }
    }
    CsrMatrix::from(&N)
}

struct Picking {
    flip: bool,
    corner: bool,
    both_sides: bool,
    width: bool,
}
const RIGHT: Picking = Picking { flip: false, corner: true, both_sides: true, width: false };
fn pick_hits(
    p: &Picking,
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
) -> (Vector3<f64>, Vector3<f64>, Vec<f64>) {
    let inverse = (proj.cast::<f64>() * view.cast::<f64>()).try_inverse().unwrap();
    let port = viewport.cast::<f64>();
    let (x0, y0) = if p.corner { (port[0], port[1]) } else { (0.0, 0.0) };
    let y = if p.flip { port[3] - win.y } else { win.y };
    let (x, y) = (2.0 * (win.x - x0) / port[2] - 1.0, 2.0 * (y - y0) / port[if p.width { 2 } else { 3 }] - 1.0);
    let point = |z: f64| {
        let h = inverse * Vector4::new(x, y, z, 1.0);
        h.xyz() / h.w
    };
    let (near, far) = (point(-1.0), point(1.0));
    let d = far - near;
    let mut hits = Vec::new();
    for f in F {
        let (a, b, c) = (V[f[0]], V[f[1]], V[f[2]]);
        let n = (b - a).cross(&(c - a));
        let denominator = n.dot(&d);
        if denominator == 0.0 || (!p.both_sides && denominator > 0.0) {
            continue;
        }
        let t = n.dot(&(a - near)) / denominator;
        let x = near + d * t;
        let inside =
            [(a, b), (b, c), (c, a)].iter().all(|(p, q)| (q - p).cross(&(x - p)).dot(&n) >= -1e-12 * n.norm_squared());
        if inside && t >= 0.0 {
            hits.push(t);
        }
    }
    (near, d, hits)
}
fn within(V: &[Vector3<f64>], point: Vector3<f64>, radius: f64) -> Vec<usize> {
    (0..V.len()).filter(|&i| (V[i] - point).norm() <= radius).collect()
}
