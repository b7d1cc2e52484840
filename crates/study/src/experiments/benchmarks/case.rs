//! A published case: its values on a sequence of meshes, beside the reference.

use std::time::Instant;

use fem_chart::{Axis, Chart, Dot, Series};
use fem_engine::simulator::build;
use fem_mesh::{Pattern, box_mesh, rectangle_mesh};
use fem_model::simulation::Simulation;
use fem_model::{Body, BodyMesh, Integrator, Material, Method, Motion, Refusal, Selector};
use nalgebra::Vector3;

use crate::study::{Mark, Part, Result, Table};

/// The source of a reference that is computed here.
pub const CLOSED_FORM: &str = "closed form";

/// A value of a case and its reference.
pub struct Quantity {
    /// Its name with the unit.
    pub name: &'static str,
    pub reference: f64,
    /// Largest relative error on the finest mesh.
    pub tolerance: f64,
    /// Where the reference comes from.
    pub source: &'static str,
}

/// A solution on one mesh.
pub struct Level {
    pub nodes: usize,
    /// The values, in the order of the quantities.
    pub values: Vec<f64>,
    /// Of the solution without set-up.
    pub seconds: f64,
}

/// A mesh with the place of each node in the box or square that it is mapped from, with edges of 1.
pub struct Mapped {
    pub mesh: BodyMesh,
    pub places: Vec<Vector3<f64>>,
}

impl Mapped {
    /// Quadratic triangles, one in each half of so many cells along both edges.
    pub fn square(cells: [usize; 2], map: impl Fn(f64, f64) -> [f64; 2]) -> Result<Self> {
        let mut mesh = rectangle_mesh(cells.map(|n| n as f64), 1, Pattern::Alternating)?;
        let place = |x: &Vector3<f64>| Vector3::new(x.x / cells[0] as f64, x.y / cells[1] as f64, 0.0);
        mesh.vertices.iter_mut().for_each(|x| *x = place(x));
        let unit = BodyMesh::flat(mesh.clone(), 1.0);
        for x in &mut mesh.vertices {
            let [a, b] = map(x.x, x.y);
            *x = Vector3::new(a, b, 0.0);
        }
        Self::quadratic(unit, BodyMesh::flat(mesh, 1.0))
    }

