//! The structural cases of S. Turek and J. Hron, Proposal for Numerical Benchmarking of Fluid–Structure Interaction (2006): a beam of 0.35 × 0.02 m behind
//! a cylinder under its weight.

use std::path::Path;
use std::time::Instant;

use fem_engine::simulator::build;
use fem_model::{Body, Elastic, Integrator, Law, Material, Method};

use super::case::{Level, Mapped, Quantity, equilibrium, part, supported};
use crate::scenes::{displacement, step};
use crate::study::{Part, Result};

const SOURCE: &str = "FeatFlow";

/// μ = 0.5 MPa.
pub fn csm1(_: &Path, quick: bool) -> Result<Part> {
    case("csm1", 0.5e6, [-7.1877e-3, -66.1029e-3], quick)
}

/// μ = 2 MPa.
pub fn csm2(_: &Path, quick: bool) -> Result<Part> {
    case("csm2", 2e6, [-0.46901e-3, -16.9740e-3], quick)
}

fn case(name: &str, shear: f64, [along, down]: [f64; 2], quick: bool) -> Result<Part> {
    let of = |name, reference| Quantity { name, reference, tolerance: 1e-3, source: SOURCE };
    let text = format!(
        "St. Venant–Kirchhoff, plane strain, μ = {shear:e} Pa, ν = 0.4, ρ = 1000 kg/m³, 2 m/s² downwards; the displacement of the middle of the free end."
    );
    part((name, &text), &[of("u_x (m)", along), of("u_y (m)", down)], (&[2, 4, 8], 3), quick, |cells| {
        solve(cells, shear)
    })
}

/// CSM1 from rest, without damping.
pub fn csm3(_: &Path, quick: bool) -> Result<Part> {
    let of = |name, reference, tolerance| {
        let source = "from memory; FeatFlow 0.014280, −0.063541, 0.065094, 1.0995 with 6468 unknowns, 0.014389, −0.064271, 0.064595, 1.0956 with 320 elements";
        Quantity { name, reference, tolerance, source }
    };
    let of = [
        of("amplitude of u_x (m)", 14.305e-3, 1e-2),
        of("mean of u_y (m)", -63.607e-3, 1e-2),
        of("amplitude of u_y (m)", 65.160e-3, 1e-2),
        of("frequency (Hz)", 1.0995, 5e-3),
    ];
    let text = "CSM1 from rest, without damping: (max − min)/2 and (max + min)/2 of the last period before 10 s, and the mean frequency. Implicit midpoint rule, dt = 0.005 s. With 8 cells across, 5 457 nodes and a minute, it is \
                −0.014303 ± 0.014303, −0.063603 ± 0.065158 m and 1.0941 Hz.";
    part(("csm3", text), &of, (&[2, 4], 1), quick, vibrate)
}

/// The motion up to 10 s, as of the reference: a second mode changes the extremes of a period by 2 %.
fn vibrate(cells: usize) -> Result<Level> {
    const STEPS: usize = 2000;
    const DT: f64 = 0.005;
    let (body, mapped) = beam(cells, 0.5e6)?;
    let node = mapped.node_at([1.0, 0.5, 0.0]);
    let method = Method::new(Integrator::ImplicitMidpoint, DT);
    let mut simulation = build(body, &method)?;
    let start = Instant::now();
    let mut tip = vec![displacement(&*simulation, node)];
    for _ in 0..STEPS {
        step(&mut *simulation)?;
        tip.push(displacement(&*simulation, node));
    }
    let seconds = start.elapsed().as_secs_f64();
    let range = |from: usize, i: usize| {
        let all = tip[from..].iter().map(|u| u[i]);
        let [least, most] = [all.clone().fold(f64::INFINITY, f64::min), all.fold(f64::NEG_INFINITY, f64::max)];
        [0.5 * (most + least), 0.5 * (most - least)]
    };
    let last = tip.len() - (0.91 / DT) as usize - 1;
    let ([_, along], [mean, down]) = (range(last, 0), range(last, 1));
    // Times at which the tip rises through the mean.
    let rises = |k: &usize| tip[*k].y < mean && tip[*k + 1].y >= mean;
    let time = |k: usize| DT * (k as f64 + (mean - tip[k].y) / (tip[k + 1].y - tip[k].y));
    let times: Vec<f64> = (0..tip.len() - 1).filter(rises).map(time).collect();
    let frequency = (times.len() - 1) as f64 / (times[times.len() - 1] - times[0]);
    Ok(Level { nodes: mapped.places.len(), values: vec![along, mean, down, frequency], seconds })
}

fn solve(cells: usize, shear: f64) -> Result<Level> {
    let (body, mapped) = beam(cells, shear)?;
    let (nodes, node) = (mapped.places.len(), mapped.node_at([1.0, 0.5, 0.0]));
    let (simulation, seconds) = equilibrium(body, 4)?;
    let u = displacement(&*simulation, node);
    Ok(Level { nodes, values: vec![u.x, u.y], seconds })
}

/// The beam with so many cells across, under its weight.
fn beam(cells: usize, shear: f64) -> Result<(Body, Mapped)> {
    let mapped = Mapped::square([20 * cells, cells], |s, t| {
        let y = 0.19 + 0.02 * t;
        // The beam begins on the cylinder of radius 0.05 about (0.2, 0.2).
        let start = 0.2 + (0.05f64.powi(2) - (y - 0.2).powi(2)).sqrt();
        [start + s * (0.6 - start), y]
    })?;
    let material = Material::new(Law::StVenantKirchhoff(Elastic::new(2.8 * shear, 0.4)), 1000.0);
    let body =
        supported(mapped.mesh.clone(), material, &mapped.places, |place| [place.x == 0.0, place.x == 0.0, false])?;
    Ok((body.gravity([0.0, -2.0, 0.0])?, mapped))
}
