//! The energy of the volume with J = det F averaged over patches of elements, Σ V U(J̄) with J̄ = Σ V_q J_q/V over the quadrature points of a patch:
//! elements whose volume is constrained at each point lock as Poisson's ratio approaches ½, those of a patch only together.
//!
//! A quadratic element is a patch of its own: Simo, Taylor, Pister, Variational and Projection Methods for the Volume Constraint in Finite
//! Deformation Elasto-Plasticity (1985), section 3. Linear ones share patches: de Souza Neto, Andrade Pires, Owen, F-bar-Based Linear Triangles and
//! Tetrahedra for Finite Strain Analysis of Nearly Incompressible Solids, Part I (2005), here with an energy, so that forces are
//! conservative and the stiffness is symmetric.
//!
//! The bulk modulus here is Lamé's λ, and the law at the points keeps 2/3 μ, as in selective integration: Hughes, The Finite Element Method (1987),
//! section 4.4. Without it a quadratic tetrahedron has motions without energy, the conformal ones u = 2 (b·x) x − (x·x) b, whose strain is
//! 2 (b·x) 1.

mod patches;

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use fem_model::{Body, Material, VolumeEnergy, Volumetric};
use nalgebra::{Matrix3, Vector3};

use super::points::shape_gradients;
use super::potential::add_block;
use super::volume_change::{
    add, change, cofactor, contracted, cross, of_matrix, projected_second_derivative, second_derivative,
};
use super::{AddBlock, Energy, HessianKind, InElements, Moment, Potential};
use fem_elements::materials::AnyLaw;
use fem_elements::sparse::{Block, Pattern};
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;
use patches::patches;

/// Key in the statistics.
pub const NAME: &str = "averaged_volume";

const NOT_STORED: u32 = u32::MAX;

/// The energy of the volume of a body, or of the parts of it whose material averages it.
pub struct AveragedVolume {
    patches: Vec<Patch>,
    /// Quadrature points, patch by patch.
    points: Vec<Point>,
    /// The nodes of each point, as many for all.
    terms: Vec<Term>,
    nodes_per_point: usize,
    /// Nodes of the patches, patch by patch.
    nodes: Vec<u32>,
    /// Place of the block of each pair of nodes of a patch in the matrix, row by row, [`NOT_STORED`] where it has none; empty without a matrix.
    places: Vec<u32>,
    room: Mutex<Room>,
}

/// The Hessian of one patch, and the gradient of its volume; they are overwritten.
#[derive(Default)]
struct Room {
    blocks: Vec<Matrix3<f64>>,
    slopes: Vec<Vector3<f64>>,
}

/// Elements that share a mean of J.
struct Patch {
    energy: VolumeEnergy,
    /// Bulk modulus beyond that of the law at the quadrature points, Pa.
    bulk: f64,
    /// Undeformed volume, m³.
    volume: f64,
    points: Range<usize>,
    nodes: Range<usize>,
}

struct Point {
    /// Number in the mesh.
    number: usize,
    /// m³
    volume: f64,
}

/// A node of a point.
struct Term {
    /// Place among the nodes of the patch.
    place: usize,
    /// Gradient of its shape function at the point, 1/m.
    gradient: Vector3<f64>,
}

/// The mean over a patch of θ = J − 1, or of tr G, with the derivatives of its energy density.
struct Mean {
    /// U, J/m³.
    energy: f64,
    /// U', Pa.
    pressure: f64,
    /// U'', Pa.
    curvature: f64,
}

/// The energy of the volume of a body; `None` if no material averages it.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    let mesh = &body.shape.mesh;
    let mut volume = AveragedVolume {
        patches: Vec::new(),
        points: Vec::new(),
        terms: Vec::new(),
        nodes_per_point: mesh.element().nodes(),
        nodes: Vec::new(),
        places: Vec::new(),
        room: Mutex::default(),
    };
    let volumes = mesh.volumes();
    for (material, elements) in body.materials() {
        let Some(energy) = material.volume_energy(Volumetric::Averaged) else { continue };
        for patch in patches(mesh, &elements) {
            volume.add_patch(body, (material, energy), &patch, &volumes, numbering);
        }
    }
    if volume.patches.is_empty() { None } else { Some(Box::new(volume)) }
}

