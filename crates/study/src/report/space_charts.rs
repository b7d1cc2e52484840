//! The charts of errors in space.

use crate::report::text::{number, seconds};
use crate::runs::row::Row;
use crate::scenes::LINEAR;
use crate::studies::space::{self, SpaceOrders, SpaceStudy};
use fem_chart::{Axis, Chart, Dot, Guide, Picture, Series};

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
                Some(Dot::new(space::spacing(row), error?, title))
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
pub fn locking(space: &SpaceStudy) -> Picture {
    let label = "volumetric locking: tip deflection relative to Timoshenko's";
    let y = Axis { range: Some((0.0, 1.05)), ..Axis::linear("tip deflection / Timoshenko's") };
    let mut chart = Chart::new(label, Axis::log("edge of a cell, beam 1 m high (m)"), y);
    chart.guides.push(Guide::Horizontal(1.0, "Timoshenko".to_owned()));
    let linear = LINEAR.to_string();
    for (place, poisson) in crate::space::locking::RATIOS.into_iter().enumerate() {
        let beams = space.tip_deflections.iter().filter(|bent| bent.elements == linear && bent.poisson == poisson);
        let dot = |bent: &crate::space::locking::TipDeflection| {
            let title = format!("ν = {poisson}, {} cells\n{} of theory", bent.cells, number(Some(bent.ratio)));
            Dot::new(1.0 / bent.cells as f64, bent.ratio, title)
        };
        chart.series.push(Series::joined(format!("ν = {poisson}"), (place, place), beams.map(dot)));
    }
    chart.draw()
}
