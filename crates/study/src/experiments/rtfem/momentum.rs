//! Momentum and angular momentum of a free body, and their conservation by each method.

use std::path::Path;

use fem_engine::simulator::Simulator;
use fem_mesh::TetrahedralMesh;
use fem_model::simulation::Simulation;
use fem_model::{Body, Integrator, IterationSettings, Method};
use nalgebra::Vector3;

use super::methods::{LAW, block};
use crate::scenes::{SPRINGS, material, spinning};
use crate::study::{Mark, Part, Result, Table};

pub const DENSITY: f64 = 1000.0;
const CELLS: [usize; 3] = [4, 2, 2];
const EDGE: f64 = 0.5;

/// Steps of a run, and of a second.
const STEPS: usize = 100;
const RATE: usize = 100;

/// Largest relative change of a momentum that a method conserves; the same for a method that iterates to convergence; smallest change of a
/// momentum that is not conserved.
const KEPT: f64 = 1e-12;
const CONVERGED: f64 = 1e-10;
const LOST: f64 = 1e-7;

/// Momenta that a method conserves.
#[derive(Clone, Copy, PartialEq)]
enum Promise {
    Both,
    Linear,
    Converged,
    Nothing,
}

impl Promise {
    fn words(self) -> &'static str {
        match self {
            Self::Both => "both",
            Self::Linear => "momentum",
            Self::Converged => "momentum, as far as it converges",
            Self::Nothing => "neither",
        }
    }
}

/// Methods: name, law, integrator, settings of its iterations, promise.
type Row = (&'static str, &'static str, Integrator, IterationSettings, Promise);

/// So many iterations a step.
const fn sweeps(count: usize) -> IterationSettings {
    let (tolerance, acceleration) = (None, None);
    IterationSettings { count, tolerance, acceleration, stiffness: 1.0, residual: true, accept_unconverged: false }
}

const METHODS: [Row; 13] = [
    ("Verlet", LAW, Integrator::Verlet, sweeps(1), Promise::Both),
    ("springs, Verlet", SPRINGS, Integrator::Verlet, sweeps(1), Promise::Both),
    ("springs, Newton", SPRINGS, Integrator::ImplicitEuler, sweeps(1), Promise::Linear),
    ("Newton", LAW, Integrator::ImplicitEuler, sweeps(1), Promise::Linear),
    ("linearly implicit", LAW, Integrator::LinearlyImplicitEuler, sweeps(1), Promise::Linear),
    ("PBD, 5 sweeps", LAW, Integrator::Pbd, sweeps(5), Promise::Linear),
    ("XPBD, 1 sweep", LAW, Integrator::Xpbd, sweeps(1), Promise::Linear),
    ("XPBD, 5 sweeps", LAW, Integrator::Xpbd, sweeps(5), Promise::Linear),
    (
        "XPBD, no residual, 5 sweeps",
        LAW,
        Integrator::Xpbd,
        IterationSettings { residual: false, ..sweeps(5) },
        Promise::Linear,
    ),
    ("PD, 5 rounds", LAW, Integrator::ProjectiveDynamics, sweeps(5), Promise::Linear),
    ("VBD, 1 sweep", LAW, Integrator::Vbd, sweeps(1), Promise::Nothing),
    ("VBD, 5 sweeps", LAW, Integrator::Vbd, sweeps(5), Promise::Nothing),
    ("VBD, iterated until nothing changes", LAW, Integrator::Vbd, UNTIL_SETTLED, Promise::Converged),
];

const UNTIL_SETTLED: IterationSettings = IterationSettings { tolerance: Some(1e-13), ..sweeps(5000) };

/// Relative changes of momentum and angular momentum.
struct Drift {
    linear: f64,
    angular: f64,
}

