//! The elastica: a slender cantilever under an end force of fixed direction, and under an end moment that bends it to a full circle.
//! R. Frisch-Fay, Flexible Bars (1962), chapters 1 and 2.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;
use std::time::Instant;

use fem_engine::forces::{AddBlock, Energy, HessianKind, Moment, Potential};
use fem_engine::simulator::Simulator;
use fem_model::{Axis, Body, Elastic, Integrator, Law, Material, Method, Selector};
use nalgebra::{Matrix2, Vector2};

use super::case::{CLOSED_FORM, Level, Mapped, Quantity, part, supported};
use crate::scenes::{displacement, steps};
use crate::study::{Part, Result};

/// Length of the beam in thicknesses, and its bending stiffness, N m², with E = 1 Pa, a thickness and a width of 1 m.
const LENGTH: f64 = 100.0;
const BENDING: f64 = 1.0 / 12.0;
/// α = P L²/(E I) of the end forces P, and the names of the drop and of the shortening over L.
const FORCES: [(f64, [&str; 2]); 4] = [
    (1.0, ["drop, α = 1", "shortening, α = 1"]),
    (2.0, ["drop, α = 2", "shortening, α = 2"]),
    (5.0, ["drop, α = 5", "shortening, α = 5"]),
    (10.0, ["drop, α = 10", "shortening, α = 10"]),
];

/// Drops and shortenings of the end under forces, and its rotation and shortening under the moment.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let quantity = |name, reference| Quantity { name, reference, tolerance: 5e-3, source: CLOSED_FORM };
    let mut of = Vec::new();
    for (alpha, names) in FORCES {
        of.extend(names.into_iter().zip(elastica(alpha)).map(|(name, reference)| quantity(name, reference)));
    }
    of.extend([quantity("circle: rotation over 2π", 1.0), quantity("circle: shortening", 1.0)]);
    let text = "A beam a hundred times as long as thick, St. Venant–Kirchhoff, ν = 0, one quadratic cell across. Under an end force P of fixed direction with α = P L²/(E I) \
                the drop and the shortening of its end, over its length, are elliptic integrals; an end moment of 2π E I/L bends it to a full circle.";
    part(("elastica", text), &of, (&[25, 50, 100], 2), quick, |cells| {
        let start = Instant::now();
        let (nodes, mut values) = forced(cells)?;
        values.extend(rolled(cells)?);
        Ok(Level { nodes, values, seconds: start.elapsed().as_secs_f64() })
    })
}

/// Drop and shortening over the length, by the slope θ of the end: k² = (1 + sin θ)/2, sin φ = 1/(k √2), K(k) − F(φ, k) = √α.
fn elastica(alpha: f64) -> [f64; 2] {
    let modulus = |slope: f64| {
        let k = (0.5 * (1.0 + slope.sin())).sqrt();
        (k, (1.0 / (k * 2f64.sqrt())).asin())
    };
    let first = |slope: f64| {
        let (k, phi) = modulus(slope);
        integral([phi, FRAC_PI_2], |t| 1.0 / (1.0 - (k * t.sin()).powi(2)).sqrt())
    };
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if first(middle) < alpha.sqrt() { low = middle } else { high = middle }
    }
    let (k, phi) = modulus(low);
    let second = integral([phi, FRAC_PI_2], |t| (1.0 - (k * t.sin()).powi(2)).sqrt());
    [1.0 - 2.0 * second / alpha.sqrt(), 1.0 - (2.0 * low.sin() / alpha).sqrt()]
}

/// Simpson's rule for a smooth function.
fn integral([from, to]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    const PARTS: usize = 2000;
    let h = (to - from) / PARTS as f64;
    let weight = |i: usize| if i == 0 || i == PARTS { 1.0 } else { (2 + 2 * (i % 2)) as f64 };
    (0..=PARTS).map(|i| weight(i) * f(from + h * i as f64)).sum::<f64>() * h / 3.0
}

fn beam(cells: usize) -> Result<(Body, Mapped)> {
    let mapped = Mapped::square([cells, 1], |s, t| [LENGTH * s, t])?;
    let material = Material::new(Law::StVenantKirchhoff(Elastic::new(1.0, 0.0)), 1.0);
    Ok((
        supported(mapped.mesh.clone(), material, &mapped.places, |place| [place.x == 0.0, place.x == 0.0, false])?,
        mapped,
    ))
}

/// Number of nodes, and drops and shortenings of the end as the force grows in twenty steps.
fn forced(cells: usize) -> Result<(usize, Vec<f64>)> {
    let (body, mapped) = beam(cells)?;
    let end = mapped.node_at([1.0, 0.5, 0.0]);
    let most = FORCES[3].0;
    let force = most * BENDING / LENGTH.powi(2);
    let method = Method { load_steps: 20, ..Method::new(Integrator::Static, 1.0) };
    let body = body.traction(&Selector::most(Axis::X), [0.0, -force, 0.0]);
    let mut simulation = body.and_then(|body| Simulator::<f64>::new(body, &method))?;
    let (mut values, mut done) = (Vec::new(), 0);
    for (alpha, _) in FORCES {
        let until = (alpha / most * 20.0).round() as usize;
        steps(&mut simulation, until - done)?;
        done = until;
        let u = displacement(&simulation, end);
        values.extend([-u.y / LENGTH, -u.x / LENGTH]);
    }
    Ok((mapped.places.len(), values))
}

