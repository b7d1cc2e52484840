//! Adaptive steps: estimated errors beside true ones.

use fem_chart::page::figure;
use fem_chart::{Axis, Chart, Dot, Guide, Picture, SHAPES, Series};
use fem_model::Integrator;
use maud::{Markup, html};

use super::text::{number, seconds};
use crate::runs::row::Row;
use crate::studies::scene::SceneStudy;
use crate::study::{Column, Table};

/// The completed runs of adaptive steps.
fn rows(study: &SceneStudy) -> impl Iterator<Item = &Row> {
    study.rows.iter().filter(|row| row.config.group == "adaptive" && row.is_done() && row.errors.estimated.is_some())
}

/// True over estimated errors; `None` without such runs.
pub(super) fn chart(study: &SceneStudy) -> Option<Picture> {
    let label = format!("{}: estimated and true error of adaptive steps", study.name);
    let (x, y) = ("sum of estimated errors / body length", "largest true error / body length");
    let mut chart = Chart::new(label, Axis::log(x), Axis::log(y));
    for (number, method) in methods(study).into_iter().enumerate() {
        let dot = |row: &Row| Some(Dot::new(row.errors.estimated?, row.errors.time_linf?, row.config.method.clone()));
        let dots = rows(study).filter(|row| row.config.integrator == method).filter_map(dot);
        chart.series.push(Series::joined(method.name().replace('_', " "), (number, number % SHAPES), dots));
    }
    let through = chart.series.first()?.dots.first().map(|dot| (dot.x, dot.x))?;
    chart.guides.push(Guide::Slope { through, slope: 1.0, name: "equal".to_owned() });
    Some(chart.draw())
}

/// The integrators with such runs.
fn methods(study: &SceneStudy) -> Vec<Integrator> {
    let mut methods: Vec<Integrator> = rows(study).map(|row| row.config.integrator).collect();
    methods.dedup();
    methods
}

/// The table and the chart.
pub(super) fn html(study: &SceneStudy) -> Markup {
    let Some(picture) = chart(study) else { return html! {} };
    let columns: [Column<&Row>; 7] = [
        ("run", &|row| row.config.method.clone()),
        (">steps", &|row| row.counters.accepted_steps.to_string()),
        (">rejected", &|row| row.counters.rejected_steps.to_string()),
        (">estimated error", &|row| number(row.errors.estimated)),
        (">true error", &|row| number(row.errors.time_linf)),
        (">true / estimated", &|row| {
            number(row.errors.time_linf.zip(row.errors.estimated).map(|(error, estimated)| error / estimated))
        }),
        (">total", &|row| seconds(row.seconds())),
    ];
    let caption = "Estimates are those of the displacements of each step, added up; true errors are the largest distance from the reference at the \
        end, in which errors of earlier steps have grown or swung back.";
    html! {
        h3 { "Adaptive steps" }
        (figure(&picture, caption))
        (Table::of("adaptive", &rows(study).collect::<Vec<_>>(), &columns).html())
    }
}
