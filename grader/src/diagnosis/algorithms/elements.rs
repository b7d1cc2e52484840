//! Energy, gradient and Hessian of an elastic element: the deformation gradient, the density, the chain rule.

use finite_elements_3d as solved;
use finite_elements_3d::given;
use nalgebra::{Matrix3, Matrix4x3, SMatrix, SVector, Vector3};

use super::assembly::with_eigenvalues;
use crate::diagnosis::switches::Switch;
use crate::reference::trial::{Elastic, Input, Observed, Trial};

type Gradients = Matrix4x3<f64>;

/// The steps of the computation.
#[derive(Clone, Copy)]
pub struct Settings {
    /// The vertices whose positions are read, and those whose shape functions are taken.
    in_q: fn([usize; 4]) -> [usize; 4],
    in_V: fn([usize; 4]) -> [usize; 4],
    /// The row of a vertex's x in q.
    row: fn(usize) -> usize,
    gradients: fn(Gradients) -> Gradients,
    F: fn(Matrix3<f64>) -> Matrix3<f64>,
    stress: fn(Matrix3<f64>, &Matrix3<f64>) -> Matrix3<f64>,
    /// The gradients of the chain rule.
    chain: fn(Gradients, &Matrix3<f64>) -> Gradients,
    /// The order in which the density's second derivative is read.
    entry: fn(usize) -> usize,
    finished: fn(SMatrix<f64, 12, 12>) -> SMatrix<f64, 12, 12>,
    /// The factor of the density, from the volume, det F and the volume computed anew.
    weight: fn(f64, f64, f64) -> f64,
}

/// The computation of the course.
pub const RIGHT: Settings = Settings {
    in_q: |element| element,
    in_V: |element| element,
    row: |vertex| 3 * vertex,
    gradients: |gradients| gradients,
    F: |F| F,
    stress: |P, _| P,
    chain: |gradients, _| gradients,
    entry: |k| k,
    finished: |H| H,
    weight: |volume, _, _| volume,
};

const VERTICES: &str =
    "Positions and shape functions do not belong together: which vertices of the mesh does the element have?";
const ROWS: &str = "The wrong entries of q are read: where does a vertex's x stand?";
const F_GRADIENT: &str = "The deformation gradient is another one: what is it for a body that is not deformed, and for one that is only rotated?";
const STRESS: &str =
    "The stress is another one: force on which area, the undeformed or the deformed one, and measured in which frame?";
const CHAIN: &str = "The chain rule takes another matrix: how does F depend on the position of one vertex?";
const WEIGHT: &str = "The density is right, its weight is not: over which body is it integrated?";

fn sorted(mut element: [usize; 4]) -> [usize; 4] {
    element.sort_unstable();
    element
}

