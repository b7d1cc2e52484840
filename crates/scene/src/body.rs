//! The body of a scene: its meshes, constraints and loads.

use std::path::{Path, PathBuf};

use nalgebra::Vector3;

use crate::check::{check, flat};
use crate::load::refused;
use crate::mass::lumps_mass;
use crate::meshes::{elements, flat_body, mesh_error, scale, surface, text};
use crate::paths::find;
use crate::picture;
use crate::simulation::Shape;
use crate::tables::{MeshTable, SurfaceTable};
use crate::values::{
    Contact, Damping, DirichletCondition, Drag, MaterialRegion, NodalForce, Plasticity, Pressure, Spring, Traction,
    contact, curve, damping, density_factors, dirichlet_conditions, drag, initial_velocity, nodal_forces, plasticity,
    regions, springs, surface_loads,
};
use crate::{BodyMesh, LoadCurve, Material, Scene, SceneError};
use fem_mesh::{SurfaceMesh, TetrahedralMesh};

/// A body as a pipeline simulates it: checked meshes, material, constraints and external forces, in the mesh's node numbers and
/// SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Name of the scene.
    pub name: String,
    /// Nodes, tetrahedra and surfaces.
    pub shape: Shape,
    /// Remarks on the mesh files, one line each: what was left out of them, and what was changed.
    pub notes: Vec<String>,
    /// Constitutive law and density of the elements outside of all regions.
    pub material: Material,
    /// Parts of the body with materials of their own. No element belongs to two of them.
    pub regions: Vec<MaterialRegion>,
    /// Plastic flow of all elements.
    pub plasticity: Option<Plasticity>,
    /// True if the mass matrix is lumped instead of consistent: as the scene says, else for an explicit method and a mesh of more than
    /// [`CONSISTENT_MASS`](crate::CONSISTENT_MASS) nodes or with obstacles.
    pub lumped_mass: bool,
    /// Factor on the moduli of each element; empty for a uniform body. Scene files have no key for it.
    pub stiffness_factors: Vec<f64>,
    /// Factor on the density of `material` for each element, that of its region included; empty for a uniform body.
    pub density_factors: Vec<f64>,
    /// Acceleration of gravity, m/s².
    pub gravity: Option<Vector3<f64>>,
    /// Factor of time on gravity.
    pub gravity_curve: Option<LoadCurve>,
    /// Body force per undeformed volume, N/m³.
    pub body_force: Option<Vector3<f64>>,
    /// Factor of time on the body force.
    pub body_force_curve: Option<LoadCurve>,
    /// `[fixed]` first if there is one, then each `[[prescribed]]` in order. No two of them prescribe the same coordinate.
    pub dirichlet: Vec<DirichletCondition>,
    /// Velocity of each node at the start, m/s; empty for a body at rest. Constrained nodes have their prescribed motion instead.
    pub initial_velocity: Vec<Vector3<f64>>,
    /// Dead loads on the surface.
    pub tractions: Vec<Traction>,
    /// Dead loads on single nodes.
    pub nodal_forces: Vec<NodalForce>,
    /// Follower loads on the surface.
    pub pressures: Vec<Pressure>,
    /// Springs between nodes.
    pub springs: Vec<Spring>,
    /// Obstacles.
    pub contact: Option<Contact>,
    /// The scripted drag.
    pub drag: Option<Drag>,
    /// Damping; `None` if both coefficients are zero.
    pub damping: Option<Damping>,
}

impl Body {
    /// The nodes of `[fixed]`, ascending and without repeats; `None` if the scene has no such table.
    pub fn fixed_nodes(&self) -> Option<&[usize]> {
        self.dirichlet.iter().find(|condition| condition.motion.is_none()).map(|condition| &condition.nodes[..])
    }
}

/// Reads and checks the meshes of a scene, and builds the body. A mesh file is searched beside the scene, then in `data`.
pub fn body(scene: &Scene, data: &Path) -> Result<Body, SceneError> {
    let Some(table) = &scene.mesh.picture else {
        let mut notes = Vec::new();
        let mut body = body_of(scene, elements(scene, data, &mut notes)?, data)?;
        body.notes.splice(0..0, notes);
        return Ok(body);
    };
    let found = picture::triangles(table, &find(scene, data, &table.file), scene.mesh.scale);
    let (triangles, place, remark) = found.map_err(|text| scene.refuse("mesh.picture", &text))?;
    let mut body = body_of(scene, flat_body(scene, triangles), data)?;
    body.shape.picture = Some(place);
    body.notes.extend(remark.map(|remark| format!("mesh.picture {}: {remark}", table.file.display())));
    Ok(body)
}

/// Builds the body on a mesh in memory, in place of the one that the scene names.
pub fn body_of(scene: &Scene, mesh: impl Into<BodyMesh>, data: &Path) -> Result<Body, SceneError> {
    let mesh = checked(scene, mesh.into())?;
    let mut notes = Vec::new();
    let display = scene.mesh.display.as_ref().map(|file| surface(scene, data, file, &mut notes)).transpose()?;
    let boundary = mesh.surface();
    let mut body = body_of_shape(scene, Shape { mesh, boundary, display, picture: None }, data)?;
    body.notes = notes;
    Ok(body)
}

