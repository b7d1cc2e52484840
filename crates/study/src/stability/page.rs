//! The page: the answer first, then the maps, then every row.

use super::case::{Outcome, Row};
use super::map::{EXPONENTS_OF_YOUNG, Map, PARTS_OF_DT, TIME_STEPS};
use super::output::Table;
use super::poisson::CANTILEVER;
use fem_chart::page;
use fem_chart::{Cell, HeatMap, Picture, Shade, escape};

/// The whole page.
pub fn page(table: &Table) -> String {
    let mut body = head(table);
    body.push_str(&failures(table));
    body.push_str(&maps(table));
    body.push_str(&recovery(table));
    body.push_str(&locking(table));
    body.push_str("<h2>Every case</h2>\n");
    let mut families: Vec<&str> = table.rows.iter().map(|row| row.family).collect();
    families.dedup();
    for family in families {
        let rows: Vec<&Row> = table.rows.iter().filter(|row| row.family == family).collect();
        body.push_str(&chapter(family, &rows));
    }
    page::page("Stiff and extreme cases", &body)
}

fn head(table: &Table) -> String {
    let counts = table.counts;
    let failed = counts.rows - counts.pass;
    let answer = if failed == 0 {
        format!("All <b>{}</b> cases end as they must.", counts.rows)
    } else {
        format!("<b>{failed}</b> of {} cases do not end as they must.", counts.rows)
    };
    let of = |outcome: Outcome| table.rows.iter().filter(|row| row.outcome == outcome).count();
    let ends = [
        (Outcome::Survives, "survive"),
        (Outcome::Recovers, "return to the shape of rest"),
        (Outcome::Untangles, "untangle into another balance"),
        (Outcome::Explodes, "explode with an error that names the step"),
        (Outcome::Refused, "are refused with an error that names the element or field"),
        (Outcome::Inverts, "fold where their law allows it"),
        (Outcome::Locks, "lock"),
    ];
    let ends: Vec<String> = ends.iter().map(|(outcome, words)| format!("{} {words}", of(*outcome))).collect();
    format!(
        "<h1>Stiff and extreme cases</h1>\n<p class=\"soft\">What the engine does with bodies and steps that an adversary would \
         choose.</p>\n<div class=\"answer\">{answer} {}; {} panics, {} hangs, {} NaN handed on. For stiff bodies and long \
         steps take <b>implicit Euler</b>, which survives all of its map; explicit methods end with an error that names the \
         step as soon as dt passes the line that theory draws.</div>\n<p class=\"soft\">{} rows start from random numbers, {} \
         seeds; the maps hold {} more runs. {}{:.0} s on the clock. {}.</p>\n",
        ends.join(", "),
        of(Outcome::Panics),
        of(Outcome::Hangs),
        of(Outcome::NotFinite),
        counts.seeded_rows,
        counts.seeds,
        counts.map_cells,
        if table.quick { "This is the reduced study. " } else { "" },
        table.seconds,
        escape(&table.machine.line()),
    )
}

fn failures(table: &Table) -> String {
    let failed: Vec<&Row> = table.rows.iter().filter(|row| !row.pass).collect();
    if failed.is_empty() {
        return String::new();
    }
    format!("<h2>Not as expected</h2>\n{}", rows(&failed))
}

fn maps(table: &Table) -> String {
    if table.maps.is_empty() {
        return String::new();
    }
    let mut text = "<h2>Stiffness and time step</h2>\n<p>A clamped neo-Hookean box of 2 × 1 × 1 m in cells of 1 m, ρ = 1000 kg/m³, \
        starts in the shape of its fastest vibration, 0.1 mm large. The line is the largest stable step, \
        dt = limit / ω<sub>max</sub>, with ω<sub>max</sub> of M⁻¹K at rest by power iteration. Explicit Euler and RK2 have no \
        stable step for what vibrates without damping: their line is where the growth shows within the run. × explodes.</p>\n\
        <div class=\"charts\">\n"
        .to_owned();
    for map in &table.maps {
        let exploded = map.cells.iter().filter(|cell| cell.outcome == Outcome::Explodes).count();
        let wrong = map.cells.iter().filter(|cell| cell.outcome != cell.expected).count();
        let caption = format!(
            "<b>{}</b>: {exploded} of {} pairs explode, {wrong} against the forecast; up to {} steps.",
            words(map.integrator),
            map.cells.len(),
            map.cells.iter().map(|cell| cell.steps).max().unwrap_or_default()
        );
        text.push_str(&page::figure(&picture(map), &caption));
    }
    text + "</div>\n"
}

