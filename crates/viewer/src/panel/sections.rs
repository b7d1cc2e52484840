//! The sections of the panel, each of which can be closed.

use kiss3d::egui::{CollapsingHeader, RichText, Ui};

use super::request::UserRequest;
use super::rows::{ParameterRows, Section};
use super::save::Save;
use super::{ViewState, boundary, load, plot, solver, timers};
use crate::setup::{Mode, Setup};

/// State of the sections between frames.
#[derive(Default)]
pub struct Sections {
    parameters: ParameterRows,
    save: Save,
    /// The tool for which the sections were opened and closed.
    arranged: Mode,
}

/// Title of a section, and the tools with which it is open at first.
type Title = (&'static str, &'static [Mode]);

const ENERGIES: Title = ("Energies", &[Mode::Pull]);
const MESHING: Title = ("Meshing", &[Mode::Pull]);
const MATERIAL: Title = ("Material", &[Mode::Pull]);
const BOUNDARY: Title = ("Boundary", &[Mode::Pull, Mode::Fix]);
const LOAD: Title = ("Load", &[Mode::Pull, Mode::Load]);
const SOLVER: Title = ("Solver", &[Mode::Pull]);
const TIMERS: Title = ("Timers", &[]);
const SAVE: Title = ("Save", &[Mode::Fix, Mode::Load]);

impl Sections {
    /// Lays out the sections that a simulation has.
    pub fn show(&mut self, ui: &mut Ui, state: &ViewState, setup: &mut Setup, requests: &mut Vec<UserRequest>) {
        let snapshot = state.snapshot;
        let rearranged = (self.arranged != setup.mode).then_some(setup.mode);
        self.arranged = setup.mode;
        let section =
            |ui: &mut Ui, title: Title, body: &mut dyn FnMut(&mut Ui)| collapsing(ui, title, rearranged, body);
        section(ui, ENERGIES, &mut |ui| plot::show(ui, &snapshot.history));
        let scene = snapshot.setup.as_deref();
        let rows = &mut self.parameters;
        for (title, kind) in [
            (MESHING, Section::Meshing),
            (MATERIAL, Section::Material),
            (BOUNDARY, Section::Boundary),
            (LOAD, Section::Load),
            (SOLVER, Section::Solver),
        ] {
            let has_tools = matches!(kind, Section::Boundary | Section::Load | Section::Solver) && scene.is_some();
            if !has_tools && !ParameterRows::has(kind, snapshot) {
                continue;
            }
            section(ui, title, &mut |ui| {
                if let (Section::Solver, Some(scene)) = (kind, scene) {
                    solver::show(ui, &scene.scene, snapshot.integrator, requests);
                }
                rows.show(ui, kind, state, requests);
                match (kind, scene) {
                    (Section::Boundary, Some(scene)) => boundary::show(ui, scene, setup, state, requests),
                    (Section::Load, Some(scene)) => load::show(ui, scene, setup, state, requests),
                    _ => {}
                }
            });
        }
        section(ui, TIMERS, &mut |ui| timers::show(ui, snapshot));
        if scene.is_some() {
            section(ui, SAVE, &mut |ui| self.save.show(ui, state.name, snapshot, requests));
        }
    }
}

/// A section; `rearranged` is the tool that was just chosen, for which it opens or closes.
fn collapsing(ui: &mut Ui, (title, tools): Title, rearranged: Option<Mode>, body: &mut dyn FnMut(&mut Ui)) {
    let header = CollapsingHeader::new(RichText::new(title).strong()).default_open(tools.contains(&Mode::Pull));
    header.open(rearranged.map(|mode| tools.contains(&mode))).show_unindented(ui, body);
}
