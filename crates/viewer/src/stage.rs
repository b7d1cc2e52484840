//! What is drawn: the body, the floor and the shadow on it. Window and pictures share it.

use std::cell::RefCell;
use std::rc::Rc;

use fem_scene::simulation::Shape;
use kiss3d::color::Color;
use kiss3d::glamx::Vec3;
use kiss3d::resource::GpuMesh3d;
use kiss3d::scene::SceneNode3d;
use kiss3d::window::Window;

use crate::geometry::{Bounds, edges, faces, first_hit, level_axes, single, smooth_normals};
use crate::matte::{Kind, Shared, Surroundings, matte};
use crate::theme;

/// Which of a body's two surfaces is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shown {
    /// The display surface, moved by the simulation; the simulation mesh where a scene has none.
    #[default]
    Skinned,
    /// The boundary of the simulation mesh, with its edges.
    SimulationMesh,
}

/// The body and its surroundings.
pub struct Stage {
    /// What the drawing library draws.
    pub root: SceneNode3d,
    skin: Option<Surface>,
    mesh: Surface,
    edges: Vec<[usize; 2]>,
    shown: Shown,
    bounds: Bounds,
    floor: SceneNode3d,
    surroundings: Rc<RefCell<Surroundings>>,
}

impl Stage {
    /// Sets the stage for a body at rest. Needs the drawing library's window or picture to exist.
    pub fn new(shape: &Shape, up: Vec3) -> Self {
        let mut root = SceneNode3d::empty();
        let nodes: Vec<Vec3> = shape.mesh.vertices.iter().map(single).collect();
        let shown: Vec<Vec3> = match &shape.display {
            Some(display) => display.vertices.iter().map(single).collect(),
            None => nodes.clone(),
        };
        let bounds = Bounds::of(&shown);
        let surroundings = Rc::new(RefCell::new(surroundings(&bounds, up)));
        let floor = floor(&surroundings.borrow(), matte(Kind::Floor, &surroundings));
        root.add_child(floor.clone());
        let paint = [matte(Kind::Body, &surroundings), matte(Kind::Shadow, &surroundings)];
        let skin =
            shape.display.as_ref().map(|d| Surface::new(&mut root, &shown, &d.elements, Shading::Smooth, &paint));
        let mesh = Surface::new(&mut root, &nodes, &shape.boundary, Shading::Flat, &paint);
        let edges = edges(&shape.boundary);
        let mut stage = Stage { root, skin, mesh, edges, shown: Shown::Skinned, bounds, floor, surroundings };
        stage.show(Shown::Skinned);
        stage
    }

    /// The box around the body at rest.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Whether there are two surfaces to show.
    pub fn has_skin(&self) -> bool {
        self.skin.is_some()
    }

    /// Which surface is shown.
    pub fn shown(&self) -> Shown {
        self.shown
    }

    /// Shows one of the two surfaces; the simulation mesh where there is no other.
    pub fn show(&mut self, shown: Shown) {
        self.shown = if self.skin.is_some() { shown } else { Shown::SimulationMesh };
        if let Some(skin) = &mut self.skin {
            skin.set_visible(self.shown == Shown::Skinned);
        }
        self.mesh.set_visible(self.shown == Shown::SimulationMesh);
    }

    /// Moves the shown surface to where the body is now, and gives the box around it.
    pub fn place(&mut self, positions: &[Vec3], display: &[Vec3]) -> Bounds {
        let shown = match (&mut self.skin, self.shown) {
            (Some(skin), Shown::Skinned) => skin.place(display),
            _ => self.mesh.place(positions),
        };
        self.lower_floor(&shown);
        shown
    }

    /// The floor makes room for a body that comes lower than it, and stays there.
    fn lower_floor(&mut self, body: &Bounds) {
        let mut surroundings = self.surroundings.borrow_mut();
        let lowest = floor_under(body, surroundings.up, surroundings.radius);
        if lowest < surroundings.floor {
            let up = surroundings.up;
            self.floor.modify_vertices(&mut |corners| {
                corners.iter_mut().for_each(|corner| *corner += up * (lowest - surroundings.floor));
            });
            surroundings.floor = lowest;
        }
    }

    /// Distance along a ray to the shown surface, m.
    pub fn hit(&self, origin: Vec3, ray: Vec3, positions: &[Vec3], display: &[Vec3]) -> Option<f32> {
        match (&self.skin, self.shown) {
            (Some(skin), Shown::Skinned) => first_hit(origin, ray, display, &skin.triangles),
            _ => first_hit(origin, ray, positions, &self.mesh.triangles),
        }
    }

