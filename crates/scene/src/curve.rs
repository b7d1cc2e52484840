//! `curve`: a factor of time on a load or on a prescribed motion.

use std::f64::consts::TAU;

use serde::Deserialize;

use crate::check::numbers::{Problem, check_finite, check_positive, problem};

/// `curve`: a factor of time on a load or on a prescribed motion, of one of four kinds: `ramp`, `table`, `sine`, or `on` and `off`, either of
/// which may be left out. Engine only. With `static` the load steps count the time, and what has a curve follows it instead of growing with
/// the load steps.
///
/// Implicit methods evaluate the factor at the end of a step (`implicit_midpoint` and `generalized_alpha` within it), explicit methods at
/// the time of each stage.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct CurveTable {
    /// Time in which the factor grows linearly from 0 to 1, s; positive. The factor is 1 afterwards.
    pub ramp: Option<f64>,
    /// Pairs of time (s) and factor, such as `[[0, 0], [2, 1]]`, whose times increase. The factor is linear between them, and constant
    /// before the first and after the last.
    pub table: Option<Vec<Vec<f64>>>,
    /// A harmonic oscillation.
    pub sine: Option<SineTable>,
    /// Time from which the factor is 1, s; before it the factor is 0. Default: the start, if `off` is given.
    pub on: Option<f64>,
    /// Time from which the factor is 0 again, s; later than `on`. Default: never, if `on` is given.
    pub off: Option<f64>,
}

/// `sine`: the factor sin(2π · frequency · t + phase).
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SineTable {
    /// Frequency, Hz; positive.
    pub frequency: f64,
    /// Phase, rad.
    #[serde(default)]
    pub phase: f64,
}

/// A factor of time on a load or on a prescribed motion.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadCurve {
    /// Linear from 0 at the start to 1 after this duration (s), and 1 from then on.
    Ramp(f64),
    /// Linear between pairs of time (s) and factor, whose times increase; constant before the first and after the last.
    Table(Vec<[f64; 2]>),
    /// sin(2π · frequency · t + phase)
    Sine {
        /// Hz
        frequency: f64,
        /// Radians.
        phase: f64,
    },
    /// 1 for on ≤ t < off, else 0.
    Switch {
        /// s
        on: f64,
        /// s
        off: f64,
    },
    /// The integral from 0 of another curve, of 1 without one, s: the part of a velocity that has become a displacement.
    Integral(Option<Box<LoadCurve>>),
}

impl LoadCurve {
    /// The factor at a time, s.
    pub fn factor(&self, time: f64) -> f64 {
        match self {
            Self::Ramp(duration) => (time / duration).clamp(0.0, 1.0),
            Self::Table(points) => interpolated(points, time),
            Self::Sine { frequency, phase } => (TAU * frequency * time + phase).sin(),
            Self::Switch { on, off } => f64::from(u8::from(!is_before(time, *on) && is_before(time, *off))),
            Self::Integral(curve) => curve.as_ref().map_or(time, |curve| curve.integral(time)),
        }
    }

    /// Integral of the factor from 0 to a time, s, exactly.
    fn integral(&self, time: f64) -> f64 {
        match self {
            Self::Ramp(duration) => {
                let grown = time.clamp(0.0, *duration);
                0.5 * grown * grown / duration + f64::max(time - duration, 0.0)
            }
            Self::Table(points) => integrated(points, time) - integrated(points, 0.0),
            Self::Sine { frequency, phase } => {
                let rate = TAU * frequency;
                (phase.cos() - (rate * time + phase).cos()) / rate
            }
            Self::Switch { on, off } => f64::max(time.min(*off) - on.max(0.0), 0.0),
            // Accelerations have no key.
            Self::Integral(_) => unreachable!("a scene integrates a curve once"),
        }
    }

