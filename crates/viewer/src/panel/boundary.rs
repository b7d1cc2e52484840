//! The section of the panel for Dirichlet conditions: the brush and the painted condition.

use kiss3d::egui::{DragValue, Slider, Ui};

use super::request::UserRequest;
use super::rows::label;
use super::{ViewState, message, offer};
use crate::editing::change::Change;
use crate::editing::editor::SceneSetup;
use crate::editing::edits::{self, Motion};
use crate::picture::numbers;
use crate::setup::brush::Target;
use crate::setup::{Mode, Setup};

/// Ends of the range of the brush's radius, in radii of the body.
const RADII: (f32, f32) = (0.005, 1.0);

/// Lays out the section below the sliders of the scene.
pub fn show(ui: &mut Ui, scene: &SceneSetup, setup: &mut Setup, state: &ViewState, requests: &mut Vec<UserRequest>) {
    if setup.mode != Mode::Fix {
        let text = format!("fixed: {} nodes", scene.conditions.fixed().len());
        return offer(ui, text, "Paint nodes", Mode::Fix, requests);
    }
    let body = setup.body(state.shape);
    let (mut radius, size) = (setup.brush.radius_on(body), body.radius);
    ui.horizontal(|ui| {
        label(ui, "brush radius (m)");
        let range = RADII.0 * size..=RADII.1 * size;
        let slider = Slider::new(&mut radius, range).logarithmic(true).custom_formatter(|r, _| numbers::short(r));
        if ui.add(slider).changed() {
            setup.brush.radius = Some(radius);
        }
    });
    ui.checkbox(&mut setup.brush.erases, "erase (Ctrl does the other thing)");
    targets(ui, scene, setup);
    vector(ui, scene, setup, state.shape.mesh.dimension(), requests);
    let hint = "Drag over the body: nodes of the surface in a ball of this radius. The motion starts again.";
    message(ui, setup, hint);
}

/// The choice of the condition that is painted.
fn targets(ui: &mut Ui, scene: &SceneSetup, setup: &mut Setup) {
    let count = scene.scene.prescribed.len();
    let before = setup.brush.target;
    ui.radio_value(&mut setup.brush.target, Target::Fixed, format!("fixed: {} nodes", scene.conditions.fixed().len()));
    for number in 0..count {
        let nodes = scene.conditions.prescribed(number).len();
        ui.radio_value(&mut setup.brush.target, Target::Prescribed(number), format!("motion {number}: {nodes} nodes"));
    }
    ui.horizontal(|ui| {
        for (text, motion) in [("New displacement", Motion::Displacement), ("New velocity", Motion::Velocity)] {
            let is_chosen = setup.brush.new.is_some_and(|(chosen, _)| chosen == motion);
            if ui.selectable_label(is_chosen, text).clicked() {
                setup.brush.new = Some((motion, [0.0; 3]));
                setup.brush.target = Target::Prescribed(count);
            }
        }
    });
    if before != setup.brush.target && setup.brush.target != Target::Prescribed(count) {
        setup.brush.new = None;
    }
}

/// The three numbers of a prescribed motion.
fn vector(ui: &mut Ui, scene: &SceneSetup, setup: &mut Setup, dimension: usize, requests: &mut Vec<UserRequest>) {
    let Target::Prescribed(number) = setup.brush.target else { return };
    let table = scene.scene.prescribed.get(number);
    let own = table.and_then(|table| {
        let displacement = table.displacement.filter(|_| table.rotation.is_none());
        let velocity = table.velocity.map(|vector| (Motion::Velocity, vector));
        velocity.or(displacement.map(|vector| (Motion::Displacement, vector)))
    });
    let Some((motion, mut vector)) = own.or(setup.brush.new.filter(|_| table.is_none())) else {
        ui.label("a rotation, which the scene file changes");
        return;
    };
    let (unit, name) = match motion {
        Motion::Displacement => ("m", "displacement"),
        Motion::Velocity => ("m/s", "velocity"),
    };
    let mut is_changed = false;
    ui.horizontal(|ui| {
        label(ui, &format!("{name} ({unit})"));
        for number in &mut vector[..dimension] {
            is_changed |= ui.add(DragValue::new(number).speed(0.01)).changed();
        }
    });
    match table {
        Some(_) if is_changed => {
            let edit = edits::prescribed_vector(number, motion, vector);
            requests.push(UserRequest::Change(Change::Edit(edit)));
        }
        None => setup.brush.new = Some((motion, vector)),
        Some(_) => {}
    }
}
