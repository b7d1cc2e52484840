//! The five objects, dropped from 2 m between three planes, until they rest.

use std::path::Path;

use fem_chart::{Picture, grid};
use fem_engine::simulator::Simulator;
use fem_mesh::generate::picture::PictureMesh;
use fem_model::simulation::{Diagnostics, Simulation};
use fem_model::{Body, Contact, ContactPlane, Damping, DampingForm, Integrator, Method};
use nalgebra::{Vector2, Vector3};

use super::object::{DENSITY, LAME, OBJECTS, body, meshed, picture};
use crate::experiments::drawing::{Triangle, band, drawn, elements};
use crate::scenes::step;
use crate::study::{Figure, Mark, Part, Result, Table};

/// Length of the edges, m, for a height of 1 m.
const EDGE: f64 = 0.1;
/// Frames in a second, and the duration, s.
const FRAMES: f64 = 60.0;
const DURATION: f64 = 5.0;
/// Height from which the bodies fall, and the distance of the planes from their common centre, m.
const HEIGHT: f64 = 2.0;
const OFFSET: f64 = 2.8;
/// The thesis' damping of stresses, Pa s.
const DAMPING: f64 = 250.0;
/// Damping of rigid motions, 1/s: damping of stresses leaves rocking and rolling alone.
const DRAG: f64 = 3.0;
const FRICTION: f64 = 0.4;
/// Speed of sliding from which friction has its full size, m/s.
const TRANSITION: f64 = 1e-5;
/// Largest speed of a node at rest, m/s.
const REST: f64 = 1e-3;
const GRAVITY: f64 = 9.81;
/// Largest relative difference of the vertical forces of the planes and the weight at rest.
const BALANCE: f64 = 1e-6;
/// Largest relative change of the normal forces of friction: a step is repeated until theirs is below it.
const LAG: f64 = 1e-6;
/// Normals of the planes, each of length 5.
const NORMALS: [[f64; 2]; 3] = [[0.0, 5.0], [4.0, 3.0], [-4.0, 3.0]];

/// A body that has fallen.
struct Fallen {
    name: &'static str,
    triangles: usize,
    /// Smallest distance of a node from a plane after any step, m.
    smallest_gap: f64,
    /// Time from which the planes carry the weight and no node is faster than [`REST`], s; `None` if it is not reached.
    at_rest: Option<f64>,
    /// Largest speed of a node at the end, m/s.
    speed: f64,
    /// Difference of the vertical forces of the planes and the weight, and the horizontal force, over the weight at the end.
    balance: [f64; 2],
    /// Largest relative change with which the lag of friction has ended.
    lag: f64,
    /// Triangles at the end, and the planes' lines.
    drawn: Vec<Triangle>,
    planes: Vec<Vector2<f64>>,
}

/// Drops each object.
pub fn run(data: &Path, quick: bool) -> Result<Part> {
    let objects = if quick { &OBJECTS[3..] } else { &OBJECTS[..] };
    let fallen = objects.iter().map(|name| fall(data, name)).collect::<Result<Vec<_>>>()?;
    let mut marks = Vec::new();
    for body in &fallen {
        let name = body.name;
        let gap = format!("smallest gap {:.1e} m", body.smallest_gap);
        let rest = body.at_rest.map_or("not at rest".to_owned(), |time| format!("after {time:.2} s"));
        let balanced = format!("{name}: the vertical forces of the planes are m g within 1e-6");
        let settled = format!("{name}: the lag of friction has converged, its residual at most {LAG:e}");
        marks.extend([
            Mark::new(format!("{name}: no node behind a plane after any step"), gap, body.smallest_gap > 0.0),
            Mark::new(format!("{name}: at rest within {DURATION} s"), rest, body.at_rest.is_some()),
            Mark::at_most(balanced, body.balance[0], BALANCE),
            Mark::at_most(settled, body.lag, LAG),
        ]);
    }
    let text = format!(
        "Each object of {DENSITY} kg/m³ with λ = μ = {LAME} Pa falls {HEIGHT} m onto a floor between two slopes, each plane {OFFSET} m from a common centre, \
         with friction {FRICTION} and the thesis' damping of {DAMPING} Pa s, by implicit Euler at {FRAMES} steps a second. Without a damping of rigid \
         motions, here {DRAG} per second, the donut rolls and the bunny rocks for longer than {DURATION} s. A body rests from the time on at which the planes carry its weight \
         within {BALANCE:e} and no node is faster than {REST} m/s. A horizontal force is left while it creeps on friction that is smoothed below {TRANSITION:e} m/s."
    );
    let table = Table::of(
        "flat-drop",
        &fallen,
        &[
            ("object", &|body| body.name.to_owned()),
            (">triangles", &|body| body.triangles.to_string()),
            (">smallest gap (m)", &|body| format!("{:.2e}", body.smallest_gap)),
            (">at rest after (s)", &|body| body.at_rest.map_or("".to_owned(), |time| format!("{time:.2}"))),
            (">speed at the end (m/s)", &|body| format!("{:.1e}", body.speed)),
            (">|Σ F − m g| / m g", &|body| format!("{:.1e}", body.balance[0])),
            (">horizontal force / m g", &|body| format!("{:.1e}", body.balance[1])),
            (">residual of the lag", &|body| format!("{:.1e}", body.lag)),
        ],
    );
    let figure = Figure::new("flat-drop", pictures(&fallen)?, format!("The bodies after {DURATION} s."));
    Ok(Part::new(text).marks(marks).tables([table]).figures([figure]))
}

