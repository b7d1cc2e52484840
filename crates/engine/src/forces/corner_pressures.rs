//! The energy of the volume with pressures as unknowns beside the displacements: ∫ p θ − p²/(2λ) with θ = J − 1, tr G, or ln J, stationary in p.
//! Lamé's λ acts through the pressures alone, and the law at the quadrature points keeps 2/3 μ as its bulk modulus, as where the
//! [volume is averaged](super::averaged_volume). With ν = ½ the pressures hold the volume, and λ is that of [`Elastic::lame`](fem_model::Elastic::lame).
//!
//! Pressures are continuous, with a value at each corner. Quadratic elements: Taylor and Hood, A Numerical Solution of the Navier–Stokes Equations Using
//! the Finite Element Technique (1973). Linear ones do not hold them, so that they are stabilized by − (p − Π p)²/(2μ), Π p being
//! the mean of an element: Dohrmann and Bochev, A Stabilized Finite Element Method for the Stokes Problem Based on Polynomial Pressure Projections (2004).
//!
//! The energy of displacements is that of the pressures which they cause, C p = ∫ N θ. Newton's method has both as unknowns: there the energy is the
//! augmented Lagrangian at the pressures of the iteration.

use std::sync::{Mutex, PoisonError, RwLock, RwLockReadGuard};

use fem_model::{Body, Material, VolumeEnergy, Volumetric};
use nalgebra::{Matrix3, Vector3};

use super::energy::Energy;
use super::points::Points;
use super::volume_change::{change, cofactor, cross};
use fem_elements::materials::AnyLaw;
use fem_solvers::numbering::Numbering;
use fem_solvers::{Ldlt, Real};

/// Relative residual of the pressures that displacements cause.
const ROUNDING: f64 = 1e-14;

/// The energy of the volume of a body, or of the parts of it whose material has pressures.
pub struct CornerPressures {
    points: Points,
    /// The linear shape functions of the corners at each quadrature point of an element.
    shape: &'static [&'static [f64]],
    elements: Vec<Element>,
    /// The node of each pressure, in ascending order.
    nodes: Vec<u32>,
    /// Undeformed volumes of the corners, m³.
    volumes: Vec<f64>,
    /// Factor ρ of the square of the volume that is left at a corner: μ over its volume, Pa/m³.
    penalty: Vec<f64>,
    /// Pa/m
    scale: f64,
    /// The factor of C, by which displacements have pressures.
    compliance: Mutex<Ldlt>,
    /// The pressures of Newton's method while it runs, Pa.
    iteration: RwLock<Option<Vec<f64>>>,
}

/// An element with its pressures.
pub struct Element {
    /// Number in the mesh.
    number: usize,
    /// Energy of its volume.
    pub energy: VolumeEnergy,
    /// Numbers of the pressures at its corners.
    corners: Vec<u32>,
    /// Undeformed volume, m³.
    volume: f64,
    /// 1/λ, and that of the stabilization, 1/μ or zero, 1/Pa.
    compliance: [f64; 2],
}

