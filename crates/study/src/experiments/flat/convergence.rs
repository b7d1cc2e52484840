//! Errors of linear and of quadratic triangles against a manufactured solution.

use std::path::Path;

use fem_chart::{Axis, Chart, Dot, Guide, Series};

use crate::runs::convergence_order::fit;
use crate::study::{Mark, Part, Result, Table};
use fem_model::element::Element;
use fem_reference::space::manufactured::{label, orders, solve};

const MODELS: [&str; 2] = ["linear", "neo_hookean"];

/// Largest distance of an observed order from theory.
const TOLERANCE: f64 = 0.1;

/// The errors of one kind of elements and one law.
struct Sequence {
    model: &'static str,
    element: &'static Element,
    levels: Vec<Level>,
}

/// The discrete solution on one mesh: edge of a cell (m), number of nodes, relative errors in L2 and H1, seconds.
struct Level {
    spacing: f64,
    nodes: usize,
    errors: [f64; 2],
    seconds: f64,
}

/// Solves on a sequence of meshes of the unit square.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let cells: &[usize] = if quick { &[4, 8, 16] } else { &[4, 8, 16, 32, 64] };
    let models = if quick { &MODELS[1..] } else { &MODELS };
    let (mut sequences, mut marks) = (Vec::new(), Vec::new());
    for &model in models {
        for element in Element::ALL.into_iter().filter(|element| element.dimension == 2) {
            let levels = cells.iter().map(|&cells| level(model, element, cells)).collect::<Result<Vec<_>>>()?;
            let sequence = Sequence { model, element, levels };
            marks.extend((0..2).map(|norm| judge(&sequence, norm)));
            sequences.push(sequence);
        }
    }
    let text = format!(
        "Equilibrium of the unit square in plane strain under the body force of u = (0.06, −0.05) sin πx sin πy m, with fixed sides. Theory: the \
         error of linear triangles falls with h² in L2 and with h in H1, that of quadratic ones with h³ and h². An order is that of the two \
         finest of {} meshes. The thesis has no such figures.",
        cells.len()
    );
    let caption = "Relative errors of the neo-Hookean square, by quadrature of degree 7.";
    Ok(Part::new(text).marks(marks).tables([table(&sequences)]).chart("flat-convergence", &chart(&sequences), caption))
}

fn level(model: &str, element: &Element, cells: usize) -> Result<Level> {
    let solved = solve(model, element, cells)?;
    let nodes = solved.mesh.vertices().len();
    Ok(Level { spacing: 1.0 / cells as f64, nodes, errors: [solved.l2, solved.h1], seconds: solved.seconds })
}

/// The order of the errors in a norm between two meshes.
fn order(pair: &[Level], norm: usize) -> Option<f64> {
    let pairs: Vec<_> = pair.iter().map(|level| (level.spacing, level.errors[norm])).collect();
    fit(&pairs).map(|order| order.value)
}

fn judge(sequence: &Sequence, norm: usize) -> Mark {
    let expected = orders(sequence.element)[norm];
    let found = sequence.levels.windows(2).last().and_then(|pair| order(pair, norm));
    let law = sequence.model.replace('_', "-");
    let statement =
        format!("{law}, {}: order {expected} in {} within {TOLERANCE}", label(sequence.element), NORMS[norm]);
    let holds = found.is_some_and(|found| (found - expected).abs() <= TOLERANCE);
    Mark::new(statement, found.map_or("–".to_owned(), |found| format!("{found:.3}")), holds)
}

const NORMS: [&str; 2] = ["L2", "H1"];

fn table(sequences: &[Sequence]) -> Table {
    let numbered = |of| move |number| (of, number);
    let rows: Vec<(&Sequence, usize)> =
        sequences.iter().flat_map(|of| (0..of.levels.len()).map(numbered(of))).collect();
    let observed = |(of, number): &(&Sequence, usize), norm: usize| {
        let pair = number.checked_sub(1).map(|before| &of.levels[before..=*number]);
        pair.and_then(|pair| order(pair, norm)).map_or("–".to_owned(), |order| format!("{order:.3}"))
    };
    Table::of(
        "flat-convergence",
        &rows,
        &[
            ("law", &|(of, _)| of.model.to_owned()),
            ("elements", &|(of, _)| label(of.element)),
            (">h (m)", &|(of, number)| format!("{:.5}", of.levels[*number].spacing)),
            (">nodes", &|(of, number)| of.levels[*number].nodes.to_string()),
            (">error in L2", &|(of, number)| format!("{:.4e}", of.levels[*number].errors[0])),
            (">order", &|row| observed(row, 0)),
            (">error in H1", &|(of, number)| format!("{:.4e}", of.levels[*number].errors[1])),
            (">order", &|row| observed(row, 1)),
            (">solution (ms)", &|(of, number)| format!("{:.2}", 1e3 * of.levels[*number].seconds)),
        ],
    )
}

fn chart(sequences: &[Sequence]) -> Chart {
    let text = "errors of linear and quadratic triangles over the edge of a cell";
    let mut chart = Chart::new(text, Axis::log("edge of a cell (m)"), Axis::log("relative error"));
    let shown = sequences.iter().filter(|sequence| sequence.model == "neo_hookean");
    for (place, sequence) in shown.enumerate() {
        for (norm, name) in NORMS.into_iter().enumerate() {
            let dot = |level: &Level| {
                let error = level.errors[norm];
                let title = format!("{}, {} nodes\nerror in {name} {error:.3e}", label(sequence.element), level.nodes);
                Dot::new(level.spacing, error, title)
            };
            let finest = sequence.levels.last().map(|level| (level.spacing, 0.6 * level.errors[norm]));
            let slope = orders(sequence.element)[norm];
            if let Some(through) = finest {
                chart.guides.push(Guide::Slope { through, slope, name: format!("h^{slope}") });
            }
            let name = format!("{}, {name}", label(sequence.element));
            chart.series.push(Series::joined(name, (place, norm), sequence.levels.iter().map(dot)));
        }
    }
    chart
}
