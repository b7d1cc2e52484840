//! Components beside a [`SoftBody`](crate::SoftBody) that change its scene.

use bevy::ecs::component::Component;
use bevy::math::DVec3;

/// An isotropic elastic material, in place of `[material]` of the scene.
///
/// A value that is not finite or out of its range is refused with a [`SoftBodyFailed`](crate::SoftBodyFailed).
#[derive(Clone, Component, Debug, PartialEq)]
pub struct SoftBodyMaterial {
    /// The constitutive law as scene files name it: `linear`, `corotated`, `st_venant_kirchhoff`, `neo_hookean`, `stable_neo_hookean` or
    /// `hencky`.
    pub model: String,
    /// Young's modulus at small strain, Pa; above 0.
    pub young: f64,
    /// Poisson's ratio at small strain, above −1 and below 0.5. Above 0.45 linear tetrahedra lock.
    pub poisson: f64,
    /// Density, kg/m³; above 0.
    pub density: f64,
    /// Damping in place of the scene's `[damping]`: α of the mass, 1/s, and β of the stiffness, s.
    pub damping: Option<[f64; 2]>,
}

impl Default for SoftBodyMaterial {
    /// Soft rubber: E = 10⁵ Pa, ν = 0.4, 1000 kg/m³.
    fn default() -> Self {
        Self { model: "stable_neo_hookean".to_owned(), young: 1e5, poisson: 0.4, density: 1000.0, damping: None }
    }
}

/// Nodes that keep their undeformed positions, beside those of `[fixed]`. The numbers are those of the mesh, counted from 0.
#[derive(Clone, Component, Debug, Default, PartialEq)]
pub struct SoftBodyPinnedParticles(pub Vec<usize>);

/// Obstacles beside `[[planes]]` of the scene. The body is kept on the side to which the normals point.
#[derive(Clone, Component, Debug, Default, PartialEq)]
pub struct SoftBodyPlanes(pub Vec<SoftBodyPlane>);

/// A half-space that the body does not enter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftBodyPlane {
    /// A point of the plane in the body's frame, m.
    pub point: DVec3,
    /// Direction from the plane to the body, of any length.
    pub normal: DVec3,
    /// Coefficient of Coulomb friction.
    pub friction: f64,
}

/// Lets the plugin write the body's surface into a mesh, the entity's `Mesh3d`. A body without it has no picture.
///
/// Vertices and normals lie in the body's frame. A flat body has triangles of one side: give its material `double_sided` and no
/// `cull_mode`.
#[derive(Clone, Component, Copy, Debug, Default, PartialEq, Eq)]
pub enum SoftBodyMeshSync {
    /// The mesh moves evenly between the steps, and shows the body one step ago, or one frame ago where frames are longer.
    #[default]
    Interpolated,
    /// The mesh shows the newest step.
    Newest,
}