    /// Draws the edges of the simulation mesh into the next frame, where that is shown.
    pub fn draw_edges(&self, window: &mut Window, positions: &[Vec3], eye: Vec3) {
        if self.shown == Shown::SimulationMesh {
            // A little towards the eye, so that the faces do not hide them.
            let nearer = |i: usize| positions[i] + (eye - positions[i]) * 2e-3;
            let width = theme::EDGE_WIDTH * window.scale_factor() as f32;
            for &[a, b] in &self.edges {
                window.draw_line(nearer(a), nearer(b), theme::EDGE, width, false);
            }
        }
    }
}

/// How the triangles of a surface are lit.
#[derive(Clone, Copy, PartialEq)]
enum Shading {
    /// As if they were curved.
    Smooth,
    /// Each as the plane that it is.
    Flat,
}

/// Triangles that move, and their shadow.
struct Surface {
    node: SceneNode3d,
    shadow: SceneNode3d,
    mesh: Rc<RefCell<GpuMesh3d>>,
    triangles: Vec<[usize; 3]>,
    faces: Vec<[u32; 3]>,
    shading: Shading,
}

impl Surface {
    fn new(
        root: &mut SceneNode3d,
        points: &[Vec3],
        triangles: &[[usize; 3]],
        shading: Shading,
        [body, shadow]: &[Shared; 2],
    ) -> Self {
        let triangles = triangles.to_vec();
        let faces = match shading {
            Shading::Smooth => faces(&triangles),
            // Each triangle has its own three corners, because each corner has a normal for every triangle.
            Shading::Flat => (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        };
        let coords = corners(points, &triangles, shading);
        let normals = smooth_normals(&coords, &faces);
        let mesh = Rc::new(RefCell::new(GpuMesh3d::new(coords, faces.clone(), Some(normals), None, true)));
        let color = if shading == Shading::Smooth { theme::CLAY } else { theme::MESH };
        let mut add = |material: &Shared, color: Color| {
            let mut node = SceneNode3d::mesh(Rc::clone(&mesh), Vec3::ONE);
            node.set_material(Rc::clone(material)).set_color(color);
            root.add_child(node.clone());
            node
        };
        let (node, shadow) = (add(body, color), add(shadow, theme::SHADOW));
        Surface { node, shadow, mesh, triangles, faces, shading }
    }

    fn set_visible(&mut self, visible: bool) {
        self.node.set_visible(visible);
        self.shadow.set_visible(visible);
    }

    /// Moves the corners, and gives the box around them.
    fn place(&mut self, points: &[Vec3]) -> Bounds {
        let coords = corners(points, &self.triangles, self.shading);
        let bounds = Bounds::of(&coords);
        let normals = smooth_normals(&coords, &self.faces);
        let mesh = self.mesh.borrow();
        if let Ok(mut buffer) = mesh.coords().write() {
            *buffer.data_mut() = Some(coords);
        }
        if let Ok(mut buffer) = mesh.normals().write() {
            *buffer.data_mut() = Some(normals);
        }
        bounds
    }
}

fn corners(points: &[Vec3], triangles: &[[usize; 3]], shading: Shading) -> Vec<Vec3> {
    match shading {
        Shading::Smooth => points.to_vec(),
        Shading::Flat => triangles.iter().flatten().map(|&i| points[i]).collect(),
    }
}

fn surroundings(bounds: &Bounds, up: Vec3) -> Surroundings {
    let (right, front) = level_axes(up);
    let (centre, radius) = (bounds.center(), bounds.radius());
    Surroundings { up, right, front, floor: floor_under(bounds, up, radius), centre, radius }
}

/// Height along `up` of a floor under `bounds`, m.
fn floor_under(bounds: &Bounds, up: Vec3, radius: f32) -> f32 {
    bounds.corners().into_iter().map(|corner| corner.dot(up)).fold(f32::INFINITY, f32::min) - 0.01 * radius
}

/// A square so large that it has faded into the background before it ends.
fn floor(surroundings: &Surroundings, material: Shared) -> SceneNode3d {
    let Surroundings { up, right, front, floor, centre, radius } = *surroundings;
    let middle = centre + up * (floor - centre.dot(up));
    let (right, front) = (right * 40.0 * radius, front * 40.0 * radius);
    let corners = [-right - front, right - front, right + front, front - right].map(|c| middle + c).to_vec();
    let mesh = GpuMesh3d::new(corners, vec![[0, 2, 1], [0, 3, 2]], Some(vec![up; 4]), None, true);
    let mut node = SceneNode3d::mesh(Rc::new(RefCell::new(mesh)), Vec3::ONE);
    node.set_material(material).set_color(theme::FLOOR);
    node
}

/// What a window needs to know once, before the first frame.
pub fn prepare(window: &mut Window) {
    window.set_background_color(theme::BACKGROUND);
    window.set_shadows_enabled(false); // the material throws its own
}
