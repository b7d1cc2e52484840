//! The numbers that kernels compute with, [`Number`] and [`Lanes`] of them, and the floats of a simulation, [`Float`].

use std::fmt::Debug;
use std::ops::{Add, AddAssign, BitAnd, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use nalgebra::RealField;
use pulp::WithSimd;

use super::Packed;

/// The type that a kernel computes with: one [`Float`], or lanes of them. A branch is written as a [`select`](Self::select) between two
/// values, so that lanes never part.
pub trait Number:
    Copy
    + Debug
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// The number in a lane.
    type Element: Float;
    /// A truth value in each lane.
    type Mask: Copy + BitAnd<Output = Self::Mask>;

    /// Number of lanes.
    const LANES: usize;

    /// Runs work with the instructions that these lanes are made for. Functions that it calls must be inlined into it.
    ///
    /// Work is a type of its own, not a closure: only its `with_simd`, marked `inline(always)`, is sure to become one with the kernel.
    #[inline(always)]
    fn vectorize<W: WithSimd>(work: W) -> W::Output {
        work.with_simd(pulp::Scalar::new())
    }

    /// The same, compiled once more for processors that have more registers of this kind: for kernels in which that matters.
    #[inline(always)]
    fn vectorize_widest<W: WithSimd>(work: W) -> W::Output {
        Self::vectorize(work)
    }

    /// The same number in every lane.
    fn splat(x: Self::Element) -> Self;

    /// x^(−1/3) to a few percent, for normal x > 0: divides the exponent by three in the binary representation.
    fn rough_inverse_cube_root(self) -> Self;

    /// The number in a lane.
    fn lane(&self, lane: usize) -> Self::Element;

    /// Replaces the number in a lane.
    fn set_lane(&mut self, lane: usize, x: Self::Element);

    /// The function of the number in each lane.
    fn map_lanes(self, value: impl Fn(Self::Element) -> Self::Element) -> Self;

    /// The integer k for which x/2^k lies in [√½, √2), and x/2^k, for normal x > 0.
    #[inline(always)]
    fn exponent_and_significand(self) -> (Self, Self) {
        let exponent = self.map_lanes(
            #[inline(always)]
            |x| x.binary_exponent(),
        );
        let significand = self.map_lanes(
            #[inline(always)]
            |x| x.significand(),
        );
        (exponent, significand)
    }

    /// This number in lanes where the mask is true, else the other.
    fn select(self, mask: Self::Mask, other: Self) -> Self;

    /// x y + z, in one instruction where the processor has it.
    #[inline(always)]
    fn times_plus(self, y: Self, z: Self) -> Self {
        self * y + z
    }

    /// √x
    fn sqrt(self) -> Self;

    /// |x|
    fn abs(self) -> Self;

    /// |x| with the sign of another number.
    fn copysign(self, sign: Self) -> Self;

    /// x > y
    fn gt(self, other: Self) -> Self::Mask;

    /// x ≥ y
    fn ge(self, other: Self) -> Self::Mask;

    /// x = y
    fn eq(self, other: Self) -> Self::Mask;

    /// Returns true if a mask is true in every lane.
    fn all(mask: Self::Mask) -> bool;

    /// x ≤ y
    #[inline(always)]
    fn le(self, other: Self) -> Self::Mask {
        other.ge(self)
    }

    /// x < y
    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        other.gt(self)
    }

    /// The larger of two numbers; the other one if this is NaN.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.select(self.gt(other), other)
    }

    /// The smaller of two numbers; the other one if this is NaN.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.select(self.lt(other), other)
    }

    /// 0
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(Self::Element::default())
    }

    /// 1
    #[inline(always)]
    fn one() -> Self {
        Self::splat(Self::Element::of(1.0))
    }
}

/// Numbers of as many elements as a register holds, or of one element where kernels are run without registers of their own.
pub trait Lanes: Number {
    /// Number of parts in which a stored batch is computed: one, or one for each of its elements.
    const PARTS: usize = <Self::Element as Float>::WIDTH / Self::LANES;

