//! The part of the page about convergence orders in time and errors in space, with its charts.

use fem_chart::page::{figure, table};
use fem_chart::{Axis, Chart, Dot, Guide, Picture, Series};
use maud::{Markup, html};

use super::text::{number, seconds};
use super::{Observed, Report, charts, orders_in_time};
use crate::runs::convergence_order::ConvergenceOrder;
use crate::runs::row::Row;
use crate::studies::space::{SpaceOrders, SpaceStudy, spacing};
use crate::study::{Column, Table};
use fem_reference::LINEAR;
use fem_reference::space::locking::{RATIOS, TipDeflection};
use fem_reference::space::manufactured;

/// Convergence orders in time on the small body.
pub(super) fn orders(report: &Report) -> Markup {
    let study = &report.orders;
    let is_met = |of: &Observed| of.order.is_some_and(|order| (order.value - of.expected).abs() <= 0.1);
    let columns: [Column<Observed>; 4] = [
        ("method", &|of| of.method.clone()),
        (">order (95 %)", &|of| text(of.order)),
        (">theory", &|of| of.expected.to_string()),
        ("", &|of| if is_met(of) { "within 0.1" } else { "not within 0.1" }.to_owned()),
    ];
    html! {
        h2 id="orders" { "Convergence orders in time" }
        p class="soft" { (study.about) ": " (study.size.0) " nodes." }
        div class="charts" {
            (figure(&charts::convergence(study), "Errors at the end against the reference in time."))
            div { (Table::of("orders", &orders_in_time(study), &columns).html()) }
        } "\n"
    }
}

fn text(order: Option<ConvergenceOrder>) -> String {
    order.map_or("–".to_owned(), |order| order.text())
}

/// The manufactured solution, and locking.
pub(super) fn space(study: &SpaceStudy) -> Markup {
    let columns: [Column<SpaceOrders>; 5] = [
        ("scene", &|of| of.scene.clone()),
        ("elements", &|of| manufactured::label(of.element)),
        (">order in L2", &|of| text(of.observed[0])),
        (">order in H1", &|of| text(of.observed[1])),
        (">theory", &|of| {
            let [in_l2, in_h1] = manufactured::orders(of.element);
            format!("{in_l2} and {in_h1}")
        }),
    ];
    html! {
        h2 id="space" { "Errors in space" }
        p {
            "Equilibrium of a cube under the body force of the manufactured solution u" sub { "i" } " = a" sub { "i" } " sin πx sin πy sin πz, and of a \
             square in plane strain under that of u" sub { "i" } " = a" sub { "i" } " sin πx sin πy. Orders are fitted to the two finest meshes."
        }
        div class="charts" {
            (figure(&in_space(study), "Relative errors, by quadrature of degree 7."))
            (figure(&time_in_plane(study), "Linear and quadratic triangles: error in H1 over the wall-clock time of the solution."))
            div { (Table::of("space", &study.orders, &columns).html()) }
        } "\n"
        (locking(study))
    }
}

fn locking(study: &SpaceStudy) -> Markup {
    let mut meshes: Vec<(&str, usize)> = study.tip_deflections.iter().map(|tip| (&*tip.elements, tip.cells)).collect();
    meshes.dedup();
    let ratios: Vec<f64> = RATIOS.into_iter().chain([0.5]).collect();
    let names: Vec<String> = ratios.iter().map(|ratio| format!(">ν = {ratio}")).collect();
    let head: Vec<&str> = ["elements", ">h"].into_iter().chain(names.iter().map(String::as_str)).collect();
    let row = |&(elements, cells): &(&str, usize)| {
        let bent = |poisson: &f64| {
            let is_meant =
                |tip: &&TipDeflection| tip.elements == elements && tip.cells == cells && tip.poisson == *poisson;
            study.tip_deflections.iter().find(is_meant).map_or(String::new(), |tip| number(Some(tip.ratio)))
        };
        [elements.to_owned(), format!("1/{cells} m")]
            .into_iter()
            .chain(ratios.iter().map(bent))
            .collect::<Vec<String>>()
    };
    html! {
        h3 id="locking" { "Volumetric locking" }
        p {
            "Linear tetrahedra lock when the material is nearly incompressible: they bend too little, and no mesh of this table is fine enough for ν near ½. \
             Quadratic ones (mesh.order), volumes averaged over patches and pressures as unknowns (material.volumetric) are the remedies. The table gives the tip \
             deflection of a cantilever of 8 × 1 × 1 m relative to Timoshenko's beam theory."
        }
        div class="charts" {
            (figure(&locking_chart(study), "Linear tetrahedra; the exact ratio is 1."))
            div { (table(&head, &meshes.iter().map(row).collect::<Vec<_>>())) }
        } "\n"
    }
}

