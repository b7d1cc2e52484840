//! Moving triangle meshes.

use std::cell::RefCell;
use std::rc::Rc;

use kiss3d::color::Color;
use kiss3d::glamx::{Vec2, Vec3};
use kiss3d::resource::GpuMesh3d;
use kiss3d::scene::SceneNode3d;

use super::geometry::{Bounds, faces, smooth_normals};
use super::shader::Shared;
use super::theme;

/// Shading of a surface.
#[derive(Clone, Copy, PartialEq)]
pub enum Shading {
    /// Normals are interpolated between vertices.
    Smooth,
    /// Each triangle has its own normal.
    Flat,
}

/// A moving triangle mesh and its shadow.
pub struct Surface {
    node: SceneNode3d,
    /// A flat body has none.
    shadow: Option<SceneNode3d>,
    mesh: Rc<RefCell<GpuMesh3d>>,
    /// Corners of the triangles.
    pub triangles: Vec<[usize; 3]>,
    faces: Vec<[u32; 3]>,
    shading: Shading,
}

impl Surface {
    /// Adds a surface to the scene graph; `shadow` is the material of its shadow.
    pub fn new(
        root: &mut SceneNode3d,
        points: &[Vec3],
        triangles: &[[usize; 3]],
        shading: Shading,
        (body, shadow): (&Shared, Option<&Shared>),
    ) -> Self {
        let triangles = triangles.to_vec();
        let faces = match shading {
            Shading::Smooth => faces(&triangles),
            // Each triangle has three corners of its own, because a corner has one normal.
            Shading::Flat => (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        };
        let coords = corners(points, &triangles, shading);
        let normals = smooth_normals(&coords, &faces);
        let mesh = Rc::new(RefCell::new(GpuMesh3d::new(coords, faces.clone(), Some(normals), None, true)));
        let color = if shading == Shading::Smooth { theme::CLAY } else { theme::MESH };
        let node = add(root, &mesh, body, color);
        let shadow = shadow.map(|shadow| add(root, &mesh, shadow, theme::SHADOW));
        Surface { node, shadow, mesh, triangles, faces, shading }
    }

    /// Gives the surface another colour.
    pub fn set_color(&mut self, color: Color) {
        self.node.set_color(color);
    }

    /// Removes the surface from the scene graph.
    pub fn remove(mut self) {
        self.node.detach();
        if let Some(mut shadow) = self.shadow {
            shadow.detach();
        }
    }

    /// Shows or hides the surface, and its shadow.
    pub fn set_visible(&mut self, visible: bool, shadow: bool) {
        self.node.set_visible(visible);
        if let Some(node) = &mut self.shadow {
            node.set_visible(visible && shadow);
        }
    }

    /// Sets the texture coordinates of the triangles' corners; `place` returns that of a triangle's corner.
    pub fn set_texture(&mut self, place: impl Fn(usize, usize) -> Vec2) {
        let of_triangle = |i: usize| self.triangles[i].map(|corner| place(i, corner));
        let places: Vec<Vec2> = (0..self.triangles.len()).flat_map(of_triangle).collect();
        if self.shading == Shading::Flat
            && let Ok(mut buffer) = self.mesh.borrow().uvs().write()
        {
            *buffer.data_mut() = Some(places);
        }
    }

    /// Moves the corners and returns their bounding box.
    pub fn update(&mut self, points: &[Vec3]) -> Bounds {
        let coords = corners(points, &self.triangles, self.shading);
        let bounds = Bounds::of(&coords);
        let normals = smooth_normals(&coords, &self.faces);
        move_corners(&self.mesh, coords, normals);
        bounds
    }
}

/// Adds a mesh with a material to the scene graph.
pub fn add(root: &mut SceneNode3d, mesh: &Rc<RefCell<GpuMesh3d>>, material: &Shared, color: Color) -> SceneNode3d {
    let mut node = SceneNode3d::mesh(Rc::clone(mesh), Vec3::ONE);
    node.set_material(Rc::clone(material)).set_color(color);
    root.add_child(node.clone());
    node
}

/// Moves the corners of a mesh, and turns their normals.
pub fn move_corners(mesh: &RefCell<GpuMesh3d>, corners: Vec<Vec3>, normals: Vec<Vec3>) {
    let mesh = mesh.borrow();
    for (buffer, vectors) in [(mesh.coords(), corners), (mesh.normals(), normals)] {
        if let Ok(mut buffer) = buffer.write() {
            *buffer.data_mut() = Some(vectors);
        }
    }
}

fn corners(points: &[Vec3], triangles: &[[usize; 3]], shading: Shading) -> Vec<Vec3> {
    match shading {
        Shading::Smooth => points.to_vec(),
        Shading::Flat => triangles.iter().flatten().map(|&i| points[i]).collect(),
    }
}
