//! Picking faces of the surface, and the traction along their normal.

use std::collections::BTreeSet;

use fem_scene::tables::TractionTable;
use kiss3d::glamx::{Vec2, Vec3};
use nalgebra::Vector3;

use super::{Body, Pointer};
use crate::editing::change::Change;
use crate::editing::editor::SceneSetup;
use crate::editing::edits::{self, Force};
use crate::editing::parameters::young;
use crate::picture::geometry::double;

/// Largest angle between the normals of a smooth part and of the face that was clicked, degrees.
const ANGLE: f64 = 20.0;
/// Distance from an edge within which a click picks it, pixels.
const REACH: f32 = 14.0;
/// Young's modulus for the range of the slider where the scene gives none, Pa.
const MODULUS: f64 = 1e5;
/// Motion of the mouse with which a drag begins, pixels.
const BEGINS: f32 = 4.0;

/// The picked faces, their traction and the load of the scene that they are.
pub struct Loads {
    /// Numbers of the picked faces.
    pub faces: BTreeSet<usize>,
    /// The `[[traction]]` with these faces; `None` for faces that are not loaded yet.
    pub current: Option<usize>,
    /// Traction along the outward normal, Pa; positive in tension.
    pub traction: f64,
    /// The load follows the deformed surface; otherwise it keeps its direction, the mean normal of the undeformed faces.
    pub follows: bool,
    /// A click picks the smooth part of the surface around a face.
    pub grows: bool,
    /// Largest angle between normals in a smooth part, degrees.
    pub angle: f64,
    pull: Option<Pull>,
}

/// A drag on a face.
struct Pull {
    cursor: Vec2,
    /// Point of the face under the mouse when the drag began, m.
    grip: Vec3,
    /// Direction of the motion that pulls, of unit length: the normal of the face as the picture shows it.
    direction: Vec3,
    /// Traction when the drag began, and its growth per metre of the drag, Pa and Pa/m.
    traction: (f64, f64),
    has_moved: bool,
    /// The press has changed the faces of a load of the scene.
    has_other_faces: bool,
}

impl Default for Loads {
    fn default() -> Self {
        Loads {
            faces: BTreeSet::new(),
            current: None,
            traction: 0.0,
            follows: true,
            grows: true,
            angle: ANGLE,
            pull: None,
        }
    }
}

/// The traction at the end of the slider, Pa: a tenth of Young's modulus.
pub fn range(scene: &SceneSetup) -> f64 {
    0.1 * young(&scene.scene).unwrap_or(MODULUS)
}

impl Loads {
    /// Returns true if faces are picked.
    pub fn is_used(&self) -> bool {
        !self.faces.is_empty() || self.current.is_some()
    }

    /// Picks the face under the mouse, or begins a drag on one that is picked. Returns false beside the body.
    pub(super) fn press(&mut self, body: &Body, pointer: &Pointer) -> bool {
        let ray = pointer.camera.ray(pointer.cursor);
        let pixel = pointer.camera.metres_per_pixel();
        let Some((face, grip)) = body.facets.hit(ray, pointer.positions, REACH * pixel) else { return false };
        let picked = match self.grows {
            true => body.facets.smooth_part(face, self.angle.to_radians()),
            false => BTreeSet::from([face]),
        };
        if pointer.control {
            let is_picked = self.faces.contains(&face);
            if is_picked {
                self.faces.retain(|face| !picked.contains(face));
            } else {
                self.faces.extend(picked);
            }
        } else if !self.faces.contains(&face) {
            self.pick(body, pointer.scene, face, picked);
        }
        let normal = body.facets.centre_and_normal(face, pointer.positions).1;
        self.pull = Some(Pull {
            cursor: pointer.cursor,
            grip,
            direction: in_picture(normal, pointer),
            // With this scale, the end of a loaded bar of the body's length would follow the mouse.
            traction: (self.traction, 10.0 * range(pointer.scene) / f64::from(2.0 * body.radius)),
            has_moved: false,
            has_other_faces: pointer.control && self.current.is_some(),
        });
        true
    }

    /// Picks the load of a face, or else faces without one.
    fn pick(&mut self, body: &Body, scene: &SceneSetup, face: usize, faces: BTreeSet<usize>) {
        let numbers = |load: &Vec<Vec<usize>>| load.iter().filter_map(|face| body.facets.number(face)).collect();
        let loads: Vec<BTreeSet<usize>> = scene.conditions.loaded.iter().map(numbers).collect();
        match loads.iter().position(|load| load.contains(&face)) {
            Some(load) => self.choose(body, scene, load),
            None => (self.faces, self.current, self.traction) = (faces, None, 0.0),
        }
    }