/// The mistakes.
pub const SWITCHES: &[Switch<Settings>] = &[
    (
        "local for global indices in q",
        "The first four vertices of q are taken, whatever the element. What do the entries of element count?",
        |s| {
            s.in_q = |_| [0, 1, 2, 3];
        },
    ),
    (
        "local for global indices in V",
        "The first four vertices of V are taken, whatever the element. What do the entries of element count?",
        |s| {
            s.in_V = |_| [0, 1, 2, 3];
        },
    ),
    ("sorted vertices in q", VERTICES, |s| s.in_q = sorted),
    ("sorted vertices in V", VERTICES, |s| s.in_V = sorted),
    ("sorted vertices", VERTICES, |s| {
        s.in_q = sorted;
        s.in_V = sorted;
    }),
    ("other vertex order in q", VERTICES, |s| s.in_q = |[a, b, c, d]| [b, a, c, d]),
    ("other vertex order in q", VERTICES, |s| s.in_q = |[a, b, c, d]| [d, c, b, a]),
    ("other vertex order in q", VERTICES, |s| s.in_q = |[a, b, c, d]| [b, c, d, a]),
    ("other vertex order in q", VERTICES, |s| s.in_q = |[a, b, c, d]| [d, a, b, c]),
    ("factor 3 left out in q", ROWS, |s| s.row = |vertex| vertex),
    ("off by one in q", ROWS, |s| s.row = |vertex| 3 * vertex + 1),
    ("factor 4 in q", ROWS, |s| s.row = |vertex| 4 * vertex),
    ("gradients with the wrong sign", F_GRADIENT, |s| s.gradients = |D| -D),
    ("first shape function left out", F_GRADIENT, |s| {
        s.gradients = |D| Gradients::from_fn(|i, j| if i == 0 { 0.0 } else { D[(i, j)] })
    }),
    ("last shape function left out", F_GRADIENT, |s| {
        s.gradients = |D| Gradients::from_fn(|i, j| if i == 3 { 0.0 } else { D[(i, j)] })
    }),
    ("F transposed", F_GRADIENT, |s| s.F = |F| F.transpose()),
    ("inverse of F", F_GRADIENT, |s| s.F = |F| F.try_inverse().unwrap_or_default()),
    ("displacement gradient for F", F_GRADIENT, |s| s.F = |F| F - Matrix3::identity()),
    ("identity added to F", F_GRADIENT, |s| s.F = |F| F + Matrix3::identity()),
    ("symmetric part of F", F_GRADIENT, |s| s.F = |F| (F + F.transpose()) * 0.5),
    ("FᵀF for F", F_GRADIENT, |s| s.F = |F| F.transpose() * F),
    ("F Fᵀ for F", F_GRADIENT, |s| s.F = |F| F * F.transpose()),
    ("Green's strain for F", F_GRADIENT, |s| s.F = |F| (F.transpose() * F - Matrix3::identity()) * 0.5),
    ("no deformation", F_GRADIENT, |s| s.F = |_| Matrix3::identity()),
    ("only the diagonal of F", F_GRADIENT, |s| s.F = |F| Matrix3::from_diagonal(&F.diagonal())),
    ("half of F", F_GRADIENT, |s| s.F = |F| F * 0.5),
    (
        "transposed",
        "The stress is multiplied from the wrong side. Which of its indices does the gradient of a shape function meet?",
        |s| {
            s.stress = |P, _| P.transpose();
        },
    ),
    ("Cauchy stress", STRESS, |s| s.stress = |P, F| P * F.transpose() / F.determinant()),
    ("Kirchhoff stress", STRESS, |s| s.stress = |P, F| P * F.transpose()),
    ("second Piola–Kirchhoff stress", STRESS, |s| s.stress = |P, F| F.try_inverse().unwrap_or_default() * P),
    ("F times the stress", STRESS, |s| s.stress = |P, F| F * P),
    ("symmetric part of the stress", STRESS, |s| s.stress = |P, _| (P + P.transpose()) * 0.5),
    ("only the diagonal of the stress", STRESS, |s| s.stress = |P, _| Matrix3::from_diagonal(&P.diagonal())),
    ("gradients in the deformed body", CHAIN, |s| s.chain = |D, F| D * F.try_inverse().unwrap_or_default()),
    ("gradients times F", CHAIN, |s| s.chain = |D, F| D * F),
    ("gradients times Fᵀ", CHAIN, |s| s.chain = |D, F| D * F.transpose()),
    ("gradients in another order", CHAIN, |s| s.chain = |D, _| Gradients::from_fn(|i, j| D[(3 - i, j)])),
    ("unit gradients", CHAIN, |s| s.chain = |D, _| Gradients::from_fn(|i, j| D[(i, j)] / D.row(i).norm())),
    (
        "columns for rows",
        "The chain rule's matrix flattens F another way than the derivative of the energy density does.",
        |s| {
            s.entry = |k| 3 * (k % 3) + k / 3;
            s.stress = |P, _| P.transpose();
        },
    ),
    ("projected", "The negative eigenvalues are gone. Is this function asked for the exact Hessian?", |s| {
        s.finished = |H| given::project(&H)
    }),
    (
        "absolute eigenvalues",
        "The negative eigenvalues are turned round. Is this function asked for the exact Hessian?",
        |s| {
            s.finished = |H| with_eigenvalues(&H, f64::abs);
        },
    ),
    (
        "projected and negated",
        "The sign is reversed and the negative eigenvalues are gone: is this function asked for the exact Hessian of an energy?",
        |s| {
            s.finished = |H| -given::project(&H);
        },
    ),
    ("projected after the minus", "The positive eigenvalues are gone, and no projection is asked for.", |s| {
        s.finished = |H| given::project(&-H)
    }),
    ("blocks transposed", "Each 3×3 block is transposed. Which index of a block belongs to which vertex?", |s| {
        s.finished = |H| SMatrix::<f64, 12, 12>::from_fn(|i, j| H[(i / 3 * 3 + j % 3, j / 3 * 3 + i % 3)]);
    }),
    ("missing volume", "The answer does not depend on the volume: an integral over the element is meant.", |s| {
        s.weight = |_, _, _| 1.0
    }),
    ("volume squared", WEIGHT, |s| s.weight = |volume, _, _| volume * volume),
    ("divided by the volume", WEIGHT, |s| s.weight = |volume, _, _| 1.0 / volume),
    ("deformed volume", WEIGHT, |s| s.weight = |volume, J, _| volume * J),
    ("divided by det F", WEIGHT, |s| s.weight = |volume, J, _| volume / J),
    ("computes the volume anew", WEIGHT, |s| s.weight = |_, _, own| own),
    ("volume with a sign", WEIGHT, |s| s.weight = |volume, _, own| volume * own.signum()),
];

