//! Lanes against single numbers, single against double precision.

use super::*;
use fem_elements::Real;
use fem_elements::number::{Float, Lanes};
use fem_elements::tensor::from_fn;

/// Energy, stress, both at once, derivative and projected derivative of one law at G.
fn answers<T: Number>(law: &dyn Law<T>, G: &Tensor<T>) -> Vec<T> {
    let mut all = vec![law.energy(G)];
    all.extend_from_slice(law.stress(G).as_flattened());
    let (energy, P) = law.energy_and_stress(G);
    all.push(energy);
    all.extend_from_slice(P.as_flattened());
    all.extend_from_slice(law.derivative(G).as_flattened());
    all.extend_from_slice(law.projected_derivative(G).as_flattened());
    all
}

/// The largest difference between lanes and single numbers, and between those and f64, relative to the largest answer.
fn differences<T: Float + Number<Element = T>, L: Lanes<Element = T>>(
    one: &dyn Law<T>,
    many: &dyn Law<L>,
    exact: &dyn Law<f64>,
    gradients: &[Tensor<f64>],
) -> (f64, f64) {
    let (mut of_lanes, mut of_precision) = (0.0f64, 0.0f64);
    for batch in gradients.chunks_exact(L::LANES) {
        let single = |lane: usize| from_fn(|i, j| <T as Float>::of(batch[lane][i][j]));
        let lanes = from_fn(|i, j| {
            let mut entry = L::zero();
            (0..L::LANES).for_each(|lane| entry.set_lane(lane, single(lane)[i][j]));
            entry
        });
        let found = answers(many, &lanes);
        for lane in 0..L::LANES {
            let expected = answers(one, &single(lane));
            // In double precision at the very same gradient.
            let exact = answers(exact, &single(lane).map(|row| row.map(Float::as_f64)));
            let size = exact.iter().fold(MU, |size, x| size.max(x.abs()));
            for ((found, expected), exact) in found.iter().zip(expected).zip(exact) {
                let (found, expected) = (Float::as_f64(found.lane(lane)), Float::as_f64(expected));
                of_lanes = of_lanes.max((found - expected).abs() / size);
                of_precision = of_precision.max((expected - exact).abs() / size);
            }
        }
    }
    (of_lanes, of_precision)
}

/// A law by reference.
type ByReference<L> = fn(&AnyLaw<L>) -> &dyn Law<L>;

/// The same for every law in one precision: name, and the two differences.
fn of_all_laws<T: Real + Number<Element = T>, L: Lanes<Element = T>>(
    by_reference: ByReference<L>,
) -> impl Iterator<Item = (&'static str, f64, f64)> {
    let (one, many, exact) = (laws::<T>(), laws::<L>(), laws::<f64>());
    (0..exact.len()).map(move |i| {
        let (one, exact_law) = (T::law(&one[i]), f64::law(&exact[i]));
        let (lanes, precision) = differences::<T, L>(one, by_reference(&many[i]), exact_law, &upright());
        (exact[i].name(), lanes, precision)
    })
}

fn lanes_agree<D: Lanes<Element = f64>, S: Lanes<Element = f32>>(double: ByReference<D>, single: ByReference<S>) {
    for (name, of_lanes, of_precision) in of_all_laws::<f64, D>(double) {
        assert!(of_lanes < 1e-13 && of_precision == 0.0, "{name}: {of_lanes:e}");
    }
    for (name, of_lanes, of_precision) in of_all_laws::<f32, S>(single) {
        // Fused operations round once where others round twice.
        assert!(of_lanes < 1e-5, "{name}, f32: {of_lanes:e}");
        assert!(of_precision < 1e-4, "{name}, f32 against f64: {of_precision:e}");
    }
}

#[test]
fn lanes_agree_with_single_numbers_and_single_precision_with_double() {
    lanes_agree::<<f64 as Float>::Lanes, <f32 as Float>::Lanes>(|law| law, |law| law);
}

#[test]
fn lanes_in_wide_registers_agree_with_single_numbers_where_the_processor_has_them() {
    if f64::has_fast() {
        lanes_agree(f64::fast_law, f32::fast_law);
    }
}
