//! Optimal Delaunay triangulation in the plane: Chen and Xu, Optimal Delaunay Triangulations (2004); Alliez, Cohen-Steiner, Yvinec and Desbrun,
//! Variational Tetrahedral Meshing (2005).
//!
//! The energy is the error of the piecewise linear interpolant u_I of u = |x|², which is convex and so below it:
//!
//! E = ∫ (u_I − u) = 1/(d+1) Σᵢ |xᵢ|² |Ωᵢ| − ∫ |x|² = Σ_τ |τ| / ((d+1)(d+2)) Σ_edges |e|², with d = 2,
//!
//! and Ωᵢ the triangles around vertex i. The factor before the sum over the vertices is 1/3 in the plane; 1/4 belongs to space. A density ρ = h⁻⁴
//! in front of every triangle's share makes edges of length h optimal.

mod polish;

use nalgebra::Vector2;

use crate::generate::outline::{Curve, OnCurve, Outline};
use crate::generate::triangulation::Triangulation;

/// Moves that are tried along a direction, each half as long as the one before.
const HALVINGS: usize = 4;
/// Moves shorter than this part of the wanted edge are not made.
const STILL: f64 = 2e-3;

/// Measures of a mesh after an iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OdtStep {
    /// The energy above; m⁴ with the density 1, without unit for a density h⁻⁴.
    pub energy: f64,
    /// Smallest angle, degrees.
    pub smallest_angle: f64,
    /// Median of circumradius over shortest edge.
    pub median_radius_to_edge: f64,
    /// Circumradius over shortest edge that 99 % of the triangles do not exceed.
    pub radius_to_edge_99: f64,
    /// Largest circumradius over shortest edge.
    pub worst_radius_to_edge: f64,
}

struct Smoothing<'a, S> {
    mesh: &'a mut Triangulation,
    outline: &'a mut Outline,
    size: S,
    /// Wanted length of edges at each vertex, m.
    sizes: Vec<f64>,
    star: Vec<(u32, usize)>,
    /// Squared circumradius over shortest edge that no triangle may exceed.
    worst: f64,
    /// Energy that the moves of this iteration have gained.
    gained: f64,
}

/// Relaxes a triangulation for up to `iterations`. Inner vertices move towards the average of the circumcentres around them, weighted by
/// density times area; vertices of the boundary slide along the outline; edges are flipped where they are not Delaunay. A move
/// is made only where it lowers the energy of the triangles around it and leaves none worse than the worst of the whole mesh was before. `size` is
/// the wanted length of edges for a vertex at a place, m. Returns the measures at the start and after each iteration; fewer if no vertex moves any more.
pub fn relax(
    mesh: &mut Triangulation,
    outline: &mut Outline,
    size: impl Fn(u32, Vector2<f64>) -> f64,
    iterations: usize,
) -> Vec<OdtStep> {
    let sizes = (0..mesh.points.len() as u32).map(|vertex| size(vertex, mesh.points[vertex as usize])).collect();
    let mut smoothing = Smoothing { mesh, outline, size, sizes, star: Vec::new(), worst: 0.0, gained: 0.0 };
    let mut steps = vec![smoothing.measure()];
    let mut is_active = vec![true; smoothing.mesh.points.len()];
    for iteration in 0..iterations {
        smoothing.worst = steps[steps.len() - 1].worst_radius_to_edge.powi(2);
        smoothing.gained = 0.0;
        let moved = smoothing.iterate(&mut is_active);
        smoothing.polish(iteration);
        steps.push(smoothing.measure());
        if !moved {
            break;
        }
    }
    steps
}

/// Share of the energy of a triangle of density 1: |τ| / 12 Σ |e|², m⁴, and squared circumradius over shortest edge.
fn energy_and_shape([a, b, c]: [Vector2<f64>; 3]) -> (f64, f64) {
    let (u, v, w) = (b - a, c - a, c - b);
    let twice_area = u.perp(&v);
    let [uu, vv, ww] = [u.norm_squared(), v.norm_squared(), w.norm_squared()];
    let longer = uu.max(vv).min(uu.min(vv).max(ww)) * uu.max(vv).max(ww);
    (twice_area / 24.0 * (uu + vv + ww), longer / (4.0 * twice_area * twice_area))
}

