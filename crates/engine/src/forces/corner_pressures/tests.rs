//! The inf–sup condition, by numbers: Chapelle and Bathe, The Inf-Sup Test (1993). The smallest β with
//! sup B(u, p) / ‖∇u‖ ≥ β ‖p‖ for all pressures stays where meshes are refined, or pressures oscillate and elements lock.

use fem_mesh::{Pattern, box_mesh, rectangle_mesh};
use fem_model::{Body, BodyMesh, Elastic, Law, Material, Volumetric};
use nalgebra::{DMatrix, Vector3};

use super::CornerPressures;
use fem_solvers::Ldlt;
use fem_solvers::numbering::Numbering;

/// The pressures of a square or a cube of so many cells along an edge, with the numbering of its nodes: those at one side are fixed. Nodes within
/// are moved by a part of a cell.
fn pressures(dimension: usize, cells: usize, order: usize) -> (CornerPressures, Numbering) {
    let moved = |x: Vector3<f64>, number: usize| {
        let is_inside = (0..dimension).all(|i| x[i] > 1e-9 && x[i] < 1.0 - 1e-9);
        let shift = |i: usize| if i < dimension { ((3 * number + i) as f64 * 2.399).sin() } else { 0.0 };
        x + if is_inside { 0.15 / cells as f64 * Vector3::from_fn(|i, _| shift(i)) } else { Vector3::zeros() }
    };
    let shape = if dimension == 2 {
        let mut mesh = rectangle_mesh([1.0, 1.0], cells, Pattern::Alternating).unwrap();
        mesh.vertices.iter_mut().enumerate().for_each(|(number, x)| *x = moved(*x, number));
        BodyMesh::flat(mesh, 1.0)
    } else {
        let mut mesh = box_mesh([1.0, 1.0, 1.0], cells, Pattern::Alternating).unwrap();
        mesh.vertices.iter_mut().enumerate().for_each(|(number, x)| *x = moved(*x, number));
        BodyMesh::solid(mesh)
    };
    let material = Material::new(Law::Linear(Elastic::new(3.0, 0.5)), 1.0);
    let material = Material { volumetric: Volumetric::Mixed, ..material };
    let body = Body::new(shape.of_order(order).unwrap(), material).unwrap();
    let vertices = body.shape.mesh.vertices();
    let (mut mesh_node, fixed): (Vec<u32>, Vec<u32>) =
        (0..vertices.len() as u32).partition(|&node| vertices[node as usize].x > 1e-9);
    let free = mesh_node.len();
    mesh_node.extend(fixed);
    let mut engine_node = vec![0; mesh_node.len()];
    mesh_node.iter().zip(0..).for_each(|(&node, number)| engine_node[node as usize] = number);
    let numbering = Numbering { mesh_node, engine_node, free };
    (CornerPressures::new(&body, &numbering).unwrap(), numbering)
}

/// β of the pressures of a body, with or without the stabilization of linear elements.
fn beta(dimension: usize, cells: usize, order: usize, is_stabilized: bool) -> f64 {
    let (ref mixed, Numbering { free, mesh_node, .. }) = pressures(dimension, cells, order);
    let count = mixed.count();
    let mut laplacian = laplacian(mixed, free);
    let mut B = vec![DMatrix::zeros(free, count); dimension];
    let mut pairs = mixed.couplings();
    mixed.coupling(&vec![[0.0; 3]; mesh_node.len()], |of| {
        let (corner, node) = pairs.next().unwrap();
        if node < free {
            (0..dimension).for_each(|i| B[i][(node, corner as usize)] += of[i]);
        }
    });
    let (mut sum, mut mass) = (DMatrix::zeros(count, count), DMatrix::zeros(count, count));
    for B in &B {
        let mut solved = B.clone();
        solved.column_iter_mut().for_each(|mut column| {
            laplacian.solve(column.as_mut_slice(), 1e-12);
        });
        sum += B.transpose() * solved;
    }
    for element in &mixed.elements {
        let n = element.corners.len() as f64;
        for (i, &row) in element.corners.iter().enumerate() {
            for (j, &column) in element.corners.iter().enumerate() {
                let consistent = if i == j { 2.0 } else { 1.0 } / (n * (n + 1.0));
                let place = (row as usize, column as usize);
                mass[place] += element.volume * consistent;
                if is_stabilized && element.compliance[1] > 0.0 {
                    sum[place] += element.volume * (consistent - 1.0 / (n * n));
                }
            }
        }
    }
    let L = mass.cholesky().unwrap().l();
    let half = L.solve_lower_triangular(&sum).unwrap();
    let values = L.solve_lower_triangular(&half.transpose()).unwrap().symmetric_eigenvalues();
    values.min().max(0.0).sqrt()
}

/// ∫ ∇N·∇N of the free nodes, factored.
fn laplacian(mixed: &CornerPressures, free: usize) -> Ldlt {
    let (mut places, mut entries) = (Vec::new(), Vec::new());
    for point in 0..mixed.points.count() {
        for (row, a) in mixed.points.nodes(point) {
            for (column, b) in mixed.points.nodes(point).filter(|(column, _)| *column <= row && row < free) {
                places.push([row as u32, column as u32]);
                entries.push(mixed.points.volume(point) * a.dot(b));
            }
        }
    }
    let mut factor = Ldlt::new(free, &places);
    factor.set(entries.into_iter());
    assert_eq!(factor.factor(), Ok(free));
    factor
}

/// β on meshes with more and more cells, and its order in their size: zero where it stays.
fn sequence(dimension: usize, cells: [usize; 3], order: usize, is_stabilized: bool) -> ([f64; 3], f64) {
    let betas = cells.map(|cells| beta(dimension, cells, order, is_stabilized));
    let order = (betas[0] / betas[2]).ln() / (cells[2] as f64 / cells[0] as f64).ln();
    (betas, order)
}

#[test]
fn pressures_of_quadratic_elements_and_stabilized_ones_of_linear_elements_satisfy_the_inf_sup_condition() {
    for (dimension, cells) in [(2, [3, 6, 12]), (3, [3, 4, 6])] {
        for order in [1, 2] {
            let (betas, slope) = sequence(dimension, cells, order, true);
            assert!(betas[2] > 0.4 && slope.abs() < 0.1, "{dimension}, {order}: {betas:?} {slope}");
        }
    }
}

#[test]
fn pressures_of_linear_elements_without_stabilization_do_not() {
    let (betas, slope) = sequence(2, [3, 6, 12], 1, false);
    assert!(betas[2] < 0.1 || slope > 0.4, "{betas:?} {slope}");
}
