//! The panel at the left, the help line at the bottom, and the banner of a failure.

mod boundary;
mod load;
mod plot;
pub mod request;
mod rows;
mod save;
mod sections;
mod solver;
mod timers;

use std::path::PathBuf;

use fem_model::simulation::Shape;
use kiss3d::egui::{
    Align2, Area, Button, Color32, Context, CornerRadius, Frame, Grid, Id, Margin, Pos2, Rect, RichText, ScrollArea,
    Ui, vec2,
};

use crate::editing::change::Change;
use crate::editing::tables::TableOffer;
use crate::picture::scene_view::DisplayedSurface;
use crate::picture::{numbers, theme};
use crate::setup::{Mode, Setup};
use crate::worker::{Command, Snapshot, pacing};
use request::UserRequest;
use sections::Sections;

/// Width of the panel including its margins, logical pixels.
pub const WIDTH: f32 = 356.0;
const CONTENT_WIDTH: f32 = 312.0;
const HELP_WIDTH: f32 = 1012.0; // of the text in one line
const HELP: [&str; 4] = [
    "drag the body: pull  ·  drag beside it: turn  ·  middle button: move  ·  wheel: zoom  ·  \
     S surface  ·  C colours  ·  F forces  ·  N integrator  ·  Space pause  ·  R reset  ·  Esc quit",
    "drag the body: pull  ·  drag beside it, or right button: move  ·  wheel: zoom  ·  \
     C colours  ·  T picture  ·  F forces  ·  N integrator  ·  Space pause  ·  R reset  ·  Esc quit",
    "drag over the body: paint nodes  ·  Ctrl: erase  ·  drag beside it, or right button: look around  ·  wheel: zoom  ·  \
     Space pause  ·  R reset  ·  Esc quit",
    "click: pick faces  ·  Ctrl: add, remove  ·  drag a picked face: pull or push  ·  right button: look around  ·  wheel: zoom  ·  \
     Space pause  ·  Esc quit",
];

/// Values that the panel shows.
pub struct ViewState<'a> {
    /// The state of the simulation.
    pub snapshot: &'a Snapshot,
    /// The scene's name.
    pub name: &'a str,
    /// Pictures that the body can be made from.
    pub objects: &'a [PathBuf],
    /// The displayed surface.
    pub shown: DisplayedSurface,
    /// The body has a display surface beside its simulation mesh.
    pub has_skin: bool,
    /// The camera turns around the body.
    pub turns: bool,
    /// Running mean of the time per frame, s.
    pub frame_seconds: f64,
    /// The undeformed body.
    pub shape: &'a Shape,
}

/// State of the panel between frames.
#[derive(Default)]
pub struct Panel {
    places: Vec<Rect>,
    sections: Sections,
}

impl Panel {
    /// Returns true if the panel or the banner covers `point`, logical pixels.
    pub fn covers(&self, point: Pos2) -> bool {
        self.places.iter().any(|place| place.contains(point))
    }

    /// Lays out panel, help and banner, and returns the user's requests.
    pub fn show(&mut self, context: &Context, state: &ViewState, setup: &mut Setup) -> Vec<UserRequest> {
        let mut requests = Vec::new();
        self.places.clear();
        let height = context.content_rect().height();
        let area = Area::new(Id::new("panel")).fixed_pos([12.0, 12.0]).default_size([CONTENT_WIDTH, height]).show(
            context,
            |ui| {
                panel_frame().show(ui, |ui| {
                    ui.set_width(CONTENT_WIDTH);
                    let scroll = ScrollArea::vertical().max_height(height - 76.0).min_scrolled_height(height - 76.0);
                    scroll.show(ui, |ui| self.contents(ui, state, setup, &mut requests));
                });
            },
        );
        self.places.push(area.response.rect);
        help(context, help_text(setup.mode, state.turns));
        if let Some(stop) = &state.snapshot.stop {
            self.banner(context, &stop.to_string(), &mut requests);
        }
        requests
    }

