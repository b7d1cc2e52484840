//! Optimal Delaunay triangulation in the plane: Chen and Xu, Optimal Delaunay Triangulations (2004); Alliez, Cohen-Steiner, Yvinec and Desbrun,
//! Variational Tetrahedral Meshing (2005).
//!
//! The energy is the error of the piecewise linear interpolant u_I of u = |x|², which is convex and so below it:
//!
//! E = ∫ (u_I − u) = 1/(d+1) Σᵢ |xᵢ|² |Ωᵢ| − ∫ |x|² = Σ_τ |τ| / ((d+1)(d+2)) Σ_edges |e|², with d = 2,
//!
//! and Ωᵢ the triangles around vertex i. The factor before the sum over the vertices is 1/3 in the plane; 1/4 belongs to space. A density ρ = h⁻⁴
//! in front of every triangle's share makes edges of length h optimal.

mod moves;

use nalgebra::Vector2;

use crate::generate::outline::{OnCurve, Outline};
use crate::generate::triangulation::Triangulation;

/// Moves that are tried along a direction, each half as long as the one before.
const HALVINGS: usize = 2;
/// Moves shorter than this part of the wanted edge are not made.
const STILL: f64 = 2e-3;

/// Median of circumradius over shortest edge up to which a mesh is good apart from its worst triangles; equilateral ones have 0.577.
const GOOD: f64 = 0.6;

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
    /// Share of each triangle in the energy, and its squared circumradius over shortest edge.
    shares: Vec<[f64; 2]>,
    /// Triangles around the vertex that is being moved.
    star: Vec<(u32, usize)>,
    /// Shares of the triangles around a vertex at the place that was tried last.
    tried: Vec<[f64; 2]>,
    /// Squared circumradius over shortest edge that no triangle may exceed.
    worst: f64,
    /// Energy that the moves of this iteration have gained.
    gained: f64,
}