    /// First and second derivative of the factor (1/s, 1/s²) at a time, s. They are those of the time right after it at a kink, and
    /// zero where the factor jumps.
    pub fn derivatives(&self, time: f64) -> [f64; 2] {
        match self {
            Self::Ramp(duration) if (0.0..*duration).contains(&time) => [1.0 / duration, 0.0],
            Self::Ramp(_) | Self::Switch { .. } => [0.0; 2],
            Self::Table(points) => {
                let next = points.partition_point(|[t, _]| *t <= time);
                if next == 0 || next == points.len() {
                    return [0.0; 2];
                }
                let ([t0, f0], [t1, f1]) = (points[next - 1], points[next]);
                [(f1 - f0) / (t1 - t0), 0.0]
            }
            Self::Sine { frequency, phase } => {
                let rate = TAU * frequency;
                let (sine, cosine) = (rate * time + phase).sin_cos();
                [rate * cosine, -rate * rate * sine]
            }
            Self::Integral(None) => [1.0, 0.0],
            Self::Integral(Some(curve)) => [curve.factor(time), curve.derivatives(time)[0]],
        }
    }

    /// The largest rate of the factor at any time, 1/s; that of a switch, whose factor jumps, is zero.
    pub fn largest_rate(&self) -> f64 {
        match self {
            Self::Ramp(duration) => 1.0 / duration,
            Self::Table(points) => {
                let rate = |pair: &[[f64; 2]]| ((pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])).abs();
                points.windows(2).map(rate).fold(0.0, f64::max)
            }
            Self::Sine { frequency, .. } => TAU * frequency,
            Self::Switch { .. } => 0.0,
            Self::Integral(curve) => match curve.as_deref() {
                Some(Self::Table(points)) => points.iter().map(|[_, factor]| factor.abs()).fold(0.0, f64::max),
                _ => 1.0,
            },
        }
    }

    /// The factor and its first and second derivative (1/s, 1/s²) within a time step, at a part of it (0 at `begin`, 1 at `end`, s). A
    /// curve that is piecewise linear counts as linear during the step, so that a kink inside it changes the rate and never the ends.
    pub fn in_step(&self, [begin, end]: [f64; 2], part: f64) -> [f64; 3] {
        let time = begin + part * (end - begin);
        let is_smooth = match self {
            Self::Sine { .. } => true,
            Self::Integral(Some(curve)) => !curve.has_jumps(),
            Self::Ramp(_) | Self::Table(_) | Self::Switch { .. } | Self::Integral(None) => false,
        };
        if is_smooth {
            let [rate, change] = self.derivatives(time);
            return [self.factor(time), rate, change];
        }
        let (first, last) = (self.factor(begin), self.factor(end));
        let factor = if part == 1.0 { last } else { first + part * (last - first) };
        [factor, (last - first) / (end - begin), 0.0]
    }

    /// Times at which the factor has a kink or a jump, s.
    pub fn kinks(&self) -> Vec<f64> {
        match self {
            Self::Ramp(duration) => vec![*duration],
            Self::Table(points) => points.iter().map(|[time, _]| *time).collect(),
            Self::Sine { .. } => Vec::new(),
            Self::Switch { on, off } => vec![*on, *off],
            Self::Integral(curve) => curve.as_ref().map_or(Vec::new(), |curve| curve.kinks()),
        }
    }

    /// Returns true if the factor jumps.
    pub fn has_jumps(&self) -> bool {
        matches!(self, Self::Switch { .. })
    }
}

/// Returns true if a time precedes an instant, s. A time is a sum of steps, and counts as the instant when round-off alone separates
/// them, so that a load or a constraint that ends with a step ends with that step.
pub fn is_before(time: f64, instant: f64) -> bool {
    time < instant * (1.0 - 1e-9)
}