    fn contents(&mut self, ui: &mut Ui, state: &ViewState, setup: &mut Setup, requests: &mut Vec<UserRequest>) {
        let snapshot = state.snapshot;
        ui.label(RichText::new(state.name).size(20.0).strong());
        ui.add_space(2.0);
        buttons(ui, state, requests);
        if snapshot.setup.is_some() {
            tools(ui, setup.mode, requests);
        }
        if snapshot.is_building {
            ui.horizontal(|ui| {
                ui.spinner();
                ui.label("building the changed scene …");
            });
        }
        if let Some(refusal) = &snapshot.refusal {
            ui.label(RichText::new(refusal).color(theme::FAILURE));
        }
        ui.add_space(6.0);
        figures(ui, state, requests);
        if let Some(scene) = &snapshot.setup {
            tables(ui, &scene.offers, requests);
        }
        ui.add_space(6.0);
        self.sections.show(ui, state, setup, requests);
    }

    fn banner(&mut self, context: &Context, text: &str, requests: &mut Vec<UserRequest>) {
        let width = (context.content_rect().width() - WIDTH - 40.0).clamp(200.0, 620.0);
        let area = Area::new(Id::new("banner")).anchor(Align2::CENTER_TOP, vec2(WIDTH / 2.0, 16.0));
        let shown = area.show(context, |ui| {
            let frame = Frame::new().fill(theme::FAILURE).corner_radius(CornerRadius::same(6)).inner_margin(12.0);
            frame.show(ui, |ui| {
                ui.set_width(width);
                ui.label(RichText::new(text).size(15.0).color(Color32::WHITE));
                ui.add_space(4.0);
                if ui.button("Reset (R)").clicked() {
                    requests.push(UserRequest::Send(Command::Reset));
                }
            });
        });
        self.places.push(shown.response.rect);
    }
}

fn buttons(ui: &mut Ui, state: &ViewState, requests: &mut Vec<UserRequest>) {
    ui.horizontal(|ui| {
        let mut button = |text: &str, request: UserRequest| {
            if ui.add(Button::new(text).min_size(vec2(70.0, 24.0))).clicked() {
                requests.push(request);
            }
        };
        button(if state.snapshot.paused { "Continue" } else { "Pause" }, UserRequest::Send(Command::TogglePause));
        button("Reset", UserRequest::Send(Command::Reset));
        if state.has_skin {
            let other = if state.shown == DisplayedSurface::Skinned { "Show mesh" } else { "Show skin" };
            button(other, UserRequest::NextSurface);
        }
    });
}

/// The choice of what the left mouse button does on the body.
fn tools(ui: &mut Ui, mode: Mode, requests: &mut Vec<UserRequest>) {
    ui.horizontal(|ui| {
        for (tool, text) in [(Mode::Pull, "1 Pull"), (Mode::Fix, "2 Fix nodes"), (Mode::Load, "3 Load faces")] {
            if ui.selectable_label(mode == tool, text).clicked() {
                requests.push(UserRequest::Choose(tool));
            }
        }
    });
}

/// The tables that can be added to the scene and removed from it.
fn tables(ui: &mut Ui, offers: &[TableOffer], requests: &mut Vec<UserRequest>) {
    for (title, is_there) in [("Add:", false), ("Remove:", true)] {
        let mut offers = offers.iter().filter(|offer| offer.is_there == is_there).peekable();
        if offers.peek().is_none() {
            continue;
        }
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(title).color(theme::SECONDARY_TEXT));
            for offer in offers {
                if ui.small_button(offer.name).clicked() {
                    requests.push(UserRequest::Change(Change::Edit(offer.edit.clone())));
                }
            }
        });
    }
}

fn help_text(mode: Mode, turns: bool) -> &'static str {
    match mode {
        Mode::Pull if turns => HELP[0],
        Mode::Pull => HELP[1],
        Mode::Fix => HELP[2],
        Mode::Load => HELP[3],
    }
}