/// Relaxes a triangulation for up to `iterations`. Inner vertices move towards the average of the circumcentres around them, weighted by
/// density times area; vertices of the boundary slide along the outline; edges are flipped where they are not Delaunay. A move
/// is made only where it lowers the energy of the triangles around it and leaves none worse than the worst of the whole mesh was before. `size` is
/// the wanted length of edges for a vertex at a place, m. Once the median of the triangles is good, only corners of those move whose circumradius over
/// shortest edge is above `moved_above`; 0 stands for all. Returns the measures at the start and after each iteration; fewer if no vertex moves any more.
pub fn relax(
    mesh: &mut Triangulation,
    outline: &mut Outline,
    size: impl Fn(u32, Vector2<f64>) -> f64,
    iterations: usize,
    moved_above: f64,
) -> Vec<OdtStep> {
    let mut smoothing = Smoothing::new(mesh, outline, size);
    let mut steps = vec![smoothing.measure()];
    let mut is_active = vec![true; smoothing.mesh.points.len()];
    for iteration in 0..iterations {
        let OdtStep { median_radius_to_edge: median, worst_radius_to_edge: worst, .. } = steps[steps.len() - 1];
        (smoothing.worst, smoothing.gained) = (worst * worst, 0.0);
        let moved_above = if median > GOOD { 0.0 } else { moved_above };
        let moved = smoothing.iterate(&mut is_active, moved_above * moved_above);
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

impl<'a, S: Fn(u32, Vector2<f64>) -> f64> Smoothing<'a, S> {
    fn new(mesh: &'a mut Triangulation, outline: &'a mut Outline, size: S) -> Self {
        let sizes = (0..).zip(&mesh.points).map(|(vertex, point)| size(vertex, *point)).collect();
        let shares = vec![[0.0; 2]; mesh.triangles.len()];
        let (star, tried) = (Vec::new(), Vec::new());
        let mut new = Self { mesh, outline, size, sizes, shares, star, tried, worst: 0.0, gained: 0.0 };
        (0..new.mesh.triangles.len() as u32).for_each(|triangle| new.judge(triangle));
        new
    }

    /// Density of a triangle: h⁻⁴, with h the mean of the lengths wanted at its corners.
    fn density(&self, [a, b, c]: [f64; 3]) -> f64 {
        let size = (a + b + c) / 3.0;
        1.0 / (size * size * size * size)
    }

    fn judge(&mut self, triangle: u32) {
        let (energy, shape) = energy_and_shape(self.mesh.corners(triangle));
        let sizes = self.mesh.triangles[triangle as usize].map(|vertex| self.sizes[vertex as usize]);
        self.shares[triangle as usize] = [self.density(sizes) * energy, shape];
    }

    fn measure(&self) -> OdtStep {
        let energy = self.shares.iter().map(|[energy, _]| energy).sum();
        let mut shapes: Vec<f64> = self.shares.iter().map(|[_, shape]| *shape).collect();
        let worst = shapes.iter().copied().fold(0.0, f64::max).sqrt();
        let mut quantile = |share: f64| {
            let rank = ((share * shapes.len() as f64).ceil() as usize).saturating_sub(1);
            shapes.select_nth_unstable_by(rank, f64::total_cmp).1.sqrt()
        };
        OdtStep {
            energy,
            smallest_angle: (0.5 / worst).min(1.0).asin().to_degrees(),
            median_radius_to_edge: quantile(0.5),
            radius_to_edge_99: quantile(0.99),
            worst_radius_to_edge: worst,
        }
    }

    /// Moves active vertices and flips edges; vertices are active next time if they or a neighbour moved. Only corners of triangles with a squared
    /// circumradius over shortest edge above `moved_above` move. Returns whether one did.
    fn iterate(&mut self, is_active: &mut [bool], moved_above: f64) -> bool {
        let mut is_movable = vec![false; is_active.len()];
        for (corners, [_, shape]) in self.mesh.triangles.iter().zip(&self.shares) {
            if *shape > moved_above {
                corners.iter().for_each(|&vertex| is_movable[vertex as usize] = is_active[vertex as usize]);
            }
        }
        is_active.fill(false);
        let mut moved = Vec::new();
        for vertex in (0..is_movable.len() as u32).filter(|vertex| is_movable[*vertex as usize]) {
            let mut star = std::mem::take(&mut self.star);
            let is_closed = self.mesh.star(vertex, &mut star);
            let has_moved = match self.outline.place(vertex) {
                _ if star.is_empty() => false,
                None => is_closed && self.relax_inner(vertex, &star),
                Some(place) => !place.is_fixed && !is_closed && self.slide(vertex, place, &star),
            };
            if has_moved {
                for &(triangle, _) in &star {
                    moved.push(triangle);
                    self.mesh.triangles[triangle as usize].iter().for_each(|&near| is_active[near as usize] = true);
                }
            }
            self.star = star;
        }
        let any = !moved.is_empty();
        let (sizes, worst) = (&self.sizes, self.worst);
        let flipped =
            self.mesh.make_delaunay(moved, |mesh, triangle, i| flip_lowers_energy(mesh, sizes, worst, triangle, i));
        flipped.into_iter().for_each(|triangle| self.judge(triangle));
        any
    }

    /// Energy of the triangles around a vertex, and their largest squared circumradius over shortest edge.
    fn energy_around(&self, star: &[(u32, usize)]) -> (f64, f64) {
        let shares = star.iter().map(|(triangle, _)| self.shares[*triangle as usize]);
        shares.fold((0.0, 0.0), |(sum, worst), [energy, shape]| (sum + energy, shape.max(worst)))
    }

    /// The same as if the vertex were elsewhere; none if a triangle is turned over, or its squared ratio above `bound`.
    fn energy_at(&mut self, star: &[(u32, usize)], place: Vector2<f64>, size: f64, bound: f64) -> Option<(f64, f64)> {
        self.tried.clear();
        let (mut sum, mut worst) = (0.0, 0.0_f64);
        for &(triangle, i) in star {
            let [_, q, r] = [0, 1, 2].map(|k| self.mesh.triangles[triangle as usize][(i + k) % 3]);
            let (a, b) = (self.mesh.points[q as usize], self.mesh.points[r as usize]);
            if !((a - place).perp(&(b - place)) > 0.0) {
                return None;
            }
            let (energy, shape) = energy_and_shape([place, a, b]);
            if !(shape <= bound) {
                return None;
            }
            let energy = self.density([size, self.sizes[q as usize], self.sizes[r as usize]]) * energy;
            self.tried.push([energy, shape]);
            sum += energy;
            worst = worst.max(shape);
        }
        Some((sum, worst))
    }

    /// Moves a vertex to the place that was tried last.
    fn move_to(&mut self, vertex: u32, star: &[(u32, usize)], place: Vector2<f64>, size: f64) {
        self.mesh.points[vertex as usize] = place;
        self.sizes[vertex as usize] = size;
        for (&(triangle, _), tried) in star.iter().zip(&self.tried) {
            self.shares[triangle as usize] = *tried;
        }
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

    /// Makes the first of the moves by 1, 1/2, 1/4 … of a step that lowers the energy and leaves no triangle worse than the worst.
    fn try_moves(
        &mut self,
        vertex: u32,
        star: &[(u32, usize)],
        place: impl Fn(f64) -> Option<(Vector2<f64>, Option<OnCurve>)>,
        length: f64,
    ) -> bool {
        if !(length > STILL * self.sizes[vertex as usize]) {
            return false;
        }
        let (old, shape) = self.energy_around(star);
        let bound = self.worst.min(shape.max(ACCEPTED));
        for halving in 0..HALVINGS {
            let Some((point, on_curve)) = place(0.5_f64.powi(halving as i32)) else { continue };
            let size = (self.size)(vertex, point);
            if let Some((energy, _)) = self.energy_at(star, point, size, bound)
                && energy < old
            {
                self.gained += old - energy;
                self.move_to(vertex, star, point, size);
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

/// Returns true if a flip lowers the energy, and makes neither triangle worse than the worst. For a constant density every Delaunay flip
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
