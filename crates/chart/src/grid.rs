//! Several pictures on one.

use maud::{Markup, html};

use crate::Picture;
use crate::svg::text;

/// Height of the title of each picture, pixels.
const TITLE: f64 = 22.0;

/// Space between pictures, pixels.
const GAP: f64 = 16.0;

/// Pictures in rows of `columns`, each under its label; their legends are left out.
pub fn grid(label: &str, columns: usize, pictures: &[Picture]) -> Picture {
    let (mut parts, mut y, mut width) = (Vec::<Markup>::new(), 0.0, 0.0_f64);
    for row in pictures.chunks(columns.max(1)) {
        let mut x = 0.0;
        for picture in row {
            let (w, h) = picture.size;
            let (left, top) = (x, y + TITLE);
            parts.push(html! {
                (text("name", "start", (left + 10.0, top - 7.0), &picture.label))
                svg x=(left) y=(top) width=(w) height=(h) viewBox={ "0 0 " (w) " " (h) } { (picture.inner) } "\n"
            });
            x += w + GAP;
        }
        width = width.max(x - GAP);
        y += TITLE + GAP + row.iter().map(|picture| picture.size.1).fold(0.0, f64::max);
    }
    let inner = html! { @for part in parts { (part) } };
    Picture { size: (width.max(1.0), y.max(1.0)), label: label.to_owned(), inner, legend: Vec::new() }
}
