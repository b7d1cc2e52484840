//! Random inputs. They shrink towards the plain ones: no rotation, no stretch, no offset.

use std::ops::Range;

use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngSeed, TestRunner};

use super::meshes::Tetrahedron;
use super::outcome::{Mistake, Outcome};

const CASES: usize = 100;
const FEW_CASES: usize = 20;
const SHRINKING_STEPS: usize = 100;

/// Checks a property for random inputs. After a wrong answer, a simpler input that also fails is searched for and shown.
///
/// # Errors
/// The mistake, with the input.
pub fn for_all<S: Strategy>(seed: u64, inputs: S, property: impl Fn(S::Value) -> Outcome) -> Outcome {
    for_cases(CASES, seed, &inputs, &property)
}

/// The same with fewer inputs, for properties that make many calls for each.
///
/// # Errors
/// The mistake, with the input.
pub fn for_some<S: Strategy>(seed: u64, inputs: S, property: impl Fn(S::Value) -> Outcome) -> Outcome {
    for_cases(FEW_CASES, seed, &inputs, &property)
}

fn for_cases<S: Strategy>(cases: usize, seed: u64, inputs: &S, property: &impl Fn(S::Value) -> Outcome) -> Outcome {
    let config = Config { rng_seed: RngSeed::Fixed(seed), failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new(config);
    for _ in 0..cases {
        // Only strategies that filter can fail to generate a value, and these do not filter.
        let Ok(tree) = inputs.new_tree(&mut runner) else { continue };
        match property(tree.current()) {
            Err(Mistake::Wrong { rule, figures, .. }) => return Err(simplest(tree, rule, figures, seed, property)),
            // Inputs that make a program panic or end are not shrunk.
            other => other?,
        }
    }
    Ok(())
}

/// The mistake with the simplest input that is found to cause one.
fn simplest<T: ValueTree>(
    mut tree: T,
    mut rule: String,
    mut figures: String,
    seed: u64,
    property: &impl Fn(T::Value) -> Outcome,
) -> Mistake {
    let mut input = tree.current();
    let mut goes_on = tree.simplify();
    for _ in 0..SHRINKING_STEPS {
        if !goes_on {
            break;
        }
        goes_on = match property(tree.current()) {
            Err(Mistake::Wrong { rule: broken, figures: now, .. }) => {
                (rule, figures, input) = (broken, now, tree.current());
                tree.simplify()
            }
            _ => tree.complicate(),
        };
    }
    Mistake::Wrong { rule, figures, counterexample: format!("{input:?} (random inputs from seed {seed})") }
}

/// Vectors with entries of this range.
pub fn vector(range: Range<f64>) -> impl Strategy<Value = Vector3<f64>> {
    [range.clone(), range.clone(), range].prop_map(Vector3::from)
}

/// Rotations about any axis.
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
