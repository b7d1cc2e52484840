//! The section of the panel for the time of a step and its parts.

use kiss3d::egui::{Grid, RichText, Ui, vec2};

use crate::picture::{numbers, theme};
use crate::worker::Snapshot;

/// Lays out a row for each part, with its share of the whole step.
pub fn show(ui: &mut Ui, snapshot: &Snapshot) {
    if snapshot.timers.is_empty() {
        ui.label(RichText::new("no step was taken lately").color(theme::SECONDARY_TEXT));
        return;
    }
    let whole = snapshot.timed_step.max(f64::MIN_POSITIVE);
    Grid::new("timers").num_columns(4).spacing(vec2(12.0, 3.0)).show(ui, |ui| {
        for name in ["in a step", "ms", "share", "uses"] {
            ui.label(RichText::new(name).color(theme::SECONDARY_TEXT));
        }
        ui.end_row();
        for timer in &snapshot.timers {
            ui.label(timer.name.replace('_', " "));
            ui.label(numbers::short(1e3 * timer.seconds));
            ui.label(format!("{:.0} %", 100.0 * timer.seconds / whole));
            ui.label(numbers::short(timer.uses));
            ui.end_row();
        }
        ui.label(RichText::new("the whole step").strong());
        ui.label(RichText::new(numbers::short(1e3 * snapshot.timed_step)).strong());
        ui.end_row();
    });
}
