//! The page of a stability study: the answer, the maps, recovery and locking, every case.

use fem_chart::page::{details, figure, page, table};
use fem_chart::{Cell, HeatMap, Picture, Shade};
use fem_model::Integrator;
use maud::{Markup, html};

use super::case::{self, CaseRow, Map, Outcome};
use super::families::incompressibility::CANTILEVER;
use super::families::maps::{EXPONENTS_OF_YOUNG, PARTS_OF_DT, TIME_STEPS};
use super::results::Results;

/// The whole page.
pub fn render(study: &Results) -> String {
    let mut families: Vec<&str> = study.rows.iter().map(|row| row.family.as_str()).collect();
    families.dedup();
    let failed: Vec<&CaseRow> = study.rows.iter().filter(|row| !row.pass).collect();
    let body = html! {
        (head(study))
        @if !failed.is_empty() { h2 { "Unexpected outcomes" } (rows(&failed)) }
        (stiffness_and_step(&study.maps))
        (recovery(study))
        (locking(study))
        h2 { "All cases" }
        @for family in families { (chapter(family, study)) }
    };
    page("Stiff and extreme cases", body)
}

fn head(study: &Results) -> Markup {
    let counts = study.counts;
    let of = |outcome: Outcome| study.rows.iter().filter(|row| row.outcome == outcome).count();
    let ends = [
        (Outcome::Survives, "survive"),
        (Outcome::Recovers, "return to the undeformed shape"),
        (Outcome::Untangles, "untangle into another equilibrium"),
        (Outcome::Explodes, "diverge with an error that names the step"),
        (Outcome::Refused, "are refused with an error that names the element or the key"),
        (Outcome::Inverts, "invert elements, which their material allows"),
        (Outcome::Locks, "lock"),
        (Outcome::Panics, "panic"),
        (Outcome::Hangs, "hang"),
        (Outcome::NotFinite, "return NaN"),
    ];
    let ends: Vec<String> = ends.iter().map(|(outcome, words)| format!("{} {words}", of(*outcome))).collect();
    html! {
        h1 { "Stiff and extreme cases" }
        p class="soft" { "The engine's behaviour for extreme bodies, materials, loads and time steps." }
        div class="answer" {
            @if counts.pass == counts.rows {
                "All " b { (counts.rows) } " cases end as expected: "
            } @else {
                b { (counts.rows - counts.pass) } " of " (counts.rows) " cases do not end as expected. In all: "
            }
            (ends.join(", ")) ". For stiff bodies and long time steps use " b { "implicit Euler" } ", which survives its whole map. Explicit \
             integrators end with an error that names the step when dt exceeds the stability limit."
        } "\n"
        p class="soft" {
            (counts.seeded_rows) " cases start from random states with " (counts.seeds) " seeds; the maps contain " (counts.map_cells)
            " more runs. " @if study.quick { "This is the short study. " }
            "Wall-clock time: " (format!("{:.0}", study.seconds)) " s. " (study.machine.line()) "."
        } "\n"
    }
}

fn stiffness_and_step(maps: &[Map]) -> Markup {
    let caption = |map: &Map| {
        let exploded = map.cells.iter().filter(|cell| cell.outcome == Outcome::Explodes).count();
        let unexpected = map.cells.iter().filter(|cell| cell.outcome != cell.expected).count();
        let steps = map.cells.iter().map(|cell| cell.steps).max().unwrap_or_default();
        html! {
            b { (words(map.integrator)) } ": " (exploded) " of " (map.cells.len()) " runs diverge, " (unexpected)
            " against the prediction; up to " (steps) " steps."
        }
    };
    html! {
        @if !maps.is_empty() {
            h2 { "Stiffness and time step" }
            p {
                "A clamped neo-Hookean box of 2 × 1 × 1 m with cells of 1 m and ρ = 1000 kg/m³ starts in the mode of the highest natural frequency with an \
                 amplitude of 0.1 mm. The line is the stability limit dt = limit / ω" sub { "max" } "; ω" sub { "max" } " is computed from M⁻¹K at rest by \
                 power iteration. Explicit Euler and RK2 have no stable step for undamped vibrations; their line marks where the growth becomes visible \
                 within the run. × marks divergence."
            }
            div class="charts" { @for map in maps { (figure(&picture(map), caption(map))) } } "\n"
        }
    }
}