/// The name of a method for people.
fn words(name: &str) -> &str {
    match name {
        "explicit_euler" => "Explicit Euler",
        "semi_implicit_euler" => "Semi-implicit Euler",
        "rk2" => "RK2",
        "rk4" => "RK4",
        "verlet" => "Velocity Verlet",
        "linearly_implicit_euler" => "Linearly implicit Euler",
        "implicit_euler" => "Implicit Euler",
        other => other,
    }
}

/// The map of a method.
pub fn picture(map: &Map) -> Picture {
    let cell = |(i, cell): (usize, &super::map::Cell)| {
        let shade = match cell.outcome {
            outcome if outcome != cell.expected => Shade::Fair,
            Outcome::Survives => Shade::Good,
            _ => Shade::Bad,
        };
        let title = format!(
            "E = {:e} Pa, dt = {:.2e} s, dt ω_max = {:.3e}\n{} (expected: {})\n{}",
            cell.young, cell.dt, cell.z, cell.outcome, cell.expected, cell.note
        );
        let text = if cell.outcome == Outcome::Explodes { "×".to_owned() } else { String::new() };
        Cell { column: i % TIME_STEPS, row: i / TIME_STEPS, shade, text, title }
    };
    let dt = |column: usize| match column as i32 % PARTS_OF_DT {
        0 => format!("1e{}", column as i32 / PARTS_OF_DT - 5),
        _ => String::new(),
    };
    let curves = map.limit.map(|limit| (limit_is(map), line(limit))).into_iter().collect();
    HeatMap {
        label: format!("{}: what survives, and what explodes (×)", words(map.integrator)),
        columns: ("time step dt (s)".to_owned(), (0..TIME_STEPS).map(dt).collect()),
        rows: (
            "Young's modulus E (Pa)".to_owned(),
            EXPONENTS_OF_YOUNG.map(|exponent| format!("1e{exponent}")).collect(),
        ),
        cells: map.cells.iter().enumerate().map(cell).collect(),
        curves,
        cell: (46.0, 26.0),
    }
    .draw()
}

/// What the line of a map is.
fn limit_is(map: &Map) -> String {
    match map.integrator {
        "explicit_euler" | "rk2" => format!("growth by e¹⁸ in {} steps", map.most_steps),
        _ => "dt = limit / ω max".to_owned(),
    }
}

/// E dt² = limit, from the bottom of the map to its top, in columns and rows.
fn line(limit: f64) -> Vec<(f64, f64)> {
    let (first, last) = (f64::from(*EXPONENTS_OF_YOUNG.start()), f64::from(*EXPONENTS_OF_YOUNG.end()));
    let place = |exponent: f64| {
        let dt = (limit / 10f64.powf(exponent)).sqrt();
        ((dt.log10() + 5.0) * f64::from(PARTS_OF_DT), exponent - first)
    };
    vec![place(first - 0.5), place(last + 0.5)]
}

/// How many of each tangle come back, and how far.
fn recovery(table: &Table) -> String {
    let rows: Vec<&Row> = table.rows.iter().filter(|row| row.family == "recovery").collect();
    let mut kinds: Vec<&str> = Vec::new();
    for row in &rows {
        if !kinds.contains(&row.case.as_str()) {
            kinds.push(&row.case);
        }
    }
    let line = |kind: &&str| {
        let of = |outcome: Option<Outcome>| {
            let same =
                rows.iter().filter(|row| row.case == *kind && outcome.is_none_or(|outcome| row.outcome == outcome));
            same.count().to_string()
        };
        vec![(*kind).to_owned(), of(None), of(Some(Outcome::Recovers)), of(Some(Outcome::Untangles))]
    };
    let lines: Vec<Vec<String>> = kinds.iter().map(line).collect();
    format!(
        "<h2>Recovery</h2>\n<p>A stable neo-Hookean box of 2 × 1 × 1 m, ν = 0.4, starts from a tangle and moves by implicit Euler, \
         lightly damped. Mirrored and flattened to a plane it must return to the shape of rest. Where nodes have passed through \
         each other it must end upright and in balance: elements may then surround an inner edge twice, which no energy of \
         single elements can tell from rest.</p>\n{}",
        page::table(&["from", ">seeds", ">in the shape of rest", ">upright, in another balance"], &lines)
    )
}

