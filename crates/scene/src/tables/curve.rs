//! `curve`: a factor of time on a load or on a prescribed motion.

use fem_model::numbers::{check_finite, check_positive, problem};
use fem_model::{LoadCurve, Refusal};
use serde::Deserialize;

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
    pub(crate) fn check(&self, field: &str) -> Result<(), Refusal> {
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

    fn check_switch(&self, field: &str) -> Result<(), Refusal> {
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

fn check_points(field: &str, points: &[Vec<f64>]) -> Result<(), Refusal> {
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
