//! Yield strain, creep, friction and damping, each varied alone: a bunny thrown onto a floor.

use std::path::Path;

use fem_chart::grid;
use fem_engine::simulator::Simulator;
use fem_mesh::Mesh;
use fem_model::simulation::Simulation;
use fem_model::{ContactPlane, Integrator, Method, Plasticity};
use nalgebra::{Vector2, Vector3};

use super::object::{LAME, body, meshed, picture};
use crate::experiments::drawing::{Triangle, band, drawn, elements};
use crate::scenes::step;
use crate::study::{Figure, Mark, Part, Result, Table};

/// Length of the edges, m, for a height of 1 m.
const EDGE: f64 = 0.1;
/// Frames in a second.
const FRAMES: f64 = 60.0;
/// Duration, s, also of the short version.
const DURATIONS: [f64; 2] = [2.0, 0.75];
/// Velocity at the start, m/s, and the distance of the floor below the body, m.
const THROWN: [f64; 2] = [1.5, -8.0];
const HEIGHT: f64 = 0.2;

/// A parameter: its name, its unit, the values that it takes, and the one that it has while others vary.
type Parameter = (&'static str, &'static str, [f64; 4], f64);

const PARAMETERS: [Parameter; 4] = [
    ("yield", "strain", [0.01, 0.03, 0.1, 0.3], 0.03),
    ("creep", "1/s", [1.0, 5.0, 25.0, 125.0], 25.0),
    ("friction", "", [0.0, 0.1, 0.3, 0.9], 0.3),
    ("damping", "Pa s", [25.0, 100.0, 400.0, 1600.0], 250.0),
];

/// The body after a run.
struct Thrown {
    parameter: usize,
    value: f64,
    /// Mean of |εᵖ| over the elements.
    plastic: f64,
    /// Place of the mean of all nodes along the floor at the end, and its way, m.
    end: f64,
    way: f64,
    triangles: Vec<Triangle>,
}

/// A measure of the end.
type Measure = fn(&Thrown) -> f64;

/// Throws the bunny with each value.
pub fn run(data: &Path, quick: bool) -> Result<Part> {
    let mesh = meshed(&picture(data, "bunny")?, EDGE, 5)?.mesh;
    let duration = DURATIONS[usize::from(quick)];
    let mut found = Vec::new();
    for (parameter, (.., values, _)) in PARAMETERS.iter().enumerate() {
        for value in if quick { vec![values[0], values[3]] } else { values.to_vec() } {
            found.push(thrown(&mesh, duration, parameter, value)?);
        }
    }
    let of = |parameter: usize| found.iter().filter(move |run| run.parameter == parameter);
    let falls = |parameter: usize, measure: Measure, sign: f64| {
        let values: Vec<f64> = of(parameter).map(|run| sign * measure(run)).collect();
        values.windows(2).all(|pair| pair[1] < pair[0])
    };
    let statements: [(&str, usize, Measure, f64); 4] = [
        ("the higher the yield strain, the less the body flows", 0, |run| run.plastic, 1.0),
        ("the faster the creep, the more the body flows", 1, |run| run.plastic, -1.0),
        ("the larger the friction, the shorter the way", 2, |run| run.way, 1.0),
        ("the larger the damping, the less the body flows", 3, |run| run.plastic, 1.0),
    ];
    let marks = statements.map(|(statement, parameter, measure, sign)| {
        let values: Vec<String> = of(parameter).map(|run| format!("{:.3}", measure(run))).collect();
        Mark::new(statement, values.join(", "), falls(parameter, measure, sign))
    });
    let figures = (0..4).map(|parameter| figure(parameter, duration, of(parameter))).collect::<Result<Vec<_>>>()?;
    let table = Table::of(
        "flat-sweep",
        &found,
        &[
            ("parameter", &|run| named(run.parameter)),
            (">value", &|run| run.value.to_string()),
            (">mean |εᵖ|", &|run| format!("{:.4}", run.plastic)),
            (">way (m)", &|run| format!("{:.3}", run.way)),
        ],
    );
    let text = format!(
        "A bunny of λ = μ = {LAME} Pa is thrown onto a floor {HEIGHT} m below it with {THROWN:?} m/s, by implicit Euler at {FRAMES} steps a second. One parameter varies; the others are {}.",
        PARAMETERS.map(|(name, unit, _, usual)| format!("{name} {usual} {unit}").trim_end().to_owned()).join(", ")
    );
    Ok(Part::new(text).marks(marks).tables([table]).figures(figures))
}

fn named(parameter: usize) -> String {
    let (name, unit, ..) = PARAMETERS[parameter];
    if unit.is_empty() { name.to_owned() } else { format!("{name} ({unit})") }
}

fn thrown(mesh: &Mesh<2, 3>, duration: f64, parameter: usize, value: f64) -> Result<Thrown> {
    let [yield_strain, creep, friction, damping] =
        [0, 1, 2, 3].map(|other| if other == parameter { value } else { PARAMETERS[other].3 });
    let method = Method::new(Integrator::ImplicitEuler, 1.0 / FRAMES);
    let floor = ContactPlane { friction, ..ContactPlane::new(Vector3::new(0.0, -HEIGHT, 0.0), Vector3::y()) };
    let body = body(mesh, LAME, damping / LAME)?.gravity([0.0, -9.81, 0.0])?;
    let mut body = body.velocity([THROWN[0], THROWN[1], 0.0])?.obstacles(vec![floor], &method)?;
    body.plasticity = Some(Plasticity::Additive { yield_strain, creep, maximum: 0.5 });
    let mut simulation = Simulator::<f64>::new(body, &method)?;
    let start = middle(&simulation);
    for _ in 0..(duration * FRAMES) as usize {
        step(&mut simulation).map_err(|problem| format!("{} = {value}: {problem}", PARAMETERS[parameter].0))?;
    }
    let strains = simulation.system().elements.plastic_strains().ok_or("the bunny has no plasticity")?;
    Ok(Thrown {
        parameter,
        value,
        plastic: strains.iter().sum::<f64>() / strains.len() as f64,
        end: middle(&simulation).x,
        way: middle(&simulation).x - start.x,
        triangles: elements(&simulation),
    })
}

/// The mean of all nodes, m.
fn middle(simulation: &Simulator<f64>) -> Vector2<f64> {
    let q = simulation.positions();
    q.as_slice().chunks(3).map(|x| Vector2::new(x[0], x[1])).sum::<Vector2<f64>>() / (q.len() / 3) as f64
}

/// The ends of all runs of a parameter.
fn figure<'a>(parameter: usize, duration: f64, runs: impl Iterator<Item = &'a Thrown>) -> Result<Figure> {
    let (name, ..) = PARAMETERS[parameter];
    let picture = |run: &Thrown| {
        let [left, right] = [-0.75, 0.75].map(|x| Vector2::new(run.end + x, -HEIGHT));
        let shown = [&run.triangles[..], &band(left, right, 0.03)].concat();
        drawn(&format!("{name} {}: {:.2} m", run.value, run.way), &shown, [[left.x, left.y, 0.0], [right.x, 0.7, 0.0]])
    };
    let pictures = runs.map(picture).collect::<Result<Vec<_>>>()?;
    let named = named(parameter);
    let caption = format!("The bunny after {duration} s for values of {named}, and the way that it has gone.");
    Ok(Figure::new(format!("flat-sweep-{name}"), grid(&named, 2, &pictures), caption))
}
