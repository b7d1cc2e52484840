use nalgebra::{Matrix4, Vector3, Vector4};

/// Unprojects two points and solves one system for each triangle.
pub fn pick_nearest_vertices(
    win: &Vector3<f64>,
    view: &Matrix4<f32>,
    proj: &Matrix4<f32>,
    viewport: &Vector4<f32>,
    V: &[Vector3<f64>],
    F: &[[usize; 3]],
    radius: f64,
) -> Vec<usize> {
    let clip = proj.map(f64::from) * view.map(f64::from);
    let unprojected = |depth: f64| {
        let device = Vector4::new(
            2.0 * (win.x - f64::from(viewport.x)) / f64::from(viewport.z) - 1.0,
            2.0 * (win.y - f64::from(viewport.y)) / f64::from(viewport.w) - 1.0,
            depth,
            1.0,
        );
        let world = clip.lu().solve(&device)?;
        Some(world.xyz() / world.w)
    };
    let (Some(near), Some(far)) = (unprojected(-1.0), unprojected(1.0)) else { return vec![] };
    let mut nearest = f64::MAX;
    for triangle in F {
        let corners = triangle.map(|vertex| V[vertex] - near);
        // The line through the triangle's plane as a positive combination of the corners, in the frame of the near point.
        let mut A = Matrix4::zeros();
        for (column, corner) in corners.iter().enumerate() {
            A.fixed_view_mut::<3, 1>(0, column).copy_from(corner);
            A[(3, column)] = 1.0;
        }
        A.fixed_view_mut::<3, 1>(0, 3).copy_from(&(near - far));
        let Some(weights) = A.lu().solve(&Vector4::w()) else { continue };
        if weights.xyz().min() >= -1e-8 && weights.w >= 0.0 {
            nearest = nearest.min(weights.w);
        }
    }
    if nearest == f64::MAX {
        return vec![];
    }
    let hit = near + (far - near) * nearest;
    (0..V.len()).filter(|&vertex| nalgebra::distance(&V[vertex].into(), &hit.into()) <= radius).collect()
}
