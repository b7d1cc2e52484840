//! The section of the panel for the method: integrator, Newton's method, linear solver, iterations.

use fem_model::{Integrator, Preconditioner, SolverKind};
use fem_scene::Scene;
use fem_scene::tables::{IterationsTable, NewtonTable, SolverTable};
use kiss3d::egui::{ComboBox, DragValue, Ui};

use super::request::UserRequest;
use super::rows::label;
use crate::editing::change::{Change, Edit};
use crate::editing::edits;

/// Lays out the choices that `scene` has with its integrator, which is the one in use.
pub fn show(ui: &mut Ui, scene: &Scene, running: &str, requests: &mut Vec<UserRequest>) {
    let method = Integrator::from_name(running).unwrap_or(scene.time.integrator);
    let mut push = |edit: Edit| requests.push(UserRequest::Change(Change::Edit(edit)));
    let kinds = Integrator::ALL.map(|kind| (kind.name().replace('_', " "), kind));
    if let Some(kind) = choice(ui, "integrator", &kinds, &method) {
        push(edits::integrator(scene, kind));
    }
    // Tables belong to the integrator of the scene: that which N has chosen has defaults.
    if method != scene.time.integrator {
        return;
    }
    if method.has_newton() {
        newton(ui, scene, &mut push);
    }
    if method.has_matrix() && !method.is_iterated() {
        linear(ui, scene, &mut push);
    }
    if method.is_iterated() {
        iterations(ui, scene, method, &mut push);
    }
}

fn newton(ui: &mut Ui, scene: &Scene, push: &mut impl FnMut(Edit)) {
    let mut table: NewtonTable = scene.newton.clone().unwrap_or_default();
    let count = count(ui, "Newton iterations", &mut table.max_iterations, 50);
    if tolerance(ui, "Newton tolerance", &mut table.tolerance, 1e-8) || count {
        push(edits::of_method("newton", Some(&table)));
    }
}

fn linear(ui: &mut Ui, scene: &Scene, push: &mut impl FnMut(Edit)) {
    let mut kinds = vec![("by size".to_owned(), None)];
    kinds.extend(SolverKind::FACTS.map(|(kind, name, _)| (name.replace('_', " "), Some(kind))));
    let present = scene.solver.clone();
    if let Some(kind) = choice(ui, "linear solver", &kinds, &present.as_ref().map(|table| table.kind)) {
        let table = kind.map(|kind| SolverTable {
            kind,
            tolerance: present.as_ref().and_then(|table| table.tolerance),
            preconditioner: None,
            precision: None,
        });
        return push(edits::of_method("solver", table.as_ref()));
    }
    let Some(mut table) = present else { return };
    if table.kind == SolverKind::Pcg {
        let kinds = Preconditioner::FACTS.map(|(kind, name, _)| (name.replace('_', " "), kind));
        if let Some(kind) = choice(ui, "preconditioner", &kinds, &table.preconditioner.unwrap_or_default()) {
            table.preconditioner = Some(kind);
            push(edits::of_method("solver", Some(&table)));
        }
    }
    let is_direct = matches!(table.kind, SolverKind::Cholesky | SolverKind::Lu);
    if !is_direct && tolerance(ui, "relative residual", &mut table.tolerance, 1e-5) {
        push(edits::of_method("solver", Some(&table)));
    }
}

fn iterations(ui: &mut Ui, scene: &Scene, method: Integrator, push: &mut impl FnMut(Edit)) {
    let mut table: IterationsTable = scene.iterations.clone().unwrap_or_default();
    let mut is_changed = count(ui, "iterations", &mut table.count, 20);
    is_changed |= tolerance(ui, "tolerance", &mut table.tolerance, 1e-6);
    match method {
        Integrator::Vbd => is_changed |= share(ui, "acceleration", &mut table.acceleration, 0.9),
        Integrator::Pbd => is_changed |= share(ui, "stiffness (0 to 1)", &mut table.stiffness, 1.0),
        _ => {}
    }
    if is_changed {
        push(edits::of_method("iterations", Some(&table)));
    }
}

/// A row with a list; returns another choice than the present one.
fn choice<T: Copy + PartialEq>(ui: &mut Ui, name: &str, kinds: &[(String, T)], present: &T) -> Option<T> {
    let text = kinds.iter().find(|(_, kind)| kind == present).map_or("", |(text, _)| text);
    let mut chosen = None;
    ui.horizontal(|ui| {
        label(ui, name);
        ComboBox::from_id_salt(name).selected_text(text).width(160.0).height(420.0).show_ui(ui, |ui| {
            for (text, kind) in kinds {
                if ui.selectable_label(kind == present, text).clicked() && kind != present {
                    chosen = Some(*kind);
                }
            }
        });
    });
    chosen
}

/// A row with a number that may have its default; returns whether the user has changed it. `first` is the value when it is switched on.
fn optional<T: Copy>(
    ui: &mut Ui,
    name: &str,
    value: &mut Option<T>,
    first: T,
    number: impl FnOnce(&mut Ui, &mut T) -> bool,
) -> bool {
    let mut is_changed = false;
    ui.horizontal(|ui| {
        label(ui, name);
        let mut is_given = value.is_some();
        let text = if is_given { "" } else { "default" };
        if ui.checkbox(&mut is_given, text).changed() {
            *value = is_given.then_some(first);
            is_changed = true;
        } else if let Some(value) = value {
            is_changed = number(ui, value);
        }
    });
    is_changed
}

fn count(ui: &mut Ui, name: &str, value: &mut Option<usize>, first: usize) -> bool {
    optional(ui, name, value, first, |ui, count| {
        ui.add(DragValue::new(count).range(1..=10_000).update_while_editing(false)).changed()
    })
}

fn tolerance(ui: &mut Ui, name: &str, value: &mut Option<f64>, first: f64) -> bool {
    optional(ui, name, value, first, |ui, tolerance| {
        let shown = DragValue::new(tolerance).speed(0.0).range(1e-15..=0.99).update_while_editing(false);
        ui.add(shown.custom_formatter(|value, _| format!("{value:.0e}"))).changed()
    })
}

fn share(ui: &mut Ui, name: &str, value: &mut Option<f64>, first: f64) -> bool {
    optional(ui, name, value, first, |ui, share| {
        ui.add(DragValue::new(share).speed(0.005).range(0.0..=1.0).update_while_editing(false)).changed()
    })
}
