//! Forces of triangles, and corotation.

use fem_engine::materials::{Corotated, Law};
use fem_engine::tensor::Tensor;
use fem_mesh::{Pattern, rectangle_mesh};
use nalgebra::{Matrix2, Vector2};

use crate::experiments::flat::modulus::{STRAIN, YOUNG, modulus};
use crate::experiments::mistake::Mistake;

/// Nodal forces of a stretched strip with ν = 0, divided by 3 in place of 2.
pub fn thirds() -> Result<Mistake, String> {
    Ok(Mistake {
        rule: "the force of a triangle's edges divided by 3",
        right: "divided by 2",
        quantity: "modulus of a stretched strip over E".to_owned(),
        theirs: strip(3.0)? / YOUNG,
        ours: modulus("corotated")? / YOUNG,
        truth: 1.0,
        tolerance: 1e-10,
    })
}

/// Force of a strip of 2 × 1 m with constant stress on the nodes of its end, over area and strain, Pa. Each node has the forces of the two
/// edges that meet in it, divided by `divisor`.
fn strip(divisor: f64) -> Result<f64, String> {
    let mesh = rectangle_mesh([2.0, 1.0], 3, Pattern::Kuhn).map_err(|error| error.to_string())?;
    let stress = YOUNG * STRAIN;
    let mut force = 0.0;
    for triangle in &mesh.elements {
        for i in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|k| mesh.vertices[triangle[(i + k) % 3]]);
            if a.x < 2.0 - 1e-9 {
                continue;
            }
            // Outward normals of the edges ab and ca, times their lengths, along x.
            force -= stress * ((b.y - a.y) + (a.y - c.y)) / divisor;
        }
    }
    Ok(force.abs() / STRAIN)
}

/// λ = μ, Pa.
const LAME: f64 = 45_000.0;

/// The elastic energy of a deformed triangle whose vertices are numbered in three ways.
pub fn first_vertex() -> Mistake {
    let rest = [[0.0, 0.0], [1.0, 0.0], [0.2, 0.9]].map(Vector2::from);
    let F = Matrix2::new(1.2, 0.5, -0.1, 0.9);
    let now = rest.map(|x| F * x);
    let spread = |energy: &dyn Fn([Vector2<f64>; 3], [Vector2<f64>; 3]) -> f64| {
        let of = |first: usize| [0, 1, 2].map(|k| (first + k) % 3);
        let energies = [0, 1, 2].map(|first| energy(of(first).map(|i| rest[i]), of(first).map(|i| now[i])));
        let (low, high) = energies.iter().fold((f64::INFINITY, 0.0f64), |(a, b), &x| (a.min(x), b.max(x)));
        (high - low) / high
    };
    Mistake {
        rule: "corotation by QR of the edges",
        right: "by polar decomposition",
        quantity: "relative spread of a triangle's energy over its first vertex".to_owned(),
        theirs: spread(&by_qr),
        ours: spread(&by_polar),
        truth: 0.0,
        tolerance: 1e-13,
    }
}

/// The edges from the first vertex as columns.
fn edges([a, b, c]: [Vector2<f64>; 3]) -> Matrix2<f64> {
    Matrix2::from_columns(&[b - a, c - a])
}

/// Corotated energy density with the rotation of the first edge, J/m³: the QR decomposition of the edges has it as Q.
fn by_qr(rest: [Vector2<f64>; 3], now: [Vector2<f64>; 3]) -> f64 {
    let (before, after) = (edges(rest), edges(now));
    let frame = |edges: &Matrix2<f64>| {
        let first = edges.column(0).normalize();
        Matrix2::new(first.x, -first.y, first.y, first.x)
    };
    let R = frame(&after) * frame(&before).transpose();
    let Some(inverse) = before.try_inverse() else { return f64::NAN };
    let S = R.transpose() * after * inverse;
    let strain = 0.5 * (S + S.transpose()) - Matrix2::identity();
    LAME * strain.norm_squared() + 0.5 * LAME * strain.trace().powi(2)
}

/// The engine's corotated energy density, J/m³.
fn by_polar(rest: [Vector2<f64>; 3], now: [Vector2<f64>; 3]) -> f64 {
    let Some(inverse) = edges(rest).try_inverse() else { return f64::NAN };
    let F = edges(now) * inverse - Matrix2::identity();
    let G: Tensor<f64> = [[F.m11, F.m12, 0.0], [F.m21, F.m22, 0.0], [0.0; 3]];
    Corotated { mu: LAME, lambda: LAME }.energy(&G)
}
