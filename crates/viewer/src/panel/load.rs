//! The section of the panel for loads: picked faces and their traction.

use kiss3d::egui::{DragValue, Ui};

use super::request::UserRequest;
use super::rows::{label, number_slider};
use super::{ViewState, message, offer};
use crate::editing::editor::SceneSetup;
use crate::picture::numbers;
use crate::setup::{Mode, Setup, loads};

/// Lays out the section below the sliders of the scene.
pub fn show(ui: &mut Ui, scene: &SceneSetup, setup: &mut Setup, state: &ViewState, requests: &mut Vec<UserRequest>) {
    if setup.mode != Mode::Load {
        let text = format!("loads on faces: {}", scene.scene.traction.len());
        return offer(ui, text, "Pick faces", Mode::Load, requests);
    }
    ui.horizontal(|ui| {
        ui.checkbox(&mut setup.loads.grows, "the smooth part, within");
        ui.add(DragValue::new(&mut setup.loads.angle).range(1.0..=180.0).suffix("°").max_decimals(0));
    });
    list(ui, scene, setup, requests);
    if setup.loads.is_used() {
        traction(ui, scene, setup, requests);
    }
    let kind = if state.shape.mesh.dimension() == 2 { "an edge of the outline" } else { "a face" };
    let hint = format!(
        "Click on {kind}; Ctrl adds and removes. Drag a picked one along its normal to pull or push it. Smooth parts and the normal of \
         a load that keeps its direction are those of the undeformed body."
    );
    message(ui, setup, &hint);
}

/// The loads of the scene, to be picked.
fn list(ui: &mut Ui, scene: &SceneSetup, setup: &Setup, requests: &mut Vec<UserRequest>) {
    for (number, table) in scene.scene.traction.iter().enumerate() {
        let force = match (table.pressure, table.force_per_area) {
            (Some(pressure), _) => format!("pressure {}", numbers::quantity(pressure, "Pa")),
            (_, Some(force)) => format!("({}) Pa", force.map(numbers::short).join(", ")),
            (None, None) => String::new(),
        };
        let faces = scene.conditions.loaded.get(number).map_or(0, Vec::len);
        let text = format!("load {number}: {faces} faces, {force}");
        if ui.selectable_label(setup.loads.current == Some(number), text).clicked() {
            requests.push(UserRequest::ChooseLoad(number));
        }
    }
}

/// The traction on the picked faces.
fn traction(ui: &mut Ui, scene: &SceneSetup, setup: &mut Setup, requests: &mut Vec<UserRequest>) {
    let loads = &mut setup.loads;
    let range = loads::range(scene);
    ui.label(format!("{} faces picked; traction along the outward normal (Pa)", loads.faces.len()));
    let mut is_changed = false;
    ui.horizontal(|ui| {
        label(ui, "− pushes, + pulls");
        is_changed |= ui.add(number_slider(&mut loads.traction, -range..=range)).changed();
    });
    let is_loaded = loads.current.is_some();
    ui.horizontal(|ui| {
        is_changed |= ui.radio_value(&mut loads.follows, true, "follows the surface").changed() && is_loaded;
        is_changed |= ui.radio_value(&mut loads.follows, false, "keeps its direction").changed() && is_loaded;
    });
    if is_changed {
        requests.push(UserRequest::Load);
    }
    if is_loaded && ui.button("Remove load").clicked() {
        requests.push(UserRequest::RemoveLoad);
    }
}
