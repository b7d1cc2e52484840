//! Quadratic tetrahedra.

use nalgebra::{DMatrix, Vector3};

use super::{
    Case, blocks_of_both_kinds_are_alike, case_of, converges, dot, largest, law, moved, multiply,
    product_without_a_matrix, random,
};
use fem_elements::elements::Elements;
use fem_elements::materials::{Corotated, Law, Linear, NeoHookean, StableNeoHookean};
use fem_elements::number::Float;
use fem_elements::tensor::Tensor;
use fem_mesh::{Mesh, Pattern, TetrahedralMesh, box_mesh};
use fem_model::BodyMesh;

/// Quadrature points of a tetrahedron.
const POINTS: usize = 4;

/// Tetrahedra of 2 × 1 × 1 m whose inner nodes are displaced, and whose tetrahedra begin at different corners.
fn irregular(cells: usize) -> BodyMesh {
    let mut mesh = box_mesh([2.0, 1.0, 1.0], cells, Pattern::Alternating).unwrap();
    let mut random = random(3);
    for x in mesh.vertices.iter_mut().filter(|x| is_inner(x)) {
        *x += 0.15 / cells as f64 * Vector3::new(random(), random(), random());
    }
    // An even permutation of the corners keeps the volume positive.
    mesh.elements.iter_mut().enumerate().for_each(|(i, element)| element[..3].rotate_left(i % 3));
    quadratic(mesh)
}

fn is_inner(x: &Vector3<f64>) -> bool {
    x.x > 1e-9 && x.x < 2.0 - 1e-9 && [x.y, x.z].iter().all(|x| (1e-9..1.0 - 1e-9).contains(x))
}

fn quadratic(linear: TetrahedralMesh) -> BodyMesh {
    BodyMesh::solid(linear).of_order(2).unwrap()
}

fn elements_of<T: Float>(mesh: &BodyMesh, pattern: &fem_elements::sparse::Pattern) -> Elements<T, 3, 9, 10> {
    Elements::at_points(mesh.element(), mesh.vertices(), &nodes(mesh), &[], pattern)
}

fn nodes(mesh: &BodyMesh) -> Vec<[u32; 10]> {
    mesh.arrays().unwrap().iter().map(|nodes| nodes.map(|node| node as u32)).collect()
}

fn tetrahedra(mesh: &BodyMesh) -> Case<3, 9, 10> {
    case_of(mesh.vertices(), &nodes(mesh), |pattern| elements_of(mesh, pattern))
}

/// One element that is no half of a symmetric one.
fn single() -> BodyMesh {
    let x = [[0.0, 0.0, 0.0], [1.1, 0.2, 0.0], [0.1, 0.9, -0.1], [0.3, 0.2, 0.8]].map(Vector3::from);
    quadratic(Mesh::new(x.to_vec(), vec![[0, 1, 2, 3]]))
}

fn sample() -> Case<3, 9, 10> {
    let case = tetrahedra(&irregular(2));
    Case { u: case.u.iter().map(|u| u.map(|u| 0.3 * u)).collect(), ..case }
}

#[test]
fn energy_gradient_and_stiffness_of_quadratic_tetrahedra_belong_together() {
    converges(&sample());
}

#[test]
fn products_and_blocks_of_quadratic_tetrahedra_are_those_of_their_matrix() {
    product_without_a_matrix(&sample());
    blocks_of_both_kinds_are_alike(&sample(), law::<f64>());
    blocks_of_both_kinds_are_alike(&sample(), StableNeoHookean { mu: 2.0, lambda: 3.0 });
    blocks_of_both_kinds_are_alike(&sample(), Corotated { mu: 2.0, lambda: 3.0 });
}

