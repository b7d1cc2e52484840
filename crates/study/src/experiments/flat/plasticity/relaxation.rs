//! Strips whose nodes all have a prescribed displacement, by the whole engine: the elastic strain at a constant total strain, and the stress
//! over the strain of a strip that is stretched beyond its yield strain and released, as the thesis' figure 2.4 sketches it.

use fem_chart::{Axis, Chart, Guide, Series};
use fem_engine::simulator::Simulator;
use fem_model::simulation::Simulation;
use fem_model::{Integrator, LoadCurve, Method, Motion, Selector};

use super::strip;
use crate::scenes::{simulator, step};
use crate::study::{Figure, Mark, Result};

/// Yield strain, creep rate (1/s) and maximum.
pub const YIELD: f64 = 0.05;
pub const CREEP: f64 = 2.0;
const MAXIMUM: f64 = 0.6;
/// The displacement gradient in the plane: symmetric, so that it is the strain.
const GRADIENT: [[f64; 2]; 2] = [[0.12, 0.05], [0.05, -0.04]];
/// Duration, s.
const DURATION: f64 = 2.0;
/// Time step of the thesis' rule, s: 10 substeps of a sixtieth of a second.
pub const THEIR_STEP: f64 = 1.0 / 600.0;

/// An instant of the relaxation.
pub struct Instant {
    /// s
    pub time: f64,
    /// |εᵉ| in the closed form.
    pub closed_form: f64,
    /// |εᵉ| of the engine; in the element that is farthest from the closed form.
    pub elastic: f64,
    /// |εᵉ| of the thesis' rule.
    pub theirs: f64,
}

/// The relaxation of a strip.
pub struct Relaxation {
    /// The start, and the end of each step.
    pub instants: Vec<Instant>,
}

impl Relaxation {
    /// Largest distance from the closed form.
    pub fn error(&self) -> f64 {
        self.instants.iter().map(|at| (at.elastic - at.closed_form).abs()).fold(0.0, f64::max)
    }
}

/// A strip whose nodes have these displacements by their places, m, with implicit Euler in steps of `dt`, s.
fn moved((creep, maximum): (f64, f64), dt: f64, displacement: impl Fn([f64; 2]) -> Motion) -> Result<Simulator<f64>> {
    let mut body = strip(1, YIELD, creep, maximum)?;
    for node in 0..6 {
        let place = [(node % 3) as f64, (node / 3) as f64];
        body = body.prescribe(&Selector::Nodes(vec![node]), [true; 3], displacement(place))?;
    }
    Ok(simulator(body, &Method::new(Integrator::ImplicitEuler, dt))?)
}

/// A strip of 2 × 1 m, all of whose nodes are displaced at once and stay there; steps of `dt` seconds.
pub fn relaxation(dt: f64) -> Result<Relaxation> {
    let mut simulation = moved((CREEP, MAXIMUM), dt, |x| {
        let u = GRADIENT.map(|row| row[0] * x[0] + row[1] * x[1]);
        Motion::by([u[0], u[1], 0.0])
    })?;
    let first = size(&GRADIENT);
    let mut theirs = Theirs { elastic: first, time: 0.0 };
    let mut instants = vec![Instant { time: 0.0, closed_form: first, elastic: first, theirs: first }];
    for number in 1..=(DURATION / dt).round() as usize {
        step(&mut simulation)?;
        let time = number as f64 * dt;
        let closed_form = YIELD + (first - YIELD) * (-CREEP * time).exp();
        let elastic = farthest(&simulation, closed_form)?;
        instants.push(Instant { time, closed_form, elastic, theirs: theirs.until(time) });
    }
    Ok(Relaxation { instants })
}

/// The thesis' rule: the whole elastic strain flows where it exceeds the yield strain.
pub struct Theirs {
    /// |εᵉ|
    pub elastic: f64,
    /// s
    pub time: f64,
}

impl Theirs {
    /// |εᵉ| at a later time, s.
    pub fn until(&mut self, time: f64) -> f64 {
        while self.time < time - 0.5 * THEIR_STEP {
            if self.elastic > YIELD {
                self.elastic -= THEIR_STEP * CREEP * self.elastic;
            }
            self.time += THEIR_STEP;
        }
        self.elastic
    }
}

/// |ε − εᵖ| in the element in which it is farthest from a value.
fn farthest(simulation: &Simulator<f64>, value: f64) -> Result<f64> {
    let plasticity = simulation.system().elements.plasticity().ok_or("the strip has no plasticity")?;
    let elastic = plasticity
        .variables()
        .iter()
        .map(|of| size(&std::array::from_fn(|i| std::array::from_fn(|j| GRADIENT[i][j] - of.plastic[i][j]))));
    // A NaN is far from everything.
    let farther = |a: f64, b: f64| if (a - value).abs() >= (b - value).abs() { a } else { b };
    Ok(elastic.reduce(farther).ok_or("the strip has no elements")?)
}

