//! To do: the weights with which display vertices follow the mesh. Read include-docs/build_skinning_matrix.md.

use nalgebra::{DMatrix, Matrix3, Vector3, Vector4};
use proptest::strategy::Strategy;

use super::meshes::{Mesh, Tetrahedron};
use super::outcome::{Mistake, Outcome, dense_of, holds, near, near_number, waits, with_input};
use super::random::{for_all, for_some, vector};
use super::{Check, Course};

/// The properties of the function.
pub const CHECKS: &[Check] = checks![
    every_row_is_that_of_a_search_through_all_elements,
    each_display_vertex_has_its_own_row_in_order,
    the_display_is_in_place_at_rest_and_follows_affine_motions,
    a_row_has_the_four_weights_of_one_element,
    vertices_edges_and_faces_belong_to_the_elements_that_they_bound,
    a_point_just_outside_an_element_belongs_to_the_neighbour_that_holds_it,
    a_point_in_no_element_goes_to_the_one_with_the_largest_smallest_weight,
    vertices_without_elements_have_no_weight,
    no_display_vertices_give_a_matrix_without_rows,
    far_from_the_origin_the_display_still_follows,
];

fn dense(
    course: &Course,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    V_skin: &[Vector3<f64>],
) -> Result<DMatrix<f64>, Mistake> {
    dense_of((V_skin.len(), V.len()), &course.subject.build_skinning_matrix(V, T, V_skin)?)
}

/// One row, the weights of one element's vertices.
pub fn row(vertices: usize, element: [usize; 4], weights: [f64; 4]) -> DMatrix<f64> {
    let mut row = DMatrix::zeros(1, vertices);
    for (vertex, weight) in element.into_iter().zip(weights) {
        row[(0, vertex)] += weight;
    }
    row
}

/// Compares one row with the weights of every element that contains the point; if no element does, with those of the nearest one.
fn is_right(course: &Course, rule: &str, found: &DMatrix<f64>, mesh: &Mesh, x: &Vector3<f64>) -> Outcome {
    let mut weights: Vec<([usize; 4], Vector4<f64>)> = Vec::new();
    for element in &mesh.T {
        let phi = course.trusted.phi_linear_tetrahedron(&mesh.V, element, x);
        weights.push((*element, phi.map_err(waits("phi_linear_tetrahedron"))?));
    }
    weights.sort_by(|(_, a), (_, b)| b.min().total_cmp(&a.min()));
    let holders = weights.iter().take_while(|(_, phi)| phi.min() >= -1e-6).count().max(1);
    let mut outcome = Ok(());
    // The last one that is looked at, the best, is the one that a message names.
    for (element, phi) in weights.iter().take(holders).rev() {
        outcome = near(rule, found, &row(mesh.V.len(), *element, (*phi).into()), 1e-11);
        if outcome.is_ok() {
            break;
        }
    }
    outcome
}

/// Points inside of a mesh: the number of an element, to be taken modulo that of all, and the weights of its vertices.
fn inside() -> impl Strategy<Value = (usize, [f64; 4])> {
    (0..1000usize, [0.05..1.0, 0.05..1.0, 0.05..1.0, 0.05..1.0f64])
}

fn point(mesh: &Mesh, (element, weights): (usize, [f64; 4])) -> Vector3<f64> {
    let X = mesh.T[element % mesh.T.len()].map(|vertex| mesh.V[vertex]);
    (0..4).map(|i| X[i] * weights[i]).sum::<Vector3<f64>>() / weights.iter().sum::<f64>()
}

fn every_row_is_that_of_a_search_through_all_elements(course: &Course) -> Outcome {
    for (cells, offset) in [([2, 1, 1], Vector3::zeros()), ([1, 2, 2], Vector3::new(-5.0, -9.0, -7.0))] {
        let mut mesh = Mesh::uneven_box(cells, 1.0);
        mesh.V.iter_mut().for_each(|X| *X += offset);
        for_some(course.seed, inside(), |place| {
            let x = point(&mesh, place);
            let found = dense(course, &mesh.V, &mesh.T, &[x])?;
            is_right(course, "a display vertex inside of the mesh", &found, &mesh, &x)
        })?;
    }
    Ok(())
}

