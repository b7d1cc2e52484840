//! Equilibria of published solids, one at a time: what `benches/peers/statics` runs beside other programs.

use std::f64::consts::FRAC_PI_2;

use fem_engine::simulator::build;
use fem_mesh::{Pattern, box_mesh};
use fem_model::{
    Body, BodyMesh, Elastic, Integrator, Law, Material, Method, Motion, NeoHookean, Refusal, Selector, SolverSettings,
    Volumetric,
};
use fem_output::stresses_at_nodes;
use fem_scene::tables::SolverTable;
use nalgebra::{Rotation3, Vector3};
use serde::Serialize;

use crate::cli::{StaticsArguments, StaticsCase};
use crate::end::End;
use crate::run::processor_seconds;

/// The answer of a case and the time to it.
#[derive(Serialize)]
struct Answer {
    value: f64,
    /// Components of the displacements of all nodes, and the pressures that are unknowns.
    unknowns: usize,
    newton_iterations: usize,
    /// Processor time from the mesh in memory to the value.
    seconds: f64,
    /// The part of it before the first load step.
    seconds_setup: f64,
}

/// The mesh of a body that is the image of a unit box, and the place of each node in the box.
struct Mapped {
    mesh: BodyMesh,
    places: Vec<Vector3<f64>>,
}

/// Solves a case several times and prints the answer with the shortest time as JSON.
pub fn run(arguments: &StaticsArguments) -> Result<(), End> {
    let mapped = Mapped::new(arguments)?;
    let mut fastest: Option<Answer> = None;
    for _ in 0..arguments.rounds {
        let answer = solve(arguments, &mapped)?;
        if fastest.as_ref().is_none_or(|so_far| answer.seconds < so_far.seconds) {
            fastest = Some(answer);
        }
    }
    println!("{}", serde_json::to_string(&fastest).map_err(End::wrong)?);
    Ok(())
}

impl Mapped {
    fn new(StaticsArguments { case, cells, order, .. }: &StaticsArguments) -> Result<Self, End> {
        let &[nx, ny, nz] = cells.as_slice() else { return Err(End::unusable("--cells: give three numbers")) };
        let size = [nx, ny, nz].map(|n| n as f64);
        let mut mesh = box_mesh(size, 1, Pattern::Alternating).map_err(End::unusable)?;
        mesh.vertices.iter_mut().for_each(|x| x.component_div_assign(&Vector3::from(size)));
        let of_order = |mesh| BodyMesh::from(mesh).of_order(*order).ok_or_else(|| End::unusable("--order: 1 or 2"));
        let places = of_order(mesh.clone())?.vertices().to_vec();
        mesh.vertices.iter_mut().for_each(|x| *x = case.map(x));
        Ok(Self { mesh: of_order(mesh)?, places })
    }