impl CornerPressures {
    /// The pressures of a body; `None` if no material has some.
    pub fn new(body: &Body, numbering: &Numbering) -> Option<Self> {
        let mesh = &body.shape.mesh;
        let volumes = mesh.volumes();
        let mut elements: Vec<Element> = Vec::new();
        let mut shear: Vec<f64> = Vec::new();
        let materials: Vec<_> = body.materials().map(|(material, own)| (moduli(material), own)).collect();
        let corners = |number: usize| mesh.corners_of(number).iter().map(|&corner| numbering.engine_node[corner]);
        let with_pressures = materials.iter().enumerate().filter(|(_, (moduli, _))| moduli.is_some());
        // In the order of the nodes, which keeps the fill of factors low. Materials that meet have pressures of their own.
        let mut nodes: Vec<(u32, usize)> = with_pressures
            .flat_map(|(place, (_, own))| own.iter().flat_map(|&n| corners(n)).map(move |node| (node, place)))
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        for (place, (moduli, own)) in materials.iter().enumerate() {
            let Some((energy, [mu, lambda])) = *moduli else { continue };
            for &number in own {
                let factor = body.stiffness_factors.get(number).copied().unwrap_or(1.0);
                let corners = corners(number).map(|node| nodes.partition_point(|other| *other < (node, place)) as u32);
                let stabilization = if mesh.element().order == 1 { 1.0 / (factor * mu) } else { 0.0 };
                let compliance = [1.0 / (factor * lambda), stabilization];
                let corners = corners.collect();
                elements.push(Element { number, energy, corners, volume: volumes[number], compliance });
                shear.push(factor * mu);
            }
        }
        if elements.is_empty() {
            return None;
        }
        let (mut lumped, mut weighted) = (vec![0.0; nodes.len()], vec![0.0; nodes.len()]);
        for (element, shear) in elements.iter().zip(&shear) {
            let share = element.volume / element.corners.len() as f64;
            for &corner in &element.corners {
                lumped[corner as usize] += share;
                weighted[corner as usize] += share * shear;
            }
        }
        let (sum, whole) = (weighted.iter().sum::<f64>(), lumped.iter().sum::<f64>());
        let scale = sum / whole / (whole / lumped.len() as f64).cbrt();
        let penalty = lumped.iter().zip(&weighted).map(|(volume, weighted)| weighted / (volume * volume)).collect();
        let (places, entries): (Vec<_>, Vec<_>) = elements.iter().flat_map(Element::compliance_entries).unzip();
        let mut compliance = Ldlt::new(nodes.len(), &places);
        // Moduli that make it anything but positive definite are refused.
        compliance.set(entries.into_iter());
        compliance.factor().ok()?;
        Some(Self {
            points: Points::new(mesh, numbering),
            shape: mesh.element().points,
            elements,
            nodes: nodes.into_iter().map(|(node, _)| node).collect(),
            penalty,
            volumes: lumped,
            scale,
            compliance: Mutex::new(compliance),
            iteration: RwLock::new(None),
        })
    }

    /// The node of each pressure, in the engine's numbers, which ascend.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// Number of elements with pressures.
    pub fn elements(&self) -> usize {
        self.elements.len()
    }

    /// The quadrature points of the whole body.
    pub fn points(&self) -> &Points {
        &self.points
    }

    /// Allocated bytes.
    pub fn allocated(&self) -> usize {
        let corners: usize = self.elements.iter().map(|element| size_of_val(&element.corners[..])).sum();
        let compliance = self.compliance.lock().unwrap_or_else(PoisonError::into_inner).bytes();
        let of_pressures =
            size_of_val(&self.penalty[..]) + size_of_val(&self.volumes[..]) + size_of_val(&self.nodes[..]);
        self.points.bytes() + size_of_val(&self.elements[..]) + corners + of_pressures + compliance
    }

    /// Energy, J: while Newton's method runs, the augmented Lagrangian at its pressures.
    pub fn energy_at<T: Real>(&self, u: &[[T; 3]]) -> Energy {
        let theta = self.weighted_theta(u);
        if !theta.iter().all(|theta| theta.is_finite()) {
            return Energy::of(f64::INFINITY);
        }
        let iteration = self.iteration();
        let Some(pressures) = &*iteration else {
            let pairs = self.pressures_of(u).into_iter().zip(theta);
            return pairs.map(|(p, theta)| Energy::of(0.5 * p * theta)).sum();
        };
        let left = self.left(u, pressures);
        let at_corner = |(((p, theta), left), penalty): (((&f64, &f64), &f64), &f64)| {
            Energy::of(0.5 * p * theta) + Energy::of(0.5 * p * left) + Energy::of(0.5 * penalty * left * left)
        };
        pressures.iter().zip(&theta).zip(&left).zip(&self.penalty).map(at_corner).sum()
    }

    /// Number of pressures.
    pub fn count(&self) -> usize {
        self.penalty.len()
    }

