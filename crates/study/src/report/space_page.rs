//! What the page tells of orders and of space.

use super::{Report, charts, orders_in_time};
use crate::report::text::number;
use crate::space::locking::RATIOS;
use fem_chart::escape;
use fem_chart::page::{figure, table};

/// Orders in time on the small body.
pub fn orders(report: &Report) -> String {
    let study = &report.orders;
    let row = |observed: super::Observed| {
        let order = observed.order;
        let is_met = order.is_some_and(|order| (order.value - observed.expected).abs() <= 0.1);
        vec![
            observed.method,
            order.map_or("–".to_owned(), |order| order.text()),
            observed.expected.to_string(),
            if is_met { "within 0.1" } else { "not within 0.1" }.to_owned(),
        ]
    };
    let rows: Vec<_> = orders_in_time(study).into_iter().map(row).collect();
    format!(
        "<h2 id=\"orders\">Orders in time</h2>\n<p class=\"soft\">{}: {} nodes.</p>\n<div class=\"charts\">\n{}<div>{}</div></div>\n",
        escape(&study.about),
        study.size.0,
        figure(&charts::convergence(study), "Errors at the end against the reference in time."),
        table(&["method", ">order (95 %)", ">theory", ""], &rows)
    )
}

/// The manufactured solution, and locking.
pub fn space(report: &Report) -> String {
    let space = &report.space;
    let rows: Vec<_> = space
        .orders
        .iter()
        .map(|(scene, l2, h1)| {
            let text = |order: &Option<crate::runs::convergence_order::ConvergenceOrder>| {
                order.map_or("–".to_owned(), |order| order.text())
            };
            vec![scene.clone(), text(l2), text(h1)]
        })
        .collect();
    let intro = "<h2 id=\"space\">Errors in space</h2>\n<p>Equilibrium of a cube under the body force that makes u<sub>i</sub> = a<sub>i</sub> sin πx \
        sin πy sin πz its solution. Theory: order 2 in L2, 1 in H1; observed between the two finest meshes.</p>\n";
    let caption = "Relative errors, integrated over the cube with a rule of degree 7.";
    format!(
        "{intro}<div class=\"charts\">\n{}<div>{}</div></div>\n{}",
        figure(&charts::in_space(space), caption),
        table(&["scene", ">order in L2", ">order in H1"], &rows),
        locking(report)
    )
}

fn locking(report: &Report) -> String {
    let space = &report.space;
    let mut meshes: Vec<usize> = space.tip_deflections.iter().map(|bent| bent.cells).collect();
    meshes.dedup();
    let names: Vec<String> = meshes.iter().map(|cells| format!(">h = 1/{cells} m")).collect();
    let head: Vec<&str> = std::iter::once("ν").chain(names.iter().map(String::as_str)).collect();
    let found = |poisson: f64, cells: usize| {
        space.tip_deflections.iter().find(|bent| bent.poisson == poisson && bent.cells == cells)
    };
    let row = |poisson: f64| {
        let cells = meshes.iter().map(|&cells| number(found(poisson, cells).map(|bent| bent.ratio)));
        std::iter::once(poisson.to_string()).chain(cells).collect::<Vec<String>>()
    };
    let rows: Vec<_> = RATIOS.into_iter().map(row).collect();
    let text = "<h3 id=\"locking\">Locking</h3>\n<p>Linear tetrahedra that can hardly change their volume can hardly bend either. The tip of a \
        cantilever of 8 × 1 × 1 m moves by this part of what Timoshenko's beam says; no mesh shown here makes up for ν near ½.</p>\n";
    let caption = "1 would be right.";
    format!(
        "{text}<div class=\"charts\">\n{}<div>{}</div></div>\n",
        figure(&charts::locking(space), caption),
        table(&head, &rows)
    )
}
