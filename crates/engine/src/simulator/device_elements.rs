//! The elements of a body as arrays for a graphics device, in the engine's numbering.

use fem_gpu::{Law, Tetrahedra};

use crate::integrators::shape;
use crate::model::system::System;
use fem_elements::materials::AnyLaw;
use fem_elements::number::Number;
use fem_elements::sparse::{Block, Pattern};
use fem_solvers::{DeviceElements, Real};

/// A law and its parameters (Pa), if the device knows it.
pub(crate) fn law<L: Number>(law: &AnyLaw<L>) -> Option<(Law, [f64; 2])> {
    let [shear, bulk] = law.moduli();
    let lame = [shear, bulk - 2.0 / 3.0 * shear];
    match law {
        AnyLaw::Linear(_) => Some((Law::Linear, lame)),
        AnyLaw::Corotated(_) => Some((Law::Corotated, lame)),
        AnyLaw::StVenantKirchhoff(_) => Some((Law::StVenantKirchhoff, lame)),
        AnyLaw::StableNeoHookean(_) => Some((Law::StableNeoHookean, lame)),
        AnyLaw::NeoHookean(_) => Some((Law::NeoHookean, [0.5 * shear, 0.5 * bulk])),
        _ => None,
    }
}

/// The elements of a body of linear tetrahedra.
pub(crate) fn tetrahedra<T: Real>(system: &System<T>) -> Tetrahedra {
    let corners = system.numbering.elements(system.shape.mesh.tetrahedra());
    let factor = |element: usize| system.elements.factor(element);
    let shapes: Vec<_> = corners.iter().enumerate().map(|(e, corners)| shape(system, corners, factor(e))).collect();
    Tetrahedra {
        gradients: shapes.iter().map(|shape| [1, 2, 3].map(|corner| shape.gradients[corner])).collect(),
        volumes: shapes.iter().map(|shape| shape.volume).collect(),
        corners,
    }
}

/// The elements of a body whose matrices a device [can assemble](super::device_assembly::is_possible).
pub(super) fn elements<T: Real>(system: &System<T>) -> DeviceElements {
    let (law, moduli) = law_and_moduli(system, system.shape.mesh.elements());
    let tetrahedra = tetrahedra(system);
    let mut masses: Vec<Block<T, 3>> = vec![[[T::default(); 3]; 3]; system.pattern.blocks()];
    system.mass.add_to(T::one(), &system.pattern, &mut masses);
    let masses: Vec<f64> = masses.iter().map(|block| block[0][0].as_f64()).collect();
    let largest = [largest_stiffness(system, &tetrahedra), largest_mass(&system.pattern, &masses)];
    DeviceElements { nodes: system.nodes(), tetrahedra, law, moduli, masses, largest }
}

/// The law of all elements, and its parameters in each.
fn law_and_moduli<T: Real>(system: &System<T>, count: usize) -> (Law, Vec<[f64; 2]>) {
    let laws = system.elements.laws().map(|of_material| law(of_material).expect("the device knows the laws"));
    let laws: Vec<_> = laws.collect();
    let mut moduli = vec![[0.0; 2]; count];
    for (material, (_, parameters)) in laws.iter().enumerate() {
        system.elements.numbers(material).into_iter().for_each(|element| moduli[element] = *parameters);
    }
    (laws[0].0, moduli)
}

/// A bound of the diagonal entries of the undeformed stiffness: Σ V (K + 4μ/3) |∇φ|² over the elements around a node, N/m.
fn largest_stiffness<T: Real>(system: &System<T>, tetrahedra: &Tetrahedra) -> f64 {
    let modulus = system.elements.moduli().map(|[shear, bulk]| bulk + 4.0 / 3.0 * shear).fold(0.0, f64::max);
    let mut sums = vec![0.0; system.nodes()];
    for ((corners, gradients), volume) in tetrahedra.corners.iter().zip(&tetrahedra.gradients).zip(&tetrahedra.volumes)
    {
        let squares = gradients.map(|gradient| gradient.iter().map(|x| x * x).sum::<f64>());
        // The gradient at the first corner is minus the sum of the others.
        let squares = [3.0 * squares.iter().sum::<f64>(), squares[0], squares[1], squares[2]];
        corners.iter().zip(squares).for_each(|(&node, square)| sums[node as usize] += volume * modulus * square);
    }
    sums.into_iter().fold(0.0, f64::max)
}

fn largest_mass(pattern: &Pattern, masses: &[f64]) -> f64 {
    pattern.diagonal().map(|block| masses[block]).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulator::device_assembly::LAWS;

    #[test]
    fn the_device_knows_the_laws_that_are_named() {
        let known = |name: &str| {
            let text = format!(
                "pipeline=\"engine\"\nmesh.box={{size=[1,1,1],cells_per_unit=1}}\nmaterial={{model=\"{name}\",young=1e5,poisson=0.3,density=1}}\ntime={{dt=1,integrator=\"static\"}}"
            );
            let scene = fem_scene::parse(&text, "laws.toml".as_ref()).unwrap_or_else(|error| panic!("{error}"));
            law(&AnyLaw::<f64>::new(&scene.material.value()).expect("it has its parameters")).is_some()
        };
        assert!(LAWS.iter().all(|name| known(name)));
        assert!(!known("hencky"));
    }
}
