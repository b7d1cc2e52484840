//! The picture that a flat body was made from, as its texture.

use std::path::PathBuf;

/// A picture, and where an undeformed flat body lies in it.
#[derive(Clone, Debug, PartialEq)]
pub struct PicturePlace {
    /// A PNG or JPEG file.
    pub file: PathBuf,
    /// Place of the body's origin, in pixels from the lower left.
    pub origin: [f64; 2],
    /// Side of a pixel, m.
    pub pixel: f64,
}

impl PicturePlace {
    /// The place of an undeformed point `(x, y)` (m), in pixels from the lower left.
    pub fn of(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + x / self.pixel, self.origin[1] + y / self.pixel]
    }
}