    /// A pressure in these units has the size of a displacement in the equations, Pa/m: the mean of μ over the size of a corner's volume.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// The pressures that displacements cause, Pa.
    pub fn pressures_of<T: Real>(&self, u: &[[T; 3]]) -> Vec<f64> {
        let mut pressures = self.weighted_theta(u);
        self.compliance.lock().unwrap_or_else(PoisonError::into_inner).solve(&mut pressures, ROUNDING);
        pressures
    }

    /// Sets the pressures at which energy and gradient are evaluated while Newton's method runs, Pa; `None` for those that displacements cause.
    pub fn set_iteration(&self, pressures: Option<Vec<f64>>) {
        *self.iteration.write().unwrap_or_else(PoisonError::into_inner) = pressures;
    }

    fn iteration(&self) -> RwLockReadGuard<'_, Option<Vec<f64>>> {
        self.iteration.read().unwrap_or_else(PoisonError::into_inner)
    }

    /// ∫ N θ − C p, m³: the volume that is left where displacements do not belong to the pressures.
    pub fn left<T: Real>(&self, u: &[[T; 3]], pressures: &[f64]) -> Vec<f64> {
        let mut left = self.weighted_theta(u);
        left.iter_mut().zip(self.compliance_times(pressures)).for_each(|(left, of)| *left -= of);
        left
    }

    /// C p, m³.
    pub fn compliance_times(&self, pressures: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.count()];
        for element in &self.elements {
            for (i, &row) in element.corners.iter().enumerate() {
                let terms = element.corners.iter().enumerate();
                let terms = terms.map(|(j, &column)| element.entry(i, j) * pressures[column as usize]);
                product[row as usize] += terms.sum::<f64>();
            }
        }
        product
    }

    /// Factor ρ of the squares in the augmented Lagrangian, Pa/m³.
    pub fn penalty(&self) -> &[f64] {
        &self.penalty
    }

    /// The largest volume that is left at a corner, relative to its own.
    pub fn relative(&self, left: &[f64]) -> f64 {
        left.iter().zip(&self.volumes).fold(0.0, |largest, (left, volume)| f64::max(largest, left.abs() / volume))
    }

    /// The pressures at which the gradient of the augmented Lagrangian is that of the Lagrangian, p + ρ (∫ N θ − C p), Pa; those that displacements
    /// cause where Newton's method does not run.
    pub fn pressures_at<T: Real>(&self, u: &[[T; 3]]) -> Vec<f64> {
        let Some(pressures) = self.iteration().clone() else { return self.pressures_of(u) };
        let left = self.left(u, &pressures);
        pressures.iter().zip(&self.penalty).zip(left).map(|((p, penalty), left)| p + penalty * left).collect()
    }

    /// Number of entries of [`coupling`](Self::coupling).
    pub fn couplings(&self) -> impl Iterator<Item = (u32, usize)> {
        self.elements.iter().flat_map(move |element| {
            self.quadrature_points(element).flat_map(move |(_, point)| {
                let pairs = move |corner: u32| self.points.nodes(point).map(move |(node, _)| (corner, node));
                element.corners.iter().flat_map(move |&corner| pairs(corner))
            })
        })
    }

    /// Passes the derivatives of ∫ N θ by the displacements, m²: for the pressures and nodes of [`couplings`](Self::couplings).
    pub fn coupling<T: Real>(&self, u: &[[T; 3]], mut pass: impl FnMut(Vector3<f64>)) {
        for element in &self.elements {
            for (shape, point) in self.quadrature_points(element) {
                let slope = element.slope(&self.points.gradient_of(point, u)) * self.points.volume(point);
                for value in shape.iter() {
                    self.points.nodes(point).for_each(|(_, gradient)| pass(*value * slope * gradient));
                }
            }
        }
    }

    /// C in entries of its lower half with their places, m³/Pa. Entries of one place add up.
    pub fn compliance(&self) -> impl Iterator<Item = ([u32; 2], f64)> {
        self.elements.iter().flat_map(Element::compliance_entries)
    }

    /// The quadrature points of an element, with the shape functions of its corners.
    fn quadrature_points(&self, element: &Element) -> impl Iterator<Item = (&'static [f64], usize)> + use<> {
        let first = element.number * self.shape.len();
        self.shape.iter().copied().enumerate().map(move |(k, shape)| (shape, first + k))
    }

    /// ∫ N θ, m³; not finite where θ is not.
    fn weighted_theta<T: Real>(&self, u: &[[T; 3]]) -> Vec<f64> {
        let mut sum = vec![0.0; self.count()];
        for element in &self.elements {
            for (shape, point) in self.quadrature_points(element) {
                let theta = element.theta(&self.points.gradient_of(point, u)) * self.points.volume(point);
                element.corners.iter().zip(shape).for_each(|(&corner, shape)| sum[corner as usize] += shape * theta);
            }
        }
        sum
    }

    /// Calls `pass` with each element and quadrature point, and the pressure there.
    pub fn for_each_point(&self, pressures: &[f64], mut pass: impl FnMut(&Element, usize, f64)) {
        for element in &self.elements {
            for (shape, point) in self.quadrature_points(element) {
                let terms =
                    element.corners.iter().zip(shape).map(|(&corner, shape)| pressures[corner as usize] * shape);
                pass(element, point, terms.sum());
            }
        }
    }
}