#[test]
fn lanes_find_what_one_element_after_the_other_does() {
    type Fast = <f64 as Float>::Fast;
    if !f64::has_fast() {
        return;
    }
    let Case { elements, u, d, pattern } = sample();
    let fast = NeoHookean { C: constant::<Fast>(super::C), D: constant::<Fast>(super::D) };
    let mut pairs =
        [[vec![[0.0; 3]; u.len()], vec![[0.0; 3]; u.len()]], [vec![[0.0; 3]; u.len()], vec![[0.0; 3]; u.len()]]];
    let [[a, b], [c, e]] = &mut pairs;
    let energies = [
        elements.add_energy_and_gradient::<f64, _>(&law::<f64>(), &u, a),
        elements.add_energy_and_gradient::<Fast, _>(&fast, &u, b),
    ];
    assert!((energies[0] - energies[1]).abs() < 1e-13 * energies[0]);
    elements.add_stiffness_times::<f64, _>(&law::<f64>(), 1.0, &u, &d, c);
    elements.add_stiffness_times::<Fast, _>(&fast, 1.0, &u, &d, e);
    for [one, other] in &pairs {
        assert!(largest(&moved(one, other, -1.0)) < 1e-13 * largest(one));
    }
    let mut values = [vec![[[0.0; 3]; 3]; pattern.blocks()], vec![[[0.0; 3]; 3]; pattern.blocks()]];
    elements.add_stiffness::<f64, _>(&law::<f64>(), 1.0, &u, &mut values[0]);
    elements.add_stiffness::<Fast, _>(&fast, 1.0, &u, &mut values[1]);
    let [one, other] = values.map(|values| values.as_flattened().to_vec());
    assert!(largest(&moved(&one, &other, -1.0)) < 1e-13 * largest(&one));
}

fn constant<L: fem_elements::number::Number<Element = f64>>(x: f64) -> L {
    L::splat(x)
}

