//! Simpler inputs. If a function is right on one of them, the error is in the part of the input that the simplification removes.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use crate::reference::trial::{Elastic, Input, Mesh, Pick, Step};

/// Changes an input in place; false if it has no such part or has this form already.
pub type Change = fn(&mut Input) -> bool;

/// The words after "It is right", and the change.
pub const PROBES: &[(&str, Change)] = &[
    ("where C = 0", |input| constants(input).is_some_and(|(C, _)| std::mem::replace(C, 0.0) != 0.0)),
    ("where D = 0", |input| constants(input).is_some_and(|(_, D)| std::mem::replace(D, 0.0) != 0.0)),
    ("where C = D", |input| constants(input).is_some_and(|(C, D)| std::mem::replace(C, *D) != *D)),
    ("where det F = 1", |input| of_F(input, |F| F / F.determinant().cbrt())),
    ("where F is symmetric", |input| of_F(input, |F| (F.transpose() * F) / F.norm())),
    ("where F is diagonal", |input| of_F(input, |F| Matrix3::from_diagonal(&F.singular_values()))),
    ("for pure rotations", |input| of_F(input, |F| F.svd(true, true).u.unwrap_or_default())),
    ("for a body that is not deformed", at_rest),
    ("for an element of the vertices 0, 1, 2, 3 in this order", first_vertices),
    ("for elements whose vertices ascend", ascending),
    ("where the volume is 1", |input| volume(input).is_some_and(|volume| std::mem::replace(volume, 1.0) != 1.0)),
    ("where the density is 1", |input| density(input).is_some_and(|density| std::mem::replace(density, 1.0) != 1.0)),
    ("for a mesh of one element", one_element),
    ("where all elements have the same volume", same_volumes),
    ("where the first vertex is at the origin", first_at_origin),
    ("where the rest length is zero", |input| match input {
        Input::Spring { l0, .. } => std::mem::replace(l0, 0.0) != 0.0,
        _ => false,
    }),
    ("for springs that are stretched", |input| match input {
        Input::Spring { q0, q1, l0, .. } => {
            *l0 = l0.min(0.5 * (*q1 - *q0).norm());
            true
        }
        _ => false,
    }),
    ("where the stiffness is 1", |input| match input {
        Input::Spring { stiffness, .. } => std::mem::replace(stiffness, 1.0) != 1.0,
        _ => false,
    }),
    ("for a step from rest", |input| step(input, |step| step.qdot.fill(0.0))),
    ("where dt = 1", |input| step(input, |step| step.dt = 1.0)),
    ("without damping", |input| step(input, |step| step.system.damping = 0.0)),
    ("where no force acts", |input| {
        step(input, |step| {
            step.system.springs.fill(0.0);
            step.system.load.fill(0.0);
            (step.system.hardening, step.system.damping, step.system.wall) = (0.0, 0.0, 0.0);
        })
    }),
    ("where the force is constant", |input| {
        step(input, |step| {
            step.system.springs.fill(0.0);
            (step.system.hardening, step.system.damping, step.system.wall) = (0.0, 0.0, 0.0);
        })
    }),
    ("where the force is linear", |input| step(input, |step| step.system.hardening = 0.0)),
    ("where the mass matrix is the identity", |input| {
        step(input, |step| step.system.mass = DMatrix::identity(step.system.mass.nrows(), step.system.mass.nrows()))
    }),
    ("with a single step", |input| match input {
        Input::Minimum { max_steps, .. } => std::mem::replace(max_steps, 1) > 1,
        _ => false,
    }),
    ("with two steps", |input| match input {
        Input::Minimum { max_steps, .. } => std::mem::replace(max_steps, 2) > 2,
        _ => false,
    }),
    ("where the viewport begins at zero", |input| {
        pick(input, |pick| {
            pick.win -= Vector3::new(f64::from(pick.viewport[0]), f64::from(pick.viewport[1]), 0.0);
            (pick.viewport[0], pick.viewport[1]) = (0.0, 0.0);
        })
    }),
    ("where every vertex is within the radius", |input| pick(input, |pick| pick.radius *= 1e3)),
    ("where no vertex is within the radius", |input| pick(input, |pick| pick.radius *= 1e-3)),
    ("in the middle of the window", |input| {
        pick(input, |pick| {
            let view = pick.viewport.cast::<f64>();
            pick.win = Vector3::new(view[0] + 0.5 * view[2], view[1] + 0.5 * view[3], pick.win.z);
        })
    }),
    ("where indices ascend and no one repeats", |input| match input {
        Input::Fixed { indices, .. } => {
            indices.sort_unstable();
            indices.dedup();
            true
        }
        _ => false,
    }),
    ("where one vertex is fixed", |input| match input {
        Input::Fixed { indices, .. } => {
            indices.truncate(1);
            true
        }
        _ => false,
    }),
    ("where vertex 0 alone is fixed", |input| match input {
        Input::Fixed { indices, .. } => {
            *indices = vec![0];
            true
        }
        _ => false,
    }),
];

