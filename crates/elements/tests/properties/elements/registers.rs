//! Sums in wide registers are those of one element after the other, to round-off.

use super::*;
use fem_elements::materials::{AnyLaw, Corotated, NeoHookean};
use fem_elements::number::Lanes;

/// Energy, gradient and stiffness, one after the other.
fn sums<T: Float, L: Lanes<Element = T>>(
    positions: &[Vector3<f64>],
    elements: &[[u32; 4]],
    law: &AnyLaw<L>,
) -> Vec<f64> {
    let pattern = Pattern::new(positions.len(), elements, fem_elements::sparse::Stored::Full);
    let made = Elements::<T, 3, 3, 4>::new(positions, elements, &pattern);
    let mut next = random(3);
    let u: Vec<[T; 3]> = positions.iter().map(|_| std::array::from_fn(|_| T::of(0.05 * next()))).collect();
    let mut gradient = vec![[T::default(); 3]; u.len()];
    let mut values = vec![[[T::default(); 3]; 3]; pattern.blocks()];
    let energy = match law {
        AnyLaw::NeoHookean(law) => {
            made.add_stiffness(law, T::of(1.0), &u, &mut values);
            made.add_energy_and_gradient(law, &u, &mut gradient)
        }
        AnyLaw::Corotated(law) => {
            made.add_stiffness(law, T::of(1.0), &u, &mut values);
            made.add_energy_and_gradient(law, &u, &mut gradient)
        }
        law => panic!("no loop is compiled for {}", law.name()),
    };
    let numbers = gradient.as_flattened().iter().chain(values.as_flattened().as_flattened());
    [energy].into_iter().chain(numbers.map(|x| x.as_f64())).collect()
}

fn agree<T: Float>(tolerance: f64) {
    let mesh = box_mesh([2.0, 1.0, 1.0], 3, fem_mesh::Pattern::Alternating).unwrap();
    let elements: Vec<_> = mesh.elements.iter().map(|element| element.map(|node| node as u32)).collect();
    let splat = |x: f64| (T::Single::splat(T::of(x)), T::Fast::splat(T::of(x)));
    let ((shear, fast_shear), (volume, fast_volume)) = (splat(C), splat(D));
    let pairs = [
        (
            AnyLaw::NeoHookean(NeoHookean { C: shear, D: volume }),
            AnyLaw::NeoHookean(NeoHookean { C: fast_shear, D: fast_volume }),
        ),
        (
            AnyLaw::Corotated(Corotated { mu: shear, lambda: volume }),
            AnyLaw::Corotated(Corotated { mu: fast_shear, lambda: fast_volume }),
        ),
    ];
    for (law, fast) in &pairs {
        let (portable, fast) =
            (sums::<T, T::Single>(&mesh.vertices, &elements, law), sums::<T, T::Fast>(&mesh.vertices, &elements, fast));
        let size = portable.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (portable, fast) in portable.iter().zip(&fast) {
            assert!((portable - fast).abs() <= tolerance * size, "{}: {portable:e} {fast:e}", law.name());
        }
    }
}

#[test]
fn sums_in_wide_registers_are_those_of_one_element_after_the_other() {
    if f64::has_fast() {
        agree::<f64>(1e-14);
        agree::<f32>(1e-6);
    }
}
