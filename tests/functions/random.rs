//! Random inputs. They shrink towards the plain ones: no rotation, no stretch, no offset.

use std::ops::Range;

use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

use crate::meshes::Tetrahedron;

pub fn vector(range: Range<f64>) -> impl Strategy<Value = Vector3<f64>> {
    [range.clone(), range.clone(), range].prop_map(Vector3::from)
}

pub fn rotation() -> impl Strategy<Value = Matrix3<f64>> {
    vector(-3.0..3.0).prop_map(|axis_angle| Rotation3::from_scaled_axis(axis_angle).into_inner())
}

/// Three principal stretches; their product, the change of volume, is between 0.05 and 20.
pub fn stretches() -> impl Strategy<Value = Vector3<f64>> {
    vector(-1.0..1.0).prop_map(|logarithms| logarithms.map(f64::exp))
}

/// Deformation gradients without any symmetry.
pub fn deformation() -> impl Strategy<Value = Matrix3<f64>> {
    (rotation(), stretches(), rotation()).prop_map(|(U, sigma, W)| U * Matrix3::from_diagonal(&sigma) * W.transpose())
}

/// C and D, Pa, of similar and of different size.
pub fn constants() -> impl Strategy<Value = (f64, f64)> {
    (4.0..6.0, 4.0..6.0).prop_map(|(C, D)| (10f64.powf(C), 10f64.powf(D)))
}

/// Elements of any shape, size, place and orientation, with any indices.
pub fn tetrahedron() -> impl Strategy<Value = Tetrahedron> {
    let slots = Just((0..9).collect::<Vec<usize>>()).prop_shuffle();
    (deformation(), vector(-3.0..3.0), -2.0..2.0, slots).prop_map(|(shape, offset, size, slots)| {
        let element = [slots[0], slots[1], slots[2], slots[3]];
        Tetrahedron::new(element, &(shape * 10f64.powf(size)), &(offset * 10f64.powf(size)))
    })
}

/// An element and positions of its vertices: a deformation gradient and a translation of some elements' length.
pub fn deformed_tetrahedron() -> impl Strategy<Value = (Tetrahedron, Matrix3<f64>, Vector3<f64>)> {
    (tetrahedron(), deformation(), vector(-3.0..3.0)).prop_map(|(tetrahedron, F, shift)| {
        let size = tetrahedron.size();
        (tetrahedron, F, shift * size)
    })
}