    /// Lanes of this kind from a part of those that are stored.
    fn load(self, stored: &<Self::Element as Float>::Lanes, part: usize) -> Self;

    /// Replaces a part of the lanes that are stored.
    fn store(self, stored: &mut <Self::Element as Float>::Lanes, part: usize);

    /// The numbers of all lanes.
    fn as_slice(&self) -> &[Self::Element];

    /// The numbers of all lanes, mutable.
    fn as_mut_slice(&mut self) -> &mut [Self::Element];

    /// The vector of the node `node(lane)` in each lane: its three components.
    fn gather(self, vectors: &[[Self::Element; 3]], node: impl Fn(usize) -> u32) -> [Self; 3];

    /// Adds the vector in each lane to that of the node `target(lane)`, unless it is out of range.
    fn add_vectors_by_lane(lanes: &[Self; 3], sums: &mut [[Self::Element; 3]], target: impl Fn(usize) -> u32);

    /// Adds each lane of a block to the block `target(lane)`, unless that is out of range. Lanes are transposed in registers,
    /// not number by number: extracting numbers from lanes takes much of the time of an assembly.
    fn add_by_lane(lanes: &[[Self; 3]; 3], blocks: &mut [[[Self::Element; 3]; 3]], target: impl Fn(usize) -> u32);
}

/// A float of a simulation.
pub trait Float: RealField + Packed + Default + std::iter::Sum {
    /// As many of them as a register of 256 bits holds, on any processor: the form in which lanes are stored.
    type Lanes: Lanes<Element = Self>;
    /// The same where kernels are [run with](Self::has_fast) wide registers.
    type Fast: Lanes<Element = Self>;
    /// The number itself, for kernels where they are not: one element after the other.
    type Single: Lanes<Element = Self>;
    /// Number of lanes in [`Lanes`](Self::Lanes).
    const WIDTH: usize;
    /// Number of lanes in the widest register of any processor, to which dense columns are padded.
    const MAX_WIDTH: usize;
    /// Relative distance from 1 to the next number.
    const EPSILON: Self;
    /// The least integer k for which 2^k is infinite.
    const MAX_EXPONENT: i32;

    /// Lanes with the value of each lane number.
    fn lanes(value: impl FnMut(usize) -> Self) -> Self::Lanes;

    /// The numbers of all lanes.
    fn each(lanes: &Self::Lanes) -> &[Self];

    /// The numbers of all lanes, mutable.
    fn each_mut(lanes: &mut Self::Lanes) -> &mut [Self];

    /// Returns true if kernels are run with the instructions of [`Fast`](Self::Fast).
    fn has_fast() -> bool;

    /// The nearest number of this type.
    fn of(x: f64) -> Self;

    /// The same number, exactly.
    fn as_f64(self) -> f64;

    /// x^(−1/3) to a few percent, for normal x > 0: divides the exponent by three in the binary representation.
    fn rough_inverse_cube_root(self) -> Self;

    /// The integer k for which x/2^k lies in [√½, √2), for normal x > 0.
    fn binary_exponent(self) -> Self;

    /// x/2^k in [√½, √2), with k the [`binary_exponent`](Self::binary_exponent).
    fn significand(self) -> Self;

    /// 2^k for an integer k; zero in place of subnormal numbers, and 1 for NaN.
    fn power_of_two(self) -> Self;
}

/// The bits of x^(−1/3) are about these minus a third of those of x. In single precision shifts and additions find the third:
/// (¼ + 1/16) (1 + 1/16) (1 + 1/256) …; in double precision the upper half of the bits times [`THIRD`].
pub(super) const CUBE_ROOT_F64: u64 = 0x553e_f0ff_289d_d796;
pub(super) const CUBE_ROOT_F32: u32 = 0x54a2_fa8c;

/// 2³²/3
pub(super) const THIRD: u64 = 0x5555_5555;
