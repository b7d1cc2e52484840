//! Marks of painted nodes, picked faces and loads in the picture.

use fem_model::simulation::Shape;
use kiss3d::color::Color;
use kiss3d::glamx::Vec3;
use kiss3d::window::Window;

use super::brush::Target;
use super::{Body, Mode, Setup, loads};
use crate::editing::editor::SceneSetup;
use crate::picture::camera::Camera;
use crate::picture::geometry::single;
use crate::picture::obstacles::draw_arrow;
use crate::picture::theme;

const CORNERS: usize = 40; // of the circle that shows the brush
const MOST_ARROWS: usize = 60; // of a load
const LONGEST_ARROW: f32 = 0.35; // in radii of the body, of a load at the end of the slider

impl Setup {
    /// The picked faces of a solid body, by their nodes.
    pub fn picked_triangles(&self, shape: &Shape) -> Vec<[usize; 3]> {
        if self.mode != Mode::Load || self.loads.faces.is_empty() || shape.mesh.dimension() == 2 {
            return Vec::new();
        }
        let facets = &self.body(shape).facets;
        self.loads.faces.iter().filter_map(|&face| facets.nodes[face][..3].try_into().ok()).collect()
    }

    /// Draws the marks into the next frame.
    pub fn draw(&self, window: &mut Window, shape: &Shape, scene: &SceneSetup, positions: &[Vec3], camera: &Camera) {
        if self.mode == Mode::Pull || positions.len() != shape.mesh.vertices().len() {
            return;
        }
        let body = self.body(shape);
        self.draw_nodes(window, scene, positions, camera);
        for load in 0..scene.conditions.loaded.len() {
            let color = if self.loads.current == Some(load) { theme::PICKED } else { theme::LOAD };
            draw_arrows(window, body, scene, load, color, positions, camera);
        }
        match self.mode {
            Mode::Fix => self.draw_brush(window, body, camera),
            Mode::Load if shape.mesh.dimension() == 2 => self.draw_edges(window, body, positions, camera),
            Mode::Load | Mode::Pull => {}
        }
    }

    fn draw_nodes(&self, window: &mut Window, scene: &SceneSetup, positions: &[Vec3], camera: &Camera) {
        let scale = window.scale_factor() as f32;
        let prescribed = (0..scene.scene.prescribed.len()).map(Target::Prescribed);
        for target in [Target::Fixed].into_iter().chain(prescribed) {
            let is_painted = self.mode == Mode::Fix && self.brush.target == target;
            let nodes = match target {
                _ if is_painted => self.brush.nodes(scene),
                Target::Fixed => scene.conditions.fixed().to_vec(),
                Target::Prescribed(number) => scene.conditions.prescribed(number).to_vec(),
            };
            let color = if target == Target::Fixed { theme::FIXED } else { theme::PRESCRIBED };
            let size = if is_painted { 9.0 } else { 6.0 };
            for node in nodes {
                window.draw_point(camera.nearer(positions[node], 0.01), color, size * scale);
            }
        }
    }

    /// A circle about the point under the mouse, as large as the brush.
    fn draw_brush(&self, window: &mut Window, body: &Body, camera: &Camera) {
        let Some(centre) = self.brush.hover() else { return };
        let radius = self.brush.radius_on(body);
        let (above, right) = (camera.above(), camera.above().cross(camera.direction()));
        let corner = |i: usize| {
            let angle = std::f32::consts::TAU * i as f32 / CORNERS as f32;
            camera.nearer(centre + (right * angle.cos() + above * angle.sin()) * radius, 0.05)
        };
        let color = if self.brush.erases { theme::FORCE } else { theme::FIXED };
        let width = 2.0 * window.scale_factor() as f32;
        for i in 0..CORNERS {
            window.draw_line(corner(i), corner(i + 1), color, width, false);
        }
    }

    fn draw_edges(&self, window: &mut Window, body: &Body, positions: &[Vec3], camera: &Camera) {
        let width = 5.0 * window.scale_factor() as f32;
        for &face in &self.loads.faces {
            let ends = [0, 1].map(|end| camera.nearer(positions[body.facets.nodes[face][end]], 0.01));
            window.draw_line(ends[0], ends[1], theme::PICKED, width, false);
        }
    }
}

/// Arrows of a load, which start at the surface in tension, and end on it in compression.
fn draw_arrows(
    window: &mut Window,
    body: &Body,
    scene: &SceneSetup,
    load: usize,
    color: Color,
    positions: &[Vec3],
    camera: &Camera,
) {
    let faces = loads::loaded_faces(body, scene, load, positions);
    let range = loads::range(scene).max(f64::MIN_POSITIVE);
    let every = faces.len().div_ceil(MOST_ARROWS).max(1);
    for (centre, normal, force) in faces.into_iter().step_by(every) {
        // The square root lets small loads show beside large ones.
        let length = (LONGEST_ARROW * body.radius * (force.norm() / range).sqrt() as f32).min(body.radius);
        let shaft = single(&force.try_normalize(0.0).unwrap_or_default()) * length;
        let outward = camera.nearer(centre, 0.01);
        // Compression is drawn outside too, because the body would hide arrows inside.
        let (tail, tip) = if normal.dot(shaft) < 0.0 { (outward - shaft, outward) } else { (outward, outward + shaft) };
        draw_arrow(window, [tail, tip], 0.06 * body.radius, color, camera);
    }
}