fn each_display_vertex_has_its_own_row_in_order(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([1, 1, 1], 1.0);
    let skin: Vec<_> = (0..9).map(|k| Vector3::new(0.3 + 0.04 * k as f64, 0.7 - 0.05 * k as f64, 0.4)).collect();
    let all = dense(course, &mesh.V, &mesh.T, &skin)?;
    holds("one row for each display vertex, one column for each vertex", all.shape() == (9, mesh.V.len()))?;
    for (k, x) in skin.iter().enumerate() {
        is_right(course, "row k belongs to display vertex k", &all.rows(k, 1).into_owned(), &mesh, x)?;
    }
    Ok(())
}

/// The weights of a display vertex move it with the mesh.
fn follows(course: &Course, mesh: &Mesh, x: &Vector3<f64>) -> Outcome {
    let F = Matrix3::new(1.2, 0.4, 0.0, -0.2, 0.8, 0.1, 0.1, 0.0, 1.5);
    let N = dense(course, &mesh.V, &mesh.T, &[*x])?;
    near_number("the weights of a display vertex sum to one", N.sum(), 1.0, 1e-12)?;
    let blend = |move_to: &dyn Fn(&Vector3<f64>) -> Vector3<f64>| -> Vector3<f64> {
        (0..mesh.V.len()).map(|vertex| move_to(&mesh.V[vertex]) * N[(0, vertex)]).sum()
    };
    near("N V = V_skin", &blend(&|X| *X), x, 1e-11)?;
    near("affine motions are followed exactly", &blend(&|X| F * X), &(F * x), 1e-11)
}

fn the_display_is_in_place_at_rest_and_follows_affine_motions(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([2, 2, 1], 1.0);
    for_all(course.seed, inside(), |place| follows(course, &mesh, &point(&mesh, place)))
}

fn a_row_has_the_four_weights_of_one_element(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([2, 2, 2], 1.0);
    for_all(course.seed, inside(), |place| {
        let N = dense(course, &mesh.V, &mesh.T, &[point(&mesh, place)])?;
        let columns: Vec<usize> = (0..N.ncols()).filter(|&column| N[(0, column)] != 0.0).collect();
        let is_element = mesh.T.iter().any(|element| columns.iter().all(|column| element.contains(column)));
        holds("the columns of a row are the four vertices of one element", is_element)
    })
}

fn vertices_edges_and_faces_belong_to_the_elements_that_they_bound(course: &Course) -> Outcome {
    let mesh = Mesh::uneven_box([1, 1, 1], 1.0);
    for element in &mesh.T {
        let X = element.map(|vertex| mesh.V[vertex]);
        let bounds = [(X[0], [1.0, 0.0, 0.0, 0.0]), ((X[1] + X[2]) / 2.0, [0.0, 0.5, 0.5, 0.0])];
        let face = ((X[0] + X[1] + X[3] * 2.0) / 4.0, [0.25, 0.25, 0.0, 0.5]);
        for (x, weights) in bounds.into_iter().chain([face]) {
            let expected = row(mesh.V.len(), *element, weights);
            near("a vertex, an edge, a face", &dense(course, &mesh.V, &mesh.T, &[x])?, &expected, 1e-12)?;
        }
    }
    Ok(())
}

fn a_point_just_outside_an_element_belongs_to_the_neighbour_that_holds_it(course: &Course) -> Outcome {
    let V = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z(), Vector3::new(2.0, 2.0, 2.0)];
    let (inner, outer) = ([0, 1, 2, 3], [1, 2, 3, 4]);
    // Just more than the slack for round-off, and much more.
    for missed_by in [1.5e-6, 1e-4, 1e-2] {
        // On the diagonal, where the coordinates add up to 1 on the face between, and to 6 at the last vertex.
        let beyond = (1.0 + missed_by, outer, [(1.0 - missed_by / 5.0) / 3.0, missed_by / 5.0]);
        let before = (1.0 - 5.0 * missed_by, inner, [(1.0 - 5.0 * missed_by) / 3.0, 5.0 * missed_by]);
        for (sum, element, [shared, own]) in [beyond, before] {
            let weights = if element == outer { [shared, shared, shared, own] } else { [own, shared, shared, shared] };
            for T in [[inner, outer], [outer, inner]] {
                let found = dense(course, &V, &T, &[Vector3::repeat(sum / 3.0)])?;
                let rule = "a point more than the slack outside of an element belongs to the neighbour that holds it";
                near(rule, &found, &row(5, element, weights), 1e-12)?;
            }
        }
    }
    Ok(())
}

