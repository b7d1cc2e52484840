use nalgebra::{Matrix4, Vector3, Vector4};

/// Vertices around the first point in which the line of sight meets the surface.
pub fn pick_nearest_vertices(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
    radius: f64,
) -> Vec<usize> {
    let Some(view_back) = view.map(f64::from).try_inverse() else { return vec![] };
    let Some(proj_back) = proj.map(f64::from).try_inverse() else { return vec![] };
    let corner = viewport.map(f64::from);
    let unproject = |depth: f64| {
        let device = Vector4::new(
            (win.x - corner.x) / corner.z * 2.0 - 1.0,
            (win.y - corner.y) / corner.w * 2.0 - 1.0,
            depth,
            1.0,
        );
        let world = view_back * (proj_back * device);
        world.xyz() / world.w
    };
    let near = unproject(-1.0);
    let sight = unproject(1.0) - near;

    let mut first: Option<f64> = None;
    for &[a, b, c] in F {
        if let Some(t) = meets(&near, &sight, [V[a], V[b], V[c]]) {
            first = Some(first.map_or(t, |before| before.min(t)));
        }
    }
    let Some(t) = first else { return vec![] };
    let point = near + t * sight;
    V.iter().enumerate().filter(|(_, x)| (*x - point).norm() <= radius).map(|(vertex, _)| vertex).collect()
}

/// The point at which a line meets the plane of a triangle, if that is on the inner side of its three edges.
fn meets(near: &Vector3<f64>, sight: &Vector3<f64>, corners: [Vector3<f64>; 3]) -> Option<f64> {
    let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
    let t = normal.dot(&(corners[0] - near)) / normal.dot(sight);
    if !t.is_finite() || t < 0.0 {
        return None;
    }
    let point = near + sight * t;
    let slack = -1e-10 * normal.norm_squared();
    let inner = |i: usize| (corners[(i + 1) % 3] - corners[i]).cross(&(point - corners[i])).dot(&normal) >= slack;
    (0..3).all(inner).then_some(t)
}
