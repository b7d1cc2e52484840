//! Random numbers from a seed, and what the trials are made of: deformations, constants, sizes.

use std::ops::Range;

use nalgebra::{DVector, Matrix3, Rotation3, Vector3};

/// A small generator (SplitMix64): the same seed and name give the same trials on every machine.
pub struct Random(u64);

impl Random {
    /// Starts from a seed and a name, so that functions do not share their inputs.
    pub fn new(seed: u64, name: &str) -> Self {
        let mut random = Self(seed);
        for byte in name.bytes() {
            random.0 = random.bits() ^ u64::from(byte);
        }
        random
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in a range.
    pub fn number(&mut self, range: Range<f64>) -> f64 {
        let unit = (self.bits() >> 11) as f64 / (1u64 << 53) as f64;
        range.start + (range.end - range.start) * unit
    }

    /// One of 0 … n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n.max(1) as u64) as usize
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
        for i in (1..n).rev() {
            order.swap(i, self.below(i + 1));
        }
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