impl AveragedVolume {
    fn add_patch(
        &mut self,
        body: &Body,
        (material, energy): (&Material, VolumeEnergy),
        of: &[usize],
        volumes: &[f64],
        numbering: &Numbering,
    ) {
        let mesh = &body.shape.mesh;
        let bulk = |law: AnyLaw<f64>| law.moduli()[1];
        let law = AnyLaw::<f64>::new(material);
        let Some((whole, kept)) = law.and_then(|law| Some((bulk(law), bulk(law.without_lambda()?)))) else { return };
        let mut nodes: Vec<u32> =
            of.iter().flat_map(|&element| mesh.nodes_of(element)).map(|&node| numbering.engine_node[node]).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let (first_point, first_node) = (self.points.len(), self.nodes.len());
        let points = mesh.element().points;
        for &element in of {
            for (k, gradients) in shape_gradients(mesh, element).enumerate() {
                let volume = volumes[element] / points.len() as f64;
                self.points.push(Point { number: element * points.len() + k, volume });
                self.terms.extend(mesh.nodes_of(element).iter().zip(gradients).map(|(&node, gradient)| {
                    let place = nodes.partition_point(|&other| other < numbering.engine_node[node]);
                    Term { place, gradient }
                }));
            }
        }
        let factor = |element: usize| body.stiffness_factors.get(element).copied().unwrap_or(1.0);
        let volume: f64 = of.iter().map(|&element| volumes[element]).sum();
        let weighted: f64 = of.iter().map(|&element| factor(element) * volumes[element]).sum();
        self.nodes.extend(nodes);
        self.patches.push(Patch {
            energy,
            bulk: (whole - kept) * weighted / volume,
            volume,
            points: first_point..self.points.len(),
            nodes: first_node..self.nodes.len(),
        });
    }

    /// The nodes of a point: engine's number and term.
    fn terms(&self, patch: &Patch, point: usize) -> impl Iterator<Item = (usize, &Term)> + Clone {
        let nodes = &self.nodes[patch.nodes.clone()];
        let terms = &self.terms[point * self.nodes_per_point..][..self.nodes_per_point];
        terms.iter().map(|term| (nodes[term.place] as usize, term))
    }

    /// The gradient of a field of nodal values at a point.
    fn gradient_of<T: Real>(&self, patch: &Patch, point: usize, x: &[[T; 3]]) -> Matrix3<f64> {
        self.terms(patch, point)
            .map(|(node, term)| Vector3::from(x[node].map(|x| x.as_f64())) * term.gradient.transpose())
            .sum()
    }

    /// Calls `pass` with each patch and the mean of its volume.
    fn for_each<T: Real>(&self, u: &[[T; 3]], mut pass: impl FnMut(&Patch, Mean)) {
        for patch in &self.patches {
            let change = |point: usize| patch.change(&self.gradient_of(patch, point, u));
            let sum: f64 = patch.points.clone().map(|point| self.points[point].volume * change(point)).sum();
            pass(patch, patch.at(sum / patch.volume));
        }
    }

    /// Calls `pass` with each patch and its Hessian, row by row: U''/V g⊗g + U' Σ V_q ∂²J_q with g = Σ V_q ∂J_q.
    fn for_each_hessian<T: Real>(
        &self,
        u: &[[T; 3]],
        kind: HessianKind,
        mut pass: impl FnMut(&Patch, &[Matrix3<f64>]),
    ) {
        let mut room = self.room.lock().unwrap_or_else(PoisonError::into_inner);
        self.for_each(u, |patch, mean| {
            self.write_hessian(patch, &mean, u, kind, &mut room);
            pass(patch, &room.blocks);
        });
    }

    fn write_hessian<T: Real>(&self, patch: &Patch, mean: &Mean, u: &[[T; 3]], kind: HessianKind, room: &mut Room) {
        let count = patch.nodes.len();
        let Room { blocks, slopes } = room;
        blocks.clear();
        blocks.resize(count * count, Matrix3::zeros());
        slopes.clear();
        slopes.resize(count, Vector3::zeros());
        for point in patch.points.clone() {
            let (G, volume) = (self.gradient_of(patch, point, u), self.points[point].volume);
            let slope = patch.slope(&G);
            self.terms(patch, point).for_each(|(_, term)| slopes[term.place] += volume * slope * term.gradient);
            let factor = volume * mean.pressure;
            if patch.energy == VolumeEnergy::Trace || factor == 0.0 {
                continue;
            }
            let F = Matrix3::identity() + G;
            let projected = (kind == HessianKind::Projected).then(|| projected_second_derivative(&F, factor));
            for (_, a) in self.terms(patch, point) {
                for (_, b) in self.terms(patch, point) {
                    blocks[a.place * count + b.place] += match &projected {
                        None => factor * second_derivative(&F, &a.gradient, &b.gradient),
                        Some(H) => contracted(H, &a.gradient, &b.gradient),
                    };
                }
            }
        }
        let curvature = match kind {
            HessianKind::Exact => mean.curvature,
            HessianKind::Projected => mean.curvature.max(0.0),
        };
        for (a, row) in blocks.chunks_exact_mut(count).enumerate() {
            for (b, block) in row.iter_mut().enumerate() {
                *block += curvature / patch.volume * slopes[a] * slopes[b].transpose();
            }
        }
    }
}

impl Patch {
    /// θ at a point: J − 1 without the loss of digits near rest, or tr G.
    fn change(&self, G: &Matrix3<f64>) -> f64 {
        match self.energy {
            VolumeEnergy::Trace => G.trace(),
            _ => change(G),
        }
    }

    /// ∂θ/∂F
    fn slope(&self, G: &Matrix3<f64>) -> Matrix3<f64> {
        match self.energy {
            VolumeEnergy::Trace => Matrix3::identity(),
            _ => cofactor(&(Matrix3::identity() + G)),
        }
    }

