//! The drawn scene: the body, the floor and the shadow on it. The window and the offscreen renderer share it.

use std::cell::RefCell;
use std::rc::Rc;

use fem_scene::simulation::Shape;
use kiss3d::color::Color;
use kiss3d::glamx::Vec3;
use kiss3d::resource::GpuMesh3d;
use kiss3d::scene::SceneNode3d;
use kiss3d::window::Window;

use crate::geometry::{Bounds, edges, faces, first_hit, level_axes, single, smooth_normals};
use crate::shader::{Environment, Kind, Shared, shader};
use crate::theme;

/// The surface of the body that is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DisplayedSurface {
    /// The display surface, skinned to the simulation mesh; the simulation mesh itself if the scene has no display surface.
    #[default]
    Skinned,
    /// The boundary of the simulation mesh, with its edges.
    SimulationMesh,
}

/// The scene graph of a body, its shadow and the floor.
pub struct SceneView {
    /// Root of kiss3d's scene graph.
    pub root: SceneNode3d,
    skin: Option<Surface>,
    mesh: Surface,
    edges: Vec<[usize; 2]>,
    shown: DisplayedSurface,
    bounds: Bounds,
    floor: SceneNode3d,
    environment: Rc<RefCell<Environment>>,
}

impl SceneView {
    /// The view of a body at rest. kiss3d's window or offscreen surface must exist before.
    pub fn new(shape: &Shape, up: Vec3) -> Self {
        let mut root = SceneNode3d::empty();
        let nodes: Vec<Vec3> = shape.mesh.vertices().iter().map(single).collect();
        let shown: Vec<Vec3> = match &shape.display {
            Some(display) => display.vertices.iter().map(single).collect(),
            None => nodes.clone(),
        };
        let bounds = Bounds::of(&shown);
        let environment = Rc::new(RefCell::new(environment(&bounds, up)));
        let floor = floor(&environment.borrow(), shader(Kind::Floor, &environment));
        root.add_child(floor.clone());
        let paint = [shader(Kind::Body, &environment), shader(Kind::Shadow, &environment)];
        let skin =
            shape.display.as_ref().map(|d| Surface::new(&mut root, &shown, &d.elements, Shading::Smooth, &paint));
        let mesh = Surface::new(&mut root, &nodes, &shape.boundary, Shading::Flat, &paint);
        let edges = edges(&shape.boundary);
        let mut view =
            SceneView { root, skin, mesh, edges, shown: DisplayedSurface::Skinned, bounds, floor, environment };
        view.show(DisplayedSurface::Skinned);
        view
    }

    /// Bounding box of the body at rest.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Whether the body has a display surface beside its simulation mesh.
    pub fn has_skin(&self) -> bool {
        self.skin.is_some()
    }

    /// The displayed surface.
    pub fn shown(&self) -> DisplayedSurface {
        self.shown
    }

    /// Displays one of the two surfaces; the simulation mesh if there is no other.
    pub fn show(&mut self, shown: DisplayedSurface) {
        self.shown = if self.skin.is_some() { shown } else { DisplayedSurface::SimulationMesh };
        if let Some(skin) = &mut self.skin {
            skin.set_visible(self.shown == DisplayedSurface::Skinned);
        }
        self.mesh.set_visible(self.shown == DisplayedSurface::SimulationMesh);
    }

    /// Moves the displayed surface to the current positions, and returns its bounding box.
    pub fn update(&mut self, positions: &[Vec3], display: &[Vec3]) -> Bounds {
        let shown = match (&mut self.skin, self.shown) {
            (Some(skin), DisplayedSurface::Skinned) => skin.update(display),
            _ => self.mesh.update(positions),
        };
        self.lower_floor(&shown);
        shown
    }

    /// Lowers the floor under a body that reaches below it.
    fn lower_floor(&mut self, body: &Bounds) {
        let mut environment = self.environment.borrow_mut();
        let lowest = floor_under(body, environment.up, environment.radius);
        if lowest < environment.floor {
            let up = environment.up;
            self.floor.modify_vertices(&mut |corners| {
                corners.iter_mut().for_each(|corner| *corner += up * (lowest - environment.floor));
            });
            environment.floor = lowest;
        }
    }

    /// Distance along a ray to the displayed surface, m.
    pub fn hit(&self, origin: Vec3, ray: Vec3, positions: &[Vec3], display: &[Vec3]) -> Option<f32> {
        match (&self.skin, self.shown) {
            (Some(skin), DisplayedSurface::Skinned) => first_hit(origin, ray, display, &skin.triangles),
            _ => first_hit(origin, ray, positions, &self.mesh.triangles),
        }
    }

    /// Draws the edges of the simulation mesh into the next frame, if it is displayed.
    pub fn draw_edges(&self, window: &mut Window, positions: &[Vec3], eye: Vec3) {
        if self.shown == DisplayedSurface::SimulationMesh {
            // Slightly towards the eye, so that the faces do not hide the edges.
            let nearer = |i: usize| positions[i] + (eye - positions[i]) * 2e-3;
            let width = theme::EDGE_WIDTH * window.scale_factor() as f32;
            for &[a, b] in &self.edges {
                window.draw_line(nearer(a), nearer(b), theme::EDGE, width, false);
            }
        }
    }
}

/// Shading of a surface.
#[derive(Clone, Copy, PartialEq)]
enum Shading {
    /// Normals are interpolated between vertices.
    Smooth,
    /// Each triangle has its own normal.
    Flat,
}

/// A moving triangle mesh and its shadow.
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
            // Each triangle has three corners of its own, because a corner has one normal.
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

    /// Moves the corners and returns their bounding box.
    fn update(&mut self, points: &[Vec3]) -> Bounds {
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

fn environment(bounds: &Bounds, up: Vec3) -> Environment {
    let (right, front) = level_axes(up);
    let (centre, radius) = (bounds.centre(), bounds.radius());
    Environment { up, right, front, floor: floor_under(bounds, up, radius), centre, radius }
}

/// Height along `up` of a floor under `bounds`, m.
fn floor_under(bounds: &Bounds, up: Vec3, radius: f32) -> f32 {
    bounds.corners().into_iter().map(|corner| corner.dot(up)).fold(f32::INFINITY, f32::min) - 0.01 * radius
}

/// A square large enough to fade into the background before its edges.
fn floor(environment: &Environment, material: Shared) -> SceneNode3d {
    let Environment { up, right, front, floor, centre, radius } = *environment;
    let middle = centre + up * (floor - centre.dot(up));
    let (right, front) = (right * 40.0 * radius, front * 40.0 * radius);
    let corners = [-right - front, right - front, right + front, front - right].map(|c| middle + c).to_vec();
    let mesh = GpuMesh3d::new(corners, vec![[0, 2, 1], [0, 3, 2]], Some(vec![up; 4]), None, true);
    let mut node = SceneNode3d::mesh(Rc::new(RefCell::new(mesh)), Vec3::ONE);
    node.set_material(material).set_color(theme::FLOOR);
    node
}

/// Sets up a window before its first frame.
pub fn prepare(window: &mut Window) {
    window.set_background_color(theme::BACKGROUND);
    window.set_shadows_enabled(false); // the shader draws its own
}
