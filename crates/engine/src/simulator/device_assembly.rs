//! Decides whether a graphics device that solves also assembles the matrix.

use fem_model::{Body, Integrator as IntegratorKind, Method, Projection};

use crate::model::system::System;
use fem_solvers::Real;

/// The laws that the device knows.
pub(crate) const LAWS: [&str; 5] = ["linear", "corotated", "st_venant_kirchhoff", "neo_hookean", "stable_neo_hookean"];

/// Returns the reason why the device cannot assemble the elements of a body; `None` if it can.
pub(super) fn unknown_elements(is_solid: bool, flows: bool, laws: &[&str]) -> Option<String> {
    let unknown = laws.iter().find(|law| !LAWS.contains(law));
    match (laws, unknown) {
        _ if !is_solid => Some("its elements are no linear tetrahedra".to_owned()),
        _ if flows => Some("[plasticity] makes a law for each element".to_owned()),
        (_, Some(law)) => Some(format!("the device does not know {law}")),
        ([], None) => Some("no element is elastic".to_owned()),
        ([first, others @ ..], None) => {
            others.iter().any(|law| law != first).then(|| "its materials have different laws".to_owned())
        }
    }
}

/// The same for the body of a scene.
pub(super) fn unknown_in_body(body: &Body) -> Option<String> {
    let in_regions: usize = body.regions.iter().map(|region| region.elements.len()).sum();
    let own = (in_regions < body.shape.mesh.elements()).then_some(&body.material);
    let materials = own.into_iter().chain(body.regions.iter().map(|region| &region.material));
    let laws: Vec<&str> = materials.map(|material| material.law.name()).collect();
    unknown_elements(!body.shape.mesh.tetrahedra().is_empty(), body.plasticity.is_some(), &laws)
}

/// Returns the reason why a method leaves the assembly to the processor; `None` if it does not.
pub(super) fn other_method(kind: IntegratorKind, method: &Method, is_linear: bool) -> Option<&'static str> {
    match method.newton.projection {
        _ if !kind.has_newton() => Some("this method solves once, to the last digit"),
        _ if is_linear => Some("a linear body has one matrix"),
        _ if kind == IntegratorKind::Static && method.arc_length => Some("a path through limit points is followed"),
        Projection::Always => Some("newton.projection is \"always\""),
        Projection::Never => Some("newton.projection is \"never\""),
        Projection::WhenNeeded => None,
    }
}

/// Returns true if the device assembles the matrices of a method.
pub(super) fn is_possible<T: Real>(kind: IntegratorKind, method: &Method, system: &System<T>) -> bool {
    let elements = &system.elements;
    let laws: Vec<&str> = elements.laws().map(|law| law.name()).collect();
    let unknown = unknown_elements(!system.shape.mesh.tetrahedra().is_empty(), elements.plasticity().is_some(), &laws);
    unknown.is_none() && other_method(kind, method, system.may_be_linear()).is_none()
}
