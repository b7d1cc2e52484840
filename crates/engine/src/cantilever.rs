//! The tip displacement of a cantilever by Timoshenko's beam theory, for comparison with a simulated one.

use std::collections::HashSet;

use nalgebra::Vector3;

use fem_elements::materials::AnyLaw;
use fem_mesh::{Side, nodes_on_side};
use fem_model::simulation::Simulation;
use fem_model::{Body, BodyMesh, Elastic, Integrator, Material, Method, Traction};

/// A beam of rectangular cross-section, clamped at one end, that bends in one plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cantilever {
    /// m
    pub length: f64,
    /// Edge of the cross-section along the load, m.
    pub height: f64,
    /// Edge of the cross-section across the load, m.
    pub width: f64,
    /// Young's modulus, Pa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
}

impl Cantilever {
    /// Deflection of the tip under a force at the tip (N), m: P L³ / (3 E I) + P L / (κ G A).
    ///
    /// κ = 10 (1 + ν) / (12 + 11 ν), G. R. Cowper, "The shear coefficient in Timoshenko's beam theory", Journal of Applied
    /// Mechanics 33, 1966.
    pub fn under_end_load(&self, force: f64) -> f64 {
        let L = self.length;
        force * (L.powi(3) / (3.0 * self.bending()) + L / self.shear())
    }

    /// Deflection of the tip under a load along the whole beam (N/m), m: w L⁴ / (8 E I) + w L² / (2 κ G A).
    pub fn under_even_load(&self, load: f64) -> f64 {
        let L = self.length;
        load * (L.powi(4) / (8.0 * self.bending()) + L.powi(2) / (2.0 * self.shear()))
    }

    /// E I, N m²
    fn bending(&self) -> f64 {
        self.young * self.width * self.height.powi(3) / 12.0
    }

    /// κ G A, N
    fn shear(&self) -> f64 {
        let nu = self.poisson;
        let kappa = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
        kappa * self.young / (2.0 * (1.0 + nu)) * self.width * self.height
    }
}

/// Tip displacement of a cantilever by Timoshenko's theory, m. `None` if the body is not one: a uniform box along x, clamped at its end of
/// smallest x, in equilibrium (`static`) under dead loads across x on the whole volume or on the other end.
pub fn expected_tip_displacement(body: &Body, method: &Method) -> Option<Vector3<f64>> {
    let size = box_size(&body.shape.mesh)?;
    let is_loaded_alone = body.pressures.is_empty()
        && body.nodal_forces.is_empty()
        && body.fields.tables().next().is_none()
        && body.springs.is_empty()
        && body.drag.is_none()
        && body.contact.is_none();
    let is_uniform = body.regions.is_empty() && body.stiffness_factors.is_empty() && body.plasticity.is_none();
    if method.integrator != Integrator::Static || !is_uniform || !is_clamped_alone(body) || !is_loaded_alone {
        return None;
    }
    let (even, end) = (force_density(body), end_traction(body)?);
    if even.x != 0.0 || end.x != 0.0 {
        return None;
    }
    let Elastic { young, poisson } = moduli(&body.material)?;
    let area = size[1] * size[2];
    let along = |axis: usize| {
        let beam = Cantilever { length: size[0], height: size[axis], width: area / size[axis], young, poisson };
        beam.under_even_load(even[axis] * area) + beam.under_end_load(end[axis] * area)
    };
    Some(Vector3::new(0.0, along(1), along(2)))
}

/// Mean displacement of the nodes of largest x, m.
pub fn tip_displacement(simulation: &dyn Simulation) -> Vector3<f64> {
    let (shape, q) = (simulation.shape(), simulation.positions());
    let X = shape.mesh.vertices();
    let tip = nodes_on_side(X, 0, Side::Max, 0.0);
    let displacement = |&node: &usize| q.fixed_rows::<3>(3 * node) - X[node];
    tip.iter().map(displacement).sum::<Vector3<f64>>() / tip.len() as f64
}

