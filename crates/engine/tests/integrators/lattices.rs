//! The elasticity that springs amount to: lattices whose moduli are known in closed form.

use std::path::Path;

use fem_engine::apparent_moduli::apparent_moduli;
use fem_engine::materials::AnyLaw;
use fem_engine::model::system::System;
use fem_engine::solvers::SolverChoice;
use fem_mesh::{SurfaceMesh, TetrahedralMesh};
use fem_model::{Body, BodyMesh};
use nalgebra::Vector3;

use crate::scene;

/// The body of a mesh with these parameters of `[material]`.
fn body(mesh: impl Into<BodyMesh>, material: &str) -> Body {
    let mesh = mesh.into();
    let source = if mesh.dimension() == 2 { "rectangle = { size = [1, 1]" } else { "box = { size = [1, 1, 1]" };
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\n{source}, cells_per_unit = 1 }}\n[material]\n{material}\ndensity = 1000\n\
         [time]\ndt = 1.0\nintegrator = \"verlet\"\n"
    );
    fem_scene::body_of(&scene(&text), mesh, Path::new("no data")).unwrap()
}

/// Equilateral triangles with edges of 0.1 m in rows of n.
fn triangles(n: usize) -> BodyMesh {
    let place = |i: usize, j: usize| Vector3::new(i as f64 + 0.5 * j as f64, 0.75f64.sqrt() * j as f64, 0.0) * 0.1;
    let node = |i: usize, j: usize| i + (n + 1) * j;
    let vertices = (0..=n).flat_map(|j| (0..=n).map(move |i| place(i, j))).collect();
    let cells = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let both =
        |(i, j)| [[node(i, j), node(i + 1, j), node(i, j + 1)], [node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]];
    BodyMesh::flat(SurfaceMesh::new(vertices, cells.flat_map(both).collect()), 0.2)
}

/// Body-centred cubic cells of 1 m, n along each edge: a tetrahedron between the centres of two cells with a common face and each edge
/// of that face.
fn bcc(n: usize) -> TetrahedralMesh {
    let corner = |x: [usize; 3]| x[0] + (n + 1) * (x[1] + (n + 1) * x[2]);
    let center = |x: [usize; 3]| (n + 1).pow(3) + x[0] + n * (x[1] + n * x[2]);
    let grid = |n: usize| (0..n).flat_map(move |k| (0..n).flat_map(move |j| (0..n).map(move |i| [i, j, k])));
    let at = |x: [usize; 3]| Vector3::from(x.map(|x| x as f64));
    let mut vertices: Vec<_> = grid(n + 1).map(at).collect();
    vertices.extend(grid(n).map(|x| at(x) + Vector3::repeat(0.5)));
    let mut elements = Vec::new();
    for x in grid(n) {
        for axis in (0..3).filter(|&axis| x[axis] > 0) {
            let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut before = x;
            before[axis] -= 1;
            let face = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[s, t]| {
                let mut place = x;
                (place[b], place[c]) = (x[b] + s, x[c] + t);
                corner(place)
            });
            for side in 0..4 {
                elements.push([face[side], face[(side + 1) % 4], center(x), center(before)]);
            }
        }
    }
    // Cells at the boundary leave corners that belong to no tetrahedron.
    let mut number = vec![usize::MAX; vertices.len()];
    elements.iter().flatten().for_each(|&node| number[node] = 0);
    let kept: Vec<usize> = (0..vertices.len()).filter(|&node| number[node] == 0).collect();
    kept.iter().enumerate().for_each(|(new, &node)| number[node] = new);
    let vertices = kept.iter().map(|&node| vertices[node]).collect();
    let elements = elements.into_iter().map(|element| element.map(|node| number[node])).collect();
    oriented(vertices, elements)
}

/// The mesh with every tetrahedron of positive volume.
fn oriented(vertices: Vec<Vector3<f64>>, mut elements: Vec<[usize; 4]>) -> TetrahedralMesh {
    for element in &mut elements {
        let [a, b, c, d] = element.map(|node| vertices[node]);
        if (b - a).cross(&(c - a)).dot(&(d - a)) < 0.0 {
            element.swap(2, 3);
        }
    }
    TetrahedralMesh::new(vertices, elements)
}