/// Displacements at the nodes, and the displacement gradients that the elements find, with their places.
fn gradients(mesh: &BodyMesh, u: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Vec<(Vector3<f64>, Tensor<f64>)> {
    let u: Vec<[f64; 3]> = mesh.vertices().iter().map(|x| u(x).into()).collect();
    let mut found = Vec::new();
    tetrahedra(mesh).elements.for_each_gradient(&u, |point, _, G| {
        found.push((mesh.points(point / POINTS)[point % POINTS], *G));
    });
    assert_eq!(found.len(), POINTS * mesh.elements());
    found
}

#[test]
fn a_quadratic_displacement_has_its_exact_gradient_at_every_quadrature_point() {
    let mesh = irregular(2);
    let u = |x: &Vector3<f64>| {
        Vector3::new(
            0.1 + 0.2 * x.x - x.y + x.x * x.x - 0.5 * x.x * x.y + 0.3 * x.y * x.z,
            0.3 * x.y * x.y + x.x * x.y - 0.7 * x.z * x.z,
            x.z * x.x - 0.4 * x.z + x.y * x.y,
        )
    };
    for (x, G) in gradients(&mesh, u) {
        let exact = [
            [0.2 + 2.0 * x.x - 0.5 * x.y, -1.0 - 0.5 * x.x + 0.3 * x.z, 0.3 * x.y],
            [x.y, 0.6 * x.y + x.x, -1.4 * x.z],
            [x.z, 2.0 * x.y, x.x - 0.4],
        ];
        for i in 0..3 {
            (0..3).for_each(|j| assert!((G[i][j] - exact[i][j]).abs() < 1e-12, "{G:?} {exact:?}"));
        }
    }
    // A cubic one has not.
    let cubic = gradients(&mesh, |x| Vector3::new(x.x * x.x * x.x, 0.0, 0.0));
    assert!(cubic.into_iter().any(|(x, G)| (G[0][0] - 3.0 * x.x * x.x).abs() > 1e-3));
}

#[test]
fn a_quadratic_state_has_the_forces_of_its_body_force_and_traction_exactly() {
    // Of a linear law: σ is affine, −div σ constant, so the forces at inner nodes are those of a uniform load, −1/20 and 1/5 of each element's.
    let law = Linear { mu: 2.0, lambda: 3.0 };
    let mesh = irregular(2);
    let u = |x: &Vector3<f64>| Vector3::new(x.x * x.y, 0.5 * x.y * x.y - 0.2 * x.z * x.x, x.z * x.z);
    // ε_kk = y + y + 2 z, ∇ε_kk = (0, 2, 2), Δu = (0, 1, 2): div σ = (μ + λ) ∇ε_kk + μ Δu.
    let div: Vector3<f64> = (law.mu + law.lambda) * Vector3::new(0.0, 2.0, 2.0) + law.mu * Vector3::new(0.0, 1.0, 2.0);
    let displacements: Vec<[f64; 3]> = mesh.vertices().iter().map(|x| u(x).into()).collect();
    let mut sum = vec![[0.0; 3]; displacements.len()];
    tetrahedra(&mesh).elements.add_gradient(&law, &displacements, &mut sum);
    let size = largest(&sum);
    for (nodes, volume) in mesh.corners().zip(mesh.volumes()) {
        for (i, &node) in nodes.iter().enumerate() {
            let share = if i < 4 { -1.0 / 20.0 } else { 1.0 / 5.0 };
            (0..3).for_each(|j| sum[node][j] += share * volume * div[j]);
        }
    }
    let inner: Vec<[f64; 3]> =
        sum.iter().zip(mesh.vertices()).filter(|(_, x)| is_inner(x)).map(|(force, _)| *force).collect();
    assert!(inner.len() > 50 && largest(&inner) < 1e-13 * size, "{:e}", largest(&inner) / size);
}

#[test]
fn a_rigid_motion_of_quadratic_tetrahedra_has_no_forces() {
    let mesh = irregular(2);
    let elements = tetrahedra(&mesh).elements;
    let turn = nalgebra::Rotation3::from_euler_angles(0.4, -1.1, 2.0);
    let turned = |x: &Vector3<f64>| (turn * x - x + Vector3::new(5.0, -3.0, 1.0)).into();
    let sheared = |x: &Vector3<f64>| [x.y, 0.0, 0.0];
    let [of_turned, of_sheared] = [&turned as &dyn Fn(&Vector3<f64>) -> [f64; 3], &sheared].map(|motion| {
        let u: Vec<[f64; 3]> = mesh.vertices().iter().map(motion).collect();
        let mut gradient = vec![[0.0; 3]; u.len()];
        elements.add_gradient(&law::<f64>(), &u, &mut gradient);
        largest(&gradient)
    });
    assert!(of_turned < 1e-12 * of_sheared, "{of_turned:e} {of_sheared:e}");
}

#[test]
fn a_free_element_and_a_free_patch_have_six_motions_without_energy_and_no_more() {
    for mesh in [single(), irregular(1)] {
        let Case { pattern, elements, .. } = tetrahedra(&mesh);
        let zero = vec![[0.0; 3]; mesh.vertices().len()];
        let mut values = vec![[[0.0; 3]; 3]; pattern.blocks()];
        elements.add_stiffness(&law::<f64>(), 1.0, &zero, &mut values);
        let column = |k: usize| {
            let mut unit = zero.clone();
            unit[k / 3][k % 3] = 1.0;
            let mut product = zero.clone();
            multiply(&pattern, &values, &unit, &mut product);
            product
        };
        let columns: Vec<f64> = (0..3 * zero.len()).flat_map(|k| column(k).into_flattened()).collect();
        let K = DMatrix::from_vec(3 * zero.len(), 3 * zero.len(), columns);
        assert!((&K - K.transpose()).amax() < 1e-14 * K.amax());
        let mut found: Vec<f64> = K.symmetric_eigenvalues().iter().copied().collect();
        found.sort_by(f64::total_cmp);
        assert!(found[5].abs() < 1e-12 * K.amax() && found[6] > 1e-4 * K.amax(), "{:?}", &found[..8]);
    }
}

#[test]
fn the_rule_integrates_the_energy_of_a_linear_law_exactly() {
    let law = Linear { mu: 2.0, lambda: 3.0 };
    let u = |x: &Vector3<f64>| [x.x * x.y + 0.2 * x.x * x.x, x.y * x.y - 0.4 * x.z * x.y, 0.3 * x.x * x.z];
    // Every mesh has the same displacement, so energies differ by errors of integration alone.
    let energy =
        |mesh: BodyMesh| tetrahedra(&mesh).elements.energy(&law, &mesh.vertices().iter().map(u).collect::<Vec<_>>());
    let [coarse, fine] = [1, 3].map(|cells| energy(irregular(cells)));
    assert!((coarse - fine).abs() < 1e-13 * fine, "{coarse} {fine}");
    // ∫ over [0, 2] × [0, 1]² by the Gauss–Legendre rule of three points.
    let points = [(-0.6_f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6_f64.sqrt(), 5.0 / 18.0)];
    let mut exact = 0.0;
    for (a, of_a) in points {
        for (b, of_b) in points {
            for (c, of_c) in points {
                let [x, y, z] = [1.0 + a, 0.5 + 0.5 * b, 0.5 + 0.5 * c];
                let G = [[y + 0.4 * x, x, 0.0], [0.0, 2.0 * y - 0.4 * z, -0.4 * y], [0.3 * z, 0.0, 0.3 * x]];
                exact += 2.0 * of_a * of_b * of_c * law.energy(&G);
            }
        }
    }
    assert!((fine - exact).abs() < 1e-12 * exact, "{fine} {exact}");
}

#[test]
fn an_affine_displacement_leaves_inner_nodes_of_an_irregular_mesh_without_force() {
    let mesh = irregular(2);
    let of = |x: &Vector3<f64>| [0.3 * x.x - 0.2 * x.y, 0.1 * x.x + 0.25 * x.z, -0.1 * x.z + 0.05 * x.y];
    let u: Vec<[f64; 3]> = mesh.vertices().iter().map(of).collect();
    let mut gradient = vec![[0.0; 3]; u.len()];
    tetrahedra(&mesh).elements.add_gradient(&law::<f64>(), &u, &mut gradient);
    let inner: Vec<[f64; 3]> =
        gradient.iter().zip(mesh.vertices()).filter(|(_, x)| is_inner(x)).map(|(force, _)| *force).collect();
    assert!(inner.len() > 50 && largest(&inner) < 1e-12 * largest(&gradient));
}

#[test]
fn chunks_and_lanes_that_are_filled_up_count_every_element_once() {
    // 5 · 23 elements are no multiple of a register; 60 cells make several chunks.
    for cells in [[23, 1, 1], [60, 3, 3]] {
        let size = cells.map(|cells| cells as f64);
        let mesh = quadratic(box_mesh(size, 1, Pattern::Alternating).unwrap());
        let Case { elements, u, d, .. } = tetrahedra(&mesh);
        assert_eq!(elements.chunks() > 1, cells[1] > 1);
        let law = Linear { mu: 2.0, lambda: 3.0 };
        let u: Vec<_> = u.iter().map(|u| u.map(|u| 0.1 * u)).collect();
        let mut volume = 0.0;
        let mut visits = vec![0; elements.count];
        let mut energy = 0.0;
        elements.for_each_gradient(&u, |point, of_point, G| {
            volume += of_point;
            visits[point] += 1;
            energy += of_point * law.energy(G);
        });
        assert!(visits.iter().all(|&count| count == 1));
        assert!((volume / size.iter().product::<f64>() - 1.0).abs() < 1e-12, "{volume}");
        assert!((elements.energy(&law, &u) - energy).abs() < 1e-13 * energy);
        let mut gradient = vec![[0.0; 3]; u.len()];
        elements.add_gradient(&law, &u, &mut gradient);
        assert!((dot(&gradient, &u) - 2.0 * energy).abs() < 1e-12 * energy);
        let mut product = vec![[0.0; 3]; u.len()];
        elements.add_stiffness_times(&law, 1.0, &u, &d, &mut product);
        assert!((dot(&product, &u) - dot(&gradient, &d)).abs() < 1e-12 * dot(&product, &d));
    }
}

#[test]
fn the_minimum_of_det_F_is_that_of_a_quadrature_point_and_names_it() {
    let mesh = irregular(1);
    let elements = tetrahedra(&mesh).elements;
    let u: Vec<[f64; 3]> = mesh.vertices().iter().map(|x| [x.x, 0.1 * x.y * x.y, 0.2 * x.z * x.x]).collect();
    let mut least = (f64::INFINITY, 0);
    elements.for_each_gradient(&u, |point, _, G| {
        let J = nalgebra::Matrix3::from_fn(|i, j| G[i][j] + f64::from(i == j)).determinant();
        least = if J < least.0 { (J, point) } else { least };
    });
    let (J, point) = elements.min_det_F(&u);
    assert!(least.0 > 1.0 && (J - least.0).abs() < 1e-14 && point == least.1, "{J} {least:?}");
    assert_eq!(elements.inverted(&u), 0);
    let mirrored: Vec<[f64; 3]> = mesh.vertices().iter().map(|x| [-2.0 * x.x, 0.0, 0.0]).collect();
    assert_eq!(elements.inverted(&mirrored), elements.count);
}