impl<S: Fn(u32, Vector2<f64>) -> f64> Smoothing<'_, S> {
    /// Density of a triangle: h⁻⁴, with h the mean of the lengths wanted at its corners.
    fn density(&self, [a, b, c]: [f64; 3]) -> f64 {
        let size = (a + b + c) / 3.0;
        1.0 / (size * size * size * size)
    }

    fn measure(&self) -> OdtStep {
        let mut energy = 0.0;
        let mut worst = 0.0_f64;
        let mut shapes = Vec::with_capacity(self.mesh.triangles.len());
        for triangle in 0..self.mesh.triangles.len() as u32 {
            let (share, shape) = energy_and_shape(self.mesh.corners(triangle));
            let sizes = self.mesh.triangles[triangle as usize].map(|vertex| self.sizes[vertex as usize]);
            energy += self.density(sizes) * share;
            worst = worst.max(shape);
            shapes.push(shape);
        }
        let rank = |share: f64| ((share * shapes.len() as f64).ceil() as usize).saturating_sub(1);
        let (middle, most) = (rank(0.5), rank(0.99));
        // The median is among those up to the other rank.
        let radius_to_edge_99 = *shapes.select_nth_unstable_by(most, f64::total_cmp).1;
        let median = *shapes[..=most].select_nth_unstable_by(middle, f64::total_cmp).1;
        let worst = worst.sqrt();
        OdtStep {
            energy,
            smallest_angle: (0.5 / worst).min(1.0).asin().to_degrees(),
            median_radius_to_edge: median.sqrt(),
            radius_to_edge_99: radius_to_edge_99.sqrt(),
            worst_radius_to_edge: worst,
        }
    }

    /// Moves the active vertices and flips edges; vertices are active next time if they or a neighbour moved. Returns whether one moved.
    fn iterate(&mut self, is_active: &mut [bool]) -> bool {
        let mut is_touched = vec![false; self.mesh.triangles.len()];
        let mut any = false;
        let active = is_active.to_vec();
        is_active.fill(false);
        for vertex in (0..self.mesh.points.len() as u32).filter(|vertex| active[*vertex as usize]) {
            let mut star = std::mem::take(&mut self.star);
            let is_closed = self.mesh.star(vertex, &mut star);
            let has_moved = match self.outline.place(vertex) {
                _ if star.is_empty() => false,
                None => is_closed && self.relax_inner(vertex, &star),
                Some(place) => !place.is_fixed && !is_closed && self.slide(vertex, place, &star),
            };
            if has_moved {
                any = true;
                for &(triangle, _) in &star {
                    is_touched[triangle as usize] = true;
                    self.mesh.triangles[triangle as usize].iter().for_each(|&near| is_active[near as usize] = true);
                }
            }
            self.star = star;
        }
        let sizes = &self.sizes;
        let worst = self.worst;
        let touched = (0..is_touched.len() as u32).filter(|&triangle| is_touched[triangle as usize]);
        self.mesh.make_delaunay(touched, |mesh, triangle, i| flip_lowers_energy(mesh, sizes, worst, triangle, i));
        any
    }

    /// Energy of the triangles around a vertex as if it were elsewhere, with the largest squared ratio; none if one is turned over.
    fn energy_at(&self, star: &[(u32, usize)], place: Vector2<f64>, size: f64) -> Option<(f64, f64)> {
        let (mut energy, mut worst) = (0.0, 0.0_f64);
        for &(triangle, i) in star {
            let [_, q, r] = [0, 1, 2].map(|k| self.mesh.triangles[triangle as usize][(i + k) % 3]);
            let (a, b) = (self.mesh.points[q as usize], self.mesh.points[r as usize]);
            if !((a - place).perp(&(b - place)) > 0.0) {
                return None;
            }
            let (share, shape) = energy_and_shape([place, a, b]);
            energy += self.density([size, self.sizes[q as usize], self.sizes[r as usize]]) * share;
            worst = worst.max(shape);
        }
        Some((energy, worst))
    }

    /// The average of the circumcentres around a vertex, weighted by density times area. Its difference to the vertex is the negative gradient of
    /// the energy, over twice the sum of the weights.
    fn average_of_circumcentres(&self, vertex: u32, star: &[(u32, usize)]) -> Vector2<f64> {
        let x = self.mesh.points[vertex as usize];
        let (mut sum, mut weights) = (Vector2::zeros(), 0.0);
        for &(triangle, i) in star {
            let [q, r] = [1, 2].map(|k| self.mesh.triangles[triangle as usize][(i + k) % 3] as usize);
            let (a, b) = (self.mesh.points[q] - x, self.mesh.points[r] - x);
            let density = self.density([self.sizes[vertex as usize], self.sizes[q], self.sizes[r]]);
            // Twice the area times the circumcentre's place relative to the vertex needs no division.
            let (aa, bb) = (a.norm_squared(), b.norm_squared());
            sum += 0.5 * density * Vector2::new(b.y * aa - a.y * bb, a.x * bb - b.x * aa);
            weights += density * a.perp(&b);
        }
        x + sum / weights
    }

    fn relax_inner(&mut self, vertex: u32, star: &[(u32, usize)]) -> bool {
        let from = self.mesh.points[vertex as usize];
        let target = self.average_of_circumcentres(vertex, star);
        self.try_moves(vertex, star, |share| Some((from.lerp(&target, share), None)), (target - from).norm())
    }

    /// Moves a vertex of the boundary along its curve, by the move towards the circumcentres' average as far as it goes along the curve.
    fn slide(&mut self, vertex: u32, place: OnCurve, star: &[(u32, usize)]) -> bool {
        let (first, last) = (star[0], star[star.len() - 1]);
        let after = self.mesh.triangles[first.0 as usize][(first.1 + 1) % 3];
        let before = self.mesh.triangles[last.0 as usize][(last.1 + 2) % 3];
        let (Some(before), Some(after)) = (self.outline.place(before), self.outline.place(after)) else { return false };
        let curves = std::mem::take(&mut self.outline.curves);
        let has_moved = self.slide_on(&curves[place.curve], vertex, place, [before, after], star);
        self.outline.curves = curves;
        has_moved
    }

    /// Slides a vertex on its curve, between its two neighbours there.
    fn slide_on(
        &mut self,
        curve: &Curve,
        vertex: u32,
        place: OnCurve,
        [before, after]: [OnCurve; 2],
        star: &[(u32, usize)],
    ) -> bool {
        let ahead = |s: f64| (s - place.s).rem_euclid(curve.length());
        let (to_after, to_before) = (ahead(after.s), curve.length() - ahead(before.s));
        let from = self.mesh.points[vertex as usize];
        let along = (curve.at(place.s + 0.25 * to_after) - curve.at(place.s - 0.25 * to_before)).try_normalize(0.0);
        let Some(along) = along else { return false };
        let wanted = (self.average_of_circumcentres(vertex, star) - from).dot(&along);
        let wanted = wanted.clamp(-0.5 * to_before, 0.5 * to_after);
        if !(wanted.abs() > STILL * self.sizes[vertex as usize]) {
            return false;
        }
        let (start, end) = (place.s - to_before, place.s + to_after);
        let turn = if start < 0.0 { curve.length() } else { 0.0 };
        let deviation = |s: f64| curve.deviation(start + turn, s + turn).max(curve.deviation(s + turn, end + turn));
        let allowed = self.outline.tolerance.max(deviation(place.s));
        let nth = |share: f64| {
            let s = place.s + wanted * share;
            let on_curve = OnCurve { s: s.rem_euclid(curve.length()), ..place };
            (deviation(s) <= allowed).then(|| (curve.at(s), Some(on_curve)))
        };
        self.try_moves(vertex, star, nth, wanted.abs())
    }

    /// Makes the first of the moves by 1, 1/2, 1/4 … of a step that lowers the energy and leaves no triangle worse than the worst.
    fn try_moves(
        &mut self,
        vertex: u32,
        star: &[(u32, usize)],
        place: impl Fn(f64) -> Option<(Vector2<f64>, Option<OnCurve>)>,
        length: f64,
    ) -> bool {
        let size = self.sizes[vertex as usize];
        if !(length > STILL * size) {
            return false;
        }
        let Some((old, shape)) = self.energy_at(star, self.mesh.points[vertex as usize], size) else {
            return false;
        };
        for halving in 0..HALVINGS {
            let Some((point, on_curve)) = place(0.5_f64.powi(halving as i32)) else { continue };
            let size = (self.size)(vertex, point);
            if let Some((energy, worst)) = self.energy_at(star, point, size)
                && energy < old
                && worst <= self.worst.min(shape.max(ACCEPTED))
            {
                self.gained += old - energy;
                self.mesh.points[vertex as usize] = point;
                self.sizes[vertex as usize] = size;
                if let Some(on_curve) = on_curve {
                    self.outline.set(vertex, on_curve);
                }
                return true;
            }
        }
        false
    }
}

