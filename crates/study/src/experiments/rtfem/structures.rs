//! Other bodies than the torus: a cantilever beside beam theory, a bunny, an armadillo and a donut that stand and are pressed from above.

use std::path::Path;
use std::time::Instant;

use fem_engine::cantilever::{Cantilever, tip_displacement};
use fem_engine::simulator::build;
use fem_mesh::generate::picture::{FromPicture, mesh_picture, read_picture};
use fem_mesh::{Pattern, Side, SurfaceMesh, box_mesh, read_tetrahedra};
use fem_model::simulation::Simulation;
use fem_model::{Axis, BodyMesh, Region, Selector};

use super::setting::{DT, LAWS, POISSON, Setting, TRACTION, YOUNG, median_and_p95, one_thread};
use crate::scenes::step;
use crate::study::{Mark, Part, Result, Table, pairs};

/// Parts of the height that stand on the ground, and that are pressed.
const FOOT: f64 = 0.1;
const HEAD: f64 = 0.1;

/// Cells per metre of the cantilever.
const CELLS: [usize; 4] = [2, 4, 8, 16];

/// Largest relative deviation of the reactions from the load.
const BALANCE: f64 = 1e-9;

/// Presses every body, and bends the cantilever.
pub fn run(data: &Path, quick: bool) -> Result<Part> {
    let (mut rows, mut marks) = (Vec::new(), Vec::new());
    let mut slowest = 0.0_f64;
    let bodies = bodies(data, quick)?;
    for ((name, mesh), law) in pairs(&bodies, LAWS) {
        let found = pressed(law, mesh, quick)?;
        slowest = slowest.max(found.milliseconds);
        if law == "linear" {
            let statement = format!("{name}: the reactions balance the load within {BALANCE:e}");
            marks.push(Mark::at_most(statement, found.imbalance, BALANCE));
        }
        rows.push((*name, mesh, law, found));
    }
    let statement = format!("a step of every body and law under {} ms on one thread", 1e3 * DT);
    marks.push(Mark::new(statement, format!("{slowest:.2} ms at most"), slowest < 1e3 * DT).unless(quick));
    let (bent, mark) = cantilevers(if quick { &CELLS[..3] } else { &CELLS })?;
    marks.push(mark);
    let text = format!(
        "Bodies with the thesis' material, damping and steps, announced there and not shown. The lowest tenth stands on the ground, and the highest tenth carries \
         {TRACTION} Pa downwards; the donut is flat, in plane strain. The settling is the mean displacement of the pressed nodes in equilibrium. The \
         cantilever, 4 × 1 × 1 m, bends under {BEND} Pa across its end."
    );
    let head = ">cells per m | >elements | >tip, Timoshenko (m) | >here, linear (m) | >error (%)";
    let tables = [table(&rows), Table::new("rtfem-cantilever", head, bent)];
    Ok(Part::new(text).marks(marks).tables(tables))
}

fn table(rows: &[(&str, &BodyMesh, &str, Pressed)]) -> Table {
    Table::of(
        "rtfem-structures",
        rows,
        &[
            ("body", &|(name, ..)| (*name).to_owned()),
            (">elements", &|(_, mesh, ..)| mesh.elements().to_string()),
            (">nodes", &|(_, mesh, ..)| mesh.vertices().len().to_string()),
            ("law", &|(.., law, _)| (*law).to_owned()),
            (">a step, one thread (ms)", &|(.., found)| format!("{:.3}", found.milliseconds)),
            (">95 % (ms)", &|(.., found)| format!("{:.3}", found.p95)),
            (">load (N)", &|(.., found)| format!("{:.5}", found.load)),
            (">settling (m)", &|(.., found)| format!("{:.5e}", found.settling)),
            (">over height (%)", &|(.., found)| format!("{:.3}", 100.0 * found.settling / found.height)),
            (">imbalance of reactions", &|(.., found)| format!("{:.1e}", found.imbalance)),
        ],
    )
}

/// Names and meshes.
fn bodies(data: &Path, quick: bool) -> Result<Vec<(&'static str, BodyMesh)>> {
    let solid = |file: &str| read_tetrahedra(&data.join(file)).map(BodyMesh::from);
    let beam = box_mesh([1.0, 4.0, 1.0], if quick { 2 } else { 4 }, Pattern::Kuhn)?;
    let mut bodies = vec![("beam", beam.into()), ("armadillo", solid("own/armadillo_own_coarse.node")?)];
    if !quick {
        bodies.push(("bunny", solid("stanford/bunny_coarse.node")?));
    }
    bodies.push(("donut", donut(data)?));
    Ok(bodies)
}

fn donut(data: &Path) -> Result<BodyMesh> {
    let picture = read_picture(&data.join("pictures/donut.png"))?;
    let found = mesh_picture(&picture, FromPicture { edge: 0.06, height: 1.0, improve: 5 })?;
    let vertices = found.mesh.vertices.iter().map(|x| x.push(0.0)).collect();
    Ok(BodyMesh::flat(SurfaceMesh::new(vertices, found.mesh.elements), 1.0))
}

