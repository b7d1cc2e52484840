//! Registers of four numbers, for kernels in which the compiler does not find them: a row of three numbers leaves one out.

use pulp::NullaryFnOnce;
use wide::f32x4;

use super::super::Row;

/// Instructions on four numbers in single precision.
pub trait Registers: Copy {
    type Four: Copy;

    fn four(self, x: Row) -> Self::Four;

    fn splat(self, x: f32) -> Self::Four;

    fn numbers(self, x: Self::Four) -> Row;

    /// a b + c
    fn multiply_add(self, a: Self::Four, b: Self::Four, c: Self::Four) -> Self::Four;
}

/// A function that is compiled once for each kind of registers. Functions that it calls must be inlined into it.
pub trait Kernel {
    type Output;

    fn run<R: Registers>(self, registers: R) -> Self::Output;
}

/// Runs a kernel with the registers that this processor has.
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = pulp::x86::V3::try_new() {
        return avx2.vectorize(Avx2 { avx2, kernel });
    }
    kernel.run(Portable)
}

/// Registers of every processor.
#[derive(Clone, Copy)]
pub struct Portable;

impl Registers for Portable {
    type Four = f32x4;

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
}

#[cfg(target_arch = "x86_64")]
impl Registers for pulp::x86::V3 {
    type Four = pulp::f32x4;

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
