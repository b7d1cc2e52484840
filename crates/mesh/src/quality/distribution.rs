//! The distribution of a measure over a mesh: its quantiles, and a histogram in plain text.

use std::fmt;

use super::quantile;

/// Values of one measure over the elements of a mesh.
///
/// ```
/// let mesh = fem_mesh::box_mesh([1.0, 1.0, 1.0], 2, fem_mesh::Pattern::Alternating)?;
/// let angles = &fem_mesh::tetrahedron_distributions(&mesh)[0];
/// assert_eq!((angles.name, angles.unit), ("dihedral angle", "°"));
/// assert!((angles.quantile(0.0) - 45.0).abs() < 1e-12 && (angles.quantile(1.0) - 90.0).abs() < 1e-12);
/// println!("{angles}"); // the histogram
/// # Ok::<(), fem_mesh::MeshError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    /// Name of the measure.
    pub name: &'static str,
    /// Its unit; empty for a ratio.
    pub unit: &'static str,
    /// Lower ends of the histogram's bins, ascending. The last bin has no upper end unless [`Distribution::end`] gives one.
    pub bins: Vec<f64>,
    /// Largest value that the measure can have; infinite if it has no bound.
    pub end: f64,
    /// Ascending.
    values: Vec<f64>,
}

/// Characters of the longest bar.
const WIDTH: f64 = 40.0;

impl Distribution {
    /// Sorts the values of a measure; values that are not finite are left out.
    pub fn new(
        name: &'static str,
        unit: &'static str,
        bins: Vec<f64>,
        end: f64,
        values: impl Iterator<Item = f64>,
    ) -> Self {
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        values.sort_unstable_by(f64::total_cmp);
        Self { name, unit, bins, end, values }
    }

    /// Number of values.
    pub fn count(&self) -> usize {
        self.values.len()
    }

    /// The smallest value that this share of the values does not exceed: 0 gives the smallest, 0.5 the median and 1 the largest value.
    /// NaN if there are no values.
    pub fn quantile(&self, share: f64) -> f64 {
        quantile(&self.values, share)
    }

    /// Name and unit.
    pub fn title(&self) -> String {
        if self.unit.is_empty() { self.name.to_owned() } else { format!("{}, {}", self.name, self.unit) }
    }

    /// Number of values in each bin. A value at the end of a bin belongs to the next; one below the first bin belongs to the first.
    pub fn counts(&self) -> Vec<usize> {
        let below = |bound: f64| self.values.partition_point(|&value| value < bound);
        let ends = self.bins[1..].iter().map(|&bound| below(bound)).chain([self.values.len()]);
        let mut start = 0;
        ends.map(|end| end - std::mem::replace(&mut start, end)).collect()
    }

    /// The two ends of a bin in words, such as `10` and `20`; the second of an open bin is empty.
    pub fn ends(&self, bin: usize) -> [String; 2] {
        let next = self.bins.get(bin + 1).copied().unwrap_or(self.end);
        [self.bins[bin].to_string(), if next.is_finite() { next.to_string() } else { String::new() }]
    }
}

/// The histogram: a line for each bin between the first and the last that have values.
impl fmt::Display for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.title())?;
        let counts = self.counts();
        let most = counts.iter().copied().max().unwrap_or(0).max(1) as f64;
        let used: Vec<usize> = (0..counts.len()).filter(|&bin| counts[bin] > 0).collect();
        let (Some(&first), Some(&last)) = (used.first(), used.last()) else { return writeln!(f, "    no values") };
        for bin in first..=last {
            let [from, to] = self.ends(bin);
            let share = 100.0 * counts[bin] as f64 / self.count() as f64;
            let bar = bar(WIDTH * counts[bin] as f64 / most);
            let line = format!("{from:>6} … {to:<5}{:>9}{share:>7.2} %  {bar}", counts[bin]);
            writeln!(f, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

/// A bar of blocks, to an eighth of a character; whatever is not zero can be seen.
fn bar(length: f64) -> String {
    const EIGHTHS: [&str; 8] = ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"];
    let eighths = if length > 0.0 { ((8.0 * length).round() as usize).max(1) } else { 0 };
    "█".repeat(eighths / 8) + EIGHTHS[eighths % 8]
}