/// The name of an integrator at the start of a sentence.
fn words(integrator: Integrator) -> String {
    let label = integrator.facts().label;
    let mut letters = label.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// The map of an integrator.
pub fn picture(map: &Map) -> Picture {
    let cell = |(i, cell): (usize, &case::Cell)| {
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
    let limit = match map.integrator.facts().stability_limit {
        Some(0.0) => format!("growth by e⁷ in {} steps", map.most_steps),
        _ => "dt = limit / ω_max".to_owned(),
    };
    HeatMap {
        label: format!("{}: stable and diverging (×) runs", words(map.integrator)),
        columns: ("time step dt (s)".to_owned(), (0..TIME_STEPS).map(dt).collect()),
        rows: (
            "Young's modulus E (Pa)".to_owned(),
            EXPONENTS_OF_YOUNG.map(|exponent| format!("1e{exponent}")).collect(),
        ),
        cells: map.cells.iter().enumerate().map(cell).collect(),
        curves: map.limit.map(|value| (limit, line(value))).into_iter().collect(),
        cell: (46.0, 26.0),
    }
    .draw()
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

/// Numbers of recoveries for each initial state.
fn recovery(study: &Results) -> Markup {
    let rows: Vec<&CaseRow> = study.rows.iter().filter(|row| row.family == "recovery").collect();
    let mut kinds: Vec<&str> = rows.iter().map(|row| row.case.as_str()).collect();
    let mut seen = std::collections::HashSet::new();
    kinds.retain(|kind| seen.insert(*kind));
    let line = |kind: &&str| {
        let of = |wanted: Option<Outcome>| {
            let is_wanted = |row: &&&CaseRow| row.case == *kind && wanted.is_none_or(|outcome| row.outcome == outcome);
            rows.iter().filter(is_wanted).count().to_string()
        };
        vec![(*kind).to_owned(), of(None), of(Some(Outcome::Recovers)), of(Some(Outcome::Untangles))]
    };
    let head = ["initial state", ">seeds", ">undeformed shape", ">another equilibrium"];
    html! {
        h2 { "Recovery" }
        p {
            "A stable neo-Hookean box of 2 × 1 × 1 m with ν = 0.4 starts from an inverted or degenerate state and moves by implicit Euler with light damping. \
             From a reflection and from a plane it must return to the undeformed shape. From the other states it must reach an equilibrium with J > 0 in all \
             elements; elements may then surround an inner edge twice, which the energies of single elements cannot distinguish from the undeformed state."
        }
        (table(&head, &kinds.iter().map(line).collect::<Vec<_>>()))
    }
}

/// Tip deflections of the cantilever, by Poisson's ratio, mesh and elements.
fn locking(study: &Results) -> Markup {
    let beams: Vec<&CaseRow> = study.rows.iter().filter(|row| row.case == CANTILEVER).collect();
    // Poisson's ratio; cells and elements, as the rows write them after the size.
    let parts = |row: &CaseRow| -> [String; 2] {
        let parts: Vec<&str> = row.parameters.split(", ").collect();
        [parts[0].to_owned(), parts.get(2..).unwrap_or_default().join(", ")]
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
        let locks = row.is_some_and(|row| row.outcome == Outcome::Locks);
        html! { @if locks { b { (margin) } } @else { (margin) } }
    };
    let line = |ratio: &String| {
        std::iter::once(html! { (ratio) }).chain(meshes.iter().map(|mesh| cell(ratio, mesh))).collect::<Vec<_>>()
    };
    let names: Vec<String> = meshes.iter().map(|mesh| format!(">{mesh}")).collect();
    let head: Vec<&str> = std::iter::once("Poisson's ratio").chain(names.iter().map(String::as_str)).collect();
    html! {
        h2 { "Volumetric locking" }
        p {
            "Linear tetrahedra lock when the material is nearly incompressible: each element keeps its volume, and the mesh has more elements than degrees of \
             freedom that are left. Refinement helps little. Quadratic elements, volumes averaged over patches, and pressures as unknowns (which alone take ν = ½) are \
             the remedies: mesh.order and material.volumetric. The table gives the tip deflection of a cantilever of 8 × 1 × 1 m relative to Timoshenko's beam theory; \
             values below one half, which count as locked, are bold."
        }
        (table(&head, &ratios.iter().map(line).collect::<Vec<_>>()))
    }
}

fn chapter(family: &str, study: &Results) -> Markup {
    let all: Vec<&CaseRow> = study.rows.iter().filter(|row| row.family == family).collect();
    let pass = all.iter().filter(|row| row.pass).count();
    details(&format!("{family}: {pass} of {} as expected", all.len()), rows(&all))
}

fn rows(all: &[&CaseRow]) -> Markup {
    let line = |row: &&CaseRow| {
        let margin = row.margin.map_or(String::new(), |margin| format!("{margin:.3e}"));
        let of = if margin.is_empty() { "" } else { &row.margin_is };
        let seed = row.seed.map_or(String::new(), |seed| format!(", seed {seed}"));
        let expected = if row.pass { String::new() } else { format!("expected: {}", row.expected) };
        vec![
            stacked("", row.outcome.name(), &expected),
            stacked("wide", &row.case, &row.parameters),
            stacked("", &row.integrator, &format!("{}{seed}", row.material)),
            stacked("wide", &margin, of),
            stacked("wide", "", &row.note),
        ]
    };
    let lines: Vec<Vec<Markup>> = all.iter().map(line).collect();
    table(&["outcome", "case and parameters", "integrator and material", "margin", "note"], &lines)
}

/// A cell of two texts, one below the other.
fn stacked(class: &str, above: &str, below: &str) -> Markup {
    html! {
        div class=(class) {
            (above) @if !above.is_empty() && !below.is_empty() { br; } span class="soft" { (below) }
        }
    }
}
