//! Axes: pixels of values, and the values that are written beside them.

/// The scale of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Linear.
    Linear,
    /// Logarithmic; shows positive values only.
    Log,
}

/// An axis with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Quantity and unit.
    pub name: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Smallest and largest value; `None` takes those of the data.
    pub range: Option<(f64, f64)>,
}

impl Axis {
    /// A logarithmic axis over the data.
    pub fn log(name: impl Into<String>) -> Self {
        Self { name: name.into(), scale: Scale::Log, range: None }
    }

    /// A linear axis over the data.
    pub fn linear(name: impl Into<String>) -> Self {
        Self { name: name.into(), scale: Scale::Linear, range: None }
    }

    /// Returns true if the axis can show a value.
    pub fn shows(&self, value: f64) -> bool {
        value.is_finite() && (self.scale == Scale::Linear || value > 0.0)
    }

    /// Places the axis between two pixels, with a margin around these values.
    pub(crate) fn between(&self, from: f64, to: f64, values: impl Iterator<Item = f64>) -> Placed {
        let values = values.filter(|&value| self.shows(value)).map(|value| self.measure(value));
        let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let given = self.range.map(|(a, b)| (self.measure(a), self.measure(b))).filter(|(a, b)| b > a);
        let (low, high) = given.unwrap_or_else(|| {
            if least > most {
                return (0.0, 1.0);
            }
            let room = if most > least { 0.06 * (most - least) } else { 0.5 };
            (least - room, most + room)
        });
        Placed { scale: self.scale, low, high, from, to }
    }

    fn measure(&self, value: f64) -> f64 {
        if self.scale == Scale::Log { value.log10() } else { value }
    }
}

/// An axis with its pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    scale: Scale,
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Placed {
    /// Pixel of a value.
    pub fn at(&self, value: f64) -> f64 {
        let x = if self.scale == Scale::Log { value.log10() } else { value };
        self.from + (self.to - self.from) * (x - self.low) / (self.high - self.low)
    }

    /// Smallest and largest value.
    pub fn ends(&self) -> (f64, f64) {
        let of = |x: f64| if self.scale == Scale::Log { 10f64.powf(x) } else { x };
        (of(self.low), of(self.high))
    }

    /// Values to write beside the axis, with their text.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        match self.scale {
            Scale::Log => self.log_ticks(),
            Scale::Linear => self.linear_ticks(),
        }
    }

    fn log_ticks(&self) -> Vec<(f64, String)> {
        let span = self.high - self.low;
        let steps: &[f64] = if span < 1.2 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let every = (span / 7.0).ceil().max(1.0) as i32;
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        let decades = decades.filter(|decade| decade.rem_euclid(every) == 0);
        let values = decades.flat_map(|decade| steps.iter().map(move |step| step * 10f64.powi(decade)));
        let inside = |value: &f64| (self.low - 1e-9..=self.high + 1e-9).contains(&value.log10());
        values.filter(inside).map(|value| (value, power(value))).collect()
    }

    fn linear_ticks(&self) -> Vec<(f64, String)> {
        let rough = (self.high - self.low) / 5.0;
        let decade = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|step| step * decade).into_iter().find(|&step| step >= rough);
        let step = step.unwrap_or(10.0 * decade);
        let (first, last) = ((self.low / step - 1e-9).ceil() as i64, (self.high / step + 1e-9).floor() as i64);
        (first..=last).map(|i| (i as f64 * step, plain(i as f64 * step, step))).collect()
    }
}

/// A number of a linear axis, with as many digits as the step of its ticks needs.
fn plain(value: f64, step: f64) -> String {
    let size = value.abs().max(step);
    if !(1e-3..1e5).contains(&size) {
        return if value == 0.0 { "0".to_owned() } else { power(value) };
    }
    let digits = (-step.log10().floor()).max(0.0) as usize;
    format!("{value:.digits$}").replace('-', "−")
}

/// A number of a logarithmic axis: `0.02`, `10⁻⁵`, `2·10⁻⁵`.
fn power(value: f64) -> String {
    let decade = value.abs().log10().floor();
    let factor = value / 10f64.powf(decade);
    if (-2.0..3.0).contains(&decade) {
        return format!("{}", (value * 1e6).round() / 1e6).replace('-', "−");
    }
    let exponent: String = format!("{decade}").chars().map(superscript).collect();
    let is_one = (factor - 1.0).abs() < 1e-9;
    if is_one { format!("10{exponent}") } else { format!("{}·10{exponent}", (factor * 100.0).round() / 100.0) }
}

fn superscript(character: char) -> char {
    match character {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|digit| char::from_u32(0x2070 + digit)).unwrap_or(digit),
    }
}
