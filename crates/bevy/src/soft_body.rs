//! The component [`SoftBody`]: where a body comes from.

use std::path::PathBuf;
use std::sync::Arc;

use bevy::ecs::component::Component;
use bevy::math::DVec3;
use bevy::transform::components::Transform;
use fem_mesh::{SurfaceMesh, TetrahedralMesh};
use fem_scene::Scene;

use crate::SoftBodyState;

/// A deformable body. The plugin reads and builds it on a thread of its own, and then moves it.
///
/// The body's frame, in which it has its positions, is that of its scene or mesh, in metres; the entity's `Transform` places this frame in the world.
/// So gravity and planes turn with the entity, and a scale changes the picture alone.
///
/// The body is built when the component is inserted, from the components beside it, and once more when one of them changes: it then
/// starts again in its initial state. Clones share meshes and scenes.
///
/// ```
/// use bevy::math::DVec3;
/// use fem_bevy::{SoftBody, SoftBodyMaterial, SoftBodyPinnedParticles};
///
/// let beam = fem_mesh::box_mesh([2.0, 0.5, 0.5], 4, fem_mesh::Pattern::Alternating)?;
/// let clamped = (0..beam.vertices.len()).filter(|&node| beam.vertices[node].x < 1e-9).collect();
/// let bundle = (
///     SoftBody::from_mesh(beam).with_dt(0.01).with_gravity(DVec3::new(0.0, -9.81, 0.0)),
///     SoftBodyMaterial { young: 1e5, ..Default::default() },
///     SoftBodyPinnedParticles(clamped),
/// );
/// # Ok::<(), fem_mesh::MeshError>(())
/// ```
#[derive(Clone, Component, Debug)]
#[require(SoftBodyState, Transform)]
pub struct SoftBody {
    pub(crate) source: Source,
    pub(crate) data: PathBuf,
    pub(crate) mesh: Option<Arc<TetrahedralMesh>>,
    pub(crate) display: Option<Arc<SurfaceMesh>>,
    /// s
    pub(crate) dt: Option<f64>,
    /// m/s²
    pub(crate) gravity: Option<DVec3>,
}

/// The scene of a body.
#[derive(Clone, Debug)]
pub(crate) enum Source {
    /// The name or the path of a scene file.
    File(Arc<str>),
    /// The text of a scene file.
    Text(Arc<str>),
    /// A scene that was read before.
    Scene(Arc<Scene>),
}

/// The scene of a body that is made from a mesh alone; `[mesh]` and `[material]` hold their places only.
const OF_MESH: &str = r#"
pipeline = "engine"
[mesh]
box = { size = [1, 1, 1], cells_per_unit = 1 }
[material]
model = "stable_neo_hookean"
young = 1e5
poisson = 0.4
density = 1000
[time]
dt = 0.016666666666666666
integrator = "implicit_euler"
"#;

impl SoftBody {
    /// The body of a scene file: its path, or its name in the folder `scenes` of `data`. Meshes are searched beside the scene, then in `data`.
    pub fn scene(name: impl AsRef<str>, data: impl Into<PathBuf>) -> Self {
        Self::of(Source::File(name.as_ref().into()), data.into())
    }

    /// The body of a scene's text. Meshes are searched in `data`.
    pub fn text(text: impl AsRef<str>, data: impl Into<PathBuf>) -> Self {
        Self::of(Source::Text(text.as_ref().into()), data.into())
    }

    /// The body of a scene that was read before. Meshes are searched beside the scene's file, then in `data`.
    pub fn from_scene(scene: Scene, data: impl Into<PathBuf>) -> Self {
        Self::of(Source::Scene(Arc::new(scene)), data.into())
    }

    /// A body of tetrahedra (vertices in m) in implicit Euler's method with a time step of 1/60 s, without gravity.
    pub fn from_mesh(mesh: TetrahedralMesh) -> Self {
        Self::of(Source::Text(OF_MESH.into()), PathBuf::new()).with_mesh(mesh)
    }

    /// The same with these tetrahedra (vertices in m) in place of those of the scene.
    pub fn with_mesh(mut self, mesh: TetrahedralMesh) -> Self {
        self.mesh = Some(Arc::new(mesh));
        self
    }

    /// The same with a surface to display (vertices in m) in place of the boundary of the tetrahedra, which carry it along.
    pub fn with_display(mut self, surface: SurfaceMesh) -> Self {
        self.display = Some(Arc::new(surface));
        self
    }

    /// The same with another time step, s.
    pub fn with_dt(mut self, dt: f64) -> Self {
        self.dt = Some(dt);
        self
    }

    /// The same with another acceleration of gravity, m/s².
    pub fn with_gravity(mut self, acceleration: DVec3) -> Self {
        self.gravity = Some(acceleration);
        self
    }

    fn of(source: Source, data: PathBuf) -> Self {
        Self { source, data, mesh: None, display: None, dt: None, gravity: None }
    }
}
