//! The legend of colours, for window and pictures.

use kiss3d::egui::{Align2, Color32, Context, FontId, Id, LayerId, Order, Rect, pos2, vec2};

use super::color_scale::{ColorScale, color};
use super::{numbers, theme};

// Logical pixels.
const SIZE: [f32; 2] = [284.0, 72.0];
const BAR: [f32; 2] = [240.0, 14.0];
const MARGIN: f32 = 14.0;
const TICKS: usize = 4; // intervals between numbers

/// Paints the legend of a scale at the upper right. It is not a widget, because a widget needs a frame to find its size, and a picture
/// has only one frame.
pub fn show(context: &Context, scale: &ColorScale) {
    let painter = context.layer_painter(LayerId::new(Order::Middle, Id::new("legend")));
    let window = context.content_rect();
    let frame = Rect::from_min_size(pos2(window.right() - MARGIN - SIZE[0], window.top() + MARGIN), SIZE.into());
    painter.rect_filled(frame, 6.0, theme::PANEL);
    let unit = scale.field.unit();
    let unit = if unit.is_empty() { String::new() } else { format!(" ({unit})") };
    let title = format!("{}{unit}", scale.field.label());
    let bar = Rect::from_min_size(frame.min + vec2(0.5 * (SIZE[0] - BAR[0]), 30.0), BAR.into());
    let corner = pos2(bar.left(), frame.top() + 7.0);
    painter.text(corner, Align2::LEFT_TOP, title, FontId::proportional(14.0), theme::TEXT);
    let colors = BAR[0] as usize;
    for i in 0..colors {
        let [r, g, b] = color((i as f32 + 0.5) / colors as f32);
        let strip = Rect::from_min_size(bar.min + vec2(i as f32, 0.0), vec2(1.5, BAR[1]));
        painter.rect_filled(strip, 0.0, Color32::from_rgb(r, g, b));
    }
    for tick in 0..=TICKS {
        let share = tick as f32 / TICKS as f32;
        let x = bar.left() + share * bar.width();
        let value = scale.low + f64::from(share) * (scale.high - scale.low);
        painter.vline(x, bar.bottom()..=bar.bottom() + 4.0, (1.0, theme::TEXT));
        let at = pos2(x, bar.bottom() + 5.0);
        painter.text(at, Align2::CENTER_TOP, numbers::short(value), FontId::proportional(11.0), theme::TEXT);
    }
}