/// Results of pressing a body.
struct Pressed {
    milliseconds: f64,
    p95: f64,
    load: f64,
    settling: f64,
    height: f64,
    imbalance: f64,
}

fn pressed(law: &str, mesh: &BodyMesh, quick: bool) -> Result<Pressed> {
    let heights = || mesh.vertices().iter().map(|x| x.y);
    let (low, high) = heights().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), y| (a.min(y), b.max(y)));
    let height = high - low;
    let loaded = |setting: &Setting| -> Result<Box<dyn Simulation>> {
        let near = |side, within| Selector::Region(Region::Side { axis: Axis::Y, side, within });
        let body = setting.body(mesh.clone())?.fix(&near(Side::Min, FOOT * height))?;
        let body = body.traction(&near(Side::Max, HEAD * height), [0.0, -TRACTION, 0.0])?;
        Ok(build(body, &setting.method())?)
    };
    let setting = Setting::of_law(law);
    let mut still = loaded(&setting.in_equilibrium())?;
    step(&mut *still)?;
    let reaction: f64 = still.reactions().iter().map(|reaction| reaction.force[1]).sum();
    let load = pressed_area(mesh, high - HEAD * height) * TRACTION;
    let q = still.positions();
    let top: Vec<usize> = heights().enumerate().filter(|(_, y)| *y >= high - HEAD * height).map(|(i, _)| i).collect();
    let settling = top.iter().map(|&i| mesh.vertices()[i].y - q[3 * i + 1]).sum::<f64>() / top.len() as f64;
    let (milliseconds, p95) = one_thread()?.install(|| timed(&mut *loaded(&setting)?, quick))?;
    Ok(Pressed { milliseconds, p95, load, settling, height, imbalance: (reaction / load - 1.0).abs() })
}

/// Median and 95 % of the times of the steps after the first, ms.
fn timed(simulation: &mut dyn Simulation, quick: bool) -> Result<(f64, f64)> {
    step(simulation)?;
    let mut times = Vec::new();
    for _ in 0..if quick { 5 } else { 60 } {
        let begun = Instant::now();
        step(simulation)?;
        times.push(1e3 * begun.elapsed().as_secs_f64());
    }
    Ok(median_and_p95(times))
}

/// Undeformed area of the sides whose nodes all lie above a height, m²; computed apart from the engine.
fn pressed_area(mesh: &BodyMesh, above: f64) -> f64 {
    let x = mesh.vertices();
    let is_above = |nodes: &[usize]| nodes.iter().all(|&i| x[i].y >= above);
    let area = |face: &Vec<usize>| match (mesh.thickness(), &face[..]) {
        (None, &[a, b, c]) => 0.5 * (x[b] - x[a]).cross(&(x[c] - x[a])).norm(),
        (thickness, face) => thickness.unwrap_or(f64::NAN) * (x[face[1]] - x[face[0]]).norm(),
    };
    mesh.faces().iter().filter(|face| is_above(face)).map(area).sum()
}

/// Load across the end of the cantilever, Pa: a deflection of a hundredth of its length.
const BEND: f64 = 1.0;

/// Rows of the cantilevers, and a mark that their errors fall.
fn cantilevers(cells: &[usize]) -> Result<(Vec<Vec<String>>, Mark)> {
    let beam = Cantilever { length: 4.0, height: 1.0, width: 1.0, young: YOUNG, poisson: POISSON };
    let expected = -beam.under_end_load(BEND);
    let (mut rows, mut errors) = (Vec::new(), Vec::new());
    for &cells in cells {
        let mesh = box_mesh([4.0, 1.0, 1.0], cells, Pattern::Kuhn)?;
        let elements = mesh.elements.len();
        let setting = Setting::default().in_equilibrium();
        let body = setting.body(mesh)?.fix(&Selector::least(Axis::X))?;
        let mut simulation = build(body.traction(&Selector::most(Axis::X), [0.0, -BEND, 0.0])?, &setting.method())?;
        step(&mut *simulation)?;
        let tip = tip_displacement(&*simulation).y;
        errors.push((tip / expected - 1.0).abs());
        let numbers =
            [format!("{expected:.5}"), format!("{tip:.5}"), format!("{:+.2}", 100.0 * (tip / expected - 1.0))];
        rows.push([cells.to_string(), elements.to_string()].into_iter().chain(numbers).collect());
    }
    let falls = errors.windows(2).all(|pair| pair[1] < pair[0] / 2.0);
    let shown: Vec<String> = errors.iter().map(|error| format!("{:.1} %", 100.0 * error)).collect();
    let statement =
        "cantilever: the error against Timoshenko's deflection more than halves with every halving of the edges";
    Ok((rows, Mark::new(statement, shown.join(" → "), falls)))
}
