//! Bars of shares, one below the other.

use super::{COLOURS, Picture, line, rectangle, text};

/// A bar: lengths that follow each other from left to right.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Beside it.
    pub name: String,
    /// The lengths, in the order of the names of their kinds.
    pub shares: Vec<f64>,
    /// Behind its end.
    pub figure: String,
}

/// Pixels of a row.
const ROW: f64 = 26.0;

/// Bars of these kinds of shares. The longest bar fills the width.
pub fn bars(label: impl Into<String>, kinds: &[&str], bars: &[Bar]) -> Picture {
    let (left, length) = (170.0, 270.0);
    let size = |bar: &Bar| bar.shares.iter().filter(|share| share.is_finite()).sum::<f64>();
    let longest = bars.iter().map(size).fold(0.0, f64::max);
    let mut inner = line("axis", (left, 0.0), (left, ROW * bars.len() as f64));
    for (i, bar) in bars.iter().enumerate() {
        let y = ROW * i as f64;
        inner.push_str(&text("", "end", (left - 8.0, y + 17.0), &bar.name));
        let mut x = left;
        for (kind, &share) in bar.shares.iter().enumerate().filter(|(_, share)| share.is_finite() && **share > 0.0) {
            let width = length * share / longest;
            let name = kinds.get(kind).copied().unwrap_or_default();
            let title = format!("{}: {name} {:.0} %", bar.name, 100.0 * share / size(bar));
            inner.push_str(&rectangle(&format!("share k{}", kind % COLOURS), (x, y + 5.0), (width, ROW - 9.0), &title));
            x += width;
        }
        inner.push_str(&text("", "start", (x + 6.0, y + 17.0), &bar.figure));
    }
    let mark = |kind: usize| format!("<rect class=\"share k{kind}\" x=\"-6\" y=\"-5\" width=\"12\" height=\"10\"/>");
    let legend = kinds.iter().enumerate().map(|(kind, name)| ((*name).to_owned(), mark(kind % COLOURS))).collect();
    Picture { size: (600.0, ROW * bars.len() as f64 + 4.0), label: label.into(), inner, legend }
}
