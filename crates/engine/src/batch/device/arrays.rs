//! A body as arrays for a device, in the engine's numbering.

use fem_gpu::{Environment, Law};
use fem_model::{Body, EnvironmentValues, Material};

use crate::forces::{Moment, dead_load};
use crate::integrators::color_nodes;
use crate::model::system::System;
use crate::simulator::device_elements;
use fem_elements::materials::AnyLaw;

/// The law of a material with its parameters, if the device knows it.
pub(super) fn law(material: &Material) -> Option<(Law, [f64; 2])> {
    device_elements::law(&AnyLaw::<f64>::new(material)?)
}

/// The parameters of an environment beside those of the body itself. The device knows the law.
pub(super) fn environment(body: &Body, values: &EnvironmentValues) -> Environment {
    let material = values.material(&body.material);
    let (_, moduli) = law(&material).expect("other laws are refused");
    let density = material.density / body.material.density;
    let gravity = values.gravity.unwrap_or(1.0);
    Environment { moduli, weight: gravity * density, density }
}

/// The arrays of a body, whose masses are lumped.
pub(super) fn arrays(system: &System<f64>, body: &Body) -> fem_gpu::Body {
    let mut inverse_masses: Vec<[f64; 3]> = system.mass.diagonal().into_iter().map(|mass| [1.0 / mass; 3]).collect();
    system.dirichlet.clear_constrained(&mut inverse_masses);
    let of_mesh = &body.initial_velocity;
    let mut velocities: Vec<[f64; 3]> = match of_mesh[..] {
        [] => Vec::new(),
        _ => system.numbering.mesh_node.iter().map(|&node| of_mesh[node as usize].into()).collect(),
    };
    if !velocities.is_empty() {
        system.dirichlet.clear_constrained(&mut velocities);
    }
    fem_gpu::Body {
        tetrahedra: device_elements::tetrahedra(system),
        weights: dead_loads(
            system,
            &Body { body_force: None, tractions: Vec::new(), nodal_forces: Vec::new(), ..body.clone() },
        ),
        loads: dead_loads(system, &Body { gravity: None, ..body.clone() }),
        inverse_masses,
        velocities,
    }
}

/// The nodes of a body by colour, those of vertex block descent on the processor.
pub(super) fn colors(system: &System<f64>, body: &Body) -> Vec<Vec<u32>> {
    let corners = system.numbering.elements(body.shape.mesh.tetrahedra());
    let cliques: Vec<&[u32]> = corners.iter().map(|corners| &corners[..]).collect();
    color_nodes(system.nodes(), &cliques)
}

/// Dead loads of a body on its nodes, N.
fn dead_loads(system: &System<f64>, body: &Body) -> Vec<[f64; 3]> {
    let mut gradient = vec![[0.0; 3]; system.nodes()];
    if let Some(load) = dead_load::build::<f64>(body, &system.numbering) {
        load.add_gradient(&[], Moment::at(0.0), &mut gradient);
    }
    gradient.into_iter().map(|gradient| gradient.map(|component| -component)).collect()
}
