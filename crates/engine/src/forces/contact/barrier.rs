//! The barrier that repels a node from an obstacle: Li et al., Incremental Potential Contact (2020), equation 6.
//!
//! A node of the area a at the distance d has the energy κ a d̂ b(d/d̂), b(s) = −(s − 1)² ln s for s < 1, and zero beyond d̂. So its
//! pressure κ |b'(d/d̂)| depends on the distance alone, and not on the mesh; κ is a pressure that a gap of about d̂/2 carries.

use fem_model::{Body, Material};

use super::areas::Areas;
use crate::forces::mass_spring;
use fem_elements::materials::AnyLaw;
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// The barrier of a body.
#[derive(Clone, Debug)]
pub struct Barrier {
    /// d̂, m.
    pub distance: f64,
    /// κ, Pa.
    pub stiffness: f64,
    areas: Areas,
}

impl Barrier {
    /// The barrier of a body with obstacles; `None` if the scene has none.
    ///
    /// κ is the largest shear modulus plus the pressure under the body's weight. So the layer is about as stiff as a layer of the
    /// body, whatever its material, and its matrix is as well conditioned.
    pub fn new(body: &Body, numbering: &Numbering) -> Option<Self> {
        let contact = body.contact.as_ref()?;
        let normals = contact.planes.iter().map(|plane| plane.normal).collect();
        Some(Self {
            distance: contact.activation_distance,
            stiffness: stiffness(body),
            areas: Areas::new(body, numbering, normals),
        })
    }

    /// Prepares a step from these displacements, m.
    pub fn begin_step<T: Real>(&mut self, u: &[[T; 3]]) {
        self.areas.update(u);
    }

    /// Area of a node, m²; zero if it cannot move away from the plane.
    pub fn area(&self, plane: usize, node: usize) -> f64 {
        self.areas.of(plane, node)
    }

    /// Energy of a node at a distance (m), J; infinite behind the plane.
    pub fn energy(&self, area: f64, gap: f64) -> f64 {
        self.stiffness * area * self.distance * b(gap / self.distance)
    }

    /// Force away from the plane on a node at a distance (m), N; zero behind it, where the energy is infinite.
    pub fn force(&self, area: f64, gap: f64) -> f64 {
        -self.stiffness * area * slope(gap / self.distance)
    }

    /// Second derivative of the energy with respect to the distance (m), N/m.
    pub fn curvature(&self, area: f64, gap: f64) -> f64 {
        self.stiffness * area / self.distance * curvature(gap / self.distance)
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        self.areas.bytes()
    }
}

/// b(s) = −(s − 1)² ln s, which keeps its digits near s = 1.
fn b(s: f64) -> f64 {
    match s {
        s if s >= 1.0 => 0.0,
        s if s > 0.0 => -(s - 1.0).powi(2) * (s - 1.0).ln_1p(),
        _ => f64::INFINITY,
    }
}

/// b'(s) = −2 (s − 1) ln s − (s − 1)²/s; zero outside 0 < s < 1.
fn slope(s: f64) -> f64 {
    if !(s > 0.0 && s < 1.0) {
        return 0.0;
    }
    let t = s - 1.0;
    -2.0 * t * t.ln_1p() - t * t / s
}

/// b''(s) = −2 ln s − 4 (s − 1)/s + (s − 1)²/s², positive in 0 < s < 1 and zero outside.
fn curvature(s: f64) -> f64 {
    if !(s > 0.0 && s < 1.0) {
        return 0.0;
    }
    let t = s - 1.0;
    -2.0 * t.ln_1p() - 4.0 * t / s + (t / s).powi(2)
}

/// The materials of a body.
fn materials(body: &Body) -> impl Iterator<Item = &Material> {
    body.regions.iter().map(|region| &region.material).chain([&body.material])
}

/// Largest shear modulus of a body's materials, or that of its springs, Pa.
pub fn largest_shear_modulus(body: &Body) -> f64 {
    let modulus = |material| AnyLaw::<f64>::new(material).map_or(0.0, |law| law.moduli()[0]);
    let largest = materials(body).map(modulus).fold(0.0, f64::max);
    let factor = body.stiffness_factors.iter().copied().reduce(f64::max).unwrap_or(1.0);
    f64::max(largest * factor, mass_spring::shear_modulus(body))
}

/// That modulus plus ρ g L, Pa.
fn stiffness(body: &Body) -> f64 {
    let density = materials(body).map(|material| material.density).fold(0.0, f64::max);
    largest_shear_modulus(body) + density * body.gravity.map_or(0.0, |g| g.norm()) * body.shape.mesh.length()
}

#[cfg(test)]
mod tests {
    use super::{b, curvature, slope};

    #[test]
    fn slope_and_curvature_of_the_barrier_are_its_derivatives() {
        for s in [1e-3, 0.02, 0.3, 0.7, 0.99] {
            let h = 1e-5 * s;
            let by_differences = (b(s + h) - b(s - h)) / (2.0 * h);
            assert!((slope(s) - by_differences).abs() < 1e-7 * (1.0 + slope(s).abs()), "{s}");
            let by_differences = (slope(s + h) - slope(s - h)) / (2.0 * h);
            assert!((curvature(s) - by_differences).abs() < 1e-7 * (1.0 + curvature(s)), "{s}");
            assert!(b(s) > 0.0 && slope(s) < 0.0 && curvature(s) > 0.0, "{s}");
        }
    }

    #[test]
    fn the_barrier_ends_smoothly_at_its_distance_and_is_infinite_behind_the_plane() {
        let s = 1.0 - 1e-6;
        assert!(b(s) < 1e-17 && slope(s).abs() < 1e-11 && curvature(s) < 1e-5);
        assert_eq!((b(1.0), slope(1.0), curvature(1.5)), (0.0, 0.0, 0.0));
        assert_eq!([b(0.0), b(-1.0), b(f64::NAN)], [f64::INFINITY; 3]);
    }
}
