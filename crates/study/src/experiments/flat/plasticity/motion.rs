//! Plastic strips that move: the bound of the plastic strain, dissipation, order in the time step, and the shape after a release.

use fem_engine::simulator::Simulator;
use fem_model::simulation::Simulation;
use fem_model::{Axis, Damping, DampingForm, Integrator, Method, Motion, Selector};

use super::strip;
use crate::scenes::{simulator, step, steps, thrown as throw};
use crate::study::{Problem, Result};

/// Bound of the plastic strain of the thrown strip.
pub const MAXIMUM: f64 = 0.08;

/// Yield strain of the strips, and their cells per metre.
const YIELD: f64 = 0.02;
const CELLS: usize = 4;

/// The strip, one end of which is thrown away from the other, with velocity Verlet and steps of `dt`, s.
fn pulled_apart(maximum: f64, dt: f64) -> Result<Simulator<f64>> {
    let body = throw(strip(CELLS, YIELD, 20.0, maximum)?, &Selector::most(Axis::X), [30.0, 3.0, 0.0])?;
    Ok(simulator(body, &Method::new(Integrator::Verlet, dt))?)
}

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
pub fn thrown(count: usize) -> Result<Thrown> {
    let mut simulation = pulled_apart(MAXIMUM, 1e-4)?;
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
pub fn orders() -> Result<Vec<(Change, Option<f64>)>> {
    let end = |dt: f64| {
        let mut simulation = pulled_apart(10.0, dt)?;
        steps(&mut simulation, (0.032 / dt).round() as usize)?;
        Ok::<_, Problem>(simulation.positions())
    };
    let times = [4e-4, 2e-4, 1e-4, 5e-5, 2.5e-5];
    let ends = times.iter().map(|dt| end(*dt)).collect::<Result<Vec<_>>>()?;
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
pub fn released() -> Result<Released> {
    let damping = Damping { alpha: 4.0, beta: 0.0, form: DampingForm::default() };
    let mut body = strip(CELLS, YIELD, 5.0, 0.5)?.damping(damping)?;
    // Nine columns and five rows of nodes, a quarter of a metre apart.
    for node in 0..45 {
        let stretched = Motion::by([0.1 * 0.25 * (node % 9) as f64, 0.0, 0.0]);
        body = body.prescribe(&Selector::Nodes(vec![node]), [true; 3], stretched)?;
    }
    body.dirichlet.iter_mut().for_each(|condition| condition.until = Some(5.0));
    let mut simulation = simulator(body, &Method::new(Integrator::ImplicitEuler, 0.1))?;
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
