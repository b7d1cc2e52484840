//! The region of a picture and its triangulation: sizes, boundary points, constrained Delaunay triangulation, refinement.

use nalgebra::Vector2;

use super::features::{chord_lengths, width_bound};
use super::lattice::Lattice;
use super::resample::resample;
use super::size::{Inside, SizeField};
use super::{Picture, corners};
use crate::generate::delaunay::{Bounds, cut_encroached, refine, triangulate_with};
use crate::generate::outline::{Curve, OnCurve, Outline};
use crate::generate::triangulation::Triangulation;

/// Distance that the boundary may have from the contour between two of its points, in pixels.
const TOLERANCE: f64 = 0.35;
/// Shortest edge that the shape of the contour asks for, in pixels.
const SHORTEST: f64 = 2.0;
/// Longest edge over the wanted one: thin places take triangles from the others.
const LONGEST: f64 = 3.0;
/// Growth of the edges' length with the distance from where they are short; the next where one asks for too many triangles.
const GROWTHS: [f64; 3] = [0.2, 0.3, 0.5];
/// Largest circumradius over shortest edge: angles of 30°.
const RADIUS_TO_EDGE: f64 = 1.0;
/// Part of the wish by which the number of triangles may miss it, and meshes that are made for that.
const MISSED: f64 = 0.025;
const TRIES: usize = 6;
/// Distance of the lattice's points from the contour, over the size of the elements.
const APART: f64 = 1.0;
/// Size in the lattice, at least, over the largest.
const UNIFORM: f64 = 0.98;

/// The region of a picture with what its mesh needs; all in pixels.
pub struct Region<'a> {
    picture: &'a Picture,
    curves: Vec<Curve>,
    corners: Vec<Vec<f64>>,
    /// Contours as they are, for a picture whose boundary would cross itself otherwise.
    found: &'a [Vec<Vector2<f64>>],
    edge: f64,
    sizes: SizeField,
    /// Distances from the contours.
    distances: SizeField,
}

/// A triangulation with the sizes that it was made for.
pub struct Sized {
    pub mesh: Triangulation,
    pub outline: Outline,
    pub sizes: SizeField,
    /// Largest size.
    pub largest: f64,
}

impl<'a> Region<'a> {
    pub fn new(picture: &'a Picture, found: &'a [Vec<Vector2<f64>>], edge: f64, wish: f64) -> Self {
        let has_steps = is_not_antialiased(picture, found);
        let mut distances = SizeField::over(picture, 1.0);
        found.iter().flatten().for_each(|&x| distances.bound(x, 0.0));
        distances.spread();
        let sizes = SizeField::over(picture, 0.0);
        let mut region = Region { picture, curves: Vec::new(), corners: Vec::new(), found, edge, sizes, distances };
        for points in found {
            let mut curve = Curve::new(points.clone());
            if has_steps {
                // Steps turn as much as obtuse corners do.
                let acute = corners::corners(&curve, corners::acute_corner);
                curve = corners::smoothed(&curve, &acute, 2.0, 0.4);
            }
            let places = corners::corners(&curve, corners::any_corner);
            let (curve, places) = corners::sharpen(&curve, &places);
            region.curves.push(curve);
            region.corners.push(places);
        }
        let bounds = region.size_bounds();
        for growth in GROWTHS {
            region.sizes = SizeField::over(picture, growth);
            bounds.iter().for_each(|&(x, size)| region.sizes.bound(x, size));
            region.sizes.spread();
            if Inside::count(&region.sizes.inside(picture), LONGEST * edge) <= wish {
                break;
            }
        }
        region
    }

    /// Sizes at points of the contours, as their curvature and the width of the region ask for.
    fn size_bounds(&self) -> Vec<(Vector2<f64>, f64)> {
        let range = [SHORTEST.min(self.edge), LONGEST * self.edge];
        let mut bounds = Vec::new();
        for (curve, corners) in self.curves.iter().zip(&self.corners) {
            let lengths = chord_lengths(curve, corners, TOLERANCE, range);
            for (i, (&s, &x)) in curve.lengths().iter().zip(curve.points()).enumerate() {
                let along = curve.at(s + 1.0) - curve.at(s - 1.0);
                let inward = Vector2::new(-along.y, along.x).try_normalize(0.0).unwrap_or_default();
                let width = width_bound(self.picture, x, inward, range[1]).filter(|width| {
                    let [behind, ahead] = corners::nearest(curve, corners, s);
                    behind.min(ahead) > 2.5 * width
                });
                bounds.push((x, lengths[i].min(width.unwrap_or(range[1])).max(range[0])));
            }
        }
        bounds
    }

