//! Gravity towards a point, of every node's mass m: V = −m μ/s with s² = |d|² + ε², where d is the vector from the point to the node. Plummer, On the
//! Problem of Distribution in Globular Star Clusters (1911): the softening length ε keeps the force finite.
//!
//! The energy is counted from that of the undeformed body, m μ (s² − s₀²)/(s s₀ (s + s₀)) with s² − s₀² = u·(2 d₀ + u), which keeps its digits
//! however far the point is. Its Hessian m μ ((1 − n nᵀ)/s³ + (s² − 3 |d|²)/s⁵ n nᵀ), n along d, is indefinite for |d| > s/√3.

use fem_model::{Body, CentralGravity};
use nalgebra::Vector3;

use super::{AddBlock, Energy, HessianKind, Moment, Potential};
use fem_elements::vector::triple;
use fem_model::element::shares::{load_shares, lumped_mass_shares};
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// Key in the statistics.
pub const NAME: &str = "central_gravity";

/// All fields of this kind on a body, in double precision.
struct Centers {
    fields: Vec<CentralGravity>,
    /// Undeformed positions of the nodes in the engine's order, m, and their masses, kg.
    nodes: Vec<(Vector3<f64>, f64)>,
}

/// The gravity of `[central_gravity]`; `None` where a body has none.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    let fields = body.fields.central_gravity.clone();
    if fields.is_empty() {
        return None;
    }
    let (x, masses) = (body.shape.mesh.vertices(), node_masses(body));
    let nodes = numbering.mesh_node.iter().map(|&node| (x[node as usize], masses[node as usize]));
    Some(Box::new(Centers { fields, nodes: nodes.collect() }))
}

/// The mass that each node carries, kg: row sums of the mass matrix.
fn node_masses(body: &Body) -> Vec<f64> {
    let mesh = &body.shape.mesh;
    let shares = if body.lumped_mass { lumped_mass_shares } else { load_shares };
    let shares = shares(mesh.element());
    let mut masses = vec![0.0; mesh.vertices().len()];
    for (element, (nodes, volume)) in mesh.corners().zip(mesh.volumes()).enumerate() {
        let mass = volume * body.material.density * body.density_factors.get(element).copied().unwrap_or(1.0);
        nodes.iter().zip(&shares).for_each(|(&node, share)| masses[node] += share * mass);
    }
    masses
}

/// A node in a field.
struct InField {
    /// m μ, N m²
    weight: f64,
    /// d₀ and d, m
    rest: Vector3<f64>,
    place: Vector3<f64>,
    /// ε, m
    softening: f64,
}

impl InField {
    /// s₀ and s, m
    fn distances(&self) -> [f64; 2] {
        [self.rest, self.place].map(|d| d.norm().hypot(self.softening))
    }
}

impl Centers {
    /// Every node in every field.
    fn nodes<'a, T: Real>(
        &'a self,
        u: &'a [[T; 3]],
        moment: Moment,
    ) -> impl Iterator<Item = (usize, InField)> + use<'a, T> {
        let factor = moment.factor(None);
        self.fields.iter().flat_map(move |field| {
            self.nodes.iter().zip(u).enumerate().map(move |(node, (&(x, mass), u))| {
                let rest = x - Vector3::from(field.center);
                let place = rest + Vector3::from(u.map(T::as_f64));
                (node, InField { weight: factor * mass * field.strength, rest, place, softening: field.softening })
            })
        })
    }
}

impl<T: Real> Potential<T> for Centers {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        let of_field = |CentralGravity { strength, softening, .. }: &CentralGravity| {
            format!("[central_gravity]: μ = {strength:.4e} m³/s², softened over {softening:.4e} m")
        };
        self.fields.iter().map(of_field).collect::<Vec<_>>().join("; ")
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..])
    }

    fn is_steady(&self) -> bool {
        true
    }

    fn energy(&self, u: &[[T; 3]], moment: Moment) -> Energy {
        let of_node = |(node, of): (usize, InField)| {
            let [start, s] = of.distances();
            let growth = (of.rest + of.place).dot(&Vector3::from(u[node].map(T::as_f64)));
            Energy::of(of.weight * growth / (s * start * (s + start)))
        };
        self.nodes(u, moment).map(of_node).sum()
    }

    fn add_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) {
        for (node, of) in self.nodes(u, moment) {
            let [_, s] = of.distances();
            let force = of.place * (of.weight / s.powi(3));
            (0..3).for_each(|i| gradient[node][i] += T::of(force[i]));
        }
    }

    fn hessian(&self, u: &[[T; 3]], moment: Moment, kind: HessianKind, add: &mut AddBlock<T>) {
        for (node, of) in self.nodes(u, moment) {
            let ([_, s], d) = (of.distances(), of.place);
            let across = of.weight / s.powi(3);
            let along = across - 3.0 * across * d.norm_squared() / (s * s);
            let along = if kind == HessianKind::Projected { along.max(0.0) } else { along };
            let n = d.try_normalize(0.0).unwrap_or_default();
            let entry = |i: usize, j: usize| {
                let diagonal = if i == j { across } else { 0.0 };
                T::of(diagonal + (along - across) * n[i] * n[j])
            };
            add(node, node, triple(|i| triple(|j| entry(i, j))));
        }
    }

    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        let rest = vec![[T::zero(); 3]; self.nodes.len()];
        let stiffness = |(_, of): (usize, InField)| T::of(of.weight / of.distances()[1].powi(3)).as_f64();
        let fits = self.nodes(&rest, Moment::at(0.0)).map(stiffness).all(f64::is_finite);
        (!fits).then_some((NAME, "a force on a node"))
    }
}
