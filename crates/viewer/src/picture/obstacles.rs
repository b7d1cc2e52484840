//! Pictures of obstacles and of their forces: hatched lines beside a flat body, faces with grids beside a solid one, arrows at nodes.

use std::cell::RefCell;
use std::rc::Rc;

use fem_model::simulation::Plane;
use kiss3d::color::Color;
use kiss3d::glamx::Vec3;
use kiss3d::resource::GpuMesh3d;
use kiss3d::scene::SceneNode3d;
use kiss3d::window::Window;

use super::camera::Camera;
use super::frame::Frame;
use super::geometry::{Bounds, level_axes, single};
use super::shader::Shared;
use super::surface::{add, move_corners};
use super::theme;

const REACH: f32 = 1.8; // of a face beyond the body's centre, in radii of the body
const LINE_REACH: f32 = 8.0; // half of a line's length, in radii
const HATCHES: f32 = 0.1; // distance between hatches, in radii
const CELL: f32 = 0.5; // side of a cell of a face's grid, in radii
const MOST_LINES: usize = 100; // of a grid, in each direction
const LONGEST_ARROW: f32 = 1.2; // in radii

/// A plane in single precision.
#[derive(Clone, Copy)]
struct HalfSpace {
    point: Vec3,
    normal: Vec3,
}

fn planes(planes: &[Plane]) -> Vec<HalfSpace> {
    planes.iter().map(|plane| HalfSpace { point: single(&plane.point), normal: single(&plane.normal) }).collect()
}

/// The box around a body at rest and the nearest points of the obstacles that are not far away, m.
pub fn arena(body: &Bounds, obstacles: &[Plane]) -> Bounds {
    let (centre, radius) = (body.centre(), body.radius());
    let hatched = 3.0 * HATCHES * radius; // room for hatches, and some for arrows
    let height = |plane: &HalfSpace| plane.normal.dot(centre - plane.point) + hatched;
    let nearest = planes(obstacles).into_iter().map(|plane| centre - plane.normal * height(&plane));
    let near = nearest.filter(|point| point.distance(centre) < 12.0 * radius);
    near.fold(*body, |arena, point| arena.joined(&Bounds { low: point, high: point }))
}

/// The faces of the obstacles of a solid body.
pub struct Faces {
    mesh: Rc<RefCell<GpuMesh3d>>,
    /// Corners of each face. All faces have the same number of corners, of which the last are repeated.
    corners: Vec<Vec<Vec3>>,
}

impl Faces {
    /// Adds the faces of so many planes to the scene graph.
    pub fn new(root: &mut SceneNode3d, planes: usize, material: Shared) -> Self {
        let corners = corners_of_face(planes);
        let fan = |face: usize| (2..corners).map(move |i| [face * corners, face * corners + i - 1, face * corners + i]);
        let triangles: Vec<[u32; 3]> = (0..planes).flat_map(fan).map(|t| t.map(|i| i as u32)).collect();
        let points = vec![Vec3::ZERO; planes * corners];
        let normals = vec![Vec3::Y; points.len()];
        let mesh = Rc::new(RefCell::new(GpuMesh3d::new(points, triangles, Some(normals), None, true)));
        add(root, &mesh, &material, theme::FACE);
        Faces { mesh, corners: Vec::new() }
    }

    /// Moves the faces to the planes, and lets them reach to the body. `rest` is the box of the body at rest.
    pub fn update(&mut self, planes: &[Plane], rest: &Bounds, body: &Bounds) {
        let reach = REACH * rest.radius() + (body.centre() - rest.centre()).length();
        let corners = faces(planes, rest.centre(), reach);
        if corners != self.corners {
            let normal = |plane: &Plane| vec![single(&plane.normal); corners_of_face(planes.len())];
            move_corners(&self.mesh, corners.concat(), planes.iter().flat_map(normal).collect());
            self.corners = corners;
        }
    }

    /// Draws outlines of the faces, and grids on those that are seen from the body's side, into the next frame. `radius` is that of the
    /// body at rest, m.
    pub fn draw_grids(&self, window: &mut Window, obstacles: &[Plane], eye: Vec3, radius: f32) {
        let width = window.scale_factor() as f32;
        for (face, plane) in self.corners.iter().zip(planes(obstacles)) {
            for (i, &from) in face.iter().enumerate() {
                window.draw_line(from, face[(i + 1) % face.len()], theme::OBSTACLE, 1.5 * width, false);
            }
            if plane.normal.dot(eye - plane.point) < 0.0 {
                continue;
            }
            let (right, front) = level_axes(plane.normal);
            for (across, along) in [(right, front), (front, right)] {
                for [from, to] in grid_lines(face, across, along, CELL * radius) {
                    window.draw_line(from, to, theme::GRID_LINE, width, false);
                }
            }
        }
    }
}

