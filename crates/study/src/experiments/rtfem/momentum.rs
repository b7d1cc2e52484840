//! Momentum and angular momentum of a free body, and their conservation by each method.

use std::path::Path;

use fem_mesh::TetrahedralMesh;
use fem_model::simulation::Simulation;
use nalgebra::Vector3;

use super::methods::block;
use crate::scenes::simulation;
use crate::study::{Mark, Part, Table};

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

/// Methods: name, model, integrator, tables, promise.
type Method = (&'static str, &'static str, &'static str, &'static str, Promise);

const METHODS: [Method; 13] = [
    ("Verlet", "corotated", "verlet", "", Promise::Both),
    ("springs, Verlet", "mass_spring", "verlet", "", Promise::Both),
    ("springs, Newton", "mass_spring", "implicit_euler", "", Promise::Linear),
    ("Newton", "corotated", "implicit_euler", "", Promise::Linear),
    ("linearly implicit", "corotated", "linearly_implicit_euler", "", Promise::Linear),
    ("PBD, 5 sweeps", "corotated", "pbd", "[iterations]\ncount = 5\n", Promise::Linear),
    ("XPBD, 1 sweep", "corotated", "xpbd", "[iterations]\ncount = 1\n", Promise::Linear),
    ("XPBD, 5 sweeps", "corotated", "xpbd", "[iterations]\ncount = 5\n", Promise::Linear),
    (
        "XPBD, no residual, 5 sweeps",
        "corotated",
        "xpbd",
        "[iterations]\ncount = 5\nresidual = false\n",
        Promise::Linear,
    ),
    ("PD, 5 rounds", "corotated", "projective_dynamics", "[iterations]\ncount = 5\n", Promise::Linear),
    ("VBD, 1 sweep", "corotated", "vbd", "[iterations]\ncount = 1\n", Promise::Nothing),
    ("VBD, 5 sweeps", "corotated", "vbd", "[iterations]\ncount = 5\n", Promise::Nothing),
    (
        "VBD, iterated until nothing changes",
        "corotated",
        "vbd",
        "[iterations]\ncount = 5000\ntolerance = 1e-13\n",
        Promise::Converged,
    ),
];

/// Relative changes of momentum and angular momentum.
struct Drift {
    linear: f64,
    angular: f64,
}

/// A free beam flies and turns for a second.
pub fn run(_: &Path, _: bool) -> Result<Part, String> {
    let found = METHODS.iter().map(|method| Ok((method, drift(method)?))).collect::<Result<Vec<_>, String>>()?;
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

fn mark((name, .., promise): &Method, drift: &Drift) -> Mark {
    let Drift { linear, angular } = *drift;
    let (text, holds) = match promise {
        Promise::Both => (format!("keeps both within {KEPT:e}"), linear <= KEPT && angular <= KEPT),
        Promise::Linear => (format!("keeps its momentum within {KEPT:e}"), linear <= KEPT),
        Promise::Converged => (format!("keeps its momentum within {CONVERGED:e}"), linear <= CONVERGED),
        Promise::Nothing => (format!("changes its momentum by more than {LOST:e}"), linear > LOST),
    };
    Mark::new(format!("{name}: {text}"), format!("{linear:.1e}, angular {angular:.1e}"), holds)
}

fn drift(&(name, model, integrator, tables, _): &Method) -> Result<Drift, String> {
    let mesh = block(CELLS, EDGE);
    let masses = lumped(&mesh);
    let poisson = if model == "mass_spring" { "" } else { "poisson = 0.25\n" };
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [1, 1, 1], cells_per_unit = 1 }}\n[material]\nmodel = \"{model}\"\nyoung = 1e5\n{poisson}\
         density = {DENSITY}\n[mass]\nlumped = true\n[[initial_velocity]]\nvelocity = [1, 0.5, -0.2]\nangular = {{ axis = [1, 2, 3], rate = 2.0 }}\n\
         {tables}[time]\nintegrator = \"{integrator}\"\ndt = {:e}\n",
        1.0 / RATE as f64
    );
    let mut simulation = simulation(&text, mesh)?;
    let before = momenta(&*simulation, &masses);
    for _ in 0..STEPS {
        simulation.step().map_err(|failure| format!("{name}: {failure}"))?;
    }
    let after = momenta(&*simulation, &masses);
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
