//! Dead loads: nodal forces that keep their direction, and their size up to a factor of time. Weight, body force, tractions, nodal forces.

use fem_model::{Body, LoadCurve};
use nalgebra::Vector3;

use super::{AddBlock, Energy, HessianKind, Moment, Potential};
use fem_elements::vector::{dot3, triple};
use fem_model::element::shares::{face_shares, load_shares, lumped_mass_shares};
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// Key in the statistics.
pub const NAME: &str = "dead_load";

/// Nodal forces in the engine's order. Loads with the same factor of time are summed.
pub struct DeadLoad<T> {
    loads: Vec<Load<T>>,
    /// The scene's table with the largest numbers.
    largest: &'static str,
}

/// Nodal forces, N, and their factor of time.
struct Load<T> {
    force: Vec<[T; 3]>,
    curve: Option<LoadCurve>,
}

impl<T: Real> DeadLoad<T> {
    /// These constant forces on the nodes, N.
    pub fn new(force: Vec<[T; 3]>) -> Self {
        Self { loads: vec![Load { force, curve: None }], largest: "gravity" }
    }
}

/// Weight, body force, dead tractions and nodal forces of a body; `None` where it has none of them.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    let mut sums = Sums { nodes: body.shape.mesh.vertices().len(), of_curve: Vec::new() };
    add_volume_loads(body, &mut sums);
    add_tractions(body, &mut sums);
    for load in &body.nodal_forces {
        let force = sums.of(&load.curve);
        load.nodes.iter().for_each(|&node| force[node] += load.force);
    }
    let in_order = |(curve, force): (Option<LoadCurve>, Vec<Vector3<f64>>)| {
        let force = numbering.mesh_node.iter().map(|&node| force[node as usize]);
        Load { force: force.map(|f| [T::of(f.x), T::of(f.y), T::of(f.z)]).collect(), curve }
    };
    let loads: Vec<_> = sums.of_curve.into_iter().map(in_order).collect();
    (!loads.is_empty()).then(|| Box::new(DeadLoad { loads, largest: largest(body) }) as Box<dyn Potential<T>>)
}

/// The scene's table whose load has the largest numbers.
fn largest(body: &Body) -> &'static str {
    let size =
        |vectors: &mut dyn Iterator<Item = &Vector3<f64>>| vectors.map(|vector| vector.amax()).fold(0.0, f64::max);
    let tables = [
        ("gravity", size(&mut body.gravity.iter())),
        ("body_force", size(&mut body.body_force.iter())),
        ("traction", size(&mut body.tractions.iter().map(|traction| &traction.force_per_area))),
        ("force", size(&mut body.nodal_forces.iter().map(|load| &load.force))),
    ];
    tables
        .into_iter()
        .reduce(|largest, next| if next.1 > largest.1 { next } else { largest })
        .map_or("gravity", |table| table.0)
}

/// Sums of the nodal forces that have the same factor of time, N.
struct Sums {
    nodes: usize,
    of_curve: Vec<(Option<LoadCurve>, Vec<Vector3<f64>>)>,
}

impl Sums {
    fn of(&mut self, curve: &Option<LoadCurve>) -> &mut [Vector3<f64>] {
        let place = self.of_curve.iter().position(|(other, _)| other == curve).unwrap_or_else(|| {
            self.of_curve.push((curve.clone(), vec![Vector3::zeros(); self.nodes]));
            self.of_curve.len() - 1
        });
        &mut self.of_curve[place].1
    }
}

/// Adds weight and body force. A weight acts on the masses of the nodes, so that all of them fall alike.
fn add_volume_loads(body: &Body, sums: &mut Sums) {
    let mesh = &body.shape.mesh;
    let density = |element: usize| body.material.density * body.density_factors.get(element).copied().unwrap_or(1.0);
    let mut add = |curve: &Option<LoadCurve>, shares: &[f64], per_volume: &dyn Fn(usize) -> Vector3<f64>| {
        let force = sums.of(curve);
        for (number, (nodes, volume)) in mesh.corners().zip(mesh.volumes()).enumerate() {
            let load = volume * per_volume(number);
            nodes.iter().zip(shares).for_each(|(&node, &share)| force[node] += share * load);
        }
    };
    if let Some(gravity) = body.gravity {
        let shares = if body.lumped_mass { lumped_mass_shares } else { load_shares };
        add(&body.gravity_curve, &shares(mesh.element()), &|element| density(element) * gravity);
    }
    if let Some(body_force) = body.body_force {
        add(&body.body_force_curve, &load_shares(mesh.element()), &|_| body_force);
    }
}

/// Adds tractions.
fn add_tractions(body: &Body, sums: &mut Sums) {
    let shares = face_shares(body.shape.mesh.element());
    for traction in &body.tractions {
        let force = sums.of(&traction.curve);
        for face in &traction.faces {
            let load = body.shape.mesh.area(face) * traction.force_per_area;
            face.iter().zip(&shares).for_each(|(&node, &share)| force[node] += share * load);
        }
    }
}

impl<T: Real> Potential<T> for DeadLoad<T> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        "[gravity], [body_force], [[force]] or [[traction]] with force_per_area".to_owned()
    }

    fn bytes(&self) -> usize {
        self.loads.iter().map(|load| size_of_val(&load.force[..])).sum()
    }

    fn is_steady(&self) -> bool {
        self.loads.iter().all(|load| load.curve.is_none())
    }

    fn constant(&self) -> Option<&[[T; 3]]> {
        match &self.loads[..] {
            [Load { force, curve: None }] => Some(force),
            _ => None,
        }
    }

    fn nodes_of_hessian(&self) -> Option<Vec<u32>> {
        Some(Vec::new())
    }

    /// Energy of the forces of this moment. A force that changes with time does work on a body that does not move.
    fn energy(&self, u: &[[T; 3]], moment: Moment) -> Energy {
        let of_load = |load: &Load<T>| -> Energy {
            let factor = moment.factor(load.curve.as_ref());
            load.force.iter().zip(u).map(|(f, u)| Energy::of(-factor * dot3(f, u))).sum()
        };
        self.loads.iter().map(of_load).sum()
    }

    fn add_gradient(&self, _: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) {
        for load in &self.loads {
            let factor = T::of(moment.factor(load.curve.as_ref()));
            for (sum, force) in gradient.iter_mut().zip(&load.force) {
                for i in 0..3 {
                    sum[i] -= factor * force[i];
                }
            }
        }
    }

    fn hessian(&self, _: &[[T; 3]], _: Moment, _: HessianKind, _: &mut AddBlock<T>) {}

    fn resultant(&self, moment: Moment) -> Option<[f64; 3]> {
        let along = |load: &Load<T>, i: usize| load.force.iter().map(|force| force[i].as_f64()).sum::<f64>();
        let of_load = |load: &Load<T>| {
            let factor = moment.factor(load.curve.as_ref());
            triple(|i| factor * along(load, i))
        };
        let add = |sum: [f64; 3], force: [f64; 3]| triple(|i| sum[i] + force[i]);
        Some(self.loads.iter().map(of_load).fold([0.0; 3], add))
    }

    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        let is_finite = |load: &Load<T>| load.force.as_flattened().iter().all(|force| force.as_f64().is_finite());
        (!self.loads.iter().all(is_finite)).then_some((self.largest, "a force on a node"))
    }
}
