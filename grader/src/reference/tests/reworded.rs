//! Functions with other formulations than those of the reference.

use grader_child::Functions;
use nalgebra::{Matrix3, SVector, Vector4};

use crate::reference::REFERENCE;

/// Right functions in other formulations, so with other round-off.
pub const REWORDED: Functions = Functions {
    phi_linear_tetrahedron: |V, e, x| {
        let T = Matrix3::from_columns(&[V[e[1]] - V[e[0]], V[e[2]] - V[e[0]], V[e[3]] - V[e[0]]]);
        let phi = T.try_inverse().unwrap_or_default() * (x - V[e[0]]);
        Vector4::new(1.0 - phi.sum(), phi.x, phi.y, phi.z)
    },
    psi_neo_hookean: |F, C, D| match F.determinant() {
        J if J > 0.0 => C * (J.powf(-2.0 / 3.0) * (F.transpose() * F).trace() - 3.0) + D * (J - 1.0).powi(2),
        _ => f64::INFINITY,
    },
    dpsi_neo_hookean_dF: |F, C, D| {
        let (J, F_inverse) = (F.determinant(), F.try_inverse().unwrap_or_default());
        let shape = F * 2.0 - F_inverse.transpose() * (2.0 / 3.0 * F.norm_squared());
        let P = shape * (C * J.powf(-2.0 / 3.0)) + F_inverse.transpose() * (2.0 * D * (J - 1.0) * J);
        SVector::from_fn(|k, _| P[(k / 3, k % 3)])
    },
    newtons_method: |x, f, g, H, solve, most| {
        let at_start = g(x).norm();
        for _ in 0..most {
            let gradient = g(x);
            if gradient.norm() <= 1e-10 * at_start {
                break;
            }
            let d = -solve(&H(x), &gradient);
            let alphas = (0..27).map(|k| 0.5f64.powi(k));
            let enough = |alpha: &f64| {
                let value = f(&(&d * *alpha + &*x));
                value.is_finite() && value - f(x) <= 1e-8 * alpha * d.dot(&gradient)
            };
            let Some(alpha) = alphas.into_iter().find(enough) else { break };
            *x += d * alpha;
        }
        f(x)
    },
    implicit_euler: |q, v, dt, M, energy, force, stiffness, solve| {
        let old = v.clone();
        // The whole minimisation in units of momentum over time.
        (REWORDED.newtons_method)(
            v,
            &|v| energy(v) / dt,
            &|v| M * (v - &old) / dt - force(&(&*q + v * dt), v),
            &|v| M * (1.0 / dt) - stiffness(&(&*q + v * dt), v) * dt,
            &|A, b| solve(A, b),
            5,
        );
        *q += &*v * dt;
    },
    linearly_implicit_euler: |q, v, dt, M, force, stiffness, solve| {
        let K = stiffness(q, v);
        let change = solve(&(M * (1.0 / dt) - &K * dt), &(force(q, v) + &K * &*v * dt));
        *v += change;
        *q += &*v * dt;
    },
    ..REFERENCE
};