    /// Picks the faces of a load of the scene.
    pub fn choose(&mut self, body: &Body, scene: &SceneSetup, load: usize) {
        let faces = scene.conditions.loaded.get(load).into_iter().flatten();
        self.faces = faces.filter_map(|face| body.facets.number(face)).collect();
        self.current = Some(load);
        self.settle(body, scene);
    }

    /// Changes the traction during a drag; returns whether the scene changes.
    pub(super) fn moved(&mut self, pointer: &Pointer) -> bool {
        let Some(pull) = &mut self.pull else { return false };
        pull.has_moved |= pointer.cursor.distance(pull.cursor) > BEGINS;
        if !pull.has_moved {
            return false;
        }
        let offset = pointer.camera.on_plane(pointer.cursor, pull.grip) - pull.grip;
        let (start, growth) = pull.traction;
        self.traction = start + growth * f64::from(offset.dot(pull.direction));
        true
    }

    /// Ends a drag; returns whether the scene changes.
    pub(super) fn release(&mut self) -> bool {
        self.pull.take().is_some_and(|pull| pull.has_other_faces)
    }

    /// The change of the scene that gives the picked faces their traction, or the reason why there is none.
    pub(super) fn change(&mut self, body: &Body, scene: &SceneSetup) -> Result<Change, String> {
        if self.faces.is_empty() && self.current.is_none() {
            return Err("no face is picked; click on the surface first".to_owned());
        }
        let force = match self.follows {
            true => Force::Pressure(0.0 - self.traction),
            false => {
                let normal = body.facets.mean_normal(&self.faces);
                let normal = normal.ok_or(
                    "the picked faces have no common normal for a load that keeps its direction; let it follow the surface",
                )?;
                Force::PerArea((normal * self.traction).into())
            }
        };
        let faces: Vec<&[usize]> = self.faces.iter().map(|&face| &body.facets.nodes[face][..]).collect();
        let number = self.current.unwrap_or(scene.scene.traction.len());
        self.current = (!faces.is_empty()).then_some(number);
        Ok(Change::Edit(edits::load(&scene.scene, number, &faces, force)))
    }

    /// Removes the load from the scene; the faces stay picked.
    pub fn remove(&mut self) -> Option<Change> {
        self.traction = 0.0;
        self.current.take().map(|load| Change::Edit(edits::without_load(load)))
    }

    /// Takes over the load of the scene once all changes are done.
    pub(super) fn settle(&mut self, body: &Body, scene: &SceneSetup) {
        if self.pull.is_some() {
            return;
        }
        let Some(load) = self.current else { return };
        let Some(table) = scene.scene.traction.get(load) else {
            (self.current, self.traction) = (None, 0.0); // it was refused
            return;
        };
        self.follows = table.pressure.is_some();
        self.traction = along_normal(table, body.facets.mean_normal(&self.faces));
    }
}

/// The traction of a load along the outward normal, Pa.
fn along_normal(table: &TractionTable, normal: Option<Vector3<f64>>) -> f64 {
    match (table.pressure, table.force_per_area) {
        (Some(pressure), _) => 0.0 - pressure,
        (_, Some(force)) => normal.map_or(0.0, |normal| normal.dot(&Vector3::from(force))),
        (None, None) => 0.0,
    }
}

/// The direction in the plane of the picture in which a normal points; upwards if it points at the eye.
fn in_picture(normal: Vec3, pointer: &Pointer) -> Vec3 {
    let to_eye = pointer.camera.direction();
    let lateral = normal - to_eye * normal.dot(to_eye);
    if lateral.length() > 0.1 { lateral.normalize() } else { pointer.camera.above() }
}

/// A load on a face: the centre (m) and outward unit normal of the face now, and the force per area, Pa.
pub type LoadedFace = (Vec3, Vec3, Vector3<f64>);

/// The faces of a load. `positions` are those of the nodes now, m.
pub fn loaded_faces(body: &Body, scene: &SceneSetup, load: usize, positions: &[Vec3]) -> Vec<LoadedFace> {
    let (Some(table), Some(faces)) = (scene.scene.traction.get(load), scene.conditions.loaded.get(load)) else {
        return Vec::new();
    };
    let loaded = |face: &Vec<usize>| {
        let (centre, normal) = body.facets.centre_and_normal(body.facets.number(face)?, positions);
        let force = match (table.pressure, table.force_per_area) {
            (Some(pressure), _) => double(normal) * -pressure,
            (_, force) => Vector3::from(force?),
        };
        Some((centre, normal, force))
    };
    faces.iter().filter_map(loaded).collect()
}
