//! Recovery of fields that are known.

use super::*;
use fem_mesh::{Pattern, TetrahedralMesh, box_mesh, rectangle_mesh};

/// Moves the nodes inside a box or rectangle, the same way in every run.
fn shaken(mut vertices: Vec<Vector3<f64>>, size: [f64; 3], by: f64) -> Vec<Vector3<f64>> {
    for (node, x) in vertices.iter_mut().enumerate() {
        for i in 0..3 {
            if x[i] > 1e-9 && x[i] < size[i] - 1e-9 {
                x[i] += by * ((node * 7 + i * 13) as f64 * 1.7).sin();
            }
        }
    }
    vertices
}

/// Irregular bodies of 1 m: tetrahedra, triangles, quadratic triangles.
fn bodies(cells: usize) -> [BodyMesh; 3] {
    let by = 0.15 / cells as f64;
    let mut solid = box_mesh([1.0; 3], cells, Pattern::Alternating).unwrap();
    solid.vertices = shaken(solid.vertices, [1.0; 3], by);
    let mut flat = rectangle_mesh([1.0, 1.0], cells, Pattern::Alternating).unwrap();
    flat.vertices = shaken(flat.vertices, [1.0, 1.0, 0.0], by);
    let flat = BodyMesh::flat(flat, 1.0);
    [solid.into(), flat.clone(), flat.of_order(2).unwrap()]
}

/// A field at all points of a body.
fn sampled(mesh: &BodyMesh, field: impl Fn(&Vector3<f64>) -> Matrix3<f64>) -> Vec<Matrix3<f64>> {
    (0..mesh.elements()).flat_map(|element| mesh.points(element)).map(|x| field(&x)).collect()
}

/// Largest distance of the recovered stresses from a field.
fn error(mesh: &BodyMesh, field: impl Fn(&Vector3<f64>) -> Matrix3<f64>) -> f64 {
    let found = stresses_at_nodes(mesh, &[], &sampled(mesh, &field));
    found.iter().zip(mesh.vertices()).map(|(stress, x)| (stress - field(x)).amax()).fold(0.0, f64::max)
}

fn linear(x: &Vector3<f64>) -> Matrix3<f64> {
    let [a, b, c] = [1.0 + 2.0 * x.x - x.y, 3.0 * x.y + x.z, x.x - 0.5 * x.z];
    Matrix3::new(a, b, c, b, 2.0 * c, a, c, a, -b)
}

#[test]
fn a_linear_stress_is_recovered_exactly_on_irregular_meshes_up_to_the_boundary() {
    for cells in [1, 2, 3, 5] {
        for mesh in bodies(cells) {
            // A single row of tetrahedra has its points in too few places.
            if cells > 1 {
                assert!(error(&mesh, linear) < 1e-11, "{cells} {}: {:e}", mesh.element().name, error(&mesh, linear));
            }
        }
    }
}

#[test]
fn quadratic_triangles_recover_a_quadratic_stress_exactly() {
    let [.., mesh] = bodies(4);
    let field = |x: &Vector3<f64>| linear(x) * (1.0 + x.x - 0.5 * x.y);
    let flat = |x: &Vector3<f64>| field(&Vector3::new(x.x, x.y, 0.0));
    assert!(error(&mesh, flat) < 1e-10, "{:e}", error(&mesh, flat));
}

#[test]
fn a_smooth_stress_is_recovered_with_an_error_of_second_order_and_averages_are_of_first() {
    let field = |x: &Vector3<f64>| Matrix3::repeat((2.0 * x.x + 0.3).sin() * (1.5 * x.y).cos() + x.z * x.z);
    let averages = |mesh: &BodyMesh| {
        let found = super::super::fields::averages_at_nodes(mesh, &sampled(mesh, field));
        found.iter().zip(mesh.vertices()).map(|(stress, x)| (stress - field(x)).amax()).fold(0.0, f64::max)
    };
    let ([coarse, flat, _], [fine, fine_flat, _]) = (bodies(6), bodies(12));
    for (coarse, fine) in [(coarse, fine), (flat, fine_flat)] {
        let order = (error(&coarse, field) / error(&fine, field)).log2();
        let of_averages = (averages(&coarse) / averages(&fine)).log2();
        assert!(order > 1.6 && of_averages < 1.4, "{}: {order} {of_averages}", fine.element().name);
        assert!(3.0 * error(&fine, field) < averages(&fine), "{}", fine.element().name);
    }
}

#[test]
fn patches_do_not_mix_materials_and_a_node_between_them_has_the_mean() {
    for mesh in bodies(6) {
        let centroid = |element: usize| mesh.points(element).iter().map(|x| x.x).sum::<f64>();
        let middle = 0.5 * mesh.points(0).len() as f64;
        let material_of: Vec<usize> = (0..mesh.elements()).map(|e| usize::from(centroid(e) > middle)).collect();
        let factor = |material: usize| [1.0, -20.0][material];
        let stresses: Vec<_> = (0..mesh.elements())
            .flat_map(|e| mesh.points(e).into_iter().map(move |x| (e, x)))
            .map(|(e, x)| factor(material_of[e]) * linear(&x))
            .collect();
        let found = stresses_at_nodes(&mesh, &material_of, &stresses);
        let mut materials = vec![[false; 2]; found.len()];
        for (element, &material) in material_of.iter().enumerate() {
            mesh.nodes_of(element).iter().for_each(|&node| materials[node][material] = true);
        }
        for ((stress, x), materials) in found.iter().zip(mesh.vertices()).zip(materials) {
            let factors: Vec<f64> = (0..2).filter(|&m| materials[m]).map(factor).collect();
            let expected = linear(x) * factors.iter().sum::<f64>() / factors.len() as f64;
            assert!((stress - expected).amax() < 1e-9, "{} at {x}: {stress} {expected}", mesh.element().name);
        }
    }
}

#[test]
fn a_single_element_keeps_its_stress() {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector3::from);
    let mesh: BodyMesh = TetrahedralMesh::new(corners.to_vec(), vec![[0, 1, 2, 3]]).into();
    let stress = linear(&Vector3::zeros());
    assert_eq!(stresses_at_nodes(&mesh, &[], &[stress]), vec![stress; 4]);
}
