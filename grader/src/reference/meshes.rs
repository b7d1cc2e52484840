//! Trials of the functions of a mesh: assembly, skinning, constraints.

use nalgebra::{DVector, Vector3};

use super::elements::trial;
use super::random::Random;
use super::scales;
use super::trial::{Input, Mesh, Trial};

/// A mesh, its elements' volumes and the size of a cell.
type Body = (Vec<Vector3<f64>>, Vec<[usize; 4]>, Vec<f64>, f64);

/// A box of a few cells, each of six elements, uneven, its vertices numbered at random, one of them used by no element.
fn uneven_box(random: &mut Random) -> Body {
    let (cells, size) = (1 + random.below(2), random.size());
    let vertices = 4 * (cells + 1);
    let names = random.order(vertices + 1);
    let mut V = vec![random.vector(-1.0..1.0) * size; vertices + 1];
    for (k, &name) in names.iter().take(vertices).enumerate() {
        let corner = Vector3::new((k / 4) as f64, (k / 2 % 2) as f64, (k % 2) as f64);
        V[name] = (corner + random.vector(-0.1..0.1)) * size;
    }
    let mut T = Vec::new();
    for cell in 0..cells {
        for [a, b] in [[4, 2], [4, 1], [2, 4], [2, 1], [1, 4], [1, 2]] {
            let corners = [0, a, a + b, 7].map(|corner| names[4 * cell + corner]);
            T.push(random.four_of(4).map(|i| corners[i]));
        }
    }
    let volume = |t: &[usize; 4]| {
        let [a, b, c, d] = t.map(|vertex| V[vertex]);
        (b - a).dot(&(c - a).cross(&(d - a))).abs() / 6.0
    };
    let v0 = T.iter().map(volume).collect();
    (V, T, v0, size)
}

/// `mass_matrix_mesh`.
pub fn masses(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let one = |index: usize| {
        let (V, mut T, v0, _) = uneven_box(random);
        // In the first ones the last vertex belongs to no element, in the others it does.
        let edge = index < 4;
        let last = V.len() - 1;
        let unused = (0..=last).find(|vertex| !T.iter().flatten().any(|used| used == vertex)).unwrap_or(last);
        let other = if edge { last } else { 0 };
        if edge || unused == last {
            T.iter_mut().flatten().filter(|vertex| **vertex == other).for_each(|vertex| *vertex = unused);
        }
        let density = random.number(1.0..5000.0);
        let scale = density * v0.iter().copied().fold(0.0, f64::max) / 10.0;
        let name = if edge { "a last vertex without elements" } else { "a small mesh" };
        let input = Input::MeshMass { q_size: 3 * V.len(), T, density, v0 };
        Trial { edge, ..trial(function, name, input, scale) }
    };
    (0..20).map(one).collect()
}

/// `assemble_forces` and `assemble_stiffness`.
pub fn assembled(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let derivatives = if function == "assemble_forces" { 1 } else { 2 };
    let one = |index: usize| {
        let (V, T, v0, size) = uneven_box(random);
        let (name, F) = random.deformation_of(index);
        let shift = random.vector(-1.0..1.0) * size;
        let uneven = if index < 5 { 0.0 } else { 0.03 * size };
        let mut q = DVector::zeros(3 * V.len());
        for (vertex, X) in V.iter().enumerate() {
            let x = F * (X + random.vector(-1.0..1.0) * uneven) + shift;
            q.fixed_rows_mut::<3>(3 * vertex).copy_from(&x);
        }
        let (C, D) = random.constants();
        let mesh = Mesh { q, V, T, v0, C, D };
        let scale = scales::mesh(&mesh, derivatives);
        trial(function, name, Input::Mesh(mesh), scale)
    };
    (0..20).map(one).collect()
}

/// `build_skinning_matrix`.
pub fn skinnings(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let one = |index: usize| {
        let (V, T, _, size) = uneven_box(random);
        let mut weights = || match index {
            0..4 => [1.0, 0.0, 0.0, 0.0],
            4..8 => [1.0, random.number(0.2..1.0), 0.0, 0.0],
            _ => [(); 4].map(|()| random.number(0.05..1.0)),
        };
        let rows: Vec<_> = (0..6).map(|_| weights()).collect();
        let inside = |(row, w): (usize, &[f64; 4])| {
            let element = T[(5 * row + index) % T.len()];
            let sum: f64 = w.iter().sum();
            (0..4).map(|i| V[element[i]] * (w[(i + row) % 4] / sum)).sum::<Vector3<f64>>()
        };
        let mut V_skin: Vec<_> = rows.iter().enumerate().map(inside).collect();
        let name = match index {
            0..4 => "at vertices",
            4..8 => "on edges",
            8..20 => "inside",
            20 => {
                V_skin.clear();
                "no display vertices"
            }
            _ => {
                let directions = V_skin.iter_mut();
                directions.for_each(|x| *x += random.vector(-1.0..1.0).normalize() * (3.0 * size));
                "outside"
            }
        };
        // Points on a boundary, no points, and points outside.
        let edge = !(8..20).contains(&index);
        Trial { edge, ..trial(function, name, Input::Skinning { V, T, V_skin }, 1.0) }
    };
    (0..28).map(one).collect()
}

/// `fixed_point_constraints`.
pub fn constraints(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let one = |index: usize| {
        let vertices = 4 + random.below(6);
        let mut indices = random.order(vertices);
        let name = match index {
            0 => {
                indices.clear();
                "nothing fixed"
            }
            1 => "everything fixed",
            2..8 => {
                indices.truncate(3);
                indices.extend_from_within(..);
                "repeated"
            }
            8..18 => {
                indices.truncate(1 + random.below(3));
                indices.sort_unstable();
                "ascending"
            }
            _ => {
                indices.truncate(2 + random.below(2));
                "in any order"
            }
        };
        let input = Input::Fixed { q_size: 3 * vertices, indices };
        Trial { edge: index < 8, ..trial(function, name, input, 1.0) }
    };
    (0..28).map(one).collect()
}
