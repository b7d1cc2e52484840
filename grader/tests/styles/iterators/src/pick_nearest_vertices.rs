use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

/// The least distance along the line of sight over all triangles.
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
    let [left, bottom, width, height]: [f64; 4] = viewport.cast::<f64>().into();
    let (x, y) = ((win.x - left) / width * 2.0 - 1.0, (win.y - bottom) / height * 2.0 - 1.0);
    let sight = back.map(|back| {
        [-1.0, 1.0].map(|depth| {
            let world = back * Vector4::new(x, y, depth, 1.0);
            world.xyz() / world.w
        })
    });
    let Some([near, far]) = sight else { return Vec::new() };
    let direction = far - near;
    let meets = |triangle: &[usize; 3]| {
        let [a, b, c] = triangle.map(|vertex| V[vertex]);
        let columns = Matrix3::from_columns(&[b - a, c - a, -direction]);
        let uvt = columns.lu().solve(&(near - a))?;
        let is_inside = uvt.x >= -1e-9 && uvt.y >= -1e-9 && uvt.x + uvt.y <= 1.0 + 1e-9 && uvt.z >= 0.0;
        is_inside.then_some(uvt.z)
    };
    let first = F.iter().filter_map(meets).filter(|t| t.is_finite()).min_by(f64::total_cmp);
    let hit = first.map(|t| near + direction * t);
    hit.map_or_else(Vec::new, |hit| (0..V.len()).filter(|&vertex| (V[vertex] - hit).norm() <= radius).collect())
}