/// The edges of a box parallel to the axes that a solid mesh fills, m; `None` for another shape.
fn box_size(mesh: &BodyMesh) -> Option<Vector3<f64>> {
    let x = mesh.vertices();
    let (least, most) = x.iter().fold((x[0], x[0]), |(least, most), x| (least.inf(x), most.sup(x)));
    let (size, volume) = (most - least, mesh.volumes().iter().sum::<f64>());
    (mesh.dimension() == 3 && (volume - size.product()).abs() <= ROUNDING * volume).then_some(size)
}

/// Part of a volume, or of a length, that is a rounding error.
const ROUNDING: f64 = 1e-9;

/// Returns true if the nodes of smallest x are fixed and no others are constrained.
fn is_clamped_alone(body: &Body) -> bool {
    let [condition] = &body.dirichlet[..] else { return false };
    let end = nodes_on_side(body.shape.mesh.vertices(), 0, Side::Min, 0.0);
    condition.motion.is_none() && condition.until.is_none() && condition.nodes == end
}

/// Gravity and body force, N/m³.
fn force_density(body: &Body) -> Vector3<f64> {
    body.material.density * body.gravity.unwrap_or_default() + body.body_force.unwrap_or_default()
}

/// Sum of all tractions, Pa; `None` unless each of them loads the whole end of largest x.
fn end_traction(body: &Body) -> Option<Vector3<f64>> {
    let x = body.shape.mesh.vertices();
    let end: HashSet<usize> = nodes_on_side(x, 0, Side::Max, 0.0).into_iter().collect();
    let is_at_end = |face: &[usize]| face.iter().all(|node| end.contains(node));
    let faces = body.shape.faces().iter().filter(|face| is_at_end(face)).count();
    let end_load = |traction: &Traction| {
        let is_end = traction.faces.len() == faces && traction.faces.iter().all(|face| is_at_end(face));
        is_end.then_some(traction.force_per_area)
    };
    body.tractions.iter().map(end_load).sum()
}

/// Young's modulus and Poisson's ratio at small strain: as given, or from the law's shear modulus G and bulk modulus K,
/// E = 9 K G / (3 K + G) and ν = (3 K − 2 G) / (6 K + 2 G). `None` for springs.
pub fn moduli(material: &Material) -> Option<Elastic> {
    material.law.elastic().or_else(|| {
        let [G, K] = AnyLaw::<f64>::new(material)?.moduli();
        Some(Elastic::new(9.0 * K * G / (3.0 * K + G), (3.0 * K - 2.0 * G) / (6.0 * K + 2.0 * G)))
    })
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    const BEAM: Cantilever = Cantilever { length: 8.0, height: 1.0, width: 1.0, young: 1e6, poisson: 0.3 };

    #[test]
    fn a_slender_beam_bends_as_euler_and_bernoulli_predict() {
        let slender = Cantilever { length: 1e4, ..BEAM };
        assert_relative_eq!(slender.under_end_load(1e-6), 4.0, max_relative = 1e-7);
        assert_relative_eq!(slender.under_even_load(1e-10), 1.5, max_relative = 1e-7);
    }

    #[test]
    fn a_short_beam_has_a_shear_deflection_beside_its_bending() {
        // κ = 13/15.3, G = 1e6/2.6: P L³/(3 E I) = 0.1024 m and P L/(κ G A) = 400/326797.4 m
        assert_relative_eq!(BEAM.under_end_load(50.0), 0.1024 + 0.001224, max_relative = 1e-9);
    }

    #[test]
    fn an_even_load_is_the_sum_of_point_loads() {
        // By Betti's theorem a force at x moves the tip by P (x²(3L − x)/(6EI) + x/(κGA)).
        let (pieces, L) = (10_000, BEAM.length);
        let piece = L / f64::from(pieces);
        let at = |x: f64| x * x * (3.0 * L - x) / (6.0 * BEAM.bending()) + x / BEAM.shear();
        let sum: f64 = (0..pieces).map(|i| 7.0 * piece * at(piece * (f64::from(i) + 0.5))).sum();
        assert_relative_eq!(BEAM.under_even_load(7.0), sum, max_relative = 1e-7);
    }
}
