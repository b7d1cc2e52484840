//! Numbers for readers: three digits, and round ends of scales.

/// Formats a number with three digits; k is a thousand, M a million.
pub fn short(value: f64) -> String {
    let size = value.abs();
    match size {
        _ if size == 0.0 => "0".into(),
        _ if !(1e-3..1e9).contains(&size) => format!("{value:.1e}"),
        _ if size >= 999.5e3 => format!("{}M", digits(value / 1e6)),
        _ if size >= 9995.0 => format!("{}k", digits(value / 1e3)),
        _ => digits(value),
    }
}

/// A number with its unit: 12.3 kN.
pub fn quantity(value: f64, unit: &str) -> String {
    let number = short(value);
    match number.strip_suffix(['k', 'M']) {
        Some(digits) => format!("{digits} {}{unit}", &number[digits.len()..]),
        None => format!("{number} {unit}"),
    }
}

/// Formats with three significant digits, without trailing zeros.
fn digits(value: f64) -> String {
    let decimals = (2 - value.abs().log10().floor() as i32).clamp(0, 6) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Parses a number in that format.
pub fn parse(text: &str) -> Option<f64> {
    let text = text.trim();
    let scaled = |letter: char, factor: f64| text.strip_suffix(letter)?.trim().parse::<f64>().ok().map(|v| v * factor);
    text.parse().ok().or_else(|| scaled('k', 1e3)).or_else(|| scaled('M', 1e6))
}

/// The smallest of some numbers from 1 to 9 or 10, times a power of ten, that is not below `least`, which is positive.
pub fn round_up(least: f64, steps: &[f64]) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    let steps = steps.iter().map(|step| step * power);
    steps.into_iter().find(|step| *step >= least * (1.0 - 1e-12)).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_and_a_suffix() {
        let cases =
            [(0.0, "0"), (0.25, "0.25"), (-1234.0, "-1234"), (12_345.0, "12.3k"), (2.5e6, "2.5M"), (1e-5, "1.0e-5")];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
        assert_eq!(quantity(-71_900.0, "Pa"), "-71.9 kPa");
        assert_eq!(quantity(0.25, "N"), "0.25 N");
    }

    #[test]
    fn shown_numbers_parse_back_to_themselves() {
        for value in [0.25, 12_300.0, 2.5e6, 1e-5, 3e10] {
            assert_eq!(parse(&short(value)), Some(value));
        }
        assert_eq!(parse("soft"), None);
    }
}
