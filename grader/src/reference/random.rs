//! Random numbers from a seed, and the inputs made of them: deformations, constants, sizes.

use std::ops::Range;

use grader_child::Exercise;
use nalgebra::{DVector, Matrix3, Rotation3, Vector3};
use rand::rngs::ChaCha8Rng;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};

/// The inputs of one function. ChaCha with eight rounds (D. J. Bernstein, ChaCha, a variant of Salsa20, 2008): the same seed
/// gives the same inputs on every machine, and each function has a stream of its own.
pub struct Random(ChaCha8Rng);

impl Random {
    /// Starts the stream of a function.
    pub fn new(seed: u64, function: Exercise) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(function as u64);
        Self(generator)
    }

    /// Uniform in a range; its start if it is empty.
    pub fn number(&mut self, range: Range<f64>) -> f64 {
        range.start + (range.end - range.start) * self.0.random::<f64>()
    }

    /// One of 0 … n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        self.0.random_range(0..n.max(1))
    }

    /// Three numbers of a range.
    pub fn vector(&mut self, range: Range<f64>) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.number(range.clone()))
    }

    /// Many numbers of a range.
    pub fn numbers(&mut self, n: usize, range: Range<f64>) -> DVector<f64> {
        DVector::from_fn(n, |_, _| self.number(range.clone()))
    }

    /// 0 … n − 1 in any order.
    pub fn order(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        order.shuffle(&mut self.0);
        order
    }

    /// Four different ones of 0 … n − 1.
    pub fn four_of(&mut self, n: usize) -> [usize; 4] {
        let order = self.order(n);
        [order[0], order[1], order[2], order[3]]
    }

    /// Any rotation.
    pub fn rotation(&mut self) -> Matrix3<f64> {
        Rotation3::from_scaled_axis(self.vector(-3.0..3.0)).into_inner()
    }

    /// A matrix without any symmetry; its determinant is between 0.05 and 20.
    pub fn deformation(&mut self) -> Matrix3<f64> {
        let stretches = self.vector(-1.0..1.0).map(f64::exp);
        self.rotation() * Matrix3::from_diagonal(&stretches) * self.rotation()
    }

    /// A deformation gradient; the first few calls with `index` 0, 1, … are the extreme ones.
    pub fn deformation_of(&mut self, index: usize) -> (&'static str, Matrix3<f64>) {
        match index {
            0 => ("undeformed", Matrix3::identity()),
            1 => ("rotated only", self.rotation()),
            2 => ("compressed twentyfold", self.rotation() * 0.05f64.cbrt()),
            3 => ("stretched twentyfold", self.rotation() * 20f64.cbrt()),
            4 => ("almost undeformed", Matrix3::identity() + Matrix3::from_fn(|_, _| self.number(-1e-5..1e-5))),
            _ => ("deformed at random", self.deformation()),
        }
    }

    /// A length, 1 cm to 100 m.
    pub fn size(&mut self) -> f64 {
        10f64.powf(self.number(-2.0..2.0))
    }

    /// C and D, Pa, of similar and of different size.
    pub fn constants(&mut self) -> (f64, f64) {
        (10f64.powf(self.number(4.0..6.0)), 10f64.powf(self.number(4.0..6.0)))
    }
}