fn fall(data: &Path, name: &'static str) -> Result<Fallen> {
    let mesh = meshed(&picture(data, name)?, EDGE, 5)?;
    let centre = centre(&mesh);
    let method = Method::new(Integrator::ImplicitEuler, 1.0 / FRAMES);
    let mut simulation = Simulator::<f64>::new(falling(&mesh, centre, &method)?, &method)?;
    let area: f64 = simulation.shape().mesh.volumes().iter().sum();
    let weight = DENSITY * area * GRAVITY;
    let (mut smallest_gap, mut at_rest, mut balance) = (f64::INFINITY, None, [f64::INFINITY; 2]);
    for _ in 0..(DURATION * FRAMES) as usize {
        step(&mut simulation).map_err(|problem| format!("{name}: {problem}"))?;
        for contact in simulation.contacts() {
            smallest_gap = if contact.smallest_gap >= smallest_gap { smallest_gap } else { contact.smallest_gap };
        }
        balance = imbalance(&simulation, weight);
        let is_at_rest = balance[0] <= BALANCE && simulation.velocities().amax() <= REST;
        at_rest = if is_at_rest { at_rest.or(Some(simulation.time())) } else { None };
    }
    let corner = |side: f64| centre + OFFSET * Vector2::new(side * 0.5, -1.0);
    let top = |side: f64| corner(side) + Vector2::new(side * 0.27, 0.36);
    Ok(Fallen {
        name,
        triangles: mesh.mesh.elements.len(),
        smallest_gap,
        at_rest,
        speed: simulation.velocities().amax(),
        balance,
        lag: simulation.lag_residual().unwrap_or(0.0),
        drawn: elements(&simulation),
        planes: vec![top(-1.0), corner(-1.0), corner(1.0), top(1.0)],
    })
}

/// Difference of the vertical forces of the planes and the weight, and the horizontal force, over the weight.
fn imbalance(simulation: &Simulator<f64>, weight: f64) -> [f64; 2] {
    let mut sum = [0.0, -weight];
    for contact in simulation.contacts() {
        (0..2).for_each(|i| sum[i] += contact.force[i]);
    }
    [sum[1].abs() / weight, sum[0].abs() / weight]
}

/// The common centre of the planes, for which the lowest point of a body falls from [`HEIGHT`].
fn centre(mesh: &PictureMesh) -> Vector2<f64> {
    let points = mesh.mesh.vertices.iter();
    let (low, high) = points.fold((mesh.mesh.vertices[0], mesh.mesh.vertices[0]), |(a, b), x| (a.inf(x), b.sup(x)));
    Vector2::new(0.5 * (low.x + high.x), low.y - HEIGHT + OFFSET)
}

/// The body under its weight between the planes.
fn falling(mesh: &PictureMesh, centre: Vector2<f64>, method: &Method) -> Result<Body> {
    let plane = |normal: &[f64; 2]| {
        let point = centre - OFFSET / 5.0 * Vector2::from(*normal);
        let plane = ContactPlane::new(point.push(0.0), Vector3::new(normal[0], normal[1], 0.0));
        ContactPlane { friction: FRICTION, ..plane }
    };
    let damping = Damping { alpha: DRAG, beta: DAMPING / LAME, form: DampingForm::default() };
    let body = body(&mesh.mesh, LAME, 0.0)?.gravity([0.0, -GRAVITY, 0.0])?.damping(damping)?;
    let contact = body.contact_with(NORMALS.iter().map(plane).collect(), method)?;
    Ok(Body { contact: Some(Contact { transition_speed: TRANSITION, ..contact }), ..body })
}

/// The bodies one after the other, to one scale.
fn pictures(fallen: &[Fallen]) -> Result<Picture> {
    let picture = |body: &Fallen| {
        let [left, right] = [body.planes[1], body.planes[2]];
        let ways = body.planes.windows(2).flat_map(|ends| band(ends[0], ends[1], 0.04));
        let shown: Vec<Triangle> = body.drawn.iter().copied().chain(ways).collect();
        let corner = |x: Vector2<f64>, dx: f64, dy: f64| [x.x + dx, x.y + dy, 0.0];
        drawn(body.name, &shown, [corner(left, -0.3, -0.05), corner(right, 0.3, 1.1)])
    };
    let all = fallen.iter().map(picture).collect::<Result<Vec<_>>>()?;
    Ok(grid("bodies at rest between three planes", 2, &all))
}
