use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

/// What counts as round-off for u, v and their sum.
const SLACK: f64 = 1e-9;

/// From the pixel to the line of sight, to the first hit, to the vertices near it.
pub fn pick_nearest_vertices(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
    radius: f64,
) -> Vec<usize> {
    let back = (proj.cast::<f64>() * view.cast::<f64>()).try_inverse().unwrap();
    let viewport = viewport.cast::<f64>();
    let x = 2.0 * (win[0] - viewport[0]) / viewport[2] - 1.0;
    let y = 2.0 * (win[1] - viewport[1]) / viewport[3] - 1.0;
    let near = back * Vector4::new(x, y, -1.0, 1.0);
    let far = back * Vector4::new(x, y, 1.0, 1.0);
    let o = near.xyz() / near[3];
    let d = far.xyz() / far[3] - o;

    let mut smallest = f64::INFINITY;
    for triangle in F {
        let [a, b, c] = triangle.map(|vertex| V[vertex]);
        // u (b − a) + v (c − a) − t d = o − a
        let Some(solution) = Matrix3::from_columns(&[b - a, c - a, -d]).lu().solve(&(o - a)) else { continue };
        let (u, v, t) = (solution[0], solution[1], solution[2]);
        if t >= 0.0 && u >= -SLACK && v >= -SLACK && u + v <= 1.0 + SLACK && t < smallest {
            smallest = t;
        }
    }
    if smallest == f64::INFINITY {
        return Vec::new();
    }
    let hit = o + d * smallest;
    let mut found = Vec::new();
    for vertex in 0..V.len() {
        if (V[vertex] - hit).norm() <= radius {
            found.push(vertex);
        }
    }
    found
}