/// Errors of the manufactured solution over the edge of a cell.
pub fn in_space(space: &SpaceStudy) -> Picture {
    let label = "manufactured solution: convergence in h";
    let mut chart = Chart::new(label, Axis::log("edge of a cell (m)"), Axis::log("relative error"));
    for (place, SpaceOrders { scene, observed: [l2, h1], .. }) in space.orders.iter().enumerate() {
        let law = scene.trim_start_matches("manufactured-");
        for (norm, order, shape) in [("L2", l2, 0), ("H1", h1, 1)] {
            let rows = space.rows.iter().filter(|row| row.config.scene == *scene);
            let dot = |row: &Row| {
                let error = if norm == "L2" { row.errors.space_l2 } else { row.errors.space_h1 };
                let title =
                    format!("{law}, {} nodes\nerror in {norm} {}\n{}", row.config.nodes, number(error), row.config.id);
                Some(Dot::new(spacing(row), error?, title))
            };
            let name =
                format!("{law}, {norm}: {}", order.map_or("–".to_owned(), |order| format!("{:.2}", order.value)));
            chart.series.push(Series::joined(name, (place, shape), rows.filter_map(dot)));
        }
    }
    chart.draw()
}

/// Errors of linear and quadratic triangles over the time of the solution.
pub fn time_in_plane(space: &SpaceStudy) -> Picture {
    let label = "manufactured solution in the plane: error against run time";
    let mut chart = Chart::new(label, Axis::log("wall-clock time (s)"), Axis::log("relative error in H1"));
    let flat = space.orders.iter().filter(|orders| orders.element.dimension == 2);
    for (place, orders) in flat.enumerate() {
        let rows = space.rows.iter().filter(|row| row.config.scene == orders.scene);
        let dot = |row: &Row| {
            let (time, error) = (row.times.total_s[1]?, row.errors.space_h1?);
            let title = format!(
                "{}, {} nodes\nerror in H1 {}\n{}",
                orders.scene,
                row.config.nodes,
                number(Some(error)),
                seconds(Some(time))
            );
            Some(Dot::new(time, error, title))
        };
        let name = orders.scene.trim_start_matches("manufactured-");
        chart.series.push(Series::joined(name, (place, place), rows.filter_map(dot)));
    }
    chart.draw()
}

/// Tip deflection of linear elements relative to theory over the edge of a cell, for each Poisson's ratio.
pub fn locking_chart(space: &SpaceStudy) -> Picture {
    let label = "volumetric locking: tip deflection relative to Timoshenko's";
    let y = Axis { range: Some((0.0, 1.05)), ..Axis::linear("tip deflection / Timoshenko's") };
    let mut chart = Chart::new(label, Axis::log("edge of a cell, beam 1 m high (m)"), y);
    chart.guides.push(Guide::Horizontal(1.0, "Timoshenko".to_owned()));
    let linear = LINEAR.to_string();
    for (place, poisson) in RATIOS.into_iter().enumerate() {
        let beams = space.tip_deflections.iter().filter(|bent| bent.elements == linear && bent.poisson == poisson);
        let dot = |bent: &TipDeflection| {
            let title = format!("ν = {poisson}, {} cells\n{} of theory", bent.cells, number(Some(bent.ratio)));
            Dot::new(1.0 / bent.cells as f64, bent.ratio, title)
        };
        chart.series.push(Series::joined(format!("ν = {poisson}"), (place, place), beams.map(dot)));
    }
    chart.draw()
}
