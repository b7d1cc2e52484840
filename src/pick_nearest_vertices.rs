use nalgebra::{Matrix4, Point3, Vector3, Vector4};

/// Vertices within `radius` (m) of the point of the surface under a pixel, ascending; empty if the ray misses the surface.
pub fn pick_nearest_vertices(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
    radius: f64,
) -> Vec<usize> {
    let Some((origin, direction)) = ray_through(win, view, proj, viewport) else { return Vec::new() };
    let hits = F.iter().filter_map(|triangle| hit(&origin, &direction, &triangle.map(|vertex| V[vertex])));
    let first_hit = hits.fold(f64::INFINITY, f64::min);
    if first_hit == f64::INFINITY {
        return Vec::new();
    }
    let point = origin + direction * first_hit;
    (0..V.len()).filter(|&vertex| (V[vertex] - point).norm() <= radius).collect()
}

/// The ray from the near plane through a pixel: its origin (m) and its direction, up to the far plane (m).
fn ray_through(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let (viewport, world_to_clip) = (viewport.cast::<f64>(), proj.cast::<f64>() * view.cast::<f64>());
    let clip_to_world = world_to_clip.try_inverse()?;
    let x = 2.0 * (win.x - viewport[0]) / viewport[2] - 1.0;
    let y = 2.0 * (win.y - viewport[1]) / viewport[3] - 1.0;

    let near = Point3::from_homogeneous(clip_to_world * Vector4::new(x, y, -1.0, 1.0))?;
    let far = Point3::from_homogeneous(clip_to_world * Vector4::new(x, y, 1.0, 1.0))?;
    Some((near.coords, far - near))
}

/// Distance to the point at which a ray meets a triangle, in units of its direction (Möller and Trumbore 1997). Both sides of
/// the triangle count.
fn hit(origin: &Vector3<f64>, direction: &Vector3<f64>, [a, b, c]: &[Vector3<f64>; 3]) -> Option<f64> {
    let (ab, ac, ao) = (b - a, c - a, origin - a);
    let p = direction.cross(&ac);
    let determinant = ab.dot(&p);
    let u = ao.dot(&p) / determinant;
    let q = ao.cross(&ab);
    let v = direction.dot(&q) / determinant;
    let t = ac.dot(&q) / determinant;

    // Slack for round-off, so that no ray slips through between two triangles. A ray in the triangle's plane gives NaN.
    const SLACK: f64 = 1e-12;
    (u >= -SLACK && v >= -SLACK && u + v <= 1.0 + SLACK && t >= 0.0 && t.is_finite()).then_some(t)
}