/// The energy, gradient or Hessian with these settings.
pub fn run(s: &Settings, trial: &Trial) -> Option<Observed> {
    let Input::Elastic(Elastic { q, V, element, volume, C, D }) = &trial.input else { return None };
    let (in_q, in_V) = ((s.in_q)(*element), (s.in_V)(*element));
    let gradients = (s.gradients)(solved::dphi_linear_tetrahedron_dX(V, &in_V, &Vector3::zeros()));
    let mut F = Matrix3::zeros();
    for (i, vertex) in in_q.into_iter().enumerate() {
        let row = (s.row)(vertex);
        let x = Vector3::new(*q.get(row)?, *q.get(row + 1)?, *q.get(row + 2)?);
        F += x * gradients.row(i);
    }
    let F = (s.F)(F);
    let [a, b, c, d] = in_V.map(|vertex| V[vertex]);
    let own = (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0;
    let weight = (s.weight)(*volume, F.determinant(), own);
    let chain = (s.chain)(gradients, &F);
    Some(match trial.function {
        "V_linear_tetrahedron" => Observed::vector(vec![solved::psi_neo_hookean(&F, *C, *D) * weight]),
        "dV_linear_tetrahedron_dq" => {
            let P = Matrix3::from_row_slice(solved::dpsi_neo_hookean_dF(&F, *C, *D).as_slice());
            let P = (s.stress)(P, &F);
            let forces = SVector::<f64, 12>::from_fn(|i, _| (P * chain.row(i / 3).transpose())[i % 3] * weight);
            Observed::vector(forces.as_slice().to_vec())
        }
        _ => {
            let H = solved::d2psi_neo_hookean_dF2(&F, *C, *D);
            let H = SMatrix::<f64, 9, 9>::from_fn(|i, j| H[((s.entry)(i), (s.entry)(j))]);
            let B =
                SMatrix::<f64, 9, 12>::from_fn(
                    |row, column| {
                        if row / 3 == column % 3 { chain[(column / 3, row % 3)] } else { 0.0 }
                    },
                );
            let H = (s.finished)(B.transpose() * H * B * weight);
            Observed::matrix(12, 12, |i, j| H[(i, j)])
        }
    })
}
