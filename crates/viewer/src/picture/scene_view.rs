//! The drawn scene: the body, the floor and the shadow on it, or the obstacles. The window and the offscreen renderer share it.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use fem_model::simulation::{Plane, Shape};
use kiss3d::camera::Camera3d;
use kiss3d::glamx::Vec3;
use kiss3d::post_processing::Tonemap;
use kiss3d::resource::GpuMesh3d;
use kiss3d::scene::SceneNode3d;
use kiss3d::window::Window;

use super::camera::{Camera, View};
use super::color_scale::ColorScale;
use super::frame::Frame;
use super::geometry::{Bounds, edges, first_hit, level_axes, single};
use super::obstacles::{self, Faces};
use super::paint::Paint;
use super::shader::{Environment, Kind, Painting, Shared, shader};
use super::surface::{Shading, Surface, add};
use super::theme;

/// The surface of the body that is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DisplayedSurface {
    /// The display surface, skinned to the simulation mesh; the simulation mesh itself if the scene has no display surface.
    #[default]
    Skinned,
    /// The boundary of the simulation mesh, with its edges.
    SimulationMesh,
}

/// The scene graph of a body, its shadow, the floor and the obstacles.
pub struct SceneView {
    /// Root of kiss3d's scene graph.
    pub root: SceneNode3d,
    skin: Option<Surface>,
    mesh: Surface,
    edges: Vec<[usize; 2]>,
    shown: DisplayedSurface,
    bounds: Bounds,
    /// A flat body has none.
    floor: Option<SceneNode3d>,
    obstacles: Option<Faces>,
    environment: Rc<RefCell<Environment>>,
    paint: Paint,
    shape: Arc<Shape>,
    /// Faces in another colour, as their nodes.
    highlight: Option<(Vec<[usize; 3]>, Surface)>,
}

impl SceneView {
    /// The view of a body at rest among obstacles. kiss3d's window or offscreen surface must exist before.
    pub fn new(shape: &Arc<Shape>, planes: &[Plane], up: Vec3) -> Self {
        let mut root = SceneNode3d::empty();
        let nodes: Vec<Vec3> = shape.mesh.vertices().iter().map(single).collect();
        let shown: Vec<Vec3> = match &shape.display {
            Some(display) => display.vertices.iter().map(single).collect(),
            None => nodes.clone(),
        };
        let bounds = Bounds::of(&shown);
        let environment = Rc::new(RefCell::new(environment(&bounds, up)));
        let paint = Paint::default();
        let shader = |kind| shader(kind, &environment, paint.painting());
        let is_solid = shape.mesh.dimension() == 3;
        let floor = is_solid.then(|| floor(&mut root, &environment.borrow(), &shader(Kind::Floor)));
        let body = shader(if is_solid { Kind::Body } else { Kind::Flat });
        let shadow = is_solid.then(|| shader(Kind::Shadow));
        let materials = (&body, shadow.as_ref());
        let skin =
            shape.display.as_ref().map(|d| Surface::new(&mut root, &shown, &d.elements, Shading::Smooth, materials));
        let mesh = Surface::new(&mut root, &nodes, &shape.boundary, Shading::Flat, materials);
        let has_faces = is_solid && !planes.is_empty();
        let obstacles = has_faces.then(|| Faces::new(&mut root, planes.len(), shader(Kind::Obstacle)));
        let edges = element_edges(shape);
        let shape = Arc::clone(shape);
        let (shown, highlight) = (DisplayedSurface::Skinned, None);
        let mut view =
            Self { root, skin, mesh, edges, shown, bounds, floor, obstacles, environment, paint, shape, highlight };
        view.show(DisplayedSurface::Skinned);
        if let (Some(floor), Some(_)) = (&mut view.floor, &view.obstacles) {
            floor.set_visible(false); // it would cut through the obstacles
        }
        view
    }

    /// Bounding box of the body at rest.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Returns true if the body has a display surface beside its simulation mesh.
    pub fn has_skin(&self) -> bool {
        self.skin.is_some()
    }

    /// The displayed surface.
    pub fn shown(&self) -> DisplayedSurface {
        self.shown
    }

    /// The scale of the colours of the last frame, if they show a field.
    pub fn scale(&self) -> Option<&ColorScale> {
        self.paint.scale()
    }

    /// Shows the picture that the body was made from, or plain colours, where no field is shown.
    pub fn show_picture(&mut self, shows_picture: bool) {
        self.paint.show_picture(shows_picture);
    }

    /// Displays one of the two surfaces; the simulation mesh if there is no other.
    pub fn show(&mut self, shown: DisplayedSurface) {
        self.shown = if self.skin.is_some() { shown } else { DisplayedSurface::SimulationMesh };
        self.set_visible();
    }

    /// Only the simulation mesh has elements whose colours show a field.
    fn shows_skin(&self) -> bool {
        self.skin.is_some() && self.shown == DisplayedSurface::Skinned && self.paint.scale().is_none()
    }

    fn set_visible(&mut self) {
        let (skin_shows, has_shadow) = (self.shows_skin(), self.obstacles.is_none());
        if let Some(skin) = &mut self.skin {
            skin.set_visible(skin_shows, has_shadow);
        }
        self.mesh.set_visible(!skin_shows, has_shadow);
    }