/// Squared circumradius over shortest edge up to which a move may make the worst triangle around its vertex worse.
const ACCEPTED: f64 = 0.5;

/// Whether a flip lowers the energy, and makes neither triangle worse than the worst. For a constant density every Delaunay flip
/// lowers it.
fn flip_lowers_energy(mesh: &Triangulation, sizes: &[f64], worst: f64, triangle: u32, i: usize) -> bool {
    let neighbour = mesh.neighbours[triangle as usize][i];
    let j = mesh.corner_beyond(neighbour, triangle);
    let [a, b, c] = [0, 1, 2].map(|k| mesh.triangles[triangle as usize][(i + k) % 3] as usize);
    let d = mesh.triangles[neighbour as usize][j] as usize;
    let share = |corners: [usize; 3]| {
        let (energy, shape) = energy_and_shape(corners.map(|vertex| mesh.points[vertex]));
        let size = corners.iter().map(|&vertex| sizes[vertex]).sum::<f64>() / 3.0;
        (energy / size.powi(4), shape)
    };
    let [old, beside, new, other] = [[a, b, c], [d, c, b], [a, b, d], [a, d, c]].map(share);
    new.0 > 0.0
        && other.0 > 0.0
        && new.0 + other.0 < old.0 + beside.0
        && new.1.max(other.1) <= worst.max(old.1).max(beside.1)
}
