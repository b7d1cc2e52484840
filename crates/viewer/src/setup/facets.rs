//! The faces of a body that can carry loads: triangles of the boundary of a solid body, edges of the outline of a flat one.

use std::collections::{BTreeSet, HashMap};

use fem_model::element::Element;
use fem_model::simulation::Shape;
use kiss3d::glamx::Vec3;
use nalgebra::Vector3;

use crate::picture::geometry::first_hit;

/// Rounding error of the cosine of an angle between normals.
const ROUNDING: f64 = 1e-9;

/// Faces, their undeformed normals and their neighbours.
pub struct Facets {
    /// The nodes of each face.
    pub nodes: Vec<Vec<usize>>,
    /// Area of each undeformed face times its outward unit normal, m² (m × thickness of a flat body: its edges have unit thickness here).
    area_vectors: Vec<Vector3<f64>>,
    /// The faces that share an edge (a node of a flat body) with each.
    neighbours: Vec<Vec<usize>>,
    element: &'static Element,
    numbers: HashMap<Vec<usize>, usize>,
}

impl Facets {
    /// The faces of a body.
    pub fn of(shape: &Shape) -> Self {
        let (element, nodes, x) = (shape.mesh.element(), shape.faces(), shape.mesh.vertices());
        let area_vectors = nodes.iter().map(|face| element.area_vector(|i| x[face[i]])).collect();
        let numbers = nodes.iter().enumerate().map(|(number, face)| (key(corners(face, element)), number)).collect();
        Facets { neighbours: neighbours(&nodes, element), nodes, area_vectors, element, numbers }
    }

    /// The number of the face with these nodes, in any order.
    pub fn number(&self, face: &[usize]) -> Option<usize> {
        self.numbers.get(&key(corners(face, self.element))).copied()
    }

    /// The face that a ray meets first, and the point there; for a flat body the edge nearest to the point in which the ray meets its
    /// plane, if that is within `reach` (m). `positions` are those of the nodes now, m.
    pub fn hit(&self, (origin, ray): (Vec3, Vec3), positions: &[Vec3], reach: f32) -> Option<(usize, Vec3)> {
        if self.element.dimension == 3 {
            let (number, distance) = first_hit(origin, ray, positions, &self.triangles())?;
            return Some((number, origin + ray * distance));
        }
        let point = origin - ray * (origin.z / ray.z);
        let distance = |face: &[usize]| distance_to_segment(point, positions[face[0]], positions[face[1]]);
        let nearest = self.nodes.iter().map(|face| distance(face)).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.filter(|(_, distance)| *distance <= reach).map(|(number, _)| (number, point))
    }

    /// The corners of all triangles of a solid body.
    fn triangles(&self) -> Vec<[usize; 3]> {
        self.nodes.iter().filter_map(|face| corners(face, self.element).try_into().ok()).collect()
    }

    /// The smooth part of the surface around a face: the connected faces whose undeformed normals differ from its own by at most an
    /// angle, rad.
    pub fn smooth_part(&self, start: usize, angle: f64) -> BTreeSet<usize> {
        let normal = |face: usize| self.area_vectors[face].normalize();
        let (own, least) = (normal(start), angle.min(std::f64::consts::PI).cos() - ROUNDING);
        let (mut part, mut open) = (BTreeSet::from([start]), vec![start]);
        while let Some(face) = open.pop() {
            for &next in &self.neighbours[face] {
                if normal(next).dot(&own) >= least && part.insert(next) {
                    open.push(next);
                }
            }
        }
        part
    }

    /// The mean outward unit normal of undeformed faces; `None` where they have none in common, such as a closed surface.
    pub fn mean_normal(&self, faces: &BTreeSet<usize>) -> Option<Vector3<f64>> {
        let sum: Vector3<f64> = faces.iter().map(|&face| self.area_vectors[face]).sum();
        let size: f64 = faces.iter().map(|&face| self.area_vectors[face].norm()).sum();
        (sum.norm() > 1e-3 * size).then(|| sum.normalize())
    }

    /// Centre and outward unit normal of a face now.
    pub fn centre_and_normal(&self, face: usize, positions: &[Vec3]) -> (Vec3, Vec3) {
        let corners = corners(&self.nodes[face], self.element);
        let centre = corners.iter().map(|&node| positions[node]).sum::<Vec3>() / corners.len() as f32;
        let double = |i: usize| crate::picture::geometry::double(positions[corners[i]]);
        let normal = self.element.area_vector(double).try_normalize(0.0).unwrap_or_default();
        (centre, crate::picture::geometry::single(&normal))
    }
}