fn figures(ui: &mut Ui, state: &ViewState, requests: &mut Vec<UserRequest>) {
    let snapshot = state.snapshot;
    let row = |ui: &mut Ui, name: &str, value: String| {
        ui.label(RichText::new(name).color(theme::SECONDARY_TEXT));
        ui.label(value);
        ui.end_row();
    };
    Grid::new("numbers").num_columns(2).spacing(vec2(10.0, 3.0)).show(ui, |ui| {
        ui.label(RichText::new("integrator").color(theme::SECONDARY_TEXT));
        if ui.button(snapshot.integrator.replace('_', " ")).on_hover_text("the next one (N)").clicked() {
            requests.push(UserRequest::Send(Command::NextIntegrator));
        }
        ui.end_row();
        row(ui, "time", format!("{:.2} s, step {}", snapshot.time, snapshot.steps));
        let is_timed = snapshot.step_seconds > 0.0;
        let one_step = is_timed.then(|| format!("{} ms", numbers::short(1e3 * snapshot.step_seconds)));
        row(ui, "one step", one_step.unwrap_or_else(|| "…".into()));
        row(ui, "one frame", format!("{} ms", numbers::short(1e3 * state.frame_seconds)));
        row(ui, "speed", speed(snapshot));
        if let Some(critical) = snapshot.critical_time_step {
            row(ui, "stable step", stability(critical));
        }
        if let Some(force) = snapshot.contact_force {
            row(ui, "contact force", contact_force(force, snapshot.weight));
        }
    });
}

/// The longest stable time step, s, of small vibrations.
fn stability(critical: f64) -> String {
    if critical <= 0.0 { "none: unstable at any".into() } else { format!("{} ms", numbers::short(1e3 * critical)) }
}

/// A force beside the weight, both in N.
fn contact_force(force: f64, weight: Option<f64>) -> String {
    let beside = weight.filter(|weight| *weight > 0.0).map(|weight| format!(", {:.2} × the weight", force / weight));
    numbers::quantity(force, "N") + &beside.unwrap_or_default()
}

/// Describes the speed of simulated time, or the reason why the simulation does not run.
fn speed(snapshot: &Snapshot) -> String {
    match snapshot.rate {
        _ if snapshot.stop.is_some() => "stopped".into(),
        _ if snapshot.finished => "finished".into(),
        _ if snapshot.paused => "paused".into(),
        None => "…".into(),
        Some(factor) => pacing::describe(factor),
    }
}

fn help(context: &Context, text: &str) {
    let width = (context.content_rect().width() - 48.0).min(HELP_WIDTH);
    let area = Area::new(Id::new("help")).anchor(Align2::CENTER_BOTTOM, vec2(0.0, -8.0)).interactable(false);
    area.show(context, |ui| {
        let margin = Margin::symmetric(12, 4);
        panel_frame().inner_margin(margin).show(ui, |ui| {
            ui.set_width(width);
            // Spaces within a hint do not break: a line ends between two hints.
            let hints: Vec<_> = text.split("  ·  ").map(|hint| hint.replace(' ', "\u{a0}")).collect();
            ui.label(RichText::new(hints.join("\u{a0}\u{a0}·\u{a0} ")).size(12.0));
        });
    });
}

/// A row that offers a tool.
fn offer(ui: &mut Ui, text: String, button: &str, mode: Mode, requests: &mut Vec<UserRequest>) {
    ui.horizontal(|ui| {
        ui.label(text);
        if ui.button(button).clicked() {
            requests.push(UserRequest::Choose(mode));
        }
    });
}

/// The reason why the last use of a tool had no effect, or else a hint.
fn message(ui: &mut Ui, setup: &Setup, hint: &str) {
    let (text, color) = match &setup.message {
        Some(message) => (&message[..], theme::FAILURE),
        None => (hint, theme::SECONDARY_TEXT),
    };
    ui.label(RichText::new(text).size(12.0).color(color));
}

fn panel_frame() -> Frame {
    Frame::new().fill(theme::PANEL).corner_radius(CornerRadius::same(6)).inner_margin(Margin::same(12))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_simulation_that_does_not_run_has_no_speed() {
        let running = Snapshot { rate: Some(1.0), ..Snapshot::default() };
        assert_eq!(speed(&running), "keeps real time");
        assert_eq!(speed(&Snapshot { paused: true, ..running.clone() }), "paused");
        assert_eq!(speed(&Snapshot { finished: true, ..running }), "finished");
    }
}
