//! The rows of the panel that change parameters.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use fem_model::simulation::{Parameter, least_stable_substeps};
use kiss3d::egui::{Align2, ComboBox, FontId, Sense, Slider, SliderClamping, Ui, vec2};

use super::ViewState;
use super::request::UserRequest;
use crate::editing::change::Change;
use crate::picture::{numbers, theme};
use crate::worker::{Command, Snapshot};

// Logical pixels.
const LABEL_WIDTH: f32 = 128.0; // of a parameter's name
const VALUE_WIDTH: f32 = 68.0;

/// Time for which a slider keeps its dragged value while the simulation has not answered.
const ANSWER_TIME: Duration = Duration::from_millis(600);

/// Parameters that stand before the others of their section, which follow those of the scene.
const FIRST: [&str; 3] = ["substeps", "dt", "density"];

/// Parameters that are counts.
const WHOLE: [&str; 3] = ["improve", "cells", "substeps"];

/// A section of the panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// The mesh.
    Meshing,
    /// The material.
    Material,
    /// Dirichlet conditions and obstacles.
    Boundary,
    /// External forces.
    Load,
    /// Time steps, solvers and damping.
    Solver,
}

impl Section {
    /// The section of a parameter.
    pub fn of(key: &str) -> Self {
        match key {
            "improve" | "edge" | "cells" | "scale" => Self::Meshing,
            "friction" => Self::Boundary,
            "gravity" | "drag" => Self::Load,
            "substeps" | "dt" | "alpha" | "beta" => Self::Solver,
            _ => Self::Material,
        }
    }
}

/// State of the rows between frames.
#[derive(Default)]
pub struct ParameterRows {
    dragged: Option<(&'static str, f64, Instant)>,
}

impl ParameterRows {
    /// Returns true if a section has rows.
    pub fn has(section: Section, snapshot: &Snapshot) -> bool {
        let mut keys = snapshot.scene_parameters.iter().chain(&snapshot.parameters).map(|parameter| parameter.key);
        keys.any(|key| Section::of(key) == section) || section == Section::Meshing && snapshot.object.is_some()
    }

    /// A row for the picture and each parameter of a section.
    pub fn show(&mut self, ui: &mut Ui, section: Section, state: &ViewState, requests: &mut Vec<UserRequest>) {
        let snapshot = state.snapshot;
        if let Some(object) = snapshot.object.as_ref().filter(|_| section == Section::Meshing) {
            choice(ui, object, state.objects, requests);
        }
        let of_scene = snapshot.scene_parameters.iter().map(|parameter| (parameter, true));
        let of_simulation = snapshot.parameters.iter().map(|parameter| (parameter, false));
        let all = of_scene.chain(of_simulation);
        let mut rows: Vec<_> = all.filter(|(parameter, _)| Section::of(parameter.key) == section).collect();
        rows.sort_by_key(|(parameter, _)| FIRST.iter().position(|key| *key == parameter.key).unwrap_or(FIRST.len()));
        for (parameter, is_of_scene) in rows {
            let name = name(parameter, snapshot.dt, snapshot.critical_time_step);
            let Some(value) = self.slider(ui, parameter, &name, snapshot.is_building) else { continue };
            requests.push(match is_of_scene {
                true => UserRequest::Change(Change::Number(parameter.key, value)),
                false => UserRequest::Send(Command::Set(parameter.key, value)),
            });
        }
    }

    /// A row with a slider; returns the value that the user gives.
    fn slider(&mut self, ui: &mut Ui, parameter: &Parameter, name: &str, is_building: bool) -> Option<f64> {
        self.dragged.take_if(|(_, _, since)| since.elapsed() > ANSWER_TIME && !is_building);
        let mut value = match self.dragged {
            Some((key, value, _)) if key == parameter.key => value,
            _ => parameter.value,
        };
        let (low, high) = parameter.range;
        let changed = ui.horizontal(|ui| {
            label(ui, name);
            ui.spacing_mut().slider_width = (ui.available_width() - VALUE_WIDTH).max(40.0);
            let slider = number_slider(&mut value, low..=high).logarithmic(parameter.logarithmic);
            let slider = if WHOLE.contains(&parameter.key) { slider.integer() } else { slider };
            ui.add(slider).changed()
        });
        changed.inner.then(|| {
            self.dragged = Some((parameter.key, value, Instant::now()));
            value
        })
    }
}

/// The name of a parameter with its unit; beside substeps, their smallest number with which small vibrations are stable, for steps of `dt`
/// and an explicit method of this critical time step, s.
fn name(parameter: &Parameter, dt: f64, critical: Option<f64>) -> String {
    match (parameter.key, critical) {
        ("substeps", Some(critical)) if critical > 0.0 => {
            format!("{}, at least {}", parameter.label, least_stable_substeps(dt, critical))
        }
        _ if parameter.unit.is_empty() => parameter.label.to_owned(),
        _ => format!("{} ({})", parameter.label, parameter.unit),
    }
}

/// The name of a row, as wide in all rows.
pub fn label(ui: &mut Ui, text: &str) {
    let (place, _) = ui.allocate_exact_size(vec2(LABEL_WIDTH, 18.0), Sense::hover());
    let font = FontId::proportional(12.5);
    ui.painter().text(place.left_center(), Align2::LEFT_CENTER, text, font, theme::TEXT);
}

/// A slider whose number is shown and typed with three digits.
pub fn number_slider(value: &mut f64, range: RangeInclusive<f64>) -> Slider<'_> {
    Slider::new(value, range)
        .update_while_editing(false) // a number that is being typed has no meaning yet
        .clamping(SliderClamping::Never) // the simulation refuses a typed value outside, with a message
        .custom_formatter(|value, _| numbers::short(value))
        .custom_parser(numbers::parse)
}

/// The choice of the picture that the body is made from.
fn choice(ui: &mut Ui, object: &Path, objects: &[PathBuf], requests: &mut Vec<UserRequest>) {
    let name = |path: &Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    ui.horizontal(|ui| {
        label(ui, "object");
        ComboBox::from_id_salt("object").selected_text(name(object)).show_ui(ui, |ui| {
            for other in objects {
                let is_present = name(other) == name(object);
                if ui.selectable_label(is_present, name(other)).clicked() && !is_present {
                    requests.push(UserRequest::Change(Change::Object(other.clone())));
                }
            }
        });
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_stable_number_of_substeps_stands_beside_the_chosen_one() {
        let substeps = Parameter {
            key: "substeps",
            label: "substeps",
            unit: "",
            value: 4.0,
            range: (1.0, 9.0),
            logarithmic: true,
        };
        assert_eq!(name(&substeps, 1.0 / 60.0, Some(1.2e-3)), "substeps, at least 14");
        assert_eq!(name(&substeps, 1.0 / 60.0, None), "substeps");
        let dt = Parameter::dt(0.01, (0.0, 1.0));
        assert_eq!(name(&dt, 0.01, Some(1.2e-3)), "time step (s)");
    }
}
