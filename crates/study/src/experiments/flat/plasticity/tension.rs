//! Stress over strain of a strip that is stretched beyond its yield strain and released, as the thesis' figure 2.4 sketches it.

use fem_chart::{Axis, Chart, Guide, Series};
use fem_model::simulation::Simulation;

use super::relaxation::{THEIR_STEP, YIELD};
use crate::scenes::{double, step};
use crate::study::{Figure, Mark};

/// λ + 2μ, Pa: the stiffness along a strip that keeps its width.
const STIFFNESS: f64 = 3.0 * 45_000.0;
/// Creep rate, 1/s.
const CREEP: f64 = 20.0;
/// Largest strain, and the rate at which it grows and falls again, 1/s.
const LARGEST: f64 = 0.12;
const RATE: f64 = 0.12;
/// Steps of the stretching and of the release, and their length, s.
const STEPS: [usize; 2] = [100, 40];
const DT: f64 = 0.01;

/// Strains and stresses, Pa.
type Curve = Vec<(f64, f64)>;

/// The curve as a chart, and statements that must be true of it.
pub fn tension() -> Result<(Figure, [Mark; 2]), String> {
    let found = stretched()?;
    let slope = |a: usize, b: usize| (found[b].1 - found[a].1) / (found[b].0 - found[a].0) / STIFFNESS;
    // The strip flows until the elastic strain, which falls from about the yield strain, is below it.
    let (loading, release) = (slope(0, 30), slope(STEPS[0] + 10, STEPS[0] + STEPS[1]));
    let off = (loading - 1.0).abs().max((release - 1.0).abs());
    let plateau = found[STEPS[0]].1 / STIFFNESS;
    // In each step the excess grows by ε̇ dt and falls by the factor e^(−c dt).
    let expected = YIELD + RATE * DT / ((CREEP * DT).exp() - 1.0);
    let marks = [
        Mark::new(
            "a strip that is stretched and released has the slope λ + 2μ below the yield strain and in the release, within 1e-9",
            format!("{off:.1e}"),
            off <= 1e-9,
        ),
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
        "A strip that keeps its width, stretched to {LARGEST} at {RATE} per second and released, with creep {CREEP} per second: elastic, flowing, elastic again; where the stress is \
         zero, the plastic strain is left. By the thesis' rule the whole elastic strain flows once it exceeds the yield strain."
    );
    Ok((Figure { name: "flat-plasticity-tension".to_owned(), picture: chart.draw(), caption }, marks))
}

/// A strip of 2 × 1 m all of whose nodes have a prescribed displacement along x.
fn stretched() -> Result<Curve, String> {
    let [up, down] = STEPS.map(|steps| steps as f64 * DT);
    let last = (LARGEST - RATE * down) / LARGEST;
    let mut text = format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [2, 1], cells_per_unit = 1, pattern = \"kuhn\" }}\n[material]\nmodel = \"corotated\"\n\
         young = 112500\npoisson = 0.25\ndensity = 140.5\n[plasticity]\nmodel = \"additive\"\nyield_strain = {YIELD}\ncreep = {CREEP}\nmaximum = 1\n\
         [time]\nintegrator = \"implicit_euler\"\ndt = {DT}\n"
    );
    for node in 0..6 {
        text += &format!(
            "[[prescribed]]\nnodes = [{node}]\ndisplacement = [{:e}, 0, 0]\ncurve = {{ table = [[0, 0], [{up}, 1], [{}, {last}]] }}\n",
            LARGEST * f64::from(node % 3),
            up + down
        );
    }
    let mut strip = double(&text, None)?;
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
            elastic -= THEIR_STEP * CREEP * elastic;
        }
        curve.push((strain, STIFFNESS * elastic));
    }
    curve
}
