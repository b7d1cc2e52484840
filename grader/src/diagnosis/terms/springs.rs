//! Energy and force of a spring.

use nalgebra::Vector3;

use super::{Part, wrong};
use crate::diagnosis::fit::Formula;
use crate::reference::trial::{Input, Trial};

type Point = Vector3<f64>;
type Stretch = fn(&Point, &Point, f64) -> f64;
type Number = fn(f64) -> f64;
type Size = fn(f64, f64) -> f64;
type Force = fn(&Point, f64) -> [Point; 2];

const LENGTHS: &str =
    "The stretch is another one: how long is a spring between two points, and how much longer is that than at rest?";
const REST: &str = "The spring pulls as if its rest length were zero. Where does l0 enter?";
const BOTH_WAYS: &str = "A spring resists both a pull and a push.";
const POWER: &str = "The stretch enters with another power: a spring stores energy whether it is pulled or pushed.";
const STIFFNESS: &str = "The stiffness enters with another power: what are the units of the answer?";
const SIZE: &str =
    "The force has the right direction and the wrong size: differentiate the energy with respect to the length.";
const DIRECTION: &str =
    "The force has the wrong size or direction: by what is the vector between the ends to be divided?";

/// Stretches, from both ends and the rest length.
const STRETCHES: &[Part<Stretch>] = &[
    ("", "", |q0, q1, l0| (q1 - q0).norm() - l0),
    ("missing rest length", REST, |q0, q1, _| (q1 - q0).norm()),
    ("squares of the lengths", LENGTHS, |q0, q1, l0| (q1 - q0).norm_squared() - l0 * l0),
    ("square of the length", LENGTHS, |q0, q1, l0| (q1 - q0).norm_squared() - l0),
    ("rest length with the wrong sign", LENGTHS, |q0, q1, l0| (q1 - q0).norm() + l0),
    ("distances from the origin", LENGTHS, |q0, q1, l0| q1.norm() - q0.norm() - l0),
    ("sum of both ends", LENGTHS, |q0, q1, l0| (q1 + q0).norm() - l0),
    ("only tension", BOTH_WAYS, |q0, q1, l0| ((q1 - q0).norm() - l0).max(0.0)),
    ("only compression", BOTH_WAYS, |q0, q1, l0| ((q1 - q0).norm() - l0).min(0.0)),
    ("relative stretch", LENGTHS, |q0, q1, l0| (q1 - q0).norm() / l0 - 1.0),
    ("relative stretch", LENGTHS, |q0, q1, l0| if l0 > 0.0 { (q1 - q0).norm() / l0 - 1.0 } else { (q1 - q0).norm() }),
    ("sum of the coordinates", LENGTHS, |q0, q1, l0| (q1 - q0).abs().sum() - l0),
    ("sum of the coordinates", LENGTHS, |q0, q1, l0| (q1 - q0).sum() - l0),
    ("largest coordinate", LENGTHS, |q0, q1, l0| (q1 - q0).amax() - l0),
    ("only x", LENGTHS, |q0, q1, l0| (q1 - q0).x - l0),
    ("only x", LENGTHS, |q0, q1, l0| (q1 - q0).x.abs() - l0),
    ("root of the length", LENGTHS, |q0, q1, l0| (q1 - q0).norm().sqrt() - l0),
];

const POWERS: &[Part<Number>] = &[
    ("", "", |x| x * x),
    ("not squared", POWER, |x| x),
    ("absolute value", POWER, f64::abs),
    ("third power", POWER, |x| x * x * x),
    ("fourth power", POWER, |x| x * x * x * x),
];

const STIFFNESSES: &[Part<Number>] = &[
    ("", "", |k| k),
    ("missing stiffness", STIFFNESS, |_| 1.0),
    ("stiffness squared", STIFFNESS, |k| k * k),
    ("root of the stiffness", STIFFNESS, f64::sqrt),
];

/// The parts of a force along the vector between the ends: that of the length, and that of the rest length.
const DIRECTIONS: &[Part<Force>] = &[
    ("", "", |d, l0| [*d, unit(d) * l0]),
    ("direction not of unit length", DIRECTION, |d, l0| [d * d.norm(), d * l0]),
    ("direction divided by the rest length", DIRECTION, |d, l0| [d * (d.norm() / l0), *d]),
    ("direction divided by the rest length", DIRECTION, |d, l0| {
        if l0 > 0.0 { [d * (d.norm() / l0), *d] } else { [d * 0.0, d * 0.0] }
    }),
    ("direction divided by the square of the length", DIRECTION, |d, l0| [unit(d), unit(d) * (l0 / d.norm())]),
    ("rest length along the vector", DIRECTION, |d, l0| [*d, d * l0]),
    ("squares of the lengths", DIRECTION, |d, l0| [d * d.norm_squared(), d * (l0 * l0)]),
    ("squares of the lengths", DIRECTION, |d, l0| [unit(d) * d.norm_squared(), unit(d) * (l0 * l0)]),
    ("size without direction", DIRECTION, |d, l0| [Point::repeat(d.norm()), Point::repeat(l0)]),
    ("rest length in each coordinate", DIRECTION, |d, l0| [*d, Point::repeat(l0)]),
    ("only tension", BOTH_WAYS, |d, l0| if d.norm() < l0 { [d * 0.0, d * 0.0] } else { [*d, unit(d) * l0] }),
    ("only compression", BOTH_WAYS, |d, l0| if d.norm() > l0 { [d * 0.0, d * 0.0] } else { [*d, unit(d) * l0] }),
    ("not divided by the length", DIRECTION, |d, l0| [*d * l0, unit(d) * (l0 * l0)]),
];

