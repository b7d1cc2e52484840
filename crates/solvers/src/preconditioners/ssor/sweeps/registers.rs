//! Registers of four numbers, and of the eight of a pair, for kernels that the compiler does not vectorise: a row has three
//! numbers.

#[cfg(target_arch = "x86_64")]
use pulp::NullaryFnOnce;
use wide::f32x4;

use super::super::super::coarse::Row;
use super::super::Pair;
#[cfg(target_arch = "x86_64")]
use fem_elements::number::avx2;

/// Instructions on four numbers in single precision, and on the eight of a pair of rows.
pub trait Registers: Copy {
    type Four: Copy;
    type Eight: Copy;

    fn four(self, x: Row) -> Self::Four;

    fn splat(self, x: f32) -> Self::Four;

    fn numbers(self, x: Self::Four) -> Row;

    /// a b + c
    fn multiply_add(self, a: Self::Four, b: Self::Four, c: Self::Four) -> Self::Four;

    fn pair(self, x: Pair) -> Self::Eight;

    fn numbers_of_pair(self, x: Self::Eight) -> Pair;

    /// a b + c
    fn multiply_add_pair(self, a: Self::Eight, b: Self::Eight, c: Self::Eight) -> Self::Eight;
}

/// A function that is compiled once for each kind of registers. Functions that it calls must be inlined into it.
pub trait Kernel {
    type Output;

    fn run<R: Registers>(self, registers: R) -> Self::Output;
}

/// Runs a kernel with the registers that this processor has.
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = avx2() {
        return avx2.vectorize(Avx2 { avx2, kernel });
    }
    kernel.run(Portable)
}

/// Registers of every processor.
#[derive(Clone, Copy)]
pub struct Portable;

impl Registers for Portable {
    type Four = f32x4;
    type Eight = [f32x4; 2];

    #[inline(always)]
    fn four(self, x: Row) -> f32x4 {
        f32x4::new(x)
    }

    #[inline(always)]
    fn splat(self, x: f32) -> f32x4 {
        f32x4::splat(x)
    }

    #[inline(always)]
    fn numbers(self, x: f32x4) -> Row {
        x.to_array()
    }

    #[inline(always)]
    fn multiply_add(self, a: f32x4, b: f32x4, c: f32x4) -> f32x4 {
        a * b + c
    }

    #[inline(always)]
    fn pair(self, x: Pair) -> [f32x4; 2] {
        x.map(f32x4::new)
    }

    #[inline(always)]
    fn numbers_of_pair(self, x: [f32x4; 2]) -> Pair {
        x.map(f32x4::to_array)
    }

    #[inline(always)]
    fn multiply_add_pair(self, a: [f32x4; 2], b: [f32x4; 2], c: [f32x4; 2]) -> [f32x4; 2] {
        [a[0] * b[0] + c[0], a[1] * b[1] + c[1]]
    }
}

#[cfg(target_arch = "x86_64")]
impl Registers for pulp::x86::V3 {
    type Four = pulp::f32x4;
    type Eight = pulp::f32x8;

    #[inline(always)]
    fn four(self, x: Row) -> pulp::f32x4 {
        pulp::cast(x)
    }

    #[inline(always)]
    fn splat(self, x: f32) -> pulp::f32x4 {
        self.splat_f32x4(x)
    }

    #[inline(always)]
    fn numbers(self, x: pulp::f32x4) -> Row {
        pulp::cast(x)
    }

    #[inline(always)]
    fn multiply_add(self, a: pulp::f32x4, b: pulp::f32x4, c: pulp::f32x4) -> pulp::f32x4 {
        self.mul_add_f32x4(a, b, c)
    }

    #[inline(always)]
    fn pair(self, x: Pair) -> pulp::f32x8 {
        pulp::cast(x)
    }

    #[inline(always)]
    fn numbers_of_pair(self, x: pulp::f32x8) -> Pair {
        pulp::cast(x)
    }

    #[inline(always)]
    fn multiply_add_pair(self, a: pulp::f32x8, b: pulp::f32x8, c: pulp::f32x8) -> pulp::f32x8 {
        self.mul_add_f32x8(a, b, c)
    }
}

/// A kernel with AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
struct Avx2<K> {
    avx2: pulp::x86::V3,
    kernel: K,
}

#[cfg(target_arch = "x86_64")]
impl<K: Kernel> NullaryFnOnce for Avx2<K> {
    type Output = K::Output;

    #[inline(always)]
    fn call(self) -> K::Output {
        self.kernel.run(self.avx2)
    }
}