    /// Moves the displayed surface to a frame, with its colours, and returns its bounding box.
    pub fn update(&mut self, frame: &Frame) -> Bounds {
        self.paint.apply(frame, &self.shape, &mut self.mesh);
        self.set_visible();
        let shows_skin = self.shows_skin();
        let shown = match &mut self.skin {
            Some(skin) if shows_skin => skin.update(&frame.display),
            _ => self.mesh.update(&frame.positions),
        };
        self.lower_floor(&shown);
        if let Some(obstacles) = &mut self.obstacles {
            obstacles.update(&frame.planes, &self.bounds, &shown);
        }
        shown
    }

    /// Lowers the floor under a body that reaches below it.
    fn lower_floor(&mut self, body: &Bounds) {
        let Some(floor) = &mut self.floor else { return };
        let mut environment = self.environment.borrow_mut();
        let lowest = floor_under(body, environment.up, environment.radius);
        if lowest < environment.floor {
            let up = environment.up;
            floor.modify_vertices(&mut |corners| {
                corners.iter_mut().for_each(|corner| *corner += up * (lowest - environment.floor));
            });
            environment.floor = lowest;
        }
    }

    /// Shows faces of the simulation mesh in another colour, where they are now.
    pub fn highlight(&mut self, faces: Vec<[usize; 3]>, positions: &[Vec3], camera: &Camera) {
        if self.highlight.as_ref().is_some_and(|(shown, _)| *shown != faces) {
            self.highlight.take().into_iter().for_each(|(_, surface)| surface.remove());
        }
        if faces.is_empty() {
            return;
        }
        let nearer: Vec<Vec3> = positions.iter().map(|point| camera.nearer(*point, 1e-3)).collect();
        let (root, environment) = (&mut self.root, &self.environment);
        let (_, surface) = self.highlight.get_or_insert_with(|| {
            let material = shader(Kind::Body, environment, &Painting::default());
            let mut surface = Surface::new(root, &nearer, &faces, Shading::Flat, (&material, None));
            surface.set_color(theme::PICKED);
            (faces, surface)
        });
        surface.update(&nearer);
    }

    /// Distance along a ray to the displayed surface, m.
    pub fn hit(&self, (origin, ray): (Vec3, Vec3), frame: &Frame) -> Option<f32> {
        let hit = match &self.skin {
            Some(skin) if self.shows_skin() => first_hit(origin, ray, &frame.display, &skin.triangles),
            _ => first_hit(origin, ray, &frame.positions, &self.mesh.triangles),
        };
        hit.map(|(_, distance)| distance)
    }

    /// Draws the lines of a frame into the next picture: edges of the simulation mesh if it is displayed without a picture on it,
    /// obstacles, and arrows.
    pub fn draw_lines(&self, window: &mut Window, frame: &Frame, camera: &Camera) {
        if !self.shows_skin() && !self.paint.has_picture() {
            let nearer = |i: usize| camera.nearer(frame.positions[i], 2e-3); // so that the faces do not hide the edges
            let width = theme::EDGE_WIDTH * window.scale_factor() as f32;
            for &[a, b] in &self.edges {
                window.draw_line(nearer(a), nearer(b), theme::EDGE, width, false);
            }
        }
        let radius = self.bounds.radius();
        match &self.obstacles {
            Some(faces) => faces.draw_grids(window, &frame.planes, camera.eye(), radius),
            None => obstacles::draw_hatched_lines(window, &frame.planes, self.bounds.centre(), radius),
        }
        obstacles::draw_arrows(window, frame, camera, radius);
    }
}

/// The edges of the elements on the surface: the triangles between the nodes of a quadratic element have further ones, between middles.
fn element_edges(shape: &Shape) -> Vec<[usize; 2]> {
    let mesh = &shape.mesh;
    let mut is_middle = vec![false; mesh.vertices().len()];
    let middles = (0..mesh.elements()).flat_map(|element| mesh.middles_of(element));
    middles.for_each(|(_, middle)| is_middle[middle] = true);
    let mut edges = edges(&shape.boundary);
    edges.retain(|edge| !edge.iter().all(|&node| is_middle[node]));
    edges
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
fn floor(root: &mut SceneNode3d, environment: &Environment, material: &Shared) -> SceneNode3d {
    let Environment { up, right, front, floor, centre, radius } = *environment;
    let middle = centre + up * (floor - centre.dot(up));
    let (right, front) = (right * 40.0 * radius, front * 40.0 * radius);
    let corners = [-right - front, right - front, right + front, front - right].map(|c| middle + c).to_vec();
    let mesh = GpuMesh3d::new(corners, vec![[0, 2, 1], [0, 3, 2]], Some(vec![up; 4]), None, true);
    add(root, &Rc::new(RefCell::new(mesh)), material, theme::FLOOR)
}

/// Sets up a window before its first frame. Colours of a flat body, which is not lit, are shown as they are.
pub fn prepare(window: &mut Window, view: View) {
    window.set_background_color(theme::BACKGROUND);
    window.set_shadows_enabled(false); // the shader draws its own
    window.set_tonemap(match view {
        View::Orbit => Tonemap::default(),
        View::Front => Tonemap::None,
    });
}
