//! A block under uniaxial tension or compression, known in closed form.

use fem_mesh::{Pattern, box_mesh};
use fem_model::Integrator;

use super::setting::{Setting, displacements};
use crate::scenes::{simulation, step};

/// Stretches of a cube of side 1 m with free sides under a dead load (Pa, positive in tension): along the load and across it.
///
/// # Errors
/// A load step that does not converge.
pub fn computed(setting: &Setting, load: f64) -> Result<[f64; 2], String> {
    let mesh = box_mesh([1.0, 1.0, 1.0], 2, Pattern::Kuhn).map_err(|error| error.to_string())?;
    let mut text = Setting { integrator: Integrator::Static, ..setting.clone() }.text();
    for axis in ["x", "y", "z"] {
        text += &format!(
            "[[prescribed]]\non = {{ axis = \"{axis}\", side = \"min\", within = 1e-9 }}\ndisplacement = [0, 0, 0]\ncomponents = [\"{axis}\"]\n"
        );
    }
    text += &format!(
        "[[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\nforce_per_area = [{load:e}, 0, 0]\n"
    );
    let mut simulation = simulation(&text, mesh.clone())?;
    step(&mut *simulation)?;
    let u = displacements(&*simulation);
    let corner = mesh.vertices.iter().position(|x| x.iter().all(|&x| x == 1.0)).ok_or("the cube lacks its corner")?;
    Ok([1.0 + u[corner].x, 1.0 + u[corner].y])
}

/// The same in closed form. Linear and corotated: ε = P/E and −ν P/E, since the stretches of the corotated law are the eigenvalues of S in
/// P = 2μ (S − 1) + λ tr(S − 1). Neo-Hookean: the stretches at which the stress of ψ = C (J^(−2/3) I₁ − 3) + D (J − 1)² is P along the
/// load and zero across it, by Newton's method on two equations.
pub fn closed_form(setting: &Setting, load: f64) -> [f64; 2] {
    let Setting { law, young, poisson, .. } = *setting;
    let strain = load / young;
    let small = [1.0 + strain, 1.0 - poisson * strain];
    if law != "neo_hookean" {
        return small;
    }
    let mu = young / (2.0 * (1.0 + poisson));
    let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let (c, d) = (0.5 * mu, 0.5 * lambda + mu / 3.0);
    let residual = |[a, b]: [f64; 2]| {
        let (J, squares) = (a * b * b, a * a + 2.0 * b * b);
        let stress =
            |s: f64| c * J.powf(-2.0 / 3.0) * (2.0 * s - 2.0 / 3.0 * squares / s) + 2.0 * d * (J - 1.0) * J / s;
        [stress(a) - load, stress(b)]
    };
    let mut stretches = small;
    for _ in 0..50 {
        let r = residual(stretches);
        let h = 1e-7;
        let [p, q] = [0, 1].map(|k| {
            let moved =
                |sign: f64| residual(std::array::from_fn(|i| stretches[i] + if i == k { sign * h } else { 0.0 }));
            let (plus, minus) = (moved(1.0), moved(-1.0));
            [0, 1].map(|i| (plus[i] - minus[i]) / (2.0 * h))
        });
        let determinant = p[0] * q[1] - p[1] * q[0];
        stretches[0] -= (r[0] * q[1] - r[1] * q[0]) / determinant;
        stretches[1] -= (p[0] * r[1] - p[1] * r[0]) / determinant;
    }
    stretches
}