/// Builds the body of a shape that was made for a scene with the same `[mesh]`.
pub fn body_of_shape(scene: &Scene, shape: Shape, data: &Path) -> Result<Body, SceneError> {
    let Shape { mesh, boundary, display, picture } = shape;
    let check = if mesh.is_flat() { flat::check } else { flat::check_solid };
    check(scene).map_err(|(field, problem)| scene.refuse(&field, &problem))?;
    let dirichlet = dirichlet_conditions(scene, &mesh)?;
    let (tractions, pressures) = surface_loads(scene, &mesh, &boundary)?;
    let regions = regions(scene, &mesh)?;
    let density_factors = density_factors(&regions, scene.material.density, mesh.elements());
    let density = |element: usize| scene.material.density * density_factors.get(element).copied().unwrap_or(1.0);
    let initial_velocity = initial_velocity(scene, &mesh, density, |file| find(scene, data, file))?;
    let contact = contact(scene, &mesh, (&dirichlet, &initial_velocity))?;
    Ok(Body {
        name: scene.name.clone(),
        material: scene.material.clone(),
        regions,
        plasticity: plasticity(scene),
        lumped_mass: lumps_mass(scene, mesh.vertices().len()),
        stiffness_factors: Vec::new(),
        density_factors,
        gravity: scene.gravity.as_ref().map(|gravity| gravity.acceleration.into()),
        gravity_curve: scene.gravity.as_ref().and_then(|gravity| curve(&gravity.curve)),
        body_force: scene.body_force.as_ref().map(|force| force.density.into()),
        body_force_curve: scene.body_force.as_ref().and_then(|force| curve(&force.curve)),
        dirichlet,
        initial_velocity,
        tractions,
        nodal_forces: nodal_forces(scene, &mesh)?,
        pressures,
        springs: springs(scene, &mesh)?,
        contact,
        drag: drag(scene, &mesh)?,
        damping: damping(scene),
        notes: Vec::new(),
        shape: Shape { mesh, boundary, display, picture },
    })
}

/// Scales, checks and refines the mesh.
fn checked(scene: &Scene, mesh: BodyMesh) -> Result<BodyMesh, SceneError> {
    match mesh {
        BodyMesh::Solid(mesh) => tetrahedra(scene, mesh).map(BodyMesh::Solid),
        BodyMesh::Flat { triangles, thickness } => {
            let triangles = in_plane(scene, triangles)?;
            Ok(match scene.mesh.order {
                2 => BodyMesh::Quadratic { triangles: fem_mesh::quadratic(triangles), thickness },
                _ => BodyMesh::Flat { triangles, thickness },
            })
        }
        // A body of a program's own, whose triangles are what they are.
        BodyMesh::Quadratic { .. } => Ok(mesh),
    }
}

fn in_plane(scene: &Scene, mesh: SurfaceMesh) -> Result<SurfaceMesh, SceneError> {
    let mesh = scale(mesh, scene.mesh.scale);
    let source = source(scene);
    fem_mesh::check_plane(&mesh, &source).map_err(|error| mesh_error(scene, "mesh", error))?;
    if scene.mesh.refine == 0 {
        return Ok(mesh);
    }
    let refined = fem_mesh::refine_triangles(mesh, scene.mesh.refine, &source);
    let checked = refined.and_then(|mesh| fem_mesh::check_plane(&mesh, &source).map(|()| mesh));
    checked.map_err(|error| mesh_error(scene, "mesh.refine", error))
}

fn tetrahedra(scene: &Scene, mesh: TetrahedralMesh) -> Result<TetrahedralMesh, SceneError> {
    let mesh = scale(mesh, scene.mesh.scale);
    let source = source(scene);
    fem_mesh::check(&mesh, &source).map_err(|error| mesh_error(scene, "mesh", error))?;
    if scene.mesh.refine == 0 {
        return Ok(mesh);
    }
    let refined = fem_mesh::refine(mesh, scene.mesh.refine, &source);
    // Small elements far from the origin can lose their volume to rounding.
    let checked = refined.and_then(|mesh| fem_mesh::check(&mesh, &source).map(|()| mesh));
    checked.map_err(|error| mesh_error(scene, "mesh.refine", error))
}

/// The name of the mesh in messages.
fn source(scene: &Scene) -> PathBuf {
    match &scene.mesh {
        MeshTable { file: Some(file), .. } | MeshTable { surface: Some(SurfaceTable { file, .. }), .. } => file.clone(),
        MeshTable { files: Some(_), .. } => PathBuf::from("files"),
        MeshTable { picture: Some(picture), .. } => picture.file.clone(),
        MeshTable { rectangle: Some(_), .. } => PathBuf::from("rectangle"),
        _ => PathBuf::from("box"),
    }
}

impl Scene {
    /// Checks the tables again after a change, such as another integrator. Returns the first problem.
    pub fn check(&self) -> Result<(), SceneError> {
        check(self).map_err(|(field, problem)| self.refuse(&field, &problem))
    }

    /// The error of a field, such as `time.integrator`: of its override, or at its line. `problem` continues the sentence that begins with the field.
    pub fn refuse(&self, field: &str, problem: &str) -> SceneError {
        refused(&text(self), self, field, &format!("{field} {problem}"))
    }
}