/// Largest number of corners of a face among so many planes: each other one cuts off a corner.
fn corners_of_face(planes: usize) -> usize {
    3 + planes
}

/// The corners of the faces that show the planes about `middle`, as far as `reach` (m), cut off behind other planes.
fn faces(obstacles: &[Plane], middle: Vec3, reach: f32) -> Vec<Vec<Vec3>> {
    let all = planes(obstacles);
    let face = |(number, plane): (usize, &HalfSpace)| {
        let centre = middle - plane.normal * plane.normal.dot(middle - plane.point);
        let (right, front) = level_axes(plane.normal);
        let reach = reach + (centre - middle).length();
        let (right, front) = (right * reach, front * reach);
        let square = [-right - front, right - front, right + front, front - right].map(|corner| centre + corner);
        let others = all.iter().enumerate().filter(|(other, _)| *other != number).map(|(_, plane)| plane);
        let mut face = others.fold(square.to_vec(), |face, plane| cut(&face, plane));
        let last = face.last().copied().unwrap_or(centre);
        face.resize(corners_of_face(all.len()), last);
        face
    };
    all.iter().enumerate().map(face).collect()
}

/// The part of a convex polygon in front of a plane: Sutherland and Hodgman, Reentrant Polygon Clipping (1974).
fn cut(polygon: &[Vec3], plane: &HalfSpace) -> Vec<Vec3> {
    let height = |point: Vec3| plane.normal.dot(point - plane.point);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &from) in polygon.iter().enumerate() {
        let to = polygon[(i + 1) % polygon.len()];
        let (a, b) = (height(from), height(to));
        if a >= 0.0 {
            kept.push(from);
        }
        if (a >= 0.0) != (b >= 0.0) {
            kept.push(from + (to - from) * (a / (a - b)));
        }
    }
    kept
}

/// Lines along one direction on a convex face, at multiples of `cell` (m) across another.
fn grid_lines(face: &[Vec3], across: Vec3, along: Vec3, cell: f32) -> Vec<[Vec3; 2]> {
    let extent = |direction: Vec3| {
        let places = face.iter().map(|corner| corner.dot(direction));
        places.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), place| (low.min(place), high.max(place)))
    };
    let ((low, high), (from, to)) = (extent(across), extent(along));
    let Some(&corner) = face.first() else { return Vec::new() };
    let line = |i: i32| {
        let start = corner + across * (i as f32 * cell - corner.dot(across)) + along * (from - corner.dot(along));
        inside(face, start, along * (to - from))
    };
    let (first, last) = ((low / cell).ceil() as i32, (high / cell).floor() as i32);
    (first..=last).take(MOST_LINES).filter_map(line).collect()
}

/// The part of a segment inside a convex polygon of the same plane.
fn inside(polygon: &[Vec3], start: Vec3, step: Vec3) -> Option<[Vec3; 2]> {
    let centre = polygon.iter().sum::<Vec3>() / polygon.len() as f32;
    let (mut first, mut last) = (0.0_f32, 1.0_f32);
    for (i, &from) in polygon.iter().enumerate() {
        let side = polygon[(i + 1) % polygon.len()] - from;
        let inward = (centre - from) - side * ((centre - from).dot(side) / side.length_squared().max(1e-30));
        (first, last) = narrowed((first, last), inward.dot(start - from), inward.dot(step));
    }
    (first < last).then(|| [start + step * first, start + step * last])
}

/// The part of a range of s in which `height + s slope` is not negative.
fn narrowed((first, last): (f32, f32), height: f32, slope: f32) -> (f32, f32) {
    match slope {
        _ if slope > 0.0 => (first.max(-height / slope), last),
        _ if slope < 0.0 => (first, last.min(-height / slope)),
        _ if height < 0.0 => (first, first),
        _ => (first, last),
    }
}

/// Draws the lines in which the obstacles of a flat body meet its plane, hatched behind them, into the next frame.
pub fn draw_hatched_lines(window: &mut Window, obstacles: &[Plane], middle: Vec3, radius: f32) {
    let width = window.scale_factor() as f32;
    let all = planes(obstacles);
    let hatch = HATCHES * radius;
    for (number, plane) in all.iter().enumerate() {
        let others = all.iter().enumerate().filter(|(other, _)| *other != number).map(|(_, plane)| plane);
        let Some([from, to]) = line(plane, others, middle, radius) else { continue };
        window.draw_line(from, to, theme::OBSTACLE, 2.5 * width, false);
        let along = (to - from).normalize_or_zero();
        for i in 1..=((to - from).length() / hatch) as usize {
            let start = from + along * (i as f32 * hatch);
            window.draw_line(start, start - (along + plane.normal) * hatch, theme::OBSTACLE, width, false);
        }
    }
}