fn unit(d: &Point) -> Point {
    if d.norm() > 0.0 { d / d.norm() } else { Point::zeros() }
}

fn ends(trial: &Trial) -> Option<(Point, Point, f64, f64)> {
    let &Input::Spring { q0, q1, l0, stiffness } = &trial.input else { return None };
    Some((q0, q1, l0, stiffness))
}

/// Energies with one or two wrong parts, and the square multiplied out.
pub fn energies<'a>() -> Vec<Formula<'a>> {
    let mut all = Vec::new();
    for &(stretch_name, about_stretch, stretch) in STRETCHES {
        for &(power_name, about_power, power) in POWERS {
            for &(stiffness_name, about_stiffness, factor) in STIFFNESSES {
                if !stretch_name.is_empty() && !power_name.is_empty() && !stiffness_name.is_empty() {
                    continue;
                }
                let names =
                    [(stretch_name, about_stretch), (power_name, about_power), (stiffness_name, about_stiffness)];
                all.push(Formula {
                    name: wrong(&names),
                    terms: &[("the square", 0.5)],
                    values: Box::new(move |trial| {
                        let (q0, q1, l0, k) = ends(trial)?;
                        Some(vec![vec![factor(k) * power(stretch(&q0, &q1, l0))]])
                    }),
                });
            }
        }
    }
    all.push(Formula {
        name: None,
        terms: &[
            ("the square of the length", 0.5),
            ("the product of length and rest length", -1.0),
            ("the square of the rest length", 0.5),
        ],
        values: Box::new(|trial| {
            let (q0, q1, l0, k) = ends(trial)?;
            let length = (q1 - q0).norm();
            Some(vec![vec![k * length * length], vec![k * length * l0], vec![k * l0 * l0]])
        }),
    });
    all
}

/// Sizes of a force, from the length and the rest length, where it is along the vector between the ends.
const SIZES: &[Part<Size>] = &[
    ("missing stretch", SIZE, |_, _| 1.0),
    ("not differentiated", SIZE, |l, l0| (l - l0).powi(2)),
    ("relative stretch", SIZE, |l, l0| (l - l0) / l0),
    ("relative stretch", SIZE, |l, l0| if l0 > 0.0 { (l - l0) / l0 } else { l }),
    ("relative stretch", SIZE, |l, l0| (l - l0) / l),
    ("product of length and rest length", SIZE, |l, l0| l * l0),
    ("absolute value", SIZE, |l, l0| (l - l0).abs()),
    ("third power", SIZE, |l, l0| (l - l0).powi(3)),
    ("rest length alone", SIZE, |_, l0| l0),
];

fn of_size<'a>(&(name, sentence, size): &Part<Size>) -> Formula<'a> {
    Formula {
        name: wrong(&[(name, sentence)]),
        terms: &[("the force on the first end", -1.0), ("the force on the second end", 1.0)],
        values: Box::new(move |trial: &Trial| {
            let (q0, q1, l0, k) = ends(trial)?;
            let d = q1 - q0;
            let f = if d.norm() > 0.0 { unit(&d) * (k * size(d.norm(), l0)) } else { Point::zeros() };
            Some(vec![vec![f.x, f.y, f.z, 0.0, 0.0, 0.0], vec![0.0, 0.0, 0.0, f.x, f.y, f.z]])
        }),
    }
}

/// Forces, with the two ends apart.
pub fn forces<'a>() -> Vec<Formula<'a>> {
    let formula = |&(name, sentence, part): &Part<Force>| Formula {
        name: wrong(&[(name, sentence)]),
        terms: &[
            ("the length on the first end", -1.0),
            ("the rest length on the first end", 1.0),
            ("the length on the second end", 1.0),
            ("the rest length on the second end", -1.0),
        ],
        values: Box::new(move |trial: &Trial| {
            let (q0, q1, l0, k) = ends(trial)?;
            let [length, rest] = part(&(q1 - q0), l0).map(|v| v * k);
            let first = |v: &Point| vec![v.x, v.y, v.z, 0.0, 0.0, 0.0];
            let second = |v: &Point| vec![0.0, 0.0, 0.0, v.x, v.y, v.z];
            Some(vec![first(&length), first(&rest), second(&length), second(&rest)])
        }),
    };
    DIRECTIONS.iter().map(formula).chain(SIZES.iter().map(of_size)).collect()
}
