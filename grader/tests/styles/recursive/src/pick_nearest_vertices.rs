use nalgebra::{Matrix4, Vector3, Vector4};

/// The nearer of the hits in the two halves of the surface.
pub fn pick_nearest_vertices(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
    radius: f64,
) -> Vec<usize> {
    let back = (proj.cast::<f64>() * view.cast::<f64>()).try_inverse();
    let Some(back) = back else { return Vec::new() };
    let [left, bottom, width, height] = [0, 1, 2, 3].map(|k| f64::from(viewport[k]));
    let device = [2.0 * (win.x - left) / width - 1.0, 2.0 * (win.y - bottom) / height - 1.0];
    let point = |depth: f64| {
        let world = back * Vector4::new(device[0], device[1], depth, 1.0);
        Vector3::new(world.x, world.y, world.z) / world.w
    };
    let sight = (point(-1.0), point(1.0) - point(-1.0));
    let hit = first_hit(V, F, &sight).map(|t| sight.0 + sight.1 * t);
    let is_near = |vertex: &usize| hit.is_some_and(|hit| V[*vertex].metric_distance(&hit) <= radius);
    (0..V.len()).filter(is_near).collect()
}

fn first_hit(V: &[Vector3<f64>], F: &[[usize; 3]], sight: &(Vector3<f64>, Vector3<f64>)) -> Option<f64> {
    match F {
        [] => None,
        [triangle] => meet(triangle.map(|vertex| V[vertex]), sight),
        several => {
            let (left, right) = several.split_at(several.len() / 2);
            let hits = [first_hit(V, left, sight), first_hit(V, right, sight)];
            hits.into_iter().flatten().min_by(f64::total_cmp)
        }
    }
}

/// By the volumes between the line and the edges, which have one sign inside.
fn meet([a, b, c]: [Vector3<f64>; 3], (o, d): &(Vector3<f64>, Vector3<f64>)) -> Option<f64> {
    let [a, b, c] = [a - o, b - o, c - o];
    let u = d.dot(&c.cross(&b));
    let v = d.dot(&a.cross(&c));
    let w = d.dot(&b.cross(&a));
    let sum = u + v + w;
    let slack = 1e-10 * (u.abs() + v.abs() + w.abs());
    let is_inside = u.min(v).min(w) >= -slack || u.max(v).max(w) <= slack;
    if !is_inside || sum.abs() <= slack {
        return None;
    }
    let hit = (a * u + b * v + c * w) / sum;
    let t = hit.dot(d) / d.norm_squared();
    (t >= 0.0).then_some(t)
}