/// The Frobenius norm.
pub fn size(a: &[[f64; 2]; 2]) -> f64 {
    a.as_flattened().iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// λ + 2μ, Pa: the stiffness along a strip that keeps its width.
const STIFFNESS: f64 = 3.0 * 45_000.0;
/// Creep rate, 1/s.
const FAST_CREEP: f64 = 20.0;
/// Largest strain, and the rate at which it grows and falls again, 1/s.
const LARGEST: f64 = 0.12;
const RATE: f64 = 0.12;
/// Steps of the stretching and of the release, and their length, s.
const STEPS: [usize; 2] = [100, 40];
const DT: f64 = 0.01;

/// Strains and stresses, Pa.
type Curve = Vec<(f64, f64)>;

/// The curve as a chart, and statements that must be true of it.
pub fn tension() -> Result<(Figure, [Mark; 2])> {
    let found = stretched()?;
    let slope = |a: usize, b: usize| (found[b].1 - found[a].1) / (found[b].0 - found[a].0) / STIFFNESS;
    // The strip flows until the elastic strain, which falls from about the yield strain, is below it.
    let (loading, release) = (slope(0, 30), slope(STEPS[0] + 10, STEPS[0] + STEPS[1]));
    let off = (loading - 1.0).abs().max((release - 1.0).abs());
    let plateau = found[STEPS[0]].1 / STIFFNESS;
    // In each step the excess grows by ε̇ dt and falls by the factor e^(−c dt).
    let expected = YIELD + RATE * DT / ((FAST_CREEP * DT).exp() - 1.0);
    let slopes = "a strip that is stretched and released has the slope λ + 2μ below the yield strain and in the release, within 1e-9";
    let marks = [
        Mark::at_most(slopes, off, 1e-9),
        Mark::new(
            format!("it flows at the elastic strain y + ε̇ dt/(e^(c dt) − 1) = {expected:.6} within 1e-6"),
            format!("{plateau:.6}"),
            (plateau - expected).abs() <= 1e-6,
        ),
    ];
    let mut chart = Chart::new("stress over strain", Axis::linear("strain"), Axis::linear("stress (Pa)"));
    chart.series = vec![Series::line("the thesis' rule", 1, theirs()), Series::line("here", 0, found)];
    chart.x.range = Some((0.0, 0.16));
    chart.guides = vec![Guide::Horizontal(STIFFNESS * YIELD, "(λ + 2μ) × yield strain".to_owned())];
    let caption = format!(
        "A strip that keeps its width, stretched to {LARGEST} at {RATE} per second and released, with creep {FAST_CREEP} per second: elastic, flowing, elastic again; where the stress is \
         zero, the plastic strain is left. By the thesis' rule the whole elastic strain flows once it exceeds the yield strain."
    );
    Ok((Figure::new("flat-plasticity-tension", chart.draw(), caption), marks))
}

/// A strip of 2 × 1 m all of whose nodes have a prescribed displacement along x.
fn stretched() -> Result<Curve> {
    let [up, down] = STEPS.map(|steps| steps as f64 * DT);
    let last = (LARGEST - RATE * down) / LARGEST;
    let curve = LoadCurve::Table(vec![[0.0, 0.0], [up, 1.0], [up + down, last]]);
    let mut strip = moved((FAST_CREEP, 1.0), DT, |x| Motion {
        curve: Some(curve.clone()),
        ..Motion::by([LARGEST * x[0], 0.0, 0.0])
    })?;
    let mut curve = vec![(0.0, 0.0)];
    for number in 1..=STEPS[0] + STEPS[1] {
        step(&mut strip)?;
        let (stretching, release) = (number.min(STEPS[0]), number.saturating_sub(STEPS[0]));
        let stress = strip.stresses().first().ok_or("the strip has no elements")?[(0, 0)];
        curve.push((RATE * DT * (stretching as f64 - release as f64), stress));
    }
    Ok(curve)
}

/// The curve by the thesis' rule, in its own substeps.
fn theirs() -> Curve {
    let steps = STEPS.map(|steps| (steps as f64 * DT / THEIR_STEP).round() as usize);
    let (mut strain, mut elastic) = (0.0, 0.0f64);
    let mut curve = vec![(0.0, 0.0)];
    for number in 0..steps[0] + steps[1] {
        let change = if number < steps[0] { RATE * THEIR_STEP } else { -RATE * THEIR_STEP };
        (strain, elastic) = (strain + change, elastic + change);
        if elastic > YIELD {
            elastic -= THEIR_STEP * FAST_CREEP * elastic;
        }
        curve.push((strain, STIFFNESS * elastic));
    }
    curve
}
