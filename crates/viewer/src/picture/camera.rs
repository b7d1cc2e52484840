//! The camera: view and projection matrices, and rays through pixels. It orbits a solid body, and looks at a flat one from the front.
//!
//! Its projection is OpenGL's (clip depth −1…1), which kiss3d expects of a camera.

use fem_model::simulation::{Click, Shape};
use kiss3d::camera::Camera3d;
use kiss3d::event::WindowEvent;
use kiss3d::glamx::{Mat4, Pose3, Vec2, Vec3};
use kiss3d::window::Canvas;
use nalgebra::{Matrix4, Vector3, Vector4};

use super::geometry::{Bounds, level_axes};

const FIELD_OF_VIEW: f32 = 0.6; // rad, vertical
const FIRST_YAW: f32 = 0.45; // rad, a little from the side: shows depth
const FIRST_PITCH: f32 = 0.22; // rad, a little from above
const STEEPEST_PITCH: f32 = 1.5; // rad, less than straight up, where the direction to the right is not defined
const MARGIN: f32 = 1.12; // body to picture edge, as a factor on the distance
const RADIANS_PER_PIXEL: f32 = 0.006;

/// The kind of view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// In perspective, turning around the target.
    Orbit,
    /// Orthographic, from positive z, without rotation: for flat bodies.
    Front,
}

impl View {
    /// The view of a body.
    pub fn of(shape: &Shape) -> Self {
        if shape.mesh.dimension() == 2 { View::Front } else { View::Orbit }
    }
}

/// A camera that looks at a target.
#[derive(Clone, Debug)]
pub struct Camera {
    view: View,
    /// The point looked at, m.
    target: Vec3,
    /// Distance from the target to the eye, m.
    distance: f32,
    /// Angle around `up`, rad.
    yaw: f32,
    /// Angle above the horizon, rad.
    pitch: f32,
    /// Direction that is up in the picture, unit length.
    up: Vec3,
    /// Half of the diagonal of the framed box, m; near and far planes are multiples of it.
    radius: f32,
    /// Width and height of the picture, physical pixels.
    size: Vec2,
    /// Width of the part at the left that the panel covers, pixels; the target is drawn in the middle of the rest.
    covered: f32,
}

impl Camera {
    /// A camera with all of `bounds` in the uncovered part of a picture of `size` pixels.
    pub fn framing(view: View, bounds: &Bounds, up: Vec3, size: Vec2, covered: f32) -> Self {
        let up = match view {
            View::Orbit => up,
            View::Front => Vec3::new(up.x, up.y, 0.0), // up lies in the picture
        };
        let up = up.try_normalize().unwrap_or(Vec3::Y);
        let (yaw, pitch) = match view {
            View::Orbit => (FIRST_YAW, FIRST_PITCH),
            View::Front => (0.0, 0.0),
        };
        let mut camera = Camera {
            view,
            target: bounds.centre(),
            distance: 1.0,
            yaw,
            pitch,
            up,
            radius: bounds.radius(),
            size,
            covered,
        };
        camera.distance = MARGIN * camera.distance_for(bounds);
        camera
    }

    /// The smallest distance at which every corner of `bounds` is inside the picture, m.
    fn distance_for(&self, bounds: &Bounds) -> f32 {
        let towards_eye = self.direction();
        let (right, above) = (self.right(), self.above());
        let vertical = (FIELD_OF_VIEW / 2.0).tan();
        let horizontal = vertical * (self.size.x - self.covered).max(1.0) / self.size.y;
        let needed = |corner: Vec3| {
            let from_target = corner - self.target;
            let lateral = f32::max(from_target.dot(right).abs() / horizontal, from_target.dot(above).abs() / vertical);
            match self.view {
                View::Orbit => from_target.dot(towards_eye) + lateral,
                View::Front => lateral,
            }
        };
        bounds.corners().into_iter().map(needed).fold(self.radius, f32::max)
    }

    /// Returns true if the camera turns around its target.
    pub fn turns(&self) -> bool {
        self.view == View::Orbit
    }

    /// Orbits the target by a mouse motion of `pixels` (right, down); a view from the front stays.
    pub fn orbit(&mut self, pixels: Vec2) {
        if !self.turns() {
            return;
        }
        self.yaw -= pixels.x * RADIANS_PER_PIXEL;
        self.pitch = (self.pitch + pixels.y * RADIANS_PER_PIXEL).clamp(-STEEPEST_PITCH, STEEPEST_PITCH);
    }

    /// Moves parallel to the picture so that the target follows a mouse motion of `pixels` (right, down).
    pub fn pan(&mut self, pixels: Vec2) {
        let metres_per_pixel = self.metres_per_pixel();
        let (right, above) = (self.right(), self.above());
        self.target += (above * pixels.y - right * pixels.x) * metres_per_pixel;
    }

    /// Moves towards the target (positive) or away from it, by notches of the mouse wheel; a view from the front keeps the point under
    /// `cursor` in its place.
    pub fn zoom(&mut self, notches: f32, cursor: Vec2) {
        let before = self.on_plane(cursor, self.target);
        let distance = self.distance * 0.9_f32.powf(notches);
        self.distance = distance.clamp(0.05 * self.radius, 50.0 * self.radius);
        if self.view == View::Front {
            self.target += before - self.on_plane(cursor, self.target);
        }
    }

