//! Packs: as many floats as one register of this processor holds, for kernels that must compile to exactly those instructions.

use pulp::Simd;

/// A float of which a register holds a pack.
pub trait Packed: Copy {
    /// As many floats as a register holds.
    type Pack<S: Simd>: Copy;

    /// A slice as whole packs, without the floats that fill no pack.
    fn packs<S: Simd>(x: &[Self]) -> &[Self::Pack<S>];

    /// A mutable slice as whole packs, without the floats that fill no pack.
    fn packs_mut<S: Simd>(x: &mut [Self]) -> &mut [Self::Pack<S>];

    /// The same number in every lane.
    fn broadcast<S: Simd>(simd: S, x: Self) -> Self::Pack<S>;

    /// a·b + c
    fn multiply_add<S: Simd>(simd: S, a: Self::Pack<S>, b: Self::Pack<S>, c: Self::Pack<S>) -> Self::Pack<S>;

    /// a·b
    fn multiply<S: Simd>(simd: S, a: Self::Pack<S>, b: Self::Pack<S>) -> Self::Pack<S>;

    /// a − b
    fn subtract<S: Simd>(simd: S, a: Self::Pack<S>, b: Self::Pack<S>) -> Self::Pack<S>;

    /// Sum over the lanes.
    fn reduce_sum<S: Simd>(simd: S, a: Self::Pack<S>) -> Self;
}

macro_rules! packed {
    ($float:ty, $pack:ident, $packs:ident, $packs_mut:ident, $splat:ident, $multiply_add:ident, $multiply:ident,
     $subtract:ident, $sum:ident) => {
        impl Packed for $float {
            type Pack<S: Simd> = S::$pack;

            #[inline(always)]
            fn packs<S: Simd>(x: &[Self]) -> &[S::$pack] {
                S::$packs(x).0
            }

            #[inline(always)]
            fn packs_mut<S: Simd>(x: &mut [Self]) -> &mut [S::$pack] {
                S::$packs_mut(x).0
            }

            #[inline(always)]
            fn broadcast<S: Simd>(simd: S, x: Self) -> S::$pack {
                simd.$splat(x)
            }

            #[inline(always)]
            fn multiply_add<S: Simd>(simd: S, a: S::$pack, b: S::$pack, c: S::$pack) -> S::$pack {
                simd.$multiply_add(a, b, c)
            }

            #[inline(always)]
            fn multiply<S: Simd>(simd: S, a: S::$pack, b: S::$pack) -> S::$pack {
                simd.$multiply(a, b)
            }

            #[inline(always)]
            fn subtract<S: Simd>(simd: S, a: S::$pack, b: S::$pack) -> S::$pack {
                simd.$subtract(a, b)
            }

            #[inline(always)]
            fn reduce_sum<S: Simd>(simd: S, a: S::$pack) -> Self {
                simd.$sum(a)
            }
        }
    };
}

packed!(f64, f64s, as_simd_f64s, as_mut_simd_f64s, splat_f64s, mul_add_e_f64s, mul_f64s, sub_f64s, reduce_sum_f64s);
packed!(f32, f32s, as_simd_f32s, as_mut_simd_f32s, splat_f32s, mul_add_e_f32s, mul_f32s, sub_f32s, reduce_sum_f32s);