    /// A triangulation whose number of triangles is as near to the wish as it gets.
    pub fn mesh(&self, wish: f64) -> Sized {
        let (mut target, mut longest) = (wish, LONGEST);
        let inside = self.sizes.inside(self.picture);
        let mut best: Option<(f64, Sized)> = None;
        for _ in 0..TRIES {
            let largest = self.size_for(&inside, target).min(longest * self.edge);
            let sized = self.triangulate(largest, wish);
            let ratio = sized.mesh.triangles.len() as f64 / wish;
            let missed = ratio.ln().abs();
            if best.as_ref().is_none_or(|(best, _)| missed < *best) {
                best = Some((missed, sized));
            }
            if missed <= MISSED {
                break;
            }
            if ratio > 1.0 && largest >= 0.999 * longest * self.edge {
                // The contour needs more triangles; beside very long edges it needs even more.
                longest *= 0.75;
            } else {
                target /= ratio;
            }
        }
        best.expect("at least one try").1
    }

    /// The largest size with which the field has a number of triangles.
    fn size_for(&self, inside: &[Inside], wish: f64) -> f64 {
        // The number is convex and piecewise linear in 1/size², so Newton's method goes down to the root without passing it.
        let [most, least] = [0.2 * self.edge, LONGEST * self.edge].map(|size| 1.0 / (size * size));
        let mut density = most;
        loop {
            let (fixed, slope) = Inside::sums(inside, density);
            let next = ((wish - fixed) / slope).max(least);
            if !(next < density * (1.0 - 1e-9)) {
                return 1.0 / density.sqrt();
            }
            density = next;
        }
    }

    fn triangulate(&self, largest: f64, wish: f64) -> Sized {
        let mut sizes = self.sizes.clone();
        let (mut mesh, mut outline) = self.boundary_mesh(largest);
        let shortest = 0.5_f64.min(0.5 * self.edge);
        let cuts = cut_encroached(&mut mesh, &mut outline, shortest);
        cuts.iter().for_each(|&(x, size)| sizes.bound_around(x, size, largest));
        let most_vertices = mesh.points.len() + (4.0 * wish) as usize + 1000;
        let bounds = Bounds { radius_to_edge: RADIUS_TO_EDGE, shortest_cut: shortest, most_vertices };
        refine(&mut mesh, &mut outline, |x| sizes.at(x, largest), bounds);
        Sized { mesh, outline, sizes, largest }
    }

    /// The constrained Delaunay triangulation of points on the contours, and of a lattice where sizes are uniform. Shorter edges follow, should
    /// two contours cross that pass close to each other.
    fn boundary_mesh(&self, largest: f64) -> (Triangulation, Outline) {
        let lattice = self.lattice(largest);
        for longest in [f64::INFINITY, 2.0, 1.0] {
            let mut outline = Outline { curves: self.curves.clone(), places: Vec::new(), tolerance: TOLERANCE };
            let mut polygons = Vec::new();
            for (index, (curve, corners)) in self.curves.iter().zip(&self.corners).enumerate() {
                let places = resample(curve, index, corners, |x| self.sizes.at(x, largest).min(longest));
                polygons.push(places.iter().map(|(x, _)| *x).collect::<Vec<_>>());
                outline.places.extend(places.into_iter().map(|(_, place)| Some(place)));
            }
            if let Some(mesh) = lattice.triangulate(&polygons) {
                return (mesh, outline);
            }
        }
        self.contour_mesh()
    }

    /// A lattice of equilateral triangles of the largest size, where no element shall be smaller.
    fn lattice(&self, largest: f64) -> Lattice {
        Lattice::new([self.picture.width, self.picture.height].map(|side| side as f64), largest, |x| {
            self.picture.is_inside(x.x as isize, x.y as isize)
                && self.distances.at(x, f64::INFINITY) >= APART * largest
                && self.sizes.at(x, largest) >= UNIFORM * largest
        })
    }

    /// The triangulation of the contours with all of their points. They do not touch each other.
    fn contour_mesh(&self) -> (Triangulation, Outline) {
        let curves: Vec<Curve> = self.found.iter().map(|points| Curve::new(points.clone())).collect();
        let mesh = triangulate_with(self.found, &[]).expect("contours do not touch");
        let mut outline = Outline { curves, places: Vec::new(), tolerance: TOLERANCE };
        for index in 0..outline.curves.len() {
            let lengths = outline.curves[index].lengths().to_vec();
            let place = |s| Some(OnCurve { curve: index, s, is_fixed: false });
            outline.places.extend(lengths.into_iter().map(place));
        }
        (mesh, outline)
    }
}

/// Returns true if the contours pass mostly between pixels that are wholly inside and wholly outside.
fn is_not_antialiased(picture: &Picture, contours: &[Vec<Vector2<f64>>]) -> bool {
    let is_whole = |x: &&Vector2<f64>| {
        let [i, j] = [x.x - 0.5, x.y - 0.5].map(|x| (x.floor() as isize, x.ceil() as isize));
        [picture.at(i.0, j.0), picture.at(i.1, j.1)].iter().all(|coverage| [0, 255].contains(coverage))
    };
    let count = contours.iter().map(Vec::len).sum::<usize>();
    2 * contours.iter().flatten().filter(is_whole).count() > count
}
