use nalgebra::{Matrix4, Vector3, Vector4};

/// Everything in the frame of the line of sight: a triangle is hit where it covers the origin of the plane across it.
pub fn pick_nearest_vertices(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
    radius: f64,
) -> Vec<usize> {
    let Some(back) = (proj.cast::<f64>() * view.cast::<f64>()).try_inverse() else { return Vec::new() };
    let at = |pixel: f64, corner: f32, size: f32| 2.0 * (pixel - f64::from(corner)) / f64::from(size) - 1.0;
    let (x, y) = (at(win.x, viewport.x, viewport.z), at(win.y, viewport.y, viewport.w));
    let world = |depth: f64| nalgebra::Point3::from_homogeneous(back * Vector4::new(x, y, depth, 1.0));
    let (Some(near), Some(far)) = (world(-1.0), world(1.0)) else { return Vec::new() };
    let along = (far - near).normalize();
    let across = [along.cross(&Vector3::ith(along.iamin(), 1.0)).normalize()];
    let axes = [across[0], along.cross(&across[0])];
    let mut hit: Option<(f64, Vector3<f64>)> = None;
    for face in F {
        let corners = face.map(|vertex| V[vertex] - near.coords);
        let flat = corners.map(|corner| [corner.dot(&axes[0]), corner.dot(&axes[1])]);
        let area = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
        let parts = Vector3::new(area(flat[1], flat[2]), area(flat[2], flat[0]), area(flat[0], flat[1]));
        let weights = parts / parts.sum();
        let point = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        let t = point.dot(&along);
        let is_hit = weights.iter().all(|&weight| weight >= -1e-9) && t >= 0.0;
        if is_hit && hit.is_none_or(|(nearest, _)| t < nearest) {
            hit = Some((t, point + near.coords));
        }
    }
    hit.map_or_else(Vec::new, |(_, point)| {
        V.iter().enumerate().filter(|(_, vertex)| vertex.metric_distance(&point) <= radius).map(|(k, _)| k).collect()
    })
}
