//! Contact with planes and friction beside closed forms.

pub mod block;
pub mod hertz;
pub mod impact;
#[cfg(test)]
mod tests;

use std::path::Path;

use fem_engine::simulator::Simulator;
use fem_model::{ContactTreatment, Integrator};

use crate::study::{Mark, Part, Result, Table};

/// The methods whose contact is compared with closed forms.
pub const METHODS: [Integrator; 6] = [
    Integrator::ImplicitEuler,
    Integrator::Verlet,
    Integrator::SemiImplicitEuler,
    Integrator::ExplicitEuler,
    Integrator::Rk2,
    Integrator::Rk4,
];

/// Returns true if a method keeps bodies in front of planes by a barrier.
fn has_barrier(method: Integrator) -> bool {
    method.facts().contact == Some(ContactTreatment::Barrier)
}

/// Runs all cases, with implicit Euler and, in a full run, every method that supports contact.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let methods = if quick { &METHODS[..1] } else { &METHODS[..] };
    let (mut marks, mut tables) = (Vec::new(), Vec::new());
    add_resting(&mut marks, &mut tables)?;
    for &method in methods {
        marks.extend(on_an_incline(method)?);
    }
    add_stopping(&mut marks, &mut tables, methods)?;
    let thrown = [Integrator::Verlet, Integrator::SemiImplicitEuler, Integrator::ImplicitEuler];
    for method in thrown.into_iter().take(if quick { 1 } else { 3 }) {
        marks.extend(at_a_wall(method)?);
    }
    add_hertz(&mut marks, &mut tables, quick)?;
    let text = format!(
        "A block at rest, a block on an incline and on a level floor with friction {}, a bar that hits a wall (c is its wave speed), and Hertz's contact of \
         a cylinder and of a ball with a plane (Johnson, Contact Mechanics, 1985, sections 4.2 and 4.3). Implicit methods have a barrier and smoothed friction, explicit \
         ones impulses. The thesis multiplies the tangential velocity of touching nodes in each substep.",
        block::FRICTION
    );
    Ok(Part::new(text).marks(marks).tables(tables))
}

fn add_resting(marks: &mut Vec<Mark>, tables: &mut Vec<Table>) -> Result<()> {
    let mut rows = Vec::new();
    for (young, tolerance) in [(1e7, 1e-5), (2e11, 1e-8)] {
        let block::Block { gap, root, force, unconverged } = block::block(young)?;
        let (balance, error) = (force / block::WEIGHT - 1.0, (gap - root) / block::ACTIVATION);
        let carried = format!("a block of E = {young:e} Pa rests with Σ F = m g within 1e-8");
        marks.push(Mark::new(carried, format!("{balance:.1e}"), balance.abs() <= 1e-8));
        // A soft block's nodes lean outwards by its strain.
        let place = "its gap is where the barrier's force is the weight";
        let statement = format!("{place}, within {tolerance:e} of the activation distance");
        marks.push(Mark::new(statement, format!("{error:.1e}"), error.abs() <= tolerance));
        let [gap, root] = [gap, root].map(|length| format!("{length:.12e}"));
        rows.push(vec![format!("{young:e}"), gap, root, format!("{force:.9}"), unconverged.to_string()]);
    }
    let head = ">E (Pa) | >gap (m) | >root (m) | >force (N) | >of 2000 steps unconverged";
    tables.push(Table::new("flat-contact-resting", head, rows));
    Ok(())
}

fn on_an_incline(method: Integrator) -> Result<[Mark; 2]> {
    let name = method.name();
    let creep = block::creep(method)?;
    let sticks = format!("{name}: at tan θ = 0.99 μ a block sticks, or creeps by at most ε_v t = 1e-3 m in a second");
    let [found, expected] = block::acceleration(method, 1.01)?;
    Ok([
        Mark::new(sticks, format!("{creep:.1e} m"), creep.abs() <= 1e-3),
        Mark::new(
            format!("{name}: at tan θ = 1.01 μ it accelerates by g (sin θ − μ cos θ) within 1 %"),
            format!("{found:.5} of {expected:.5} m/s²"),
            (found - expected).abs() <= 0.01 * expected,
        ),
    ])
}