/// The energy of the volume and the moduli μ and λ of a material with pressures, Pa.
fn moduli(material: &Material) -> Option<(VolumeEnergy, [f64; 2])> {
    let energy = material.volume_energy(Volumetric::Mixed)?;
    let law = AnyLaw::<f64>::new(material)?;
    let [shear, bulk] = law.moduli();
    let [_, kept] = law.without_lambda()?.moduli();
    Some((energy, [shear, bulk - kept]))
}

impl Element {
    /// Entry of C: the mass of the linear shape functions over λ, and over μ what it has beyond that of the element's means.
    fn entry(&self, i: usize, j: usize) -> f64 {
        let n = self.corners.len() as f64;
        let consistent = if i == j { 2.0 } else { 1.0 } / (n * (n + 1.0));
        let [compliance, stabilization] = self.compliance;
        self.volume * (compliance * consistent + stabilization * (consistent - 1.0 / (n * n)))
    }

    fn compliance_entries(&self) -> impl Iterator<Item = ([u32; 2], f64)> {
        let pairs = (0..self.corners.len()).flat_map(|i| (0..self.corners.len()).map(move |j| (i, j)));
        let of_pair = |(i, j): (usize, usize)| ([self.corners[i], self.corners[j]], self.entry(i, j));
        pairs.map(of_pair).filter(|([row, column], _)| row >= column)
    }

    /// θ; infinite where it is not defined.
    fn theta(&self, G: &Matrix3<f64>) -> f64 {
        match self.energy {
            VolumeEnergy::Trace => G.trace(),
            VolumeEnergy::Change => change(G),
            VolumeEnergy::Logarithm => {
                let change = change(G);
                if change > -1.0 { change.ln_1p() } else { f64::INFINITY }
            }
        }
    }

    /// ∂θ/∂F
    pub fn slope(&self, G: &Matrix3<f64>) -> Matrix3<f64> {
        match self.energy {
            VolumeEnergy::Trace => Matrix3::identity(),
            VolumeEnergy::Change => cofactor(&(Matrix3::identity() + G)),
            VolumeEnergy::Logarithm => cofactor(&(Matrix3::identity() + G)) / (1.0 + change(G)),
        }
    }

    /// `factor` ∂²θ/∂F² times a direction.
    pub fn second_derivative_times(&self, factor: f64, F: &Matrix3<f64>, direction: &Matrix3<f64>) -> Matrix3<f64> {
        match self.energy {
            VolumeEnergy::Trace => Matrix3::zeros(),
            VolumeEnergy::Change => factor * cross(direction, F),
            VolumeEnergy::Logarithm => {
                let (J, slope) = (F.determinant(), cofactor(F));
                factor / J * (cross(direction, F) - slope.dot(direction) / J * slope)
            }
        }
    }
}

#[cfg(test)]
mod tests;