    fn at(&self, theta: f64) -> Mean {
        let (bulk, J) = (self.bulk, 1.0 + theta);
        match self.energy {
            VolumeEnergy::Trace | VolumeEnergy::Change => {
                Mean { energy: 0.5 * bulk * theta * theta, pressure: bulk * theta, curvature: bulk }
            }
            VolumeEnergy::Logarithm if J > 0.0 => {
                let ln = theta.ln_1p();
                Mean { energy: 0.5 * bulk * ln * ln, pressure: bulk * ln / J, curvature: bulk * (1.0 - ln) / (J * J) }
            }
            VolumeEnergy::Logarithm => Mean { energy: f64::INFINITY, pressure: 0.0, curvature: bulk },
        }
    }
}

impl<T: Real> Potential<T> for AveragedVolume {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        let (patches, points) = (self.patches.len(), self.points.len());
        format!("[material] with volumetric = \"averaged\": J of {points} quadrature points in {patches} patches")
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.patches[..])
            + size_of_val(&self.points[..])
            + size_of_val(&self.terms[..])
            + size_of_val(&self.nodes[..])
            + size_of_val(&self.places[..])
    }

    fn energy(&self, u: &[[T; 3]], _: Moment) -> Energy {
        let mut sum = Energy::default();
        self.for_each(u, |patch, mean| sum = sum + Energy::of(patch.volume * mean.energy));
        sum
    }

    fn add_gradient(&self, u: &[[T; 3]], _: Moment, gradient: &mut [[T; 3]]) {
        self.for_each(u, |patch, mean| {
            for point in patch.points.clone() {
                let P = self.points[point].volume * mean.pressure * patch.slope(&self.gradient_of(patch, point, u));
                self.terms(patch, point).for_each(|(node, term)| add(&mut gradient[node], P * term.gradient));
            }
        });
    }

    fn hessian(&self, u: &[[T; 3]], _: Moment, kind: HessianKind, pass: &mut AddBlock<T>) {
        self.for_each_hessian(u, kind, |patch, blocks| {
            let nodes = &self.nodes[patch.nodes.clone()];
            let pairs = nodes.iter().flat_map(|row| nodes.iter().map(move |column| (*row, *column)));
            pairs.zip(blocks).for_each(|((row, column), block)| pass(row as usize, column as usize, of_matrix(block)));
        });
    }

    fn add_hessian(
        &self,
        factor: T,
        u: &[[T; 3]],
        _: Moment,
        kind: HessianKind,
        _: &Pattern,
        values: &mut [Block<T, 3>],
    ) {
        let mut places = self.places.iter();
        self.for_each_hessian(u, kind, |_, blocks| {
            for (block, &place) in blocks.iter().zip(places.by_ref()) {
                if place != NOT_STORED {
                    add_block(factor, &of_matrix(block), &mut values[place as usize]);
                }
            }
        });
    }

    fn add_hessian_times(&self, factor: T, u: &[[T; 3]], _: Moment, d: &[[T; 3]], product: &mut [[T; 3]]) {
        self.for_each(u, |patch, mean| {
            let at = |point: usize| {
                let (G, change) = (self.gradient_of(patch, point, u), self.gradient_of(patch, point, d));
                (patch.slope(&G), change, Matrix3::identity() + G, self.points[point].volume)
            };
            let along = |point: usize| {
                let (slope, change, _, volume) = at(point);
                volume * slope.dot(&change)
            };
            let of_mean = mean.curvature / patch.volume * patch.points.clone().map(along).sum::<f64>();
            for point in patch.points.clone() {
                let (slope, change, F, volume) = at(point);
                let mut P = volume * of_mean * slope;
                if patch.energy != VolumeEnergy::Trace {
                    P += volume * mean.pressure * cross(&change, &F);
                }
                P *= factor.as_f64();
                self.terms(patch, point).for_each(|(node, term)| add(&mut product[node], P * term.gradient));
            }
        });
    }

    fn set_pattern(&mut self, pattern: &Pattern) {
        let place = |row: u32, column: u32| {
            let found = pattern.find(row as usize, column as usize);
            found.map_or(NOT_STORED, |block| u32::try_from(block).expect("a matrix has fewer than 2³² blocks"))
        };
        let nodes = self.patches.iter().map(|patch| &self.nodes[patch.nodes.clone()]);
        let pairs =
            nodes.flat_map(|nodes| nodes.iter().flat_map(move |row| nodes.iter().map(move |column| (*row, *column))));
        self.places = pairs.map(|(row, column)| place(row, column)).collect();
    }

    fn resultant(&self, _: Moment) -> Option<[f64; 3]> {
        Some([0.0; 3])
    }

    fn in_elements(&self) -> Option<&dyn InElements<T>> {
        Some(self)
    }
}

impl<T: Real> InElements<T> for AveragedVolume {
    fn is_elastic(&self) -> bool {
        true
    }

    fn add_stresses(&self, u: &[[T; 3]], _: Moment, stresses: &mut [Matrix3<f64>]) {
        self.for_each(u, |patch, mean| {
            for point in &self.points[patch.points.clone()] {
                stresses[point.number] += Matrix3::from_diagonal_element(mean.pressure);
            }
        });
    }
}