/// Two elements that overlap: the unit tetrahedron and one twice as large, with other vertices.
pub fn overlapping() -> (Vec<Vector3<f64>>, [[usize; 4]; 2]) {
    let small = Tetrahedron::unit();
    let large = Tetrahedron::new([4, 5, 6, 7], &(Matrix3::identity() * 2.0), &Vector3::zeros());
    ([&small.V[..4], &large.V[4..8]].concat(), [small.element, large.element])
}

fn a_point_in_no_element_goes_to_the_one_with_the_largest_smallest_weight(course: &Course) -> Outcome {
    let V = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z(), Vector3::new(2.0, 2.0, 2.0)];
    let (near_origin, far) = ([0, 1, 2, 3], [1, 2, 3, 4]);
    // Shape functions by hand. A comparison of distances chooses a wrong element for the second point.
    let missed_by_first = (Vector3::new(-0.1, 0.2, 0.3), row(5, near_origin, [0.6, -0.1, 0.2, 0.3]));
    let missed_by_far = (Vector3::new(-0.1, 0.2, -0.3), row(5, far, [0.38, 0.68, 0.18, -0.24]));
    let orders = [[near_origin, far], [far, near_origin]];
    for (T, (x, expected)) in orders.iter().flat_map(|T| [(T, &missed_by_first), (T, &missed_by_far)]) {
        let rule = "the element whose smallest weight is largest; weights stay as they are, also negative";
        near(rule, &dense(course, &V, T, &[*x])?, expected, 1e-13)?;
    }
    let mesh = Mesh::uneven_box([2, 1, 1], 1.0);
    for_some(course.seed, vector(-1.0..1.0), |direction| {
        // Outside of the box, which reaches from 0 to 2.
        let x = Vector3::repeat(1.0) + direction.normalize() * 4.0;
        let found = dense(course, &mesh.V, &mesh.T, &[x])?;
        is_right(course, "a display vertex outside of the mesh", &found, &mesh, &x)?;
        follows(course, &mesh, &x)
    })
}

fn vertices_without_elements_have_no_weight(course: &Course) -> Outcome {
    let t = Tetrahedron::new([7, 1, 4, 2], &Matrix3::identity(), &Vector3::zeros());
    let expected = row(9, t.element, [0.4, 0.1, 0.2, 0.3]);
    near(
        "the vertices of the element that holds the point have its weights, all others none",
        &dense(course, &t.V, &[t.element], &[Vector3::new(0.1, 0.2, 0.3)])?,
        &expected,
        1e-13,
    )
}

fn no_display_vertices_give_a_matrix_without_rows(course: &Course) -> Outcome {
    let t = Tetrahedron::unit();
    near("no display vertex", &dense(course, &t.V[..4], &[t.element], &[])?, &DMatrix::zeros(0, 4), 0.0)?;
    near("no display vertex and no mesh", &dense(course, &[], &[], &[])?, &DMatrix::zeros(0, 0), 0.0)
}

fn far_from_the_origin_the_display_still_follows(course: &Course) -> Outcome {
    let mut mesh = Mesh::uneven_box([1, 1, 1], 1.0);
    let offset = Vector3::new(1048576.0, -2097152.0, 524288.0);
    mesh.V.iter_mut().for_each(|X| *X += offset);
    let x = Vector3::new(0.4, 0.5, 0.6) + offset;
    let N = dense(course, &mesh.V, &mesh.T, &[x])?;
    let blend = (0..mesh.V.len()).map(|vertex| (mesh.V[vertex] - offset) * N[(0, vertex)]).sum::<Vector3<f64>>();
    with_input("1000 km away", near("N V = V_skin, far from the origin", &blend, &(x - offset), 1e-8))
}
