//! Picking a body with a ray.

use bevy::math::{DVec3, Ray3d, Vec3};
use bevy::transform::components::GlobalTransform;
use fem_model::simulation::Shape;
use nalgebra::Vector3;

use crate::surface::{Surface, Topology};

/// The first point of a body on a ray.
#[derive(Clone, Debug, PartialEq)]
pub struct SoftBodyHit {
    /// The point, in the body's frame, m.
    pub point: Vec3,
    /// Its distance from the origin of the ray in the world.
    pub distance: f32,
    /// Nodes within the longest edge of the boundary over √3 from it, or else the nearest one; ascending.
    pub nodes: Vec<usize>,
}

/// The first hit of a ray of the world with a surface, and the nodes near it. `nodes` are their positions now, m.
pub fn pick(
    ray: Ray3d,
    placement: &GlobalTransform,
    (topology, surface): (&Topology, &Surface),
    (shape, nodes): (&Shape, &[DVec3]),
) -> Option<SoftBodyHit> {
    let to_body = placement.affine().inverse();
    let origin = to_body.transform_point3(ray.origin);
    // Not of unit length under a scale, so that distances stay those of the world.
    let direction = to_body.transform_vector3(*ray.direction);
    let corners = |triangle: &[u32; 3]| triangle.map(|vertex| Vec3::from(surface.positions[vertex as usize]));
    let hits = topology.triangles.iter().filter_map(|triangle| hit(origin, direction, corners(triangle)));
    let distance = hits.fold(f32::INFINITY, f32::min);
    if !distance.is_finite() {
        return None;
    }
    let point = origin + distance * direction;
    Some(SoftBodyHit { point, distance, nodes: nodes_near(point.as_dvec3(), shape, nodes) })
}

fn nodes_near(point: DVec3, shape: &Shape, nodes: &[DVec3]) -> Vec<usize> {
    let positions: Vec<_> = nodes.iter().map(|x| Vector3::new(x.x, x.y, x.z)).collect();
    let radius = shape.pick_radius(&positions);
    let near: Vec<usize> = (0..nodes.len()).filter(|&node| nodes[node].distance(point) <= radius).collect();
    if !near.is_empty() {
        return near;
    }
    let distance = |node: &usize| nodes[*node].distance(point);
    (0..nodes.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).into_iter().collect()
}

/// Distance along a ray to a triangle, in lengths of its direction: Möller and Trumbore, Fast, Minimum Storage Ray/Triangle
/// Intersection (1997).
fn hit(origin: Vec3, direction: Vec3, [a, b, c]: [Vec3; 3]) -> Option<f32> {
    let (ab, ac, to_origin) = (b - a, c - a, origin - a);
    let (p, q) = (direction.cross(ac), to_origin.cross(ab));
    let determinant = ab.dot(p);
    let (u, v, t) = (to_origin.dot(p) / determinant, direction.dot(q) / determinant, ac.dot(q) / determinant);
    // Slack, so that no ray slips through between two triangles; NaN, of a ray in the triangle's plane, fails.
    let slack = 1e-6;
    (u >= -slack && v >= -slack && u + v <= 1.0 + slack && t >= 0.0 && t.is_finite()).then_some(t)
}
