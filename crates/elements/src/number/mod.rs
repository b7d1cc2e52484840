//! Numbers that kernels compute with: `f32`, `f64`, or SIMD lanes of them.
//!
//! A kernel is written once over [`Number`]: a float for one element, or lanes with one float of each element of a batch, which
//! one instruction of the processor handles together.

mod arithmetic;
#[cfg(target_arch = "x86_64")]
mod avx2;
mod floats;
mod functions;
mod instructions;
mod lanes;
mod packed;

pub use arithmetic::{Float, Lanes, Number};
pub use functions::{constant, exp_m1, inverse_cube_root, is_positive, minus_ln_1p};
#[cfg(target_arch = "x86_64")]
pub use instructions::avx2;
pub use instructions::check_instructions;
pub use instructions::{Instructions, choose, instructions};
pub use packed::Packed;

/// Runs `work` with the widest [`instructions`] of this run. Functions that it calls must be inlined into it.
///
/// Work is a type of its own, not a closure: only its `with_simd`, marked `inline(always)`, is compiled once for each
/// instruction set.
#[inline(always)]
pub fn vectorized<W: pulp::WithSimd>(work: W) -> W::Output {
    match instructions() {
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx512(simd) => pulp::Simd::vectorize(simd, work),
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx2(simd) => pulp::Simd::vectorize(simd, work),
        #[cfg(target_arch = "x86_64")]
        Instructions::Fallback => pulp::Simd::vectorize(pulp::Scalar::new(), work),
        #[cfg(not(target_arch = "x86_64"))]
        Instructions::Fallback => pulp::Arch::new().dispatch(work),
    }
}
