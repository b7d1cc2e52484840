//! Colours, line widths and the style of text.

use kiss3d::color::Color;
use kiss3d::egui::{self, Color32, Theme};

// Colours of the scene are linear, and look brighter on the screen.

/// The display surface.
pub const CLAY: Color = Color::new(0.62, 0.26, 0.14, 1.0);
/// The simulation mesh, paler so that its edges stand out.
pub const MESH: Color = Color::new(0.66, 0.42, 0.28, 1.0);
/// Edges of the simulation mesh.
pub const EDGE: Color = Color::new(0.05, 0.03, 0.02, 1.0);
/// Width of an edge, logical pixels.
pub const EDGE_WIDTH: f32 = 1.2;
/// The floor near the body.
pub const FLOOR: Color = Color::new(0.80, 0.77, 0.73, 1.0);
/// The floor in the body's shadow.
pub const SHADOW: Color = Color::new(0.55, 0.53, 0.52, 1.0);
/// The background of the scene.
pub const BACKGROUND: Color = Color::new(0.78, 0.83, 0.88, 1.0);
/// Dragged nodes and the line to the mouse.
pub const DRAG: Color = Color::new(0.02, 0.12, 0.55, 1.0);

/// Kinetic energy in the plot.
pub const KINETIC: Color32 = Color32::from_rgb(0x1f, 0x6f, 0xb5);
/// Potential energy in the plot.
pub const POTENTIAL: Color32 = Color32::from_rgb(0xc4, 0x5a, 0x1b);
/// Total energy in the plot.
pub const TOTAL: Color32 = Color32::from_rgb(0x22, 0x22, 0x22);
/// Grid lines of the plot.
pub const GRID: Color32 = Color32::from_rgb(0xd5, 0xd5, 0xd5);
/// Text and numbers.
pub const TEXT: Color32 = Color32::from_rgb(0x2a, 0x2a, 0x2a);
/// Labels.
pub const SECONDARY_TEXT: Color32 = Color32::from_rgb(0x60, 0x60, 0x60);
/// Background of a failure's banner.
pub const FAILURE: Color32 = Color32::from_rgb(0xb3, 0x26, 0x1e);
/// Background of the panel.
pub const PANEL: Color32 = Color32::from_rgba_premultiplied(0xec, 0xec, 0xec, 0xee);

/// Lines of obstacles.
pub const OBSTACLE: Color = Color::new(0.10, 0.12, 0.16, 1.0);
/// Grid lines of obstacles' faces.
pub const GRID_LINE: Color = Color::new(0.42, 0.46, 0.52, 1.0);
/// Faces of obstacles.
pub const FACE: Color = Color::new(0.62, 0.66, 0.72, 0.45);
/// Arrows of contact forces.
pub const FORCE: Color = Color::new(0.62, 0.02, 0.02, 1.0);

/// Nodes that do not move, and the brush that paints them.
pub const FIXED: Color = Color::new(0.0, 0.22, 0.05, 1.0);
/// Nodes with a prescribed motion.
pub const PRESCRIBED: Color = Color::new(0.25, 0.02, 0.42, 1.0);
/// Picked faces and their load.
pub const PICKED: Color = Color::new(0.95, 0.42, 0.02, 1.0);
/// Loads on faces that are not picked.
pub const LOAD: Color = Color::new(0.55, 0.16, 0.02, 1.0);

/// Dark text on a light background.
pub fn set_style(context: &egui::Context) {
    context.set_theme(Theme::Light);
    context.all_styles_mut(|style| {
        style.visuals.override_text_color = Some(TEXT);
        style.interaction.selectable_labels = false;
        for (kind, font) in &mut style.text_styles {
            font.size = match kind {
                egui::TextStyle::Small => 12.0,
                egui::TextStyle::Heading => 20.0,
                _ => 14.0,
            };
        }
    });
}
