use nalgebra::{Matrix4, Vector3, Vector4};

/// The line of sight against each triangle, by Cramer's rule.
pub fn pick_nearest_vertices(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
    radius: f64,
) -> Vec<usize> {
    let mut matrix = Matrix4::zeros();
    for i in 0..4 {
        for j in 0..4 {
            for k in 0..4 {
                matrix[(i, j)] += f64::from(proj[(i, k)]) * f64::from(view[(k, j)]);
            }
        }
    }
    let Some(back) = matrix.try_inverse() else { return Vec::new() };
    let mut device = Vector4::new(0.0, 0.0, -1.0, 1.0);
    for axis in 0..2 {
        device[axis] = 2.0 * (win[axis] - f64::from(viewport[axis])) / f64::from(viewport[axis + 2]) - 1.0;
    }
    let near = back * device;
    device[2] = 1.0;
    let far = back * device;
    let (mut o, mut d) = (Vector3::zeros(), Vector3::zeros());
    for axis in 0..3 {
        o[axis] = near[axis] / near[3];
        d[axis] = far[axis] / far[3] - o[axis];
    }
    let mut first = f64::INFINITY;
    for k in 0..F.len() {
        let a = V[F[k][0]];
        let (e1, e2, s) = (V[F[k][1]] - a, V[F[k][2]] - a, o - a);
        let whole = -d.dot(&e1.cross(&e2));
        if whole == 0.0 {
            continue;
        }
        let t = s.dot(&e1.cross(&e2)) / whole;
        let u = -d.dot(&s.cross(&e2)) / whole;
        let v = -d.dot(&e1.cross(&s)) / whole;
        let slack = -1e-9;
        if t >= 0.0 && t < first && u >= slack && v >= slack && 1.0 - u - v >= slack {
            first = t;
        }
    }
    let mut found = Vec::new();
    if first < f64::INFINITY {
        let hit = o + d * first;
        for vertex in 0..V.len() {
            if (V[vertex] - hit).norm() <= radius {
                found.push(vertex);
            }
        }
    }
    found
}
