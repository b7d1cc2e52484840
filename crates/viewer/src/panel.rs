//! The panel at the left, the help at the bottom, and the banner of a failure.

use std::time::{Duration, Instant};

use fem_scene::simulation::Parameter;
use kiss3d::egui::{
    Align2, Area, Button, Color32, Context, CornerRadius, Frame, Grid, Id, Margin, Pos2, Rect, RichText, ScrollArea,
    Slider, SliderClamping, Ui, vec2,
};

use crate::stage::Shown;
use crate::worker::Snapshot;
use crate::{pacing, plot, theme};

/// Width of the panel with its margins, logical pixels.
pub const WIDTH: f32 = 356.0;
const INSIDE: f32 = 312.0;
const HELP_WIDTH: f32 = 890.0; // of the text in one line
const HELP: &str = "drag the body: pull  ·  drag beside it: turn  ·  middle button: move  ·  wheel: zoom  ·  \
                    S surface  ·  N integrator  ·  Space pause  ·  R reset  ·  Esc quit";
/// How long a slider stays where it was dragged while the simulation has not answered.
const ANSWER_TIME: Duration = Duration::from_millis(600);

/// What a person asked for through the panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wish {
    /// Stop, or go on.
    TogglePause,
    /// Back to the start.
    Reset,
    /// Go on with the next integrator.
    NextIntegrator,
    /// Show the other surface.
    NextSurface,
    /// Set a parameter.
    Set(&'static str, f64),
}

/// What the panel shows beside the snapshot.
pub struct Facts<'a> {
    /// The scene's name.
    pub name: &'a str,
    /// Which surface is shown.
    pub shown: Shown,
    /// Whether there are two surfaces.
    pub has_skin: bool,
    /// Time that the last frames took, s.
    pub frame_seconds: f64,
}

/// The panel's own memory.
#[derive(Default)]
pub struct Panel {
    places: Vec<Rect>,
    dragged: Option<(&'static str, f64, Instant)>,
}

impl Panel {
    /// Whether something of the panel lies at `point`, logical pixels.
    pub fn covers(&self, point: Pos2) -> bool {
        self.places.iter().any(|place| place.contains(point))
    }

    /// Lays everything out, and tells what was asked for.
    pub fn show(&mut self, context: &Context, snapshot: &Snapshot, facts: &Facts) -> Vec<Wish> {
        let mut wishes = Vec::new();
        self.places.clear();
        let height = context.content_rect().height();
        let area =
            Area::new(Id::new("panel")).fixed_pos([12.0, 12.0]).default_size([INSIDE, height]).show(context, |ui| {
                paper().show(ui, |ui| {
                    ui.set_width(INSIDE);
                    let scroll = ScrollArea::vertical().max_height(height - 76.0).min_scrolled_height(height - 76.0);
                    scroll.show(ui, |ui| self.contents(ui, snapshot, facts, &mut wishes));
                });
            });
        self.places.push(area.response.rect);
        help(context);
        if let Some(stop) = &snapshot.stop {
            self.banner(context, &stop.to_string(), &mut wishes);
        }
        wishes
    }

    fn contents(&mut self, ui: &mut Ui, snapshot: &Snapshot, facts: &Facts, wishes: &mut Vec<Wish>) {
        ui.label(RichText::new(facts.name).size(20.0).strong());
        ui.add_space(2.0);
        buttons(ui, snapshot, facts, wishes);
        ui.add_space(6.0);
        numbers(ui, snapshot, facts, wishes);
        ui.add_space(6.0);
        plot::show(ui, &snapshot.history);
        if !snapshot.parameters.is_empty() {
            ui.separator();
        }
        for parameter in &snapshot.parameters {
            self.slider(ui, parameter, wishes);
        }
        if let Some(refusal) = &snapshot.refusal {
            ui.label(RichText::new(refusal).color(theme::ALARM));
        }
    }

    fn slider(&mut self, ui: &mut Ui, parameter: &Parameter, wishes: &mut Vec<Wish>) {
        self.dragged.take_if(|(_, _, since)| since.elapsed() > ANSWER_TIME);
        let mut value = match self.dragged {
            Some((key, value, _)) if key == parameter.key => value,
            _ => parameter.value,
        };
        let (low, high) = parameter.range;
        let unit = if parameter.unit.is_empty() { String::new() } else { format!(" ({})", parameter.unit) };
        ui.label(format!("{}{unit}", parameter.label));
        ui.spacing_mut().slider_width = INSIDE - 84.0;
        let slider = Slider::new(&mut value, low..=high)
            .logarithmic(parameter.logarithmic)
            .clamping(SliderClamping::Never) // a value typed outside is the simulation's to refuse, with words
            .custom_formatter(|value, _| plot::short(value))
            .custom_parser(parse);
        if ui.add(slider).changed() {
            self.dragged = Some((parameter.key, value, Instant::now()));
            wishes.push(Wish::Set(parameter.key, value));
        }
    }

