//! Triangles inside the region of a picture.

mod contour;
mod corners;
#[cfg(feature = "pictures")]
mod decode;
mod features;
mod lattice;
mod mesh;
mod region;
mod resample;
mod size;

pub use contour::contours;
#[cfg(feature = "pictures")]
pub use decode::{PictureError, Pixels, read_picture, read_pixels};
pub use mesh::{FromPicture, PictureMesh, PictureMeshError, mesh_picture};

/// Coverage of each pixel by a region.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Coverage of each pixel by the region, from 0 to 255, row by row from the upper left.
    pub coverage: Vec<u8>,
}

impl Picture {
    /// Coverage of the pixel `i` from the left and `j` from below; zero beside the picture.
    pub fn at(&self, i: isize, j: isize) -> u8 {
        if i < 0 || j < 0 || i >= self.width as isize || j >= self.height as isize {
            return 0;
        }
        self.coverage[(self.height - 1 - j as usize) * self.width + i as usize]
    }

    fn is_inside(&self, i: isize, j: isize) -> bool {
        self.at(i, j) > 127
    }

    /// The remark that no pixel lies outside of the region, if so: its opacity may be meant to be full.
    pub fn warning(&self) -> Option<String> {
        let least = self.coverage.iter().min().filter(|least| **least > 127)?;
        Some(format!(
            "no pixel lies outside of the region, whose least opacity is {least} of 255, so nothing is cut out of the picture; make the \
             background transparent"
        ))
    }

    /// Area of the region, in pixels.
    pub fn area(&self) -> f64 {
        self.coverage.iter().map(|&coverage| u64::from(coverage)).sum::<u64>() as f64 / 255.0
    }
}