    /// The node whose place is the nearest to a point.
    fn node_at(&self, place: [f64; 3]) -> usize {
        let distance = |node: &usize| (self.places[*node] - Vector3::from(place)).norm();
        (0..self.places.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
    }
}

impl StaticsCase {
    /// The point of the body at a place in the unit box.
    fn map(self, place: &Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::Le10 => {
                let (sin, cos) = (place.y * FRAC_PI_2).sin_cos();
                let x = if place.y == 1.0 { 0.0 } else { (2.0 + 1.25 * place.x) * cos };
                Vector3::new(x, (1.0 + 1.75 * place.x) * sin, 0.6 * place.z)
            }
            Self::Twisted => {
                let section = Vector3::new(12.0 * place.x, 1.1 * (place.y - 0.5), 0.32 * (place.z - 0.5));
                Rotation3::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2 * place.x) * section
            }
            Self::Block => 50.0 * place,
        }
    }

    /// The components of the displacement that are zero at a place.
    fn constrained(self, place: &Vector3<f64>) -> [bool; 3] {
        match self {
            Self::Le10 => {
                let is_outer = place.x == 1.0;
                [is_outer || place.y == 1.0, is_outer || place.y == 0.0, is_outer && place.z == 0.5]
            }
            Self::Twisted => [place.x == 0.0; 3],
            Self::Block => [place.x == 0.0 || place.z == 1.0, place.y == 0.0 || place.z == 1.0, place.z == 0.0],
        }
    }

    /// Returns true if a place belongs to the loaded part of the surface.
    fn is_loaded(self, place: &Vector3<f64>) -> bool {
        match self {
            Self::Le10 => place.z == 1.0,
            Self::Twisted => place.x == 1.0,
            Self::Block => place.z == 1.0 && place.x <= 0.5 && place.y <= 0.5,
        }
    }

    /// Force per undeformed area, Pa; of fixed direction.
    fn traction(self) -> [f64; 3] {
        match self {
            Self::Le10 => [0.0, 0.0, -1e6],
            Self::Twisted => [0.0, 0.0, 1.0 / (1.1 * 0.32)],
            Self::Block => [0.0, 0.0, -160.0],
        }
    }

    fn law(self) -> Law {
        match self {
            Self::Le10 => Law::Linear(Elastic::new(210e9, 0.3)),
            Self::Twisted => Law::Linear(Elastic::new(29e6, 0.22)),
            // μ = 80.194 and κ = 400 943, which is ν = 0.4999.
            Self::Block => Law::NeoHookean(NeoHookean::Moduli { C: 40.0969, D: 200_471.6 }),
        }
    }

    /// The point of the unit box at which a value is taken.
    fn point(self) -> [f64; 3] {
        match self {
            Self::Le10 | Self::Block => [0.0, 0.0, 1.0],
            Self::Twisted => [1.0, 0.5, 0.5],
        }
    }
}

fn solve(arguments: &StaticsArguments, mapped: &Mapped) -> Result<Answer, End> {
    let case = arguments.case;
    let node = mapped.node_at(case.point());
    let mesh = mapped.mesh.clone();
    let start = processor_seconds()?;
    let body = body(arguments, mesh, &mapped.places).map_err(End::unusable)?;
    let pressures = if body.has_pressures() { corners(&mapped.mesh) } else { 0 };
    let settings = |SolverTable { kind, tolerance, preconditioner, precision }| SolverSettings {
        kind,
        tolerance,
        preconditioner: preconditioner.unwrap_or_default(),
        precision: precision.unwrap_or_default(),
    };
    let solver = arguments.solver.map(|name| settings(name.table()));
    let method = Method { load_steps: arguments.load_steps, solver, ..Method::new(Integrator::Static, 1.0) };
    let mut simulation = build(body, &method).map_err(End::unusable)?;
    let seconds_setup = processor_seconds()? - start;
    for _ in 0..arguments.load_steps {
        simulation.step().map_err(End::wrong)?;
    }
    let value = match case {
        StaticsCase::Le10 => stresses_at_nodes(&*simulation)[node][(1, 1)],
        StaticsCase::Twisted | StaticsCase::Block => {
            simulation.positions()[3 * node + 2] - mapped.mesh.vertices()[node].z
        }
    };
    let seconds = processor_seconds()? - start;
    let newton_iterations = simulation.counters().newton_iterations;
    let unknowns = 3 * mapped.places.len() + pressures;
    Ok(Answer { value, unknowns, newton_iterations, seconds, seconds_setup })
}

fn body(arguments: &StaticsArguments, mesh: BodyMesh, places: &[Vector3<f64>]) -> Result<Body, Refusal> {
    let case = arguments.case;
    let select = |is_selected: &dyn Fn(&Vector3<f64>) -> bool| {
        Selector::Nodes((0..places.len()).filter(|&node| is_selected(&places[node])).collect())
    };
    let volumetric = arguments.volumetric.map_or(Volumetric::Standard, Volumetric::from);
    let mut body = Body::new(mesh, Material { volumetric, ..Material::new(case.law(), 1.0) })?;
    for axis in 0..3 {
        let components = [0, 1, 2].map(|i| i == axis);
        let nodes = select(&|place| case.constrained(place)[axis]);
        body = body.prescribe(&nodes, components, Motion::by([0.0; 3]))?;
    }
    body.traction(&select(&|place| case.is_loaded(place)), case.traction())
}

/// The number of nodes that are corners of elements.
fn corners(mesh: &BodyMesh) -> usize {
    let mut nodes: Vec<usize> = mesh.corners().flatten().copied().collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes.len()
}