    /// Sets the size of the picture and the width of its covered part, physical pixels.
    pub fn resize(&mut self, size: Vec2, covered: f32) {
        self.size = size.max(Vec2::ONE);
        self.covered = covered.clamp(0.0, 0.8 * self.size.x);
    }

    /// Unit vector from the target to the eye.
    pub fn direction(&self) -> Vec3 {
        if self.view == View::Front {
            return Vec3::Z;
        }
        let (right, front) = level_axes(self.up);
        let level = front * self.yaw.cos() + right * self.yaw.sin();
        level * self.pitch.cos() + self.up * self.pitch.sin()
    }

    /// A point moved towards the eye by a part of its distance, so that the surface at the point does not hide it.
    pub fn nearer(&self, point: Vec3, part: f32) -> Vec3 {
        match self.view {
            View::Orbit => point + (self.eye() - point) * part,
            View::Front => point + Vec3::Z * (self.distance * part),
        }
    }

    /// Size of a pixel in the plane of the target, m.
    pub fn metres_per_pixel(&self) -> f32 {
        2.0 * self.distance * (FIELD_OF_VIEW / 2.0).tan() / self.size.y
    }

    /// Unit vector that points upwards in the picture.
    pub fn above(&self) -> Vec3 {
        self.direction().cross(self.right())
    }

    /// Unit vector to the right of the picture.
    fn right(&self) -> Vec3 {
        self.up.cross(self.direction()).normalize()
    }

    /// Projection matrix: eye to clip space, depth −1…1.
    fn projection(&self) -> Mat4 {
        let focal = 1.0 / (FIELD_OF_VIEW / 2.0).tan();
        let mut columns = [[0.0; 4]; 4];
        columns[0][0] = focal * self.size.y / self.size.x;
        columns[1][1] = focal;
        let shift = self.covered / self.size.x; // of the target, out of the covered part
        match self.view {
            View::Orbit => {
                let (near, far) = self.clip_planes();
                columns[2][0] = -shift;
                columns[2][2] = (far + near) / (near - far);
                columns[2][3] = -1.0;
                columns[3][2] = 2.0 * far * near / (near - far);
            }
            View::Front => {
                columns[0][0] /= self.distance;
                columns[1][1] /= self.distance;
                // The graphics card draws depths from 0 to 1: those between the eye and twice the target's distance.
                columns[2][2] = -0.5 / self.distance;
                columns[3][0] = shift;
                columns[3][3] = 1.0;
            }
        }
        Mat4::from_cols_array_2d(&columns)
    }

    /// The click at `cursor` (pixels from the upper left), in OpenGL's conventions.
    pub fn click(&self, cursor: Vec2) -> Click {
        Click {
            win: Vector3::new(f64::from(cursor.x), f64::from(self.size.y - cursor.y), 0.0),
            view: Matrix4::from_column_slice(&self.view_transform().to_mat4().to_cols_array()),
            proj: Matrix4::from_column_slice(&self.projection().to_cols_array()),
            viewport: Vector4::new(0.0, 0.0, self.size.x, self.size.y),
        }
    }

    /// The ray through `cursor` (pixels from the upper left): where it begins, and its direction, of unit length.
    pub fn ray(&self, cursor: Vec2) -> (Vec3, Vec3) {
        let centre = Vec2::new((self.size.x + self.covered) / 2.0, self.size.y / 2.0);
        let from_centre = (cursor - centre) * 2.0 * (FIELD_OF_VIEW / 2.0).tan() / self.size.y;
        let (right, above) = (self.right(), self.above());
        let lateral = right * from_centre.x - above * from_centre.y;
        match self.view {
            View::Orbit => (self.eye(), (lateral - self.direction()).normalize()),
            View::Front => (self.eye() + lateral * self.distance, -self.direction()),
        }
    }

    /// Intersection of the ray through `cursor` with the plane through `point` parallel to the picture.
    pub fn on_plane(&self, cursor: Vec2, point: Vec3) -> Vec3 {
        let (origin, ray) = self.ray(cursor);
        let normal = self.direction();
        origin + ray * ((point - origin).dot(normal) / ray.dot(normal))
    }
}

impl Camera3d for Camera {
    // The window handles the mouse itself, because a drag may belong to the body.
    fn handle_event(&mut self, _: &Canvas, event: &WindowEvent) {
        if let WindowEvent::FramebufferSize(width, height) = *event {
            self.resize(Vec2::new(width as f32, height as f32), self.covered);
        }
    }

    fn eye(&self) -> Vec3 {
        self.target + self.direction() * self.distance
    }

    fn view_transform(&self) -> Pose3 {
        Pose3::look_at_rh(self.eye(), self.target, self.up)
    }

    fn transformation(&self) -> Mat4 {
        self.projection() * self.view_transform().to_mat4()
    }

    fn inverse_transformation(&self) -> Mat4 {
        self.transformation().inverse()
    }

    fn clip_planes(&self) -> (f32, f32) {
        match self.view {
            View::Orbit => (0.02 * self.distance, self.distance + 60.0 * self.radius),
            View::Front => (0.0, 2.0 * self.distance),
        }
    }

    fn update(&mut self, _: &Canvas) {}

    fn view_transform_pair(&self, _: usize) -> (Pose3, Mat4) {
        (self.view_transform(), self.projection())
    }
}

#[cfg(test)]
mod tests;
