//! The plot of energies over time.

use kiss3d::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};

use fem_model::simulation::EnergyLedger;
use fem_output::EnergyRow;

use crate::picture::numbers::{round_up, short};
use crate::picture::theme;
use crate::worker::history::SPAN;

const HEIGHT: f32 = 150.0;
const LEFT: f32 = 52.0; // room for the numbers of the energy axis
const BELOW: f32 = 30.0; // room for the numbers and the name of the time axis
const ABOVE: f32 = 16.0; // room for the name of the energy axis
const FONT: FontId = FontId::proportional(11.0);

/// Name, colour and value of a curve.
type Curve = (&'static str, Color32, fn(&EnergyRow) -> f64);

const CURVES: [Curve; 3] = [
    ("kinetic", theme::KINETIC, |s| s.energies.kinetic),
    ("potential", theme::POTENTIAL, |s| s.energies.potential),
    ("total", theme::TOTAL, |s| s.energies.total()),
];

/// Draws the curves, their axes and a legend over the available width.
pub fn show(ui: &mut Ui, samples: &[EnergyRow]) {
    let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::hover());
    let frame = Rect::from_min_max(area.min + vec2(LEFT, ABOVE), area.max - vec2(6.0, BELOW));
    let axes = Axes::around(frame, samples);
    axes.paint(ui.painter());
    let inside = ui.painter().with_clip_rect(frame.expand(1.0));
    for (_, color, value) in CURVES {
        let at = |s: &EnergyRow| axes.at(s.time, value(s));
        let curve: Vec<Pos2> = samples.iter().filter(|s| value(s).is_finite()).map(at).collect();
        inside.add(Shape::line(curve, Stroke::new(1.6, color)));
    }
    legend(ui, samples.last());
}

fn legend(ui: &mut Ui, last: Option<&EnergyRow>) {
    // Wrapped, so that long numbers do not make the panel wider.
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        for (name, color, value) in CURVES {
            let (swatch, _) = ui.allocate_exact_size(vec2(14.0, 10.0), Sense::hover());
            ui.painter().hline(swatch.x_range(), swatch.center().y, Stroke::new(2.5, color));
            let number = last.map_or_else(String::new, |s| format!(" {}", short(value(s))));
            ui.small(format!("{name}{number}").replace(' ', "\u{a0}"));
            ui.add_space(2.0);
        }
    });
    if let Some(ledger) = last.and_then(|row| row.ledger) {
        ui.small(balance(&ledger));
    }
}

/// The line of the energies that were supplied, dissipated, and lost by the method since the start.
fn balance(ledger: &EnergyLedger) -> String {
    let [supplied, dissipated, lost] =
        [ledger.start + ledger.supplied(), ledger.dissipated(), ledger.numerical()].map(short);
    // A line breaks between two of them alone.
    let each = [format!("supplied {supplied}"), format!("dissipated {dissipated}"), format!("by the method {lost}")];
    each.map(|text| text.replace(' ', "\u{a0}")).join("   ")
}

/// Ranges of time and energy that the frame spans.
struct Axes {
    frame: Rect,
    times: (f64, f64),
    energies: (f64, f64),
    step: f64,
}

impl Axes {
    fn around(frame: Rect, samples: &[EnergyRow]) -> Self {
        let last = samples.last().map_or(0.0, |s| s.time);
        let end = last.max(SPAN);
        let (energies, step) = energy_range(samples);
        Axes { frame, times: (end - SPAN, end), energies, step }
    }

    fn at(&self, time: f64, energy: f64) -> Pos2 {
        let share = |value: f64, (low, high): (f64, f64)| ((value - low) / (high - low)) as f32;
        let x = self.frame.left() + share(time, self.times) * self.frame.width();
        let y = self.frame.bottom() - share(energy, self.energies) * self.frame.height();
        pos2(x, y)
    }

    fn paint(&self, painter: &Painter) {
        painter.rect_filled(self.frame, 0.0, Color32::WHITE);
        let line = Stroke::new(1.0, theme::GRID);
        for energy in ticks(self.energies, self.step) {
            let y = self.at(self.times.0, energy).y;
            painter.hline(self.frame.x_range(), y, line);
            let place = pos2(self.frame.left() - 4.0, y);
            painter.text(place, Align2::RIGHT_CENTER, short(energy), FONT, theme::TEXT);
        }
        for time in ticks(self.times, 2.0) {
            let x = self.at(time, self.energies.0).x;
            painter.vline(x, self.frame.y_range(), line);
            let place = pos2(x, self.frame.bottom() + 2.0);
            painter.text(place, Align2::CENTER_TOP, format!("{time:.0}"), FONT, theme::TEXT);
        }
        let corner = pos2(self.frame.left() + 2.0, self.frame.top() - ABOVE);
        painter.text(corner, Align2::LEFT_TOP, "energy (J)", FONT, theme::SECONDARY_TEXT);
        let middle = pos2(self.frame.center().x, self.frame.bottom() + BELOW - 2.0);
        painter.text(middle, Align2::CENTER_BOTTOM, "time (s)", FONT, theme::SECONDARY_TEXT);
    }
}

/// Range of the energy axis and spacing of its lines: round numbers that enclose zero and all samples.
fn energy_range(samples: &[EnergyRow]) -> ((f64, f64), f64) {
    let values = samples.iter().flat_map(|s| CURVES.map(|(_, _, value)| value(s))).filter(|v| v.is_finite());
    let (low, high) = values.fold((0.0, 0.0), |(low, high), v| (f64::min(low, v), f64::max(high, v)));
    let span = if high - low > 0.0 { high - low } else { 1.0 };
    let step = round_up(span / 4.0, &[1.0, 2.0, 5.0]);
    let low = (low / step).floor() * step;
    let high = (high / step).ceil() * step;
    ((low, high.max(low + step)), step)
}

/// Multiples of `step` in a range, at most 20.
fn ticks((low, high): (f64, f64), step: f64) -> Vec<f64> {
    let first = (low / step - 1e-6).ceil() as i64;
    let last = (high / step + 1e-6).floor() as i64;
    (first..=last).take(20).map(|i| i as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use fem_model::simulation::Energies;

    use super::*;

    fn sample(kinetic: f64, potential: f64) -> EnergyRow {
        EnergyRow { time: 0.0, energies: Energies { kinetic, potential }, ledger: None }
    }

    #[test]
    fn the_energy_axis_spans_all_curves_and_zero_in_round_steps() {
        let ((low, high), step) = energy_range(&[sample(3.0, -7.2), sample(1.0, 0.0)]);
        assert_eq!((low, high, step), (-10.0, 5.0, 5.0));
        assert_eq!(ticks((low, high), step), [-10.0, -5.0, 0.0, 5.0]);
    }

    #[test]
    fn an_axis_without_finite_energies_has_a_range() {
        assert_eq!(energy_range(&[]), ((0.0, 0.5), 0.5));
        assert_eq!(energy_range(&[sample(f64::NAN, f64::INFINITY)]), ((0.0, 0.5), 0.5));
    }
}
