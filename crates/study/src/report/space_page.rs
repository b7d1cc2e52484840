//! The part of the page about convergence orders in time and errors in space.

use fem_chart::page::{figure, table};
use maud::{Markup, html};

use super::text::number;
use super::{Observed, Report, charts, orders_in_time, space_charts};
use crate::runs::convergence_order::ConvergenceOrder;
use crate::space::locking::{RATIOS, TipDeflection};
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
            (figure(&space_charts::locking(study), "Linear tetrahedra; the exact ratio is 1."))
            div { (table(&head, &meshes.iter().map(row).collect::<Vec<_>>())) }
        } "\n"
    }
}
