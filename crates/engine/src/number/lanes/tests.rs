//! Transposes of lanes.

use super::{F32x8, F64x4, from_fn};

#[test]
fn a_transpose_swaps_rows_and_lanes() {
    let of_f64: [F64x4; 4] = from_fn(|i| F64x4::from_lanes(|lane| (10 * i + lane) as f64));
    let of_f32: [F32x8; 8] = from_fn(|i| F32x8::from_lanes(|lane| (10 * i + lane) as f32));
    for (lane, row) in F64x4::transpose(of_f64).iter().enumerate() {
        assert_eq!(row.numbers(), from_fn(|i| (10 * i + lane) as f64));
    }
    for (lane, row) in F32x8::transpose(of_f32).iter().enumerate() {
        assert_eq!(row.numbers(), from_fn(|i| (10 * i + lane) as f32));
    }
}