    fn banner(&mut self, context: &Context, text: &str, wishes: &mut Vec<Wish>) {
        let width = (context.content_rect().width() - WIDTH - 40.0).clamp(200.0, 620.0);
        let area = Area::new(Id::new("banner")).anchor(Align2::CENTER_TOP, vec2(WIDTH / 2.0, 16.0));
        let shown = area.show(context, |ui| {
            let frame = Frame::new().fill(theme::ALARM).corner_radius(CornerRadius::same(6)).inner_margin(12.0);
            frame.show(ui, |ui| {
                ui.set_width(width);
                ui.label(RichText::new(text).size(15.0).color(Color32::WHITE));
                ui.add_space(4.0);
                if ui.button("Reset (R)").clicked() {
                    wishes.push(Wish::Reset);
                }
            });
        });
        self.places.push(shown.response.rect);
    }
}

fn buttons(ui: &mut Ui, snapshot: &Snapshot, facts: &Facts, wishes: &mut Vec<Wish>) {
    ui.horizontal(|ui| {
        let mut button = |text: &str, wish: Wish| {
            if ui.add(Button::new(text).min_size(vec2(70.0, 24.0))).clicked() {
                wishes.push(wish);
            }
        };
        button(if snapshot.paused { "Go on" } else { "Pause" }, Wish::TogglePause);
        button("Reset", Wish::Reset);
        if facts.has_skin {
            let other = if facts.shown == Shown::Skinned { "Show mesh" } else { "Show skin" };
            button(other, Wish::NextSurface);
        }
    });
}

fn numbers(ui: &mut Ui, snapshot: &Snapshot, facts: &Facts, wishes: &mut Vec<Wish>) {
    let row = |ui: &mut Ui, name: &str, value: String| {
        ui.label(RichText::new(name).color(theme::PALE_INK));
        ui.label(value);
        ui.end_row();
    };
    Grid::new("numbers").num_columns(2).spacing(vec2(10.0, 3.0)).show(ui, |ui| {
        ui.label(RichText::new("integrator").color(theme::PALE_INK));
        if ui.button(snapshot.integrator.replace('_', " ")).on_hover_text("the next one (N)").clicked() {
            wishes.push(Wish::NextIntegrator);
        }
        ui.end_row();
        row(ui, "time", format!("{:.2} s, step {}", snapshot.time, snapshot.steps));
        row(ui, "one step", format!("{} ms", plot::short(1e3 * snapshot.step_seconds)));
        row(ui, "one frame", format!("{} ms", plot::short(1e3 * facts.frame_seconds)));
        row(ui, "speed", speed(snapshot));
    });
}

/// How fast simulated time runs, in words that claim nothing while it stands still.
fn speed(snapshot: &Snapshot) -> String {
    match snapshot.rate {
        _ if snapshot.stop.is_some() => "stopped".into(),
        _ if snapshot.finished => "finished".into(),
        _ if snapshot.paused => "paused".into(),
        None => "…".into(),
        Some(factor) => format!("{factor:.2}, {}", pacing::verdict(factor)),
    }
}

fn help(context: &Context) {
    let width = (context.content_rect().width() - 48.0).min(HELP_WIDTH);
    let area = Area::new(Id::new("help")).anchor(Align2::CENTER_BOTTOM, vec2(0.0, -8.0)).interactable(false);
    area.show(context, |ui| {
        let margin = Margin::symmetric(12, 4);
        paper().inner_margin(margin).show(ui, |ui| {
            ui.set_width(width);
            ui.label(RichText::new(HELP).size(12.0));
        });
    });
}

fn paper() -> Frame {
    Frame::new().fill(theme::PAPER).corner_radius(CornerRadius::same(6)).inner_margin(Margin::same(12))
}

/// A number as it is shown: with k for a thousand and M for a million.
fn parse(text: &str) -> Option<f64> {
    let text = text.trim();
    let scaled = |letter: char, factor: f64| text.strip_suffix(letter)?.trim().parse::<f64>().ok().map(|v| v * factor);
    text.parse().ok().or_else(|| scaled('k', 1e3)).or_else(|| scaled('M', 1e6))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_they_are_shown() {
        for value in [0.25, 12_300.0, 2.5e6, 1e-5, 3e10] {
            assert_eq!(parse(&plot::short(value)), Some(value));
        }
        assert_eq!(parse("soft"), None);
    }

    #[test]
    fn nothing_is_claimed_of_a_simulation_that_stands_still() {
        let running = Snapshot { rate: Some(1.0), ..Snapshot::default() };
        assert_eq!(speed(&running), "1.00, keeps real time");
        assert_eq!(speed(&Snapshot { paused: true, ..running.clone() }), "paused");
        assert_eq!(speed(&Snapshot { finished: true, ..running }), "finished");
    }
}
