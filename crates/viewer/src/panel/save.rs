//! The row of the panel that saves the scene.

use std::path::{Path, PathBuf};

use kiss3d::egui::{RichText, TextEdit, Ui};

use super::request::UserRequest;
use crate::picture::theme;
use crate::worker::{Command, Snapshot};

/// The path that is proposed or typed, and the last answer to it.
#[derive(Default)]
pub struct Save {
    path: Option<String>,
    answer: Option<Result<PathBuf, String>>,
}

impl Save {
    /// Lays out the path, the button and the answer.
    pub fn show(&mut self, ui: &mut Ui, name: &str, snapshot: &Snapshot, requests: &mut Vec<UserRequest>) {
        if snapshot.saved != self.answer {
            self.answer.clone_from(&snapshot.saved);
            if matches!(self.answer, Some(Ok(_))) {
                self.path = None; // the next file has another name
            }
        }
        let path = self.path.get_or_insert_with(|| free_name(name));
        ui.horizontal(|ui| {
            let is_asked = ui.button("Save scene").clicked();
            ui.add(TextEdit::singleline(path).desired_width(f32::INFINITY));
            if is_asked {
                requests.push(UserRequest::Send(Command::Save(PathBuf::from(path.trim()))));
            }
        });
        match &self.answer {
            Some(Ok(path)) => {
                let full = std::path::absolute(path).unwrap_or(path.clone());
                ui.label(RichText::new(format!("saved: {}", full.display())).size(12.0));
            }
            Some(Err(message)) => {
                ui.label(RichText::new(message).size(12.0).color(theme::FAILURE));
            }
            None => {}
        }
    }
}

/// The first name of a file for a scene that does not exist in the current folder.
fn free_name(scene: &str) -> String {
    let names = (1..).map(|number| match number {
        1 => format!("{scene}-window.toml"),
        number => format!("{scene}-window-{number}.toml"),
    });
    names.into_iter().find(|name| !Path::new(name).exists()).unwrap_or_default()
}