    /// Quadratic tetrahedra in so many cells along the three edges.
    pub fn cube(cells: [usize; 3], map: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Result<Self> {
        let mut mesh = box_mesh(cells.map(|n| n as f64), 1, Pattern::Alternating)?;
        let place = |x: &Vector3<f64>| x.component_div(&Vector3::from(cells.map(|n| n as f64)));
        mesh.vertices.iter_mut().for_each(|x| *x = place(x));
        let unit = BodyMesh::from(mesh.clone());
        mesh.vertices.iter_mut().for_each(|x| *x = map(x));
        Self::quadratic(unit, BodyMesh::from(mesh))
    }

    fn quadratic(unit: BodyMesh, mesh: BodyMesh) -> Result<Self> {
        let of_order = |mesh: BodyMesh| mesh.of_order(2).ok_or("there is no quadratic element");
        Ok(Self { places: of_order(unit)?.vertices().to_vec(), mesh: of_order(mesh)? })
    }

    /// The node whose place is the nearest to a point.
    pub fn node_at(&self, place: [f64; 3]) -> usize {
        let distance = |node: &usize| (self.places[*node] - Vector3::from(place)).norm();
        (0..self.places.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
    }
}

/// A body with the supports that `is_constrained` names by the places of its nodes.
pub fn supported(
    mesh: BodyMesh,
    material: Material,
    places: &[Vector3<f64>],
    is_constrained: impl Fn(&Vector3<f64>) -> [bool; 3],
) -> Result<Body, Refusal> {
    let mut body = Body::new(mesh, material)?;
    let masks: Vec<[bool; 3]> = places.iter().map(is_constrained).collect();
    for bits in 1..8 {
        let mask = [0, 1, 2].map(|i| bits >> i & 1 == 1);
        let nodes: Vec<usize> = (0..masks.len()).filter(|&node| masks[node] == mask).collect();
        if !nodes.is_empty() {
            body = body.prescribe(&Selector::Nodes(nodes), mask, Motion::by([0.0; 3]))?;
        }
    }
    Ok(body)
}

/// Equilibrium in so many load steps, and the time that it took, s.
pub fn equilibrium(body: Body, load_steps: usize) -> Result<(Box<dyn Simulation>, f64)> {
    let method = Method { load_steps, ..Method::new(Integrator::Static, 1.0) };
    let mut simulation = build(body, &method)?;
    let start = Instant::now();
    for _ in 0..load_steps {
        simulation.step()?;
    }
    Ok((simulation, start.elapsed().as_secs_f64()))
}

/// A relative error in words.
fn percent_of(error: f64) -> String {
    if error.abs() < 1e-6 { format!("{error:+.1e}") } else { format!("{:+.3} %", 100.0 * error) }
}

/// A relative tolerance in words: in per cent, or as a power of ten where that is far below.
fn percent(tolerance: f64) -> String {
    if tolerance < 1e-6 { format!("{tolerance:e}") } else { format!("{} %", 100.0 * tolerance) }
}

/// The part of a case: its levels, with the finest ones left out of a short run.
pub fn part(
    (name, text): (&str, &str),
    quantities: &[Quantity],
    (meshes, short): (&[usize], usize),
    quick: bool,
    mut solve: impl FnMut(usize) -> Result<Level>,
) -> Result<Part> {
    let meshes = if quick { &meshes[..short] } else { meshes };
    let levels = meshes.iter().map(|&cells| Ok((cells, solve(cells)?))).collect::<Result<Vec<_>>>()?;
    Ok(part_of_levels((name, text), quantities, &levels))
}

fn part_of_levels((name, text): (&str, &str), quantities: &[Quantity], levels: &[(usize, Level)]) -> Part {
    let error = |(_, level): &(usize, Level), k: usize| level.values[k] / quantities[k].reference - 1.0;
    let marks = quantities.iter().enumerate().map(|(k, of)| {
        let (value, error) = levels.last().map_or((f64::NAN, f64::NAN), |level| (level.1.values[k], error(level, k)));
        let statement = format!("{} within {}", of.name, percent(of.tolerance));
        let theirs = format!("{} ({})", of.reference, of.source);
        Mark::new(statement, format!("{value:.5e}, {}", percent_of(error)), error.abs() <= of.tolerance).beside(theirs)
    });
    let columns: String = quantities.iter().map(|of| format!(" | {} | >error (%)", of.name)).collect();
    let head = format!(">cells or steps | >nodes{columns} | >solution (ms)");
    let row = |level: &(usize, Level)| {
        let mut row = vec![level.0.to_string(), level.1.nodes.to_string()];
        for k in 0..quantities.len() {
            row.extend([format!("{:.6e}", level.1.values[k]), format!("{:+.3}", 100.0 * error(level, k))]);
        }
        row.push(format!("{:.1}", 1e3 * level.1.seconds));
        row
    };
    let table = Table::new(format!("benchmarks-{name}"), &head, levels.iter().map(row).collect());
    let about = format!("error of {name} over the number of nodes");
    let mut chart = Chart::new(&about, Axis::log("nodes"), Axis::log("relative error"));
    for (k, of) in quantities.iter().enumerate() {
        let dot = |level: &(usize, Level)| {
            let error = error(level, k).abs();
            Dot::new(level.1.nodes as f64, error, format!("{} nodes, error {error:.2e}", level.1.nodes))
        };
        chart.series.push(Series::joined(of.name, (k, 0), levels.iter().map(dot)));
    }
    let caption = "Relative errors against the reference, of which the last digit is rounded.";
    Part::new(text).marks(marks).tables([table]).chart(format!("benchmarks-{name}"), &chart, caption)
}