/// The corners of a face, without nodes in the middle of its edges.
fn corners<'a>(face: &'a [usize], element: &Element) -> &'a [usize] {
    &face[..element.dimension]
}

/// The corners that name a face, in ascending order.
fn key(corners: &[usize]) -> Vec<usize> {
    let mut key = corners.to_vec();
    key.sort_unstable();
    key
}

fn neighbours(nodes: &[Vec<usize>], element: &Element) -> Vec<Vec<usize>> {
    let rims = |face: &[usize]| -> Vec<[usize; 2]> {
        let ends = |a: usize, b: usize| [a.min(b), a.max(b)];
        match *corners(face, element) {
            [a, b] => vec![[a; 2], [b; 2]],
            ref face => (0..face.len()).map(|i| ends(face[i], face[(i + 1) % face.len()])).collect(),
        }
    };
    let mut owners: HashMap<[usize; 2], Vec<usize>> = HashMap::new();
    for (number, face) in nodes.iter().enumerate() {
        rims(face).into_iter().for_each(|rim| owners.entry(rim).or_default().push(number));
    }
    let around = |(number, face): (usize, &Vec<usize>)| {
        let others = rims(face).into_iter().flat_map(|rim| owners[&rim].iter().copied());
        others.filter(|other| *other != number).collect()
    };
    nodes.iter().enumerate().map(around).collect()
}

fn distance_to_segment(point: Vec3, from: Vec3, to: Vec3) -> f32 {
    let along = to - from;
    let share = ((point - from).dot(along) / along.length_squared().max(1e-30)).clamp(0.0, 1.0);
    point.distance(from + along * share)
}

#[cfg(test)]
mod tests {
    use fem_model::BodyMesh;

    use super::*;
    use crate::picture::geometry::single;

    fn shape(mesh: BodyMesh) -> Shape {
        Shape { boundary: mesh.surface(), mesh, display: None, picture: None }
    }

    fn beam() -> Shape {
        shape(fem_mesh::box_mesh([4.0, 1.0, 1.0], 2, fem_mesh::Pattern::Alternating).unwrap().into())
    }

    fn strip() -> Shape {
        let triangles = fem_mesh::rectangle_mesh([2.0, 1.0], 2, fem_mesh::Pattern::Alternating).unwrap();
        shape(BodyMesh::flat(triangles, 0.1))
    }

    fn positions(shape: &Shape) -> Vec<Vec3> {
        shape.mesh.vertices().iter().map(single).collect()
    }

    #[test]
    fn a_click_on_the_end_of_a_beam_gives_the_whole_end_and_no_more() {
        let beam = beam();
        let (facets, now) = (Facets::of(&beam), positions(&beam));
        let (face, point) = facets.hit((Vec3::new(9.0, 0.3, 0.4), -Vec3::X), &now, 0.0).unwrap();
        assert!((point - Vec3::new(4.0, 0.3, 0.4)).length() < 1e-5);
        let end = facets.smooth_part(face, 0.3);
        assert_eq!(end.len(), 8);
        assert_eq!(facets.mean_normal(&end), Some(Vector3::x()));
        assert_eq!(facets.smooth_part(face, 3.2).len(), facets.nodes.len(), "an angle of 180° gives all");
        assert_eq!(facets.mean_normal(&(0..facets.nodes.len()).collect()), None, "a closed surface has no direction");
        assert_eq!(facets.centre_and_normal(face, &now).1, Vec3::X);
    }

    #[test]
    fn faces_are_known_by_their_nodes_in_any_order() {
        let facets = Facets::of(&beam());
        let [a, b, c] = facets.nodes[5][..] else { panic!("a triangle") };
        assert_eq!(facets.number(&[c, a, b]), Some(5));
        assert_eq!(facets.number(&[0, 1, 2]), None);
    }

    #[test]
    fn the_faces_of_a_flat_body_are_the_edges_of_its_outline() {
        let strip = strip();
        let (facets, now) = (Facets::of(&strip), positions(&strip));
        let (face, _) = facets.hit((Vec3::new(2.05, 0.2, 5.0), -Vec3::Z), &now, 0.1).unwrap();
        let end = facets.smooth_part(face, 0.3);
        assert_eq!(end.len(), 2);
        assert_eq!(facets.mean_normal(&end), Some(Vector3::x()));
        assert!(facets.hit((Vec3::new(1.0, 0.5, 5.0), -Vec3::Z), &now, 0.1).is_none(), "inside");
    }
}
