//! Lanes: as many floats as a register of 256 bits holds, one for each element of a batch.
//!
//! Lanes live in the processor's register type, but each operation is written on an array, float by float. The compiler sees that the
//! four or eight operations are one, and chooses the instruction that the kernel around them may use: AVX inside
//! [`vectorized`](super::vectorized), pairs of SSE2 registers outside. So one source serves all instruction sets, without `unsafe`
//! and without a flag. Lanes that live in an array are taken apart instead, and found again in small kernels only.

mod transpose;

use std::array::from_fn;
use std::ops::{Add, AddAssign, BitAnd, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use pulp::bytemuck::{cast, cast_mut, cast_ref};

use super::arithmetic::{Float, Lanes, Number};

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::{__m256 as RegisterF32, __m256d as RegisterF64};
#[cfg(not(target_arch = "x86_64"))]
use wide::{f32x8 as RegisterF32, f64x4 as RegisterF64};

/// A truth value in each lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mask<const W: usize>([bool; W]);

impl<const W: usize> BitAnd for Mask<W> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(from_fn(
            #[inline(always)]
            |lane| self.0[lane] & other.0[lane],
        ))
    }
}

/// Defines lanes of a float, with their register type and their number.
macro_rules! lanes {
    ($(#[$doc:meta])* $Lanes:ident, $float:ident, $Register:ident, $width:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        pub struct $Lanes(pub(super) $Register);

        impl $Lanes {
            /// Lanes with the value of each lane number.
            #[inline(always)]
            pub fn from_lanes(value: impl FnMut(usize) -> $float) -> Self {
                Self::new(from_fn(value))
            }

            #[inline(always)]
            pub(super) fn new(numbers: [$float; $width]) -> Self {
                Self(cast(numbers))
            }

            /// The number in each lane.
            #[inline(always)]
            pub(super) fn numbers(self) -> [$float; $width] {
                cast(self.0)
            }

            /// The numbers in memory.
            #[inline(always)]
            pub(super) fn as_array(&self) -> &[$float; $width] {
                cast_ref(&self.0)
            }

            #[inline(always)]
            pub(super) fn as_array_mut(&mut self) -> &mut [$float; $width] {
                cast_mut(&mut self.0)
            }

            #[inline(always)]
            fn zip(self, other: Self, value: impl Fn($float, $float) -> $float) -> Self {
                let (a, b) = (self.numbers(), other.numbers());
                Self::new(from_fn(
                    #[inline(always)]
                    |lane| value(a[lane], b[lane]),
                ))
            }

            #[inline(always)]
            fn map(self, value: impl Fn($float) -> $float) -> Self {
                let a = self.numbers();
                Self::new(from_fn(
                    #[inline(always)]
                    |lane| value(a[lane]),
                ))
            }

            #[inline(always)]
            fn compare(self, other: Self, is_true: impl Fn($float, $float) -> bool) -> Mask<$width> {
                let (a, b) = (self.numbers(), other.numbers());
                Mask(from_fn(
                    #[inline(always)]
                    |lane| is_true(a[lane], b[lane]),
                ))
            }
        }

        impl Number for $Lanes {
            type Element = $float;
            type Mask = Mask<$width>;

            #[inline(always)]
            fn splat(x: $float) -> Self {
                Self::new([x; $width])
            }

            const LANES: usize = $width;

            #[inline(always)]
            fn lane(&self, lane: usize) -> $float {
                self.as_array()[lane]
            }

            #[inline(always)]
            fn set_lane(&mut self, lane: usize, x: $float) {
                self.as_array_mut()[lane] = x;
            }

            #[inline(always)]
            fn rough_inverse_cube_root(self) -> Self {
                self.map(#[inline(always)] |a| Float::rough_inverse_cube_root(a))
            }

            #[inline(always)]
            fn map_lanes(self, value: impl Fn($float) -> $float) -> Self {
                self.map(value)
            }

            #[inline(always)]
            fn select(self, mask: Mask<$width>, other: Self) -> Self {
                let (a, b) = (self.numbers(), other.numbers());
                Self::new(from_fn(
                    #[inline(always)]
                    |lane| if mask.0[lane] { a[lane] } else { b[lane] },
                ))
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                self.map(#[inline(always)] |a| a.sqrt())
            }

            #[inline(always)]
            fn abs(self) -> Self {
                self.map(#[inline(always)] |a| a.abs())
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                self.zip(sign, #[inline(always)] |a, b| a.copysign(b))
            }

            #[inline(always)]
            fn gt(self, other: Self) -> Mask<$width> {
                self.compare(other, #[inline(always)] |a, b| a > b)
            }

            #[inline(always)]
            fn ge(self, other: Self) -> Mask<$width> {
                self.compare(other, #[inline(always)] |a, b| a >= b)
            }

            #[inline(always)]
            fn eq(self, other: Self) -> Mask<$width> {
                self.compare(other, #[inline(always)] |a, b| a == b)
            }

            #[inline(always)]
            fn all(mask: Mask<$width>) -> bool {
                mask.0 == [true; $width]
            }
        }

        impl Lanes for $Lanes {
            #[inline(always)]
            fn load(self, stored: &Self, _part: usize) -> Self {
                *stored
            }

            #[inline(always)]
            fn store(self, stored: &mut Self, _part: usize) {
                *stored = self;
            }

            #[inline(always)]
            fn as_slice(&self) -> &[$float] {
                self.as_array()
            }

            #[inline(always)]
            fn as_mut_slice(&mut self) -> &mut [$float] {
                self.as_array_mut()
            }

            #[inline(always)]
            fn gather(self, vectors: &[[$float; 3]], node: impl Fn(usize) -> u32) -> [Self; 3] {
                let mut lanes = [[0.0; $width]; 3];
                for lane in 0..$width {
                    let vector = vectors[node(lane) as usize];
                    for i in 0..3 {
                        lanes[i][lane] = vector[i];
                    }
                }
                lanes.map(Self::new)
            }

            #[inline(always)]
            fn add_vectors_by_lane(lanes: &[Self; 3], sums: &mut [[$float; 3]], target: impl Fn(usize) -> u32) {
                for lane in 0..$width {
                    let Some(sum) = sums.get_mut(target(lane) as usize) else { continue };
                    for i in 0..3 {
                        sum[i] += lanes[i].as_array()[lane];
                    }
                }
            }

            #[inline(always)]
            fn add_by_lane(
                lanes: &[[Self; 3]; 3],
                blocks: &mut [[[$float; 3]; 3]],
                target: impl Fn(usize) -> u32,
            ) {
                let (full, rest) = lanes.as_flattened().as_chunks::<$width>();
                let mut rows = [[Self::zero(); $width]; 2];
                for (rows, lanes) in rows.iter_mut().zip(full) {
                    *rows = Self::transpose(*lanes);
                }
                for lane in 0..$width {
                    let Some(block) = blocks.get_mut(target(lane) as usize) else { continue };
                    let (sums, last) = block.as_flattened_mut().as_chunks_mut::<$width>();
                    for (sums, rows) in sums.iter_mut().zip(&rows) {
                        *sums = (Self::new(*sums) + rows[lane]).numbers();
                    }
                    for (sum, lanes) in last.iter_mut().zip(rest) {
                        *sum += lanes.as_array()[lane];
                    }
                }
            }

        }

        operators!($Lanes, Add::add +, AddAssign::add_assign);
        operators!($Lanes, Sub::sub -, SubAssign::sub_assign);
        operators!($Lanes, Mul::mul *, MulAssign::mul_assign);
        operators!($Lanes, Div::div /, DivAssign::div_assign);

        impl Neg for $Lanes {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                self.map(#[inline(always)] |a| -a)
            }
        }
    };
}

macro_rules! operators {
    ($Lanes:ident, $Operator:ident::$operate:ident $symbol:tt, $Assign:ident::$assign:ident) => {
        impl $Operator for $Lanes {
            type Output = Self;

            #[inline(always)]
            fn $operate(self, other: Self) -> Self {
                self.zip(other, #[inline(always)] |a, b| a $symbol b)
            }
        }

        impl $Assign for $Lanes {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                *self = *self $symbol other;
            }
        }
    };
}

lanes!(
    /// Four double-precision lanes.
    F64x4, f64, RegisterF64, 4
);
lanes!(
    /// Eight single-precision lanes.
    F32x8, f32, RegisterF32, 8
);
