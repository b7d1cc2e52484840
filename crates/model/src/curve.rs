//! Factors of time on loads and prescribed motions.

use std::f64::consts::TAU;

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
            Self::Integral(_) => unreachable!("a curve is integrated once"),
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
