//! Inputs that lack a part or have another one in its place.

use nalgebra::Vector3;

use super::with_element;
use crate::reference::trial::{Elastic, Input, Mesh};

/// About velocities and coordinates that have no effect.
pub const LEFT_OUT: &str = "A part of the input has no effect: over which vertices and coordinates does the sum run?";

/// Another element, whose vertices are these.
fn shifted(input: &Input, shift: impl Fn(usize, usize) -> usize) -> Option<Input> {
    let vertices = match input {
        Input::Shape { V, .. } | Input::Quadrature { V, .. } => V.len(),
        Input::Kinetic { qdot, .. } => qdot.len() / 3,
        Input::Elastic(of) => of.V.len(),
        _ => return None,
    };
    with_element(input, |element| element.map(|vertex| shift(vertex, vertices)))
}

/// The vertices behind those of the element.
pub fn off_by_one(input: &Input) -> Option<Input> {
    shifted(input, |vertex, n| (vertex + 1) % n)
}

/// The vertices before those of the element.
pub fn one_less(input: &Input) -> Option<Input> {
    shifted(input, |vertex, n| (vertex + n - 1) % n)
}

/// The element with some of its twelve velocities zero.
pub fn still(input: &Input, is_still: impl Fn(usize) -> bool) -> Option<Input> {
    let mut input = input.clone();
    let Input::Kinetic { qdot, element, .. } = &mut input else { return None };
    (0..12).filter(|&k| is_still(k)).for_each(|k| qdot[3 * element[k / 3] + k % 3] = 0.0);
    Some(input)
}

/// Velocities or ends of a spring with factors on x, y, z.
pub fn flattened(input: &Input, factors: [f64; 3]) -> Option<Input> {
    let mut input = input.clone();
    match &mut input {
        Input::Kinetic { qdot, .. } => qdot.iter_mut().enumerate().for_each(|(i, v)| *v *= factors[i % 3]),
        Input::Spring { q0, q1, .. } => {
            q0.component_mul_assign(&Vector3::from(factors));
            q1.component_mul_assign(&Vector3::from(factors));
        }
        _ => return None,
    }
    Some(input)
}

/// Other constants of the material.
pub fn of_constants(input: &Input, change: impl Fn(&mut f64, &mut f64)) -> Option<Input> {
    let mut input = input.clone();
    match &mut input {
        Input::Density { C, D, .. } | Input::Elastic(Elastic { C, D, .. }) | Input::Mesh(Mesh { C, D, .. }) => {
            change(C, D);
        }
        _ => return None,
    }
    Some(input)
}