fn constants(input: &mut Input) -> Option<(&mut f64, &mut f64)> {
    match input {
        Input::Density { C, D, .. } | Input::Elastic(Elastic { C, D, .. }) | Input::Mesh(Mesh { C, D, .. }) => {
            Some((C, D))
        }
        _ => None,
    }
}

fn of_F(input: &mut Input, change: impl Fn(&Matrix3<f64>) -> Matrix3<f64>) -> bool {
    let Input::Density { F, .. } = input else { return false };
    *F = change(F);
    F.determinant() > 0.0
}

fn volume(input: &mut Input) -> Option<&mut f64> {
    match input {
        Input::Kinetic { volume, .. } | Input::Quadrature { volume, .. } | Input::ElementMass { volume, .. } => {
            Some(volume)
        }
        Input::Elastic(of) => Some(&mut of.volume),
        _ => None,
    }
}

fn density(input: &mut Input) -> Option<&mut f64> {
    match input {
        Input::Kinetic { density, .. } | Input::ElementMass { density, .. } | Input::MeshMass { density, .. } => {
            Some(density)
        }
        _ => None,
    }
}

fn at_rest(input: &mut Input) -> bool {
    match input {
        Input::Density { F, .. } => *F = Matrix3::identity(),
        Input::Elastic(Elastic { q, V, .. }) | Input::Mesh(Mesh { q, V, .. }) => {
            *q = DVector::from_fn(q.len(), |i, _| V[i / 3][i % 3]);
        }
        _ => return false,
    }
    true
}

fn of_element(input: &mut Input) -> Option<&mut [usize; 4]> {
    match input {
        Input::Shape { element, .. } | Input::Kinetic { element, .. } | Input::Quadrature { element, .. } => {
            Some(element)
        }
        Input::Elastic(of) => Some(&mut of.element),
        _ => None,
    }
}

/// Brings the element's vertices to the front of all lists.
fn first_vertices(input: &mut Input) -> bool {
    let Some(element) = of_element(input) else { return false };
    let old = std::mem::replace(element, [0, 1, 2, 3]);
    match input {
        Input::Shape { V, .. } | Input::Quadrature { V, .. } => *V = old.map(|vertex| V[vertex]).to_vec(),
        Input::Kinetic { qdot, .. } => *qdot = DVector::from_fn(12, |i, _| qdot[3 * old[i / 3] + i % 3]),
        Input::Elastic(Elastic { q, V, .. }) => {
            *q = DVector::from_fn(12, |i, _| q[3 * old[i / 3] + i % 3]);
            *V = old.map(|vertex| V[vertex]).to_vec();
        }
        _ => {}
    }
    true
}

fn ascending(input: &mut Input) -> bool {
    if let Some(element) = of_element(input) {
        element.sort_unstable();
        return true;
    }
    match input {
        Input::MeshMass { T, .. } | Input::Mesh(Mesh { T, .. }) => T.iter_mut().for_each(|t| t.sort_unstable()),
        _ => return false,
    }
    true
}

fn one_element(input: &mut Input) -> bool {
    match input {
        Input::MeshMass { T, v0, .. } | Input::Mesh(Mesh { T, v0, .. }) => {
            T.truncate(1);
            v0.truncate(1);
        }
        Input::Skinning { T, .. } => T.truncate(1),
        _ => return false,
    }
    true
}

fn same_volumes(input: &mut Input) -> bool {
    match input {
        Input::MeshMass { v0, .. } | Input::Mesh(Mesh { v0, .. }) => {
            let first = v0[0];
            v0.fill(first);
        }
        _ => return false,
    }
    true
}

fn first_at_origin(input: &mut Input) -> bool {
    let Some(&mut [first, ..]) = of_element(input) else { return false };
    match input {
        Input::Shape { V, x, .. } => {
            let origin = V[first];
            V.iter_mut().for_each(|X| *X -= origin);
            *x -= origin;
        }
        _ => return false,
    }
    true
}

fn step(input: &mut Input, change: impl Fn(&mut Step)) -> bool {
    let Input::Step(step) = input else { return false };
    change(step);
    true
}

fn pick(input: &mut Input, change: impl Fn(&mut Pick)) -> bool {
    let Input::Pick(pick) = input else { return false };
    change(pick);
    true
}