/// Rotation of the end over 2π and its shortening over the length, under a moment of 2π E I/L.
fn rolled(cells: usize) -> Result<[f64; 2]> {
    let (body, mapped) = beam(cells)?;
    let [lower, middle, upper] = [0.0, 0.5, 1.0].map(|height| mapped.node_at([1.0, height, 0.0]));
    let method = Method { load_steps: 40, ..Method::new(Integrator::Static, 1.0) };
    let end = |nodes: [usize; 2]| EndMoment { nodes, moment: TAU * BENDING / LENGTH };
    let mut simulation = Simulator::<f64>::with_forces(body, &method, &|numbering| {
        vec![Box::new(end([lower, upper].map(|node| numbering.engine_node[node] as usize)))]
    })?;
    steps(&mut simulation, 40)?;
    let u = |node| displacement(&simulation, node);
    let across = u(upper) - u(lower);
    let rotation = end([lower, upper]).rotation(Vector2::new(across.x, 1.0 + across.y), 1.0);
    Ok([rotation / TAU, -u(middle).x / LENGTH])
}

/// A moment M on the end of the beam, which is the energy −M θ of its rotation θ: of two nodes one above the other, which alone carry
/// the linear stress of bending on the edge of a quadratic triangle. In the engine's numbering.
struct EndMoment {
    nodes: [usize; 2],
    /// N m
    moment: f64,
}

impl EndMoment {
    /// Rotation of the vector from the lower to the upper node, nearest to that of the closed form at a load factor.
    fn rotation(&self, across: Vector2<f64>, load_factor: f64) -> f64 {
        let expected = TAU * load_factor;
        let beside = (-across.x).atan2(across.y) - expected;
        expected + beside - TAU * ((beside + PI) / TAU).floor()
    }

    /// The vector from the lower to the upper node, m.
    fn across(&self, u: &[[f64; 3]]) -> Vector2<f64> {
        let [lower, upper] = self.nodes.map(|node| u[node]);
        Vector2::new(upper[0] - lower[0], 1.0 + upper[1] - lower[1])
    }
}

impl Potential<f64> for EndMoment {
    fn name(&self) -> &'static str {
        "end_moment"
    }

    fn description(&self) -> String {
        format!("a moment of {} N m", self.moment)
    }

    fn bytes(&self) -> usize {
        0
    }

    fn energy(&self, u: &[[f64; 3]], moment: Moment) -> Energy {
        let factor = moment.load_factor.unwrap_or(1.0);
        Energy::of(-factor * self.moment * self.rotation(self.across(u), factor))
    }

    /// ∂θ/∂a = (−a_y, a_x)/|a|²
    fn add_gradient(&self, u: &[[f64; 3]], moment: Moment, gradient: &mut [[f64; 3]]) {
        let across = self.across(u);
        let of_upper = -self.moment * moment.load_factor.unwrap_or(1.0) / across.norm_squared()
            * Vector2::new(-across.y, across.x);
        for (node, sign) in self.nodes.into_iter().zip([-1.0, 1.0]) {
            (0..2).for_each(|i| gradient[node][i] += sign * of_upper[i]);
        }
    }

    /// ∂²θ/∂a² = (2 a_x a_y, a_y² − a_x²; a_y² − a_x², −2 a_x a_y)/|a|⁴, with the eigenvalues ±1/|a|².
    fn hessian(&self, u: &[[f64; 3]], moment: Moment, kind: HessianKind, add: &mut AddBlock<f64>) {
        let across = self.across(u);
        let square = across.norm_squared();
        let [diagonal, beside] = [2.0 * across.x * across.y, across.y.powi(2) - across.x.powi(2)];
        let size = self.moment * moment.load_factor.unwrap_or(1.0) / square;
        let mut of_upper = -size / square * Matrix2::new(diagonal, beside, beside, -diagonal);
        if kind == HessianKind::Projected {
            of_upper = 0.5 * (of_upper + size * Matrix2::identity());
        }
        for (row, sign) in self.nodes.into_iter().zip([-1.0, 1.0]) {
            for (column, other) in self.nodes.into_iter().zip([-1.0, 1.0]) {
                let k = sign * other * of_upper;
                add(row, column, [[k[(0, 0)], k[(0, 1)], 0.0], [k[(1, 0)], k[(1, 1)], 0.0], [0.0; 3]]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_integrals_give_the_known_drops_and_shortenings() {
        let known =
            [(1.0, [0.30172, 0.05643]), (2.0, [0.49346, 0.16064]), (5.0, [0.71379, 0.38763]), (10.0, [0.81061, 0.555])];
        for (alpha, expected) in known {
            let found = super::elastica(alpha);
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 6e-6), "{alpha}: {found:?}");
        }
    }
}
