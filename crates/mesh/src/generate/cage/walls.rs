//! Triangles that a cage may not cross.

use nalgebra::Vector3;

use crate::boxes::{Bounds, BoxTree};
use crate::quality::{Triangle, meet, segment_meets};

/// Triangles in a tree.
pub struct Walls {
    tree: BoxTree,
    triangles: Vec<Triangle>,
}

impl Walls {
    /// Triangles without area are left out.
    pub fn new(triangles: &[[Vector3<f64>; 3]]) -> Self {
        let solid: Vec<_> = triangles.iter().filter_map(|&corners| Some((corners, Triangle::new(corners)?))).collect();
        let bounds = solid.iter().enumerate().map(|(i, (corners, _))| (i, Bounds::of(corners)));
        Self { tree: BoxTree::new(bounds.collect()), triangles: solid.iter().map(|(_, triangle)| *triangle).collect() }
    }

    /// Returns true if a triangle has a common point with one of the walls.
    pub fn meet(&self, corners: [Vector3<f64>; 3]) -> bool {
        let own = Triangle::new(corners);
        let mut is_met = false;
        self.tree.touching(&Bounds::of(&corners), |i| {
            is_met = is_met || meets(own.as_ref(), &corners, &self.triangles[i]);
        });
        is_met
    }
}

/// Returns true if a triangle, or its edges if it has no area, meets another triangle.
pub fn meets(own: Option<&Triangle>, [a, b, c]: &[Vector3<f64>; 3], other: &Triangle) -> bool {
    match own {
        Some(own) => meet(own, other),
        None => [[a, b], [b, c], [c, a]].into_iter().any(|ends| segment_meets(ends, other)),
    }
}
