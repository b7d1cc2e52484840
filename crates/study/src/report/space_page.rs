//! The part of the page about convergence orders in time and errors in space.

use fem_chart::page::{figure, table};
use maud::{Markup, html};

use super::text::number;
use super::{Observed, Report, charts, orders_in_time, space_charts};
use crate::runs::convergence_order::ConvergenceOrder;
use crate::space::locking::RATIOS;
use crate::space::manufactured;
use crate::studies::space::{SpaceOrders, SpaceStudy};
use crate::study::{Column, Table};

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
            (figure(&space_charts::in_space(study), "Relative errors, by quadrature of degree 7."))
            (figure(&space_charts::time_in_plane(study), "Linear and quadratic triangles: error in H1 over the wall-clock time of the solution."))
            div { (Table::of("space", &study.orders, &columns).html()) }
        } "\n"
        (locking(study))
    }
}

fn locking(study: &SpaceStudy) -> Markup {
    let mut meshes: Vec<usize> = study.tip_deflections.iter().map(|tip| tip.cells).collect();
    meshes.dedup();
    let names: Vec<String> = meshes.iter().map(|cells| format!(">h = 1/{cells} m")).collect();
    let head: Vec<&str> = std::iter::once("ν").chain(names.iter().map(String::as_str)).collect();
    let ratio = |poisson: f64, cells: usize| {
        study.tip_deflections.iter().find(|tip| tip.poisson == poisson && tip.cells == cells).map(|tip| tip.ratio)
    };
    let row = |poisson: f64| {
        let cells = meshes.iter().map(|&cells| number(ratio(poisson, cells)));
        std::iter::once(poisson.to_string()).chain(cells).collect::<Vec<String>>()
    };
    html! {
        h3 id="locking" { "Volumetric locking" }
        p {
            "Linear tetrahedra lock when the material is nearly incompressible: they bend too little. The table gives the tip deflection of a cantilever of \
             8 × 1 × 1 m relative to Timoshenko's beam theory. No mesh of this table is fine enough for ν near ½."
        }
        div class="charts" {
            (figure(&space_charts::locking(study), "The exact ratio is 1."))
            div { (table(&head, &RATIOS.map(row))) }
        } "\n"
    }
}
