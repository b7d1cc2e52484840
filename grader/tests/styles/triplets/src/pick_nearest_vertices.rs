use nalgebra::{Matrix4, Vector3, Vector4};

/// All hits in a list, the nearest of them first.
pub fn pick_nearest_vertices(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
    radius: f64,
) -> Vec<usize> {
    let (view, proj) = (view.map(f64::from), proj.map(f64::from));
    let (Some(from_eye), Some(from_clip)) = (view.try_inverse(), proj.try_inverse()) else { return Vec::new() };
    let device = |axis: usize| (win[axis] - f64::from(viewport[axis])) * 2.0 / f64::from(viewport[axis + 2]) - 1.0;
    let unproject = |depth: f64| {
        let eye = from_clip * Vector4::new(device(0), device(1), depth, 1.0);
        let world = from_eye * (eye / eye.w);
        world.xyz() / world.w
    };
    let (origin, end) = (unproject(-1.0), unproject(1.0));
    let direction = (end - origin).normalize();
    let mut hits: Vec<(f64, Vector3<f64>)> = Vec::new();
    for &[a, b, c] in F {
        let (a, b, c) = (V[a], V[b], V[c]);
        let normal = (b - a).cross(&(c - a));
        let t = normal.dot(&(a - origin)) / normal.dot(&direction);
        let point = origin + direction * t;
        let area = normal.norm_squared();
        let inside =
            |from: Vector3<f64>, to: Vector3<f64>| (to - from).cross(&(point - from)).dot(&normal) >= -1e-9 * area;
        if t.is_finite() && t >= 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
            hits.push((t, point));
        }
    }
    hits.sort_by(|(a, _), (b, _)| a.partial_cmp(b).expect("numbers"));
    let Some((_, hit)) = hits.first() else { return Vec::new() };
    let squared = radius * radius;
    V.iter()
        .enumerate()
        .filter(|(_, vertex)| (*vertex - hit).norm_squared() <= squared)
        .map(|(index, _)| index)
        .collect()
}