/// What is known to be wrong, with its figures.
fn locking(table: &Table) -> String {
    let beams: Vec<&Row> = table.rows.iter().filter(|row| row.case == CANTILEVER).collect();
    // Poisson's ratio and cells, as the rows write them.
    let parts = |row: &Row| -> [String; 2] {
        let mut parts = row.parameters.split(", ").map(str::to_owned);
        [parts.next().unwrap_or_default(), parts.last().unwrap_or_default()]
    };
    let mut sides: [Vec<String>; 2] = [Vec::new(), Vec::new()];
    for row in &beams {
        for (side, part) in sides.iter_mut().zip(parts(row)) {
            if !side.contains(&part) {
                side.push(part);
            }
        }
    }
    let [ratios, meshes] = sides;
    let cell = |ratio: &String, mesh: &String| {
        let row = beams.iter().find(|row| parts(row) == [ratio.clone(), mesh.clone()]);
        let margin = row.and_then(|row| row.margin).map_or(String::new(), |margin| format!("{margin:.3}"));
        if row.is_some_and(|row| row.outcome == Outcome::Locks) { format!("<b>{margin}</b>") } else { margin }
    };
    let line =
        |ratio: &String| [ratio.clone()].into_iter().chain(meshes.iter().map(|mesh| cell(ratio, mesh))).collect();
    let lines: Vec<Vec<String>> = ratios.iter().map(line).collect();
    let head: Vec<String> =
        ["Poisson's ratio".to_owned()].into_iter().chain(meshes.iter().map(|mesh| format!(">{mesh}"))).collect();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    format!(
        "<h2>Locking</h2>\n<p>Linear tetrahedra bend too little, and near ν = ½ hardly at all: every element keeps its own volume, \
         and the mesh has more elements than directions to move in. A finer mesh helps little there. Nothing in the engine mends \
         this yet; trust no bending of nearly incompressible bodies. The tip of a cantilever of 8 × 1 × 1 m moves by these parts \
         of what Timoshenko's theory says; what is locked, below one half, is bold:</p>\n{}",
        page::table(&head, &lines)
    )
}

fn chapter(family: &str, all: &[&Row]) -> String {
    let pass = all.iter().filter(|row| row.pass).count();
    page::details(&format!("{family}: {pass} of {} as expected", all.len()), &rows(all))
}

fn rows(all: &[&Row]) -> String {
    let line = |row: &&Row| {
        let margin = row.margin.map_or(String::new(), |margin| format!("{margin:.3e}"));
        let of = if margin.is_empty() { "" } else { row.margin_is };
        let seed = row.seed.map_or(String::new(), |seed| format!(", seed {seed}"));
        let must = if row.pass { String::new() } else { format!("must: {}", row.expected) };
        vec![
            stacked("", row.outcome.name(), &must),
            stacked("wide", &row.case, &row.parameters),
            stacked("", &row.integrator, &format!("{}{seed}", row.material)),
            stacked("wide", &margin, of),
            stacked("wide", "", &row.note),
        ]
    };
    let lines: Vec<Vec<String>> = all.iter().map(line).collect();
    page::table(&["outcome", "case and parameters", "integrator and material", "margin", "note"], &lines)
}

/// A cell of two texts, one below the other.
fn stacked(class: &str, above: &str, below: &str) -> String {
    let (above, below) = (escape(above), escape(below));
    let line = if above.is_empty() || below.is_empty() { "" } else { "<br>" };
    format!("<div class=\"{class}\">{above}{line}<span class=\"soft\">{below}</span></div>")
}
