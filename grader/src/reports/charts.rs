//! Small charts as inline SVG. Each returns one `<svg>`; the page's style colours them.

use super::escape;

const WIDTH: f64 = 460.0;

/// A point of a [`scatter`].
pub struct Point {
    pub x: f64,
    pub y: f64,
    /// Shown when the pointer rests on it.
    pub title: String,
    /// How the point looks: a class of the page's style.
    pub class: &'static str,
}

/// A bar of [`bars`]: shares of a whole, each with its class, from left to right.
pub struct Bar {
    pub name: String,
    pub shares: Vec<(&'static str, f64)>,
    pub figure: String,
    pub title: String,
}

/// A row of [`rows`]: points on one axis, joined by a line; their `y` says nothing.
pub struct Row {
    pub name: String,
    pub points: Vec<Point>,
    pub figure: String,
}

/// How many of the values, each between 0 and 1, fall into each tenth; 1 belongs to the last.
pub fn histogram(values: &[f64]) -> String {
    let (left, top, bottom) = (30.0, 20.0, 190.0);
    let mut counts = [0_usize; 10];
    for value in values {
        counts[((value * 10.0 + 1e-9) as usize).min(9)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(0).max(1);
    let step = (WIDTH - left - 24.0) / 10.0;
    let mut inner = line("axis", left, bottom, WIDTH - 24.0, bottom);
    for (i, &count) in counts.iter().enumerate() {
        let height = (bottom - top) * count as f64 / most as f64;
        let x = left + step * i as f64;
        let title = format!("{} to {} %: {count}", 10 * i, 10 * (i + 1));
        inner.push_str(&rectangle("bar", x + 2.0, bottom - height, step - 4.0, height, &title));
        if count > 0 {
            inner.push_str(&text("strong", "middle", x + step / 2.0, bottom - height - 5.0, &count.to_string()));
        }
    }
    for i in 0..=5 {
        let x = left + step * f64::from(2 * i);
        inner.push_str(&text("", "middle", x, bottom + 16.0, &format!("{} %", 20 * i)));
    }
    svg(bottom + 36.0, "Distribution of scores", &inner)
}

/// Bars of equal length, one below the other, divided into shares of 1.
pub fn bars(bars: &[Bar]) -> String {
    let (left, row, length) = (205.0, 19.0, 205.0);
    let mut inner = String::new();
    for (i, bar) in bars.iter().enumerate() {
        let y = row * i as f64;
        inner.push_str(&text("fixed", "end", left - 8.0, y + 12.5, &bar.name));
        let mut x = left;
        for (class, share) in &bar.shares {
            inner.push_str(&rectangle(class, x, y + 3.0, length * share, row - 6.0, &bar.title));
            x += length * share;
        }
        inner.push_str(&text("strong", "start", left + length + 7.0, y + 12.5, &bar.figure));
    }
    svg(row * bars.len() as f64 + 4.0, "Success per function", &inner)
}

/// Points on one logarithmic axis, a row for each name. Coordinates must be positive.
pub fn rows(rows: &[Row], label: &str, x_name: &str) -> String {
    let (left, right, height) = (205.0, WIDTH - 62.0, 19.0);
    let bottom = height * rows.len() as f64 + 4.0;
    let range = decades(rows.iter().flat_map(|row| &row.points).map(|point| point.x));
    let x = |value: f64| left + (right - left) * along(range, value);
    let mut inner = String::new();
    for decade in ticks(range, 5) {
        let at = x(10_f64.powi(decade));
        inner.push_str(&line("grid", at, 0.0, at, bottom));
        inner.push_str(&power("middle", at, bottom + 15.0, decade));
    }
    for (i, row) in rows.iter().enumerate() {
        let y = height * (i as f64 + 0.5) + 2.0;
        inner.push_str(&text("fixed", "end", left - 10.0, y + 3.5, &row.name));
        let ends = || row.points.iter().map(|point| x(point.x));
        if let Some((low, high)) = ends().reduce(f64::min).zip(ends().reduce(f64::max)) {
            inner.push_str(&line("axis", low, y, high, y));
        }
        row.points.iter().for_each(|point| inner.push_str(&circle(point, x(point.x), y, 4.0)));
        inner.push_str(&text("strong", "start", right + 9.0, y + 4.0, &row.figure));
    }
    inner.push_str(&text("strong", "end", right, bottom + 33.0, x_name));
    svg(bottom + 41.0, label, &inner)
}

/// Points on two logarithmic axes. Coordinates must be positive.
pub fn scatter(points: &[Point], x_name: &str, y_name: &str) -> String {
    plot(points.iter().map(std::slice::from_ref), x_name, y_name)
}

/// The same, with lines through the points of each curve.
pub fn curves(curves: &[Vec<Point>], x_name: &str, y_name: &str) -> String {
    plot(curves.iter().map(Vec::as_slice), x_name, y_name)
}

fn plot<'a>(curves: impl Iterator<Item = &'a [Point]> + Clone, x_name: &str, y_name: &str) -> String {
    let (left, top, bottom) = (52.0, 14.0, 300.0);
    let right = WIDTH - 14.0;
    let xs = decades(curves.clone().flatten().map(|point| point.x));
    let ys = decades(curves.clone().flatten().map(|point| point.y));
    let x = |value: f64| left + (right - left) * along(xs, value);
    let y = |value: f64| bottom - (bottom - top) * along(ys, value);
    let mut inner = String::new();
    for decade in ticks(xs, 9) {
        let at = x(10_f64.powi(decade));
        inner.push_str(&line("grid", at, top, at, bottom));
        inner.push_str(&power("middle", at, bottom + 17.0, decade));
    }
    for decade in ticks(ys, 9) {
        let at = y(10_f64.powi(decade));
        inner.push_str(&line("grid", left, at, right, at));
        inner.push_str(&power("end", left - 6.0, at + 4.0, decade));
    }
    inner.push_str(&text("strong", "end", right, bottom + 36.0, x_name));
    inner.push_str(&text("strong", "start", left + 4.0, top + 10.0, y_name));
    for curve in curves {
        for pair in curve.windows(2) {
            let class = format!("curve {}", pair[0].class);
            inner.push_str(&line(&class, x(pair[0].x), y(pair[0].y), x(pair[1].x), y(pair[1].y)));
        }
        curve.iter().for_each(|point| inner.push_str(&circle(point, x(point.x), y(point.y), 5.0)));
    }
    svg(bottom + 44.0, "Error against run time", &inner)
}

/// The powers of ten around all values.
fn decades(values: impl Iterator<Item = f64>) -> (i32, i32) {
    let logs: Vec<f64> = values.map(f64::log10).collect();
    let low = logs.iter().copied().reduce(f64::min).unwrap_or(0.0);
    let high = logs.iter().copied().reduce(f64::max).unwrap_or(1.0);
    // A little room, so that no point sits on the frame.
    let (low, high) = ((low - 0.15).floor() as i32, (high + 0.15).ceil() as i32);
    (low, high.max(low + 1))
}

fn along((low, high): (i32, i32), value: f64) -> f64 {
    (value.log10() - f64::from(low)) / f64::from(high - low)
}

/// At most so many decades, evenly spread.
fn ticks((low, high): (i32, i32), most: i32) -> impl Iterator<Item = i32> {
    let step = (high - low) / (most - 1) + 1;
    (low..=high).step_by(usize::try_from(step).unwrap_or(1))
}

fn svg(height: f64, label: &str, inner: &str) -> String {
    format!("<svg viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{label}\">\n{inner}</svg>\n")
}

fn circle(point: &Point, x: f64, y: f64, radius: f64) -> String {
    format!(
        "<circle class=\"{}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\"><title>{}</title></circle>\n",
        point.class,
        escape::html(&point.title)
    )
}

fn line(class: &str, x1: f64, y1: f64, x2: f64, y2: f64) -> String {
    format!("<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>\n")
}

fn rectangle(class: &str, x: f64, y: f64, width: f64, height: f64, title: &str) -> String {
    format!(
        "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\">\
         <title>{}</title></rect>\n",
        escape::html(title)
    )
}

fn text(class: &str, anchor: &str, x: f64, y: f64, content: &str) -> String {
    let content = escape::html(content);
    format!("<text class=\"{class}\" text-anchor=\"{anchor}\" x=\"{x:.1}\" y=\"{y:.1}\">{content}</text>\n")
}

fn power(anchor: &str, x: f64, y: f64, decade: i32) -> String {
    let exponent = format!("<tspan dy=\"-4\" font-size=\"8\">{}</tspan>", decade.to_string().replace('-', "−"));
    format!("<text text-anchor=\"{anchor}\" x=\"{x:.1}\" y=\"{y:.1}\">10{exponent}</text>\n")
}