fn relative(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

#[test]
fn equilateral_triangles_have_the_modulus_that_is_given_and_a_ratio_of_a_third_in_every_direction() {
    for n in [2, 5, 9] {
        let found = apparent_moduli(&body(triangles(n), "model = \"mass_spring\"\nyoung = 3e5")).unwrap().unwrap();
        assert!(relative(found.young, 3e5) < 1e-10, "{found:?}");
        assert!((found.poisson - 1.0 / 3.0).abs() < 1e-10, "{found:?}");
        assert!(found.young_of_directions.iter().all(|young| relative(*young, 3e5) < 1e-10), "{found:?}");
        assert!(relative(found.affine_young, 3e5) < 1e-12 && found.inside == (n - 1) * (n - 1), "{found:?}");
    }
}

#[test]
fn equal_springs_of_equilateral_triangles_approach_two_over_root_three_of_their_stiffness() {
    // The boundary has its edges alone, of which each counts in full.
    let error = |n: usize| {
        let found = apparent_moduli(&body(triangles(n), "model = \"mass_spring\"\nstiffness = 1e4"));
        let found = found.unwrap().unwrap();
        found.young * 0.2 / (2.0 / 3f64.sqrt() * 1e4) - 1.0
    };
    let errors = [error(8), error(16)];
    assert!(errors[1] > 0.0 && errors[1] < 0.1 && (errors[0] / errors[1] - 2.0).abs() < 0.1, "{errors:?}");
}

#[test]
fn a_body_centred_lattice_has_the_moduli_of_its_cubic_stiffness_with_a_mean_ratio_of_a_quarter() {
    let found = apparent_moduli(&body(bcc(4), "model = \"mass_spring\"\nyoung = 1e5")).unwrap().unwrap();
    assert!(relative(found.affine_young, 1e5) < 1e-12 && found.inside > 20, "{found:?}");
    // Every node inside is a centre of symmetry, so that a uniform strain is its equilibrium.
    assert!((found.poisson - 0.25).abs() < 1e-10 && relative(found.young, 1e5) < 1e-10, "{found:?}");
    // C11 = 10/9 E and C12 = C44 = 4/9 E: E along a cube's edge is 6/7 of the mean, along its diagonal 12/11.
    let [least, most] = found.young_of_directions;
    assert!(relative(least, 6.0 / 7.0 * 1e5) < 0.05 && relative(most, 12.0 / 11.0 * 1e5) < 0.05, "{found:?}");
}

#[test]
fn springs_of_an_irregular_mesh_are_softer_in_equilibrium_than_in_a_uniform_strain() {
    let mut mesh = fem_mesh::box_mesh([1.0, 1.0, 1.0], 5, fem_mesh::Pattern::Alternating).unwrap();
    for (i, x) in mesh.vertices.iter_mut().enumerate().filter(|(_, x)| x.min() > 0.01 && x.max() < 0.99) {
        *x += Vector3::new((7.0 * i as f64).sin(), (11.0 * i as f64).sin(), (13.0 * i as f64).sin()) * 0.03;
    }
    let found = apparent_moduli(&body(mesh, "model = \"mass_spring\"\nyoung = 1e5")).unwrap().unwrap();
    assert!(relative(found.affine_young, 1e5) < 1e-12 && found.inside == 64, "{found:?}");
    assert!(found.young < 0.99e5 && found.young > 0.8e5, "{found:?}");
    assert!(found.poisson > 0.2 && found.poisson < 0.3, "{found:?}");
    let [least, most] = found.young_of_directions;
    assert!(least < found.young && found.young < most, "{found:?}");
}

/// ‖K d − K' d‖∞ / ‖K' d‖∞ of springs and linear elements on the undeformed mesh.
fn difference(mesh: &BodyMesh, elements: &str) -> f64 {
    let product = |material: &str| {
        let body = body(mesh.clone(), material);
        let law = AnyLaw::new(&body.material);
        let system = System::<f64>::new(body, law, SolverChoice::Cholesky);
        let d: Vec<[f64; 3]> = system
            .numbering
            .mesh_node
            .iter()
            .map(|&node| {
                [0, 1, 2].map(|i| if i as usize >= mesh.dimension() { 0.0 } else { ((5 * node + i) as f64).sin() })
            })
            .collect();
        let mut force = vec![[0.0; 3]; system.nodes()];
        system.add_stiffness_times(1.0, &vec![[0.0; 3]; system.nodes()], &d, &mut force);
        system.numbering.to_mesh(&force)
    };
    let (found, expected) = (product("model = \"mass_spring\"\nyoung = 1e5"), product(elements));
    let size = expected.as_flattened().iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let pairs = found.as_flattened().iter().zip(expected.as_flattened());
    pairs.fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs())) / size
}

#[test]
fn springs_of_equilateral_triangles_are_linear_elements_in_plane_stress_at_small_strain() {
    let plane = "model = \"linear\"\nyoung = 1e5\npoisson = 0.333333333333333333\nplane = \"stress\"";
    let flat = difference(&triangles(4), plane);
    assert!(flat < 1e-12, "{flat:e}");
}
