//! From components to a simulation.

use bevy::math::DVec3;
use fem_model::simulation::Simulation;
use fem_model::{Body, DirichletCondition, Integrator};
use fem_scene::tables::{DampingTable, GravityTable, MaterialTable, PlaneTable};
use fem_scene::{Pipeline, Scene, SceneError};

use crate::soft_body::Source;
use crate::{SoftBody, SoftBodyError, SoftBodyMaterial, SoftBodyPinnedParticles, SoftBodyPlane, SoftBodyPlanes};

/// All that a body is built from.
pub struct Blueprint {
    body: SoftBody,
    material: Option<SoftBodyMaterial>,
    pinned: Option<SoftBodyPinnedParticles>,
    planes: Option<SoftBodyPlanes>,
}

impl Blueprint {
    /// Copies the components of an entity; meshes and scenes are shared.
    pub fn new(
        body: &SoftBody,
        material: Option<&SoftBodyMaterial>,
        pinned: Option<&SoftBodyPinnedParticles>,
        planes: Option<&SoftBodyPlanes>,
    ) -> Self {
        Self { body: body.clone(), material: material.cloned(), pinned: pinned.cloned(), planes: planes.cloned() }
    }

    /// Reads the scene and its meshes, and builds the engine's simulation. Returns an error that names the field and the remedy.
    pub fn build(&self) -> Result<Box<dyn Simulation>, SoftBodyError> {
        let scene = self.scene()?;
        let data = &self.body.data;
        let mut body = match &self.body.mesh {
            Some(mesh) => fem_scene::body_of(&scene, (**mesh).clone(), data)?,
            None => fem_scene::body(&scene, data)?,
        };
        if let Some(display) = &self.body.display {
            check_display(&display.vertices.iter().map(|x| DVec3::new(x.x, x.y, x.z)).collect::<Vec<_>>(), display)?;
            body.shape.display = Some((**display).clone());
        }
        if let Some(SoftBodyPinnedParticles(nodes)) = &self.pinned {
            pin(&mut body, nodes)?;
        }
        let built = scene.check_one_body().and_then(|()| fem_engine::simulator::build(body, &scene.method()));
        built.map_err(|refusal| scene.refused(refusal).into())
    }

    /// The scene with the changes of the components.
    fn scene(&self) -> Result<Scene, SoftBodyError> {
        let mut scene = match &self.body.source {
            Source::File(name) => fem_scene::load(name, &self.body.data)?,
            Source::Text(text) => fem_scene::parse(text, "soft_body.toml".as_ref())?,
            Source::Scene(scene) => (**scene).clone(),
        };
        check_method(&scene)?;
        if let Some(material) = &self.material {
            set_material(&mut scene, material);
        }
        if let Some(SoftBodyPlanes(planes)) = &self.planes {
            scene.planes.extend(planes.iter().map(plane));
        }
        if let Some(acceleration) = self.body.gravity {
            scene.gravity = Some(GravityTable { acceleration: acceleration.to_array(), curve: None });
        }
        scene.time.dt = self.body.dt.or(scene.time.dt);
        // A scene was checked when it was read; so a problem is one of the components.
        let of_component = |error: SceneError| SoftBodyError::Component(error.problem());
        scene.check().map_err(of_component)?;
        Ok(scene)
    }
}

fn check_method(scene: &Scene) -> Result<(), SoftBodyError> {
    if scene.pipeline == Pipeline::Course {
        let text = "is course, and the plugin runs the engine; write pipeline = \"engine\"";
        return Err(scene.refuse("pipeline", text).into());
    }
    if scene.method().integrator == Integrator::Static {
        let text = "is static, which has no motion; choose implicit_euler or another method with time steps";
        return Err(scene.refuse("time.integrator", text).into());
    }
    Ok(())
}

fn set_material(scene: &mut Scene, material: &SoftBodyMaterial) {
    let MaterialTable { thickness, plane, volumetric, .. } = scene.material;
    scene.material = MaterialTable {
        model: material.model.clone(),
        density: material.density,
        thickness,
        plane,
        volumetric,
        young: Some(material.young),
        poisson: Some(material.poisson),
        ..MaterialTable::default()
    };
    if let Some([alpha, beta]) = material.damping {
        scene.damping = Some(DampingTable { alpha, beta, ..DampingTable::default() });
    }
}

fn plane(plane: &SoftBodyPlane) -> PlaneTable {
    PlaneTable {
        point: plane.point.to_array(),
        normal: plane.normal.to_array(),
        friction: plane.friction,
        velocity: None,
        until: None,
        displacement: None,
        curve: None,
    }
}

/// Refuses a display surface that has triangles without corners, or places that are no numbers.
fn check_display(vertices: &[DVec3], surface: &fem_mesh::SurfaceMesh) -> Result<(), SoftBodyError> {
    let count = vertices.len();
    if let Some(vertex) = vertices.iter().position(|x| !x.is_finite()) {
        let text = format!("SoftBody::with_display: vertex {vertex} is not finite; give coordinates in m");
        return Err(SoftBodyError::Component(text));
    }
    if let Some(&vertex) = surface.elements.iter().flatten().find(|&&vertex| vertex >= count) {
        let text = format!("SoftBody::with_display: a triangle names vertex {vertex} of {count}; count from 0");
        return Err(SoftBodyError::Component(text));
    }
    Ok(())
}

/// Adds a Dirichlet condition on those of the nodes that `[fixed]` does not have.
fn pin(body: &mut Body, nodes: &[usize]) -> Result<(), SoftBodyError> {
    let refuse = |text: String| Err(SoftBodyError::Component(format!("SoftBodyPinnedParticles: {text}")));
    let count = body.shape.mesh.vertices().len();
    if let Some(node) = nodes.iter().find(|&&node| node >= count) {
        return refuse(format!("node {node} is not one of the {count} nodes of the mesh; count from 0"));
    }
    let mut pinned = nodes.to_vec();
    pinned.sort_unstable();
    pinned.dedup();
    for condition in &body.dirichlet {
        let is_constrained = |node: &usize| condition.nodes.binary_search(node).is_ok();
        if let Some(node) = pinned.iter().find(|node| condition.motion.is_some() && is_constrained(node)) {
            return refuse(format!("{} moves node {node}; name each node in one of the two", condition.name));
        }
        pinned.retain(|node| !is_constrained(node));
    }
    if !pinned.is_empty() {
        let at = body.dirichlet.iter().take_while(|condition| condition.motion.is_none()).count();
        let name = "pinned".to_owned();
        let condition = DirichletCondition { name, nodes: pinned, components: [true; 3], motion: None, until: None };
        body.dirichlet.insert(at, condition);
    }
    Ok(())
}