/// The part of a plane's line about the point nearest to `middle` that no other plane cuts off; `None` if none is left.
fn line<'a>(
    plane: &HalfSpace,
    others: impl Iterator<Item = &'a HalfSpace>,
    middle: Vec3,
    radius: f32,
) -> Option<[Vec3; 2]> {
    let along = plane.normal.cross(Vec3::Z).normalize_or_zero();
    let centre = middle - plane.normal * plane.normal.dot(middle - plane.point);
    let reach = LINE_REACH * radius;
    let (start, step) = (centre - along * reach, along * (2.0 * reach));
    let cut = |range, other: &HalfSpace| narrowed(range, other.normal.dot(start - other.point), other.normal.dot(step));
    let (first, last) = others.fold((0.0, 1.0), cut);
    (first < last).then(|| [start + step * first, start + step * last])
}

/// Draws the arrows of a frame into the next picture, each with its tip at its node. `radius` is that of the body at rest, m.
pub fn draw_arrows(window: &mut Window, frame: &Frame, camera: &Camera, radius: f32) {
    for &(node, force) in &frame.arrows {
        let Some(&node) = frame.positions.get(node) else { continue };
        let tip = camera.nearer(node, 0.01);
        let tail = tip - force.clamp_length_max(LONGEST_ARROW) * radius;
        draw_arrow(window, [tail, tip], 0.08 * radius, theme::FORCE, camera);
    }
}

/// Draws an arrow whose head is at most so long, m.
pub fn draw_arrow(window: &mut Window, [tail, tip]: [Vec3; 2], longest: f32, color: Color, camera: &Camera) {
    let width = 2.0 * window.scale_factor() as f32;
    let shaft = tip - tail;
    let side = shaft.cross(camera.direction()).normalize_or_zero();
    let head = shaft.normalize_or_zero() * (0.35 * shaft.length()).min(longest);
    for end in [tail, tip - head + side * (0.5 * head.length()), tip - head - side * (0.5 * head.length())] {
        window.draw_line(tip, end, color, width, false);
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    fn plane(point: [f64; 3], normal: [f64; 3]) -> Plane {
        Plane { point: point.into(), normal: Vector3::from(normal).normalize() }
    }

    #[test]
    fn faces_end_where_another_obstacle_begins() {
        let corner = [plane([0.0; 3], [0.0, 1.0, 0.0]), plane([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0])];
        let faces = faces(&corner, Vec3::new(0.0, 0.5, 0.0), 1.0);
        assert!(faces[0].iter().all(|c| c.y.abs() < 1e-6 && c.x >= -1.0 - 1e-6), "{faces:?}");
        assert!(faces[0].iter().any(|c| (c.x + 1.0).abs() < 1e-6));
        assert!(faces[1].iter().all(|c| c.y >= -1e-6 && (c.x + 1.0).abs() < 1e-6));
        assert_eq!([faces[0].len(), faces[1].len()], [5, 5]);
    }

    #[test]
    fn lines_of_a_flat_body_end_where_another_obstacle_begins() {
        let all = planes(&[plane([0.0; 3], [0.0, 1.0, 0.0]), plane([-1.0, 0.0, 0.0], [1.0, 1.0, 0.0])]);
        let [from, to] = line(&all[0], all[1..].iter(), Vec3::Y, 1.0).unwrap();
        let left = if from.x < to.x { from } else { to };
        assert!((left - Vec3::new(-1.0, 0.0, 0.0)).length() < 1e-5, "{left}");
        let behind = planes(&[plane([0.0, 3.0, 0.0], [0.0, 1.0, 0.0])]);
        assert!(line(&all[0], behind.iter(), Vec3::Y, 1.0).is_none());
    }

    #[test]
    fn the_first_view_contains_near_obstacles_and_leaves_out_far_ones() {
        let body = Bounds { low: Vec3::ZERO, high: Vec3::ONE };
        let near = arena(&body, &[plane([0.0, -2.8, 0.0], [0.0, 1.0, 0.0])]);
        assert_eq!((near.low.x, near.high), (0.0, Vec3::ONE));
        assert!(near.low.y < -2.8 && near.low.y > -3.2, "{near:?}");
        assert_eq!(arena(&body, &[plane([0.0, -2800.0, 0.0], [0.0, 1.0, 0.0])]), body);
    }
}
