//! Numbers and times for readers.

/// Three significant digits: `0.0123`, `12.3`, `1.2·10⁻⁵`; a dash for `None`.
pub fn number(value: Option<f64>) -> String {
    let Some(value) = value.filter(|value| value.is_finite()) else { return "–".to_owned() };
    let size = value.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if !(1e-3..1e5).contains(&size) {
        return format!("{value:.1e}").replace('-', "−");
    }
    let digits = (2.0 - size.log10().floor()).clamp(0.0, 5.0) as usize;
    format!("{value:.digits$}").replace('-', "−")
}

/// A time with its unit, from seconds.
pub fn seconds(value: Option<f64>) -> String {
    match value {
        Some(value) if value < 1e-3 => format!("{} µs", number(Some(1e6 * value))),
        Some(value) if value < 1.0 => format!("{} ms", number(Some(1e3 * value))),
        Some(value) => format!("{} s", number(Some(value))),
        None => "–".to_owned(),
    }
}

/// [`number`] without zeros at its end.
pub fn trimmed(value: f64) -> String {
    let text = number(Some(value));
    if text.contains('.') && !text.contains('e') {
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    text
}

/// A time step: `20 ms`.
pub fn step(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 1e-3 => format!("{} µs", trimmed(1e6 * seconds)),
        seconds if seconds < 1.0 => format!("{} ms", trimmed(1e3 * seconds)),
        seconds => format!("{} s", trimmed(seconds)),
    }
}

/// A part as a percentage: `0.1 %`.
pub fn percent(value: f64) -> String {
    format!("{} %", trimmed(100.0 * value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        assert_eq!(number(Some(0.012345)), "0.0123");
        assert_eq!(number(Some(123.4)), "123");
        assert_eq!(number(Some(-1.25e-7)), "−1.2e−7");
        assert_eq!(number(Some(f64::NAN)), "–");
        assert_eq!(number(None), "–");
    }

    #[test]
    fn times_have_units() {
        assert_eq!(seconds(Some(0.0123)), "12.3 ms");
        assert_eq!(seconds(Some(4.5e-5)), "45.0 µs");
        assert_eq!(seconds(Some(2.0)), "2.00 s");
        assert_eq!([step(0.02), step(1.25e-4), step(1.0)], ["20 ms", "125 µs", "1 s"]);
    }

    #[test]
    fn percentages_are_short() {
        assert_eq!(percent(0.01), "1 %");
        assert_eq!(percent(0.001), "0.1 %");
        assert_eq!(percent(1e-4), "0.01 %");
        assert_eq!(percent(1.0), "100 %");
    }
}
