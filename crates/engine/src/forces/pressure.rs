//! Follower pressures: forces along the normal of the deformed surface.

use std::collections::HashSet;

use fem_scene::{Body, LoadCurve};
use nalgebra::Vector3;

use super::{Energy, Moment, Potential};
use crate::model::numbering::Numbering;
use crate::number::Real;

/// Key in the statistics.
pub const NAME: &str = "pressure";

/// All pressures of a body.
struct Pressures<T>(Vec<Pressure<T>>);

/// A pressure on triangles of the surface.
#[derive(Clone, Debug, PartialEq)]
struct Pressure<T> {
    /// Pa; positive pushes inward.
    pressure: T,
    curve: Option<LoadCurve>,
    faces: Vec<Face<T>>,
    /// Undeformed corners of each triangle, relative to a point of the surface, m; `None` where the pressure has no potential.
    ///
    /// A pressure is p times the gradient of the volume behind its surface. Where the surface has an edge that moves, that volume
    /// depends on how the surface is closed, and the work of the pressure along a closed path need not be zero.
    corners: Option<Vec<[Vector3<f64>; 3]>>,
}

/// A triangle whose normal points outward.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Face<T> {
    /// The engine's numbers of its nodes.
    nodes: [usize; 3],
    /// Undeformed edges from the first node to the others, m.
    edges: [[T; 3]; 2],
}

/// The pressures of a body; `None` where it has none.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    let joined = joined(&body.pressures);
    let pressures: Vec<_> = joined.iter().map(|pressure| Pressure::new(body, pressure, numbering)).collect();
    (!pressures.is_empty()).then(|| Box::new(Pressures(pressures)) as Box<dyn Potential<T>>)
}

impl<T: Real> Pressure<T> {
    fn new(body: &Body, pressure: &fem_scene::Pressure, numbering: &Numbering) -> Self {
        let vertices = body.shape.mesh.vertices();
        let vector = |v: Vector3<f64>| [T::of(v.x), T::of(v.y), T::of(v.z)];
        let face = |face: &[usize; 3]| {
            let [a, b, c] = face.map(|node| vertices[node]);
            let nodes = face.map(|node| numbering.engine_node[node] as usize);
            Face { nodes, edges: [vector(b - a), vector(c - a)] }
        };
        Self {
            pressure: T::of(pressure.pressure),
            curve: pressure.curve.clone(),
            corners: edge_is_fixed(body, &pressure.faces).then(|| corners(vertices, &pressure.faces)),
            faces: pressure.faces.iter().map(face).collect(),
        }
    }

    /// Adds `factor` times the nodal forces, N: −p/6 (x_b − x_a) × (x_c − x_a) at every corner, which is −p n integrated with the
    /// corner's shape function over the deformed triangle.
    fn add_force(&self, factor: T, u: &[[T; 3]], force: &mut [[T; 3]]) {
        let sixth = -factor * self.pressure * T::of(1.0 / 6.0);
        for Face { nodes: [a, b, c], edges } in &self.faces {
            let d: [T; 3] = std::array::from_fn(|i| edges[0][i] + (u[*b][i] - u[*a][i]));
            let e: [T; 3] = std::array::from_fn(|i| edges[1][i] + (u[*c][i] - u[*a][i]));
            let normal = [d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]];
            for &node in &[*a, *b, *c] {
                for i in 0..3 {
                    force[node][i] += sixth * normal[i];
                }
            }
        }
    }

    /// p times the growth of the volume behind the surface, J; `None` where the pressure has no potential.
    fn potential(&self, u: &[[T; 3]]) -> Option<f64> {
        let at = |node: usize| Vector3::from(u[node].map(T::as_f64));
        let growth = |(face, [A, B, C]): (&Face<T>, &[Vector3<f64>; 3])| {
            let [a, b, c] = face.nodes.map(at);
            // det(A + a, B + b, C + c) − det(A, B, C), without the difference.
            a.dot(&B.cross(C)) + (A + a).dot(&b.cross(C)) + (A + a).dot(&(B + b).cross(&c))
        };
        let sixfold: f64 = self.faces.iter().zip(self.corners.as_ref()?).map(growth).sum();
        Some(self.pressure.as_f64() * sixfold / 6.0)
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.faces[..]) + self.corners.as_ref().map_or(0, |corners| size_of_val(&corners[..]))
    }
}

impl<T: Real> Potential<T> for Pressures<T> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        let has_potential = self.0.iter().all(|pressure| pressure.corners.is_some());
        let note = if has_potential { "" } else { "; the edge of its surface moves, so no energy contains its work" };
        format!("[[traction]] with pressure{note}")
    }

    fn bytes(&self) -> usize {
        self.0.iter().map(Pressure::bytes).sum()
    }

    fn is_conservative(&self) -> bool {
        false
    }

    fn energy(&self, u: &[[T; 3]], moment: Moment) -> Energy {
        let of_one =
            |pressure: &Pressure<T>| Some(Energy::of(moment.factor(pressure.curve.as_ref()) * pressure.potential(u)?));
        self.0.iter().filter_map(of_one).sum()
    }

    fn add_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) {
        for pressure in &self.0 {
            pressure.add_force(T::of(-moment.factor(pressure.curve.as_ref())), u, gradient);
        }
    }

    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        let is_finite = self.0.iter().all(|pressure| pressure.pressure.as_f64().is_finite());
        (!is_finite).then_some(("traction", "a pressure"))
    }
}

/// Tables of the same pressure and curve as one: six sides of a box together have a potential that none of them has alone.
fn joined(tables: &[fem_scene::Pressure]) -> Vec<fem_scene::Pressure> {
    let mut joined: Vec<fem_scene::Pressure> = Vec::new();
    for table in tables {
        match joined.iter_mut().find(|earlier| (earlier.pressure, &earlier.curve) == (table.pressure, &table.curve)) {
            Some(earlier) => earlier.faces.extend(&table.faces),
            None => joined.push(table.clone()),
        }
    }
    joined
}

/// Corners relative to the first node, m: they keep their digits far from the origin.
fn corners(vertices: &[Vector3<f64>], faces: &[[usize; 3]]) -> Vec<[Vector3<f64>; 3]> {
    faces.iter().map(|face| face.map(|node| vertices[node] - vertices[faces[0][0]])).collect()
}

/// Whether every node on the edge of the surface is fixed at all times; a closed surface has no edge.
fn edge_is_fixed(body: &Body, faces: &[[usize; 3]]) -> bool {
    let always = body.dirichlet.iter().filter(|condition| condition.motion.is_none() && condition.until.is_none());
    let fixed: HashSet<usize> = always.flat_map(|condition| &condition.nodes).copied().collect();
    let edges: HashSet<[usize; 2]> = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    // Two outward triangles run along a common edge in opposite directions.
    edges.iter().all(|&[a, b]| edges.contains(&[b, a]) || (fixed.contains(&a) && fixed.contains(&b)))
}