fn add_stopping(marks: &mut Vec<Mark>, tables: &mut Vec<Table>, methods: &[Integrator]) -> Result<()> {
    let expected = block::STOPPING;
    let mut rows = Vec::new();
    for &method in methods {
        let name = method.name();
        let frame = block::frame(method);
        let counts = [1.0, 2.0, 4.0, 10.0, 40.0];
        let ways = counts.map(|substeps| block::way(method, frame / substeps));
        let ways = ways.into_iter().collect::<Result<Vec<_>>>()?;
        let errors: Vec<f64> = ways.iter().map(|way| (way - expected).abs() / expected).collect();
        let order = (errors[0] / errors[2]).log2() / 2.0;
        marks.push(Mark::new(
            format!("{name}: a sliding block stops after v²/(2 μ g) within 1 % with 10 and 40 substeps"),
            format!("{:.2} % and {:.2} %", 100.0 * errors[3], 100.0 * errors[4]),
            errors[3..].iter().all(|error| *error <= 0.01),
        ));
        if has_barrier(method) {
            marks.push(Mark::new(
                "the distance is of first order in the time step (0.8 to 1.2), with 1, 2 and 4 substeps",
                format!("{order:.2}"),
                (0.8..1.2).contains(&order),
            ));
        }
        for ((substeps, way), error) in counts.iter().zip(&ways).zip(&errors) {
            let way = format!("{way:.6}");
            rows.push(vec![name.to_owned(), substeps.to_string(), way, format!("{:.3}", 100.0 * error)]);
        }
    }
    let head = "method | >substeps | >distance (m) | >error (%)";
    tables.push(Table::new("flat-contact-stopping", head, rows));
    Ok(())
}

fn at_a_wall(method: Integrator) -> Result<[Mark; 3]> {
    let name = method.name();
    let impact::Impact { duration, stress, impulse_error } = impact::bar(method, 100, 1)?;
    let impulse = format!("{name}: the wall's impulse is the change of momentum within 1e-5");
    Ok([
        Mark::new(
            format!("{name}: a bar of 100 elements touches a wall for 2 L/c within 2 %"),
            format!("{duration:.4} of {} s", impact::DURATION),
            (duration / impact::DURATION - 1.0).abs() < 0.02,
        ),
        Mark::new(
            format!("{name}: the wall's stress is ρ c v within 2 %"),
            format!("{stress:.1} of {} Pa", impact::STRESS),
            (stress / impact::STRESS - 1.0).abs() < 0.02,
        ),
        Mark::new(impulse, format!("{impulse_error:.1e}"), impulse_error < 1e-5),
    ])
}

fn add_hertz(marks: &mut Vec<Mark>, tables: &mut Vec<Table>, quick: bool) -> Result<()> {
    let mut rows = Vec::new();
    let mut widths = Vec::new();
    for cells in if quick { &[4.0, 8.0][..] } else { &[4.0, 8.0, 16.0] } {
        let [found, expected] = hertz::widths(hertz::WIDTH / cells)?;
        let error = (found - expected).abs() / expected;
        rows.push(row("cylinder, half-width (m)", *cells, [found, expected]));
        widths.push(error);
    }
    marks.push(Mark::new(
        "cylinder: half-width √(4 F R/(π E*)) within 3 % at a/h = 8, falling with refinement",
        told(&widths),
        widths[1] <= 0.03 && widths.windows(2).all(|pair| pair[1] < pair[0]),
    ));
    let (mut forces, mut radii) = (Vec::new(), Vec::new());
    for cells in if quick { &[2.0, 3.0][..] } else { &[4.0, 8.0] } {
        let hertz::Hertz { force, radius, .. } = hertz::contact(hertz::RADIUS / cells)?;
        rows.push(row("ball, force (N)", *cells, force));
        rows.push(row("ball, radius (m)", *cells, radius));
        forces.push((force[0] / force[1] - 1.0).abs());
        radii.push((radius[0] / radius[1] - 1.0).abs());
    }
    let bound = if quick { 0.08 } else { 0.03 };
    let cells = if quick { 3 } else { 8 };
    for (name, errors) in [("F = 4/3 E* √R d^1.5", &forces), ("radius (3 F R/(4 E*))^(1/3)", &radii)] {
        marks.push(Mark::new(
            format!("ball: {name} within {:.0} % at a/h = {cells}, falling with refinement", 100.0 * bound),
            told(errors),
            errors[1] <= bound && errors[1] < errors[0],
        ));
    }
    tables.push(Table::new("flat-contact-hertz", "body | >a/h | >found | >Hertz | >error (%)", rows));
    Ok(())
}

fn row(body: &str, cells: f64, [found, expected]: [f64; 2]) -> Vec<String> {
    let error = 100.0 * (found / expected - 1.0);
    vec![body.to_owned(), cells.to_string(), format!("{found:.6e}"), format!("{expected:.6e}"), format!("{error:+.2}")]
}

fn told(errors: &[f64]) -> String {
    errors.iter().map(|error| format!("{:.2} %", 100.0 * error)).collect::<Vec<_>>().join(", ")
}

/// Mean velocity of the nodes' masses times the mass, along x, kg m/s.
fn momentum(simulation: &Simulator<f64>) -> f64 {
    let (system, state) = (simulation.system(), simulation.state());
    system.mass.row_sums().iter().zip(&state.v).map(|(mass, v)| mass * v[0]).sum()
}

/// Displacement of the centre of mass along x, m.
fn travel(simulation: &Simulator<f64>) -> f64 {
    let (system, state) = (simulation.system(), simulation.state());
    let moment: f64 = system.mass.row_sums().iter().zip(&state.u).map(|(mass, u)| mass * u[0]).sum();
    moment / system.total_mass
}
