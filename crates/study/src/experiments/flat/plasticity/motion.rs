//! Plastic strips that move: the bound of the plastic strain, dissipation, order in the time step, and the shape after a release.

use fem_engine::simulator::Simulator;
use fem_model::simulation::Simulation;

use crate::scenes::{double, step, steps};

/// Bound of the plastic strain of the thrown strip.
pub const MAXIMUM: f64 = 0.08;

/// A strip of 2 × 1 m with λ = μ = 45 000 Pa that flows beyond a strain of 0.02.
fn strip(method: &str, creep: f64, maximum: f64, rest: &str) -> String {
    format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [2, 1], cells_per_unit = 4, pattern = \"kuhn\" }}\n[material]\nmodel = \"corotated\"\n\
         young = 112500\npoisson = 0.25\ndensity = 140.5\n[plasticity]\nmodel = \"additive\"\nyield_strain = 0.02\ncreep = {creep}\n\
         maximum = {maximum}\n[time]\n{method}\n{rest}"
    )
}

/// One end is thrown away from the other.
const THROWN: &str =
    "[[initial_velocity]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nvelocity = [30, 3, 0]\n";

/// A run of the thrown strip.
pub struct Thrown {
    /// Elements.
    pub elements: usize,
    /// Steps.
    pub steps: usize,
    /// Largest |εᵖ| of all elements and steps, in the Frobenius norm.
    pub largest: f64,
    /// Smallest change of the dissipated energy in a step, J.
    pub least_dissipation: f64,
    /// Dissipated energy, J.
    pub dissipated: f64,
}

/// The strip, thrown apart, with velocity Verlet and so many steps of 0.1 ms.
pub fn thrown(count: usize) -> Result<Thrown, String> {
    let mut simulation = double(&strip("integrator = \"verlet\"\ndt = 1e-4", 20.0, MAXIMUM, THROWN), None)?;
    let (mut largest, mut least, mut before) = (0.0f64, f64::INFINITY, 0.0);
    for _ in 0..count {
        step(&mut simulation)?;
        let plasticity = simulation.system().elements.plasticity().ok_or("the strip has no plasticity")?;
        for of in plasticity.variables() {
            let norm = of.plastic.as_flattened().iter().map(|entry| entry * entry).sum::<f64>().sqrt();
            largest = if norm <= largest { largest } else { norm };
        }
        let change = plasticity.dissipated() - before;
        least = if change >= least { least } else { change };
        before = plasticity.dissipated();
    }
    let elements = simulation.system().shape.mesh.elements();
    Ok(Thrown { elements, steps: count, largest, least_dissipation: least, dissipated: before })
}

/// Two runs, of which one has half of the time step.
pub struct Change {
    /// The longer time step, s.
    pub dt: f64,
    /// Largest distance of a coordinate at the end, m.
    pub distance: f64,
}

/// Changes of the end under halving of the time step, each with the order that it and the one before show.
pub fn orders() -> Result<Vec<(Change, Option<f64>)>, String> {
    let end = |dt: f64| {
        let method = format!("integrator = \"verlet\"\ndt = {dt:e}");
        let mut simulation = double(&strip(&method, 20.0, 10.0, THROWN), None)?;
        steps(&mut simulation, (0.032 / dt).round() as usize)?;
        Ok::<_, String>(simulation.positions())
    };
    let times = [4e-4, 2e-4, 1e-4, 5e-5, 2.5e-5];
    let ends = times.iter().map(|dt| end(*dt)).collect::<Result<Vec<_>, _>>()?;
    let distances: Vec<f64> = ends.windows(2).map(|pair| (&pair[0] - &pair[1]).amax()).collect();
    let order = |i: usize| (i > 0).then(|| (distances[i - 1] / distances[i]).log2());
    Ok((0..distances.len()).map(|i| (Change { dt: times[i], distance: distances[i] }, order(i))).collect())
}

/// The shape of a strip after its release.
pub struct Released {
    /// Largest difference of a strain and εᵖ.
    pub strain_error: f64,
    /// Largest stress, over that before the release.
    pub stress_left: f64,
}

/// A strip that is stretched along x by a tenth until the excess over the yield strain has flowed, then free and damped.
pub fn released() -> Result<Released, String> {
    let method = "integrator = \"implicit_euler\"\ndt = 0.1";
    let mut tables = "[damping]\nalpha = 4.0\n".to_owned();
    // Nine columns and five rows of nodes, a quarter of a metre apart.
    for node in 0..45 {
        let u = 0.1 * 0.25 * f64::from(node % 9);
        tables += &format!("[[prescribed]]\nnodes = [{node}]\ndisplacement = [{u:e}, 0, 0]\nuntil = 5.0\n");
    }
    let mut simulation = double(&strip(method, 5.0, 0.5, &tables), None)?;
    steps(&mut simulation, 50)?;
    let before = largest_stress(&simulation);
    steps(&mut simulation, 300)?;
    let (positions, shape) = (simulation.positions(), simulation.shape());
    let plasticity = simulation.system().elements.plasticity().ok_or("the strip has no plasticity")?;
    let mut error = 0.0f64;
    for (corners, of) in shape.mesh.corners().zip(plasticity.variables()) {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (corners[a], corners[b]);
            let rest = shape.mesh.vertices()[b] - shape.mesh.vertices()[a];
            let edge = (0..2).map(|i| (positions[3 * b + i] - positions[3 * a + i]).powi(2)).sum::<f64>().sqrt();
            // An unstressed edge is (1 + εᵖ) times the undeformed one.
            let expected: f64 = (0..2)
                .map(|i| (rest[i] + (0..2).map(|j| of.plastic[i][j] * rest[j]).sum::<f64>()).powi(2))
                .sum::<f64>()
                .sqrt();
            let difference = (edge - expected).abs() / rest.norm();
            error = if difference <= error { error } else { difference };
        }
    }
    Ok(Released { strain_error: error, stress_left: largest_stress(&simulation) / before })
}

fn largest_stress(simulation: &Simulator<f64>) -> f64 {
    simulation.stresses().iter().map(|stress| stress.amax()).fold(0.0, f64::max)
}