/// A free beam flies and turns for a second.
pub fn run(_: &Path, _: bool) -> Result<Part> {
    let found = METHODS.iter().map(|method| Ok((method, drift(method)?))).collect::<Result<Vec<_>>>()?;
    let text = format!(
        "A free beam of 2 × 1 × 1 m (corotated law or springs, E = 1e5 Pa, lumped mass) flies at 1 m/s and turns at 2 rad/s for {STEPS} steps of 1/{RATE} s. Changes are those of \
         Σ m v over Σ m |v| and of Σ m x × v over its size. Sweeps of PBD and XPBD move nodes by equal and opposite impulses, and PD sets the mean of a free body right \
         after its rounds; steps of VBD move one node at a time, so that forces are equal and opposite only where sweeps have converged. Methods that take the velocity from \
         the change of the positions lose angular momentum like implicit Euler, which damps rotations."
    );
    let table = Table::of(
        "rtfem-momentum",
        &found,
        &[
            ("method", &|(method, _)| method.0.to_owned()),
            ("promises to keep", &|(method, _)| method.4.words().to_owned()),
            (">change of momentum", &|(_, drift)| format!("{:.1e}", drift.linear)),
            (">change of angular momentum", &|(_, drift)| format!("{:.1e}", drift.angular)),
        ],
    );
    Ok(Part::new(text).marks(found.iter().map(|(method, drift)| mark(method, drift))).tables([table]))
}

fn mark((name, .., promise): &Row, drift: &Drift) -> Mark {
    let Drift { linear, angular } = *drift;
    let (text, holds) = match promise {
        Promise::Both => (format!("keeps both within {KEPT:e}"), linear <= KEPT && angular <= KEPT),
        Promise::Linear => (format!("keeps its momentum within {KEPT:e}"), linear <= KEPT),
        Promise::Converged => (format!("keeps its momentum within {CONVERGED:e}"), linear <= CONVERGED),
        Promise::Nothing => (format!("changes its momentum by more than {LOST:e}"), linear > LOST),
    };
    Mark::new(format!("{name}: {text}"), format!("{linear:.1e}, angular {angular:.1e}"), holds)
}

fn drift(&(name, law, integrator, iterations, _): &Row) -> Result<Drift> {
    let mesh = block(CELLS, EDGE);
    let masses = lumped(&mesh);
    let body = Body::new(mesh, material(law, 1e5, 0.25, DENSITY)?)?.velocity([1.0, 0.5, -0.2])?;
    let body = Body { lumped_mass: true, ..spinning(body, [1.0, 2.0, 3.0], 2.0) };
    let mut simulation =
        Simulator::<f64>::new(body, &Method { iterations, ..Method::new(integrator, 1.0 / RATE as f64) })?;
    let before = momenta(&simulation, &masses);
    for _ in 0..STEPS {
        simulation.step().map_err(|failure| format!("{name}: {failure}"))?;
    }
    let after = momenta(&simulation, &masses);
    Ok(Drift { linear: (after.0 - before.0).norm() / before.2, angular: (after.1 - before.1).norm() / before.1.norm() })
}

/// Lumped masses of the nodes, kg.
pub fn lumped(mesh: &TetrahedralMesh) -> Vec<f64> {
    let mut masses = vec![0.0; mesh.vertices.len()];
    for (element, volume) in mesh.elements.iter().zip(fem_mesh::volumes(mesh)) {
        element.iter().for_each(|&node| masses[node] += 0.25 * DENSITY * volume);
    }
    masses
}

/// Σ m v, Σ m x × v and Σ m |v|.
pub fn momenta(simulation: &dyn Simulation, masses: &[f64]) -> (Vector3<f64>, Vector3<f64>, f64) {
    let (x, v) = (simulation.positions(), simulation.velocities());
    let mut sums = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for (node, mass) in masses.iter().enumerate() {
        let [x, v]: [Vector3<f64>; 2] = [&x, &v].map(|of| of.fixed_rows::<3>(3 * node).into());
        sums.0 += *mass * v;
        sums.1 += *mass * x.cross(&v);
        sums.2 += mass * v.norm();
    }
    sums
}