/// The factor on the line between two points.
fn interpolated(points: &[[f64; 2]], time: f64) -> f64 {
    let next = points.partition_point(|[t, _]| *t <= time);
    match (next.checked_sub(1).map(|last| points[last]), points.get(next).copied()) {
        (Some([t0, f0]), Some([t1, f1])) => f0 + (f1 - f0) * ((time - t0) / (t1 - t0)),
        (Some([_, factor]), None) | (None, Some([_, factor])) => factor,
        (None, None) => 1.0,
    }
}

/// Integral of the interpolated factor from the first point to a time, s.
fn integrated(points: &[[f64; 2]], time: f64) -> f64 {
    let Some([first, factor]) = points.first().copied() else { return time };
    if time <= first {
        return (time - first) * factor;
    }
    let area = |[[t0, f0], [t1, f1]]: [[f64; 2]; 2]| 0.5 * (f0 + f1) * (t1 - t0);
    let passed = points.partition_point(|[t, _]| *t <= time);
    let whole: f64 = points[..passed].windows(2).map(|pair| area([pair[0], pair[1]])).sum();
    whole + area([points[passed - 1], [time, interpolated(points, time)]])
}

impl CurveTable {
    /// The curve of a checked table.
    pub(crate) fn curve(&self) -> LoadCurve {
        match self {
            Self { ramp: Some(duration), .. } => LoadCurve::Ramp(*duration),
            Self { table: Some(points), .. } => {
                LoadCurve::Table(points.iter().map(|point| [point[0], point[1]]).collect())
            }
            Self { sine: Some(SineTable { frequency, phase }), .. } => {
                LoadCurve::Sine { frequency: *frequency, phase: *phase }
            }
            Self { on, off, .. } => {
                LoadCurve::Switch { on: on.unwrap_or(f64::NEG_INFINITY), off: off.unwrap_or(f64::INFINITY) }
            }
        }
    }

    /// Checks the table that stands at `field`, such as `gravity.curve`.
    pub(crate) fn check(&self, field: &str) -> Result<(), Problem> {
        let switch = self.on.is_some() || self.off.is_some();
        let kinds = [self.ramp.is_some(), self.table.is_some(), self.sine.is_some(), switch];
        if kinds.into_iter().filter(|is_given| *is_given).count() != 1 {
            return problem(field, "needs one kind of curve; give either ramp, table, sine, or on and off");
        }
        self.ramp.map_or(Ok(()), |ramp| check_positive(&format!("{field}.ramp"), ramp, " of seconds"))?;
        self.table.as_ref().map_or(Ok(()), |points| check_points(&format!("{field}.table"), points))?;
        if let Some(sine) = &self.sine {
            check_positive(&format!("{field}.sine.frequency"), sine.frequency, " of Hz")?;
            check_finite(&format!("{field}.sine.phase"), &[sine.phase])?;
        }
        self.check_switch(field)
    }

    fn check_switch(&self, field: &str) -> Result<(), Problem> {
        for (key, time) in [("on", self.on), ("off", self.off)] {
            time.map_or(Ok(()), |time| check_finite(&format!("{field}.{key}"), &[time]))?;
        }
        match (self.on, self.off) {
            (Some(on), Some(off)) if off <= on => {
                problem(&format!("{field}.off"), format!("is {off}, not after on = {on}; give a later time"))
            }
            _ => Ok(()),
        }
    }
}

fn check_points(field: &str, points: &[Vec<f64>]) -> Result<(), Problem> {
    if points.is_empty() {
        return problem(field, "is empty; give pairs of time and factor such as [[0, 0], [2, 1]]");
    }
    for (number, point) in points.iter().enumerate() {
        let field = format!("{field}[{number}]");
        if point.len() != 2 {
            let text = format!("has {} numbers; give a pair, the time in seconds and the factor", point.len());
            return problem(&field, text);
        }
        check_finite(&field, point)?;
        if let Some(before) = number.checked_sub(1).map(|before| points[before][0])
            && point[0] <= before
        {
            return problem(&field, format!("is at {} s, not after {before} s; give times that increase", point[0]));
        }
    }
    Ok(())
}
