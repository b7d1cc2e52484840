//! The elastic strain of a body whose total strain is kept constant, by the whole engine.

use std::fmt::Write as _;

use fem_engine::simulator::Simulator;

use crate::scenes::{double, step};

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

/// A strip of 2 × 1 m, all of whose nodes are displaced at once and stay there; steps of `dt` seconds.
pub fn relaxation(dt: f64) -> Result<Relaxation, String> {
    let mut simulation = double(&scene(dt), None)?;
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

fn scene(dt: f64) -> String {
    let mut text = format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [2, 1], cells_per_unit = 1, pattern = \"kuhn\" }}\n[material]\nmodel = \"corotated\"\n\
         young = 112500\npoisson = 0.25\ndensity = 140.5\n[plasticity]\nmodel = \"additive\"\nyield_strain = {YIELD}\ncreep = {CREEP}\n\
         maximum = {MAXIMUM}\n[time]\nintegrator = \"implicit_euler\"\ndt = {dt:e}\n"
    );
    for node in 0..6 {
        let x = [f64::from(node % 3), f64::from(node / 3)];
        let u = GRADIENT.map(|row| row[0] * x[0] + row[1] * x[1]);
        let _ = writeln!(text, "[[prescribed]]\nnodes = [{node}]\ndisplacement = [{:e}, {:e}, 0]", u[0], u[1]);
    }
    text
}

/// |ε − εᵖ| in the element in which it is farthest from a value.
fn farthest(simulation: &Simulator<f64>, value: f64) -> Result<f64, String> {
    let plasticity = simulation.system().elements.plasticity().ok_or("the strip has no plasticity")?;
    let elastic = plasticity
        .variables()
        .iter()
        .map(|of| size(&std::array::from_fn(|i| std::array::from_fn(|j| GRADIENT[i][j] - of.plastic[i][j]))));
    // A NaN is far from everything.
    let farther = |a: f64, b: f64| if (a - value).abs() >= (b - value).abs() { a } else { b };
    elastic.reduce(farther).ok_or_else(|| "the strip has no elements".to_owned())
}

/// The Frobenius norm.
pub fn size(a: &[[f64; 2]; 2]) -> f64 {
    a.as_flattened().iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}
