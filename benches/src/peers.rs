//! The engine beside its peers: the same mesh, material and loads, run in turn, and their answers compared.

mod eigen;
mod fenris;

use std::cell::RefCell;
use std::path::Path;

use fem_study::machine::{self, Machine};

use crate::cli::{PeersArguments, RunArguments};
use crate::end::End;
use crate::race::{Contestant, Time, race};
use crate::run::{self, Measurement};
use crate::table::{self, Row};
use eigen::Eigen;
use fenris::Fenris;

/// Largest difference of positions, relative to the size of the armadillo.
const ARMA_DIFFERENCE: f64 = 1e-8;

/// Largest difference of the tips of beams, m.
const BEAM_DIFFERENCE: f64 = 1e-8;

/// Times per step and differences of answers, as a table.
pub fn run(arguments: &PeersArguments) -> Result<(), End> {
    let mut rows = Vec::new();
    match &arguments.eigen {
        Some(program) => rows.extend(arma(arguments, program)?),
        None => println!("No rows of a3: --eigen is not given.\n"),
    }
    match &arguments.fenris {
        Some(program) => {
            for &cells in &arguments.cells {
                rows.push(beam(arguments, program, cells)?);
            }
        }
        None => println!("No rows of fenris: --fenris is not given.\n"),
    }
    let machine = Machine::this(Path::new("."));
    table::print(&machine, &rows);
    if let Some(path) = &arguments.json {
        table::write(path, &machine, &rows)?;
    }
    let wrong: Vec<String> = rows.iter().filter_map(Row::disagreement).collect();
    if wrong.is_empty() { Ok(()) } else { Err(End::wrong(wrong.join("\n"))) }
}

/// The armadillo against Eigen: its expert program on one thread and on all, and its naive one.
fn arma(arguments: &PeersArguments, program: &Path) -> Result<Vec<Row>, End> {
    let ours = ours("arma-engine", None, arguments);
    let scene = ours.scene().map_err(End::unusable)?;
    let steps = scene.time.steps.unwrap_or(100);
    let peer = Eigen::new(program, &scene, &arguments.data, steps)?;
    let converged = peer.converged()?;

    let all = machine::threads();
    let kept = RefCell::new(None);
    let peers = [("a3, expert", true, 1), ("a3, expert", true, all), ("a3, naive", false, 1)];
    let mut contestants = vec![timed(&ours, 1, &kept), timed(&ours, all, &kept)];
    for (_, is_expert, threads) in peers {
        let peer = &peer;
        contestants.push(Box::new(move || peer.time(is_expert, threads)));
    }
    let times = race(arguments.rounds, &contestants)?;
    drop(contestants);
    let run = kept.into_inner().ok_or_else(|| End::wrong("arma-engine was not run"))?;
    let difference = distance(&run.positions, &converged)?;
    let row = |((name, _, threads), time): (&(&str, bool, usize), &Time)| Row {
        scene: "arma-engine".to_owned(),
        nodes: run.nodes,
        steps,
        peer: (*name).to_owned(),
        peer_threads: *threads,
        theirs: *time,
        ours_one: times[0],
        ours_all: times[1],
        difference,
        allowed: ARMA_DIFFERENCE * size(&run.positions),
    };
    Ok(peers.iter().zip(&times[2..]).map(row).collect())
}

/// The beam against fenris.
fn beam(arguments: &PeersArguments, program: &Path, cells: usize) -> Result<Row, End> {
    let ours = ours("beam", Some(cells), arguments);
    let scene = ours.scene().map_err(End::unusable)?;
    let steps = scene.time.steps.unwrap_or(50);
    let peer = Fenris::new(program, &scene, cells, steps)?;
    let (kept, tip) = (RefCell::new(None), RefCell::new(None));
    let contestants: [Contestant; 3] = [
        timed(&ours, 1, &kept),
        timed(&ours, machine::threads(), &kept),
        Box::new(|| {
            let (time, place) = peer.time()?;
            tip.replace(Some(place));
            Ok(time)
        }),
    ];
    let times = race(arguments.rounds, &contestants)?;
    drop(contestants);
    let (Some(run), Some(tip)) = (kept.into_inner(), tip.into_inner()) else {
        return Err(End::wrong("the beam was not run"));
    };
    let of_tip = fenris::tip_nodes(cells).into_iter().flat_map(|node| 3 * node..3 * node + 3);
    let our_tip: Vec<f64> = of_tip.filter_map(|i| run.positions.get(i).copied()).collect();
    Ok(Row {
        scene: format!("beam, {cells} cells per metre"),
        nodes: run.nodes,
        steps,
        peer: "fenris".to_owned(),
        peer_threads: 1,
        theirs: times[2],
        ours_one: times[0],
        ours_all: times[1],
        difference: distance(&our_tip, &tip)?,
        allowed: BEAM_DIFFERENCE,
    })
}

fn ours(scene: &str, cells: Option<usize>, arguments: &PeersArguments) -> RunArguments {
    let PeersArguments { steps, data, .. } = arguments;
    let (scene, overrides) = (scene.to_owned(), Vec::new());
    RunArguments { scene, steps: *steps, cells, solver: None, overrides, data: data.clone() }
}

/// The engine as a contestant that stores its last run.
fn timed<'a>(ours: &'a RunArguments, threads: usize, kept: &'a RefCell<Option<Measurement>>) -> Contestant<'a> {
    Box::new(move || {
        let run = run::apart(ours, threads)?;
        let time = Time { wall: run.wall_per_step, cpu: run.cpu_per_step };
        kept.replace(Some(run));
        Ok(time)
    })
}

/// Largest difference of a coordinate, m.
fn distance(a: &[f64], b: &[f64]) -> Result<f64, End> {
    if a.len() != b.len() {
        return Err(End::wrong(format!("answers have {} and {} coordinates", a.len(), b.len())));
    }
    let apart = || a.iter().zip(b).map(|(a, b)| (a - b).abs());
    // `f64::max` would lose a NaN.
    Ok(if apart().any(f64::is_nan) { f64::NAN } else { apart().fold(0.0, f64::max) })
}

/// Longest edge of the bounding box of positions, m.
fn size(q: &[f64]) -> f64 {
    let edge = |axis: usize| {
        let along = || q.iter().skip(axis).step_by(3).copied();
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    };
    (0..3).map(edge).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_keep_nan() {
        assert_eq!(distance(&[1.0, 5.0, 2.0], &[1.0, 3.0, 2.5]).unwrap(), 2.0);
        assert!(distance(&[f64::NAN, 1.0], &[0.0, 3.0]).unwrap().is_nan());
        assert!(distance(&[1.0, f64::NAN], &[0.0, 3.0]).unwrap().is_nan());
        assert!(distance(&[1.0], &[]).is_err());
    }

    #[test]
    fn a_size_is_the_longest_edge_of_the_bounding_box() {
        assert_eq!(size(&[0.0, 1.0, 2.0, 1.0, 4.0, 1.0]), 3.0);
    }
}
