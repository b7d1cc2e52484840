//! Histograms: of shares, and with bins that have ends of their own.

use maud::html;

use crate::Picture;
use crate::svg::{line, rectangle, text};

/// Counts of values between 0 and 1 in each tenth; the last tenth includes 1.
pub fn histogram(label: &str, values: &[f64]) -> Picture {
    let (width, left, top, bottom) = (460.0, 30.0, 20.0, 190.0);
    let mut counts = [0_usize; 10];
    for value in values.iter().filter(|value| value.is_finite()) {
        counts[((value * 10.0 + 1e-9) as usize).min(9)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(0).max(1);
    let step = (width - left - 24.0) / 10.0;
    let x = |i: usize| left + step * i as f64;
    let inner = html! {
        (line("axis", (left, bottom), (width - 24.0, bottom)))
        @for (i, &count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
            @let height = (bottom - top) * count as f64 / most as f64;
            @let tip = format!("{} to {} %: {count}", 10 * i, 10 * (i + 1));
            (rectangle("share k0", (x(i) + 2.0, bottom - height), (step - 4.0, height), &tip))
            (text("name", "middle", (x(i) + 0.5 * step, bottom - height - 5.0), &count.to_string()))
        }
        @for i in (0..=10).step_by(2) {
            (text("", "middle", (x(i), bottom + 16.0), &format!("{} %", 10 * i)))
        }
    };
    Picture { size: (width, bottom + 26.0), label: label.to_owned(), inner, legend: Vec::new() }
}

/// A histogram: the number of values in each bin, with the values at the bins' ends. An empty `ends` has no mark. The bars have equal
/// widths, whatever the bins' are. `ends` has one entry more than `counts`.
pub fn distribution(label: &str, ends: &[String], counts: &[usize]) -> Picture {
    let (width, left, top, bottom) = (340.0, 12.0, 16.0, 120.0);
    let most = counts.iter().copied().max().unwrap_or(0).max(1);
    let all = counts.iter().sum::<usize>().max(1);
    let step = (width - 2.0 * left) / counts.len().max(1) as f64;
    let x = |i: usize| left + step * i as f64;
    // Every second end is written where bins are narrow.
    let stride = if step < 26.0 { 2 } else { 1 };
    let inner = html! {
        (line("axis", (left, bottom), (width - left, bottom)))
        @for (i, &count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
            @let height = ((bottom - top) * count as f64 / most as f64).max(0.7);
            @let end = |i: usize| ends.get(i).map_or("", String::as_str);
            @let tip = format!("{} … {}: {count}, {:.2} %", end(i), end(i + 1), 100.0 * count as f64 / all as f64);
            (rectangle("share k0", (x(i) + 1.0, bottom - height), (step - 2.0, height), &tip))
        }
        @for (i, end) in ends.iter().enumerate().step_by(stride) {
            (text("", "middle", (x(i), bottom + 15.0), end))
        }
        (text("note", "end", (width - left, top - 6.0), &format!("largest bin {most}")))
    };
    Picture { size: (width, bottom + 22.0), label: label.to_owned(), inner, legend: Vec::new() }
}
