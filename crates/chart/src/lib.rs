//! Self-contained SVG charts and HTML pages: points and lines on two axes, dots in rows, heat maps, bars, histograms, regions, triangles in space.
//!
//! A [`Picture`] is drawn inline in a page that includes [`STYLE`], or written as a file of its own. Values that are not finite, or
//! not positive on a logarithmic axis, are left out: no picture contains a NaN.
//!
//! ```
//! let picture = fem_chart::histogram("share of elements", &[0.1, 0.25, 0.3, 0.9]);
//! assert!(picture.standalone().contains("<svg"));
//! ```

#![deny(missing_docs)]

mod axis;
mod chart;
mod heat_map;
mod histogram;
pub mod page;
mod picture;
mod region;
mod rows;
mod svg;
mod triangles;

pub use axis::{Axis, Scale};
pub use chart::{Chart, Dot, Guide, Series};
pub use heat_map::{Cell, Curve, HeatMap, Shade};
pub use histogram::{distribution, histogram};
pub use picture::{Picture, grid};
pub use region::region;
pub use rows::{Bar, DotRow, bars, dot_rows};
pub use triangles::{triangles, triangles_in_frame};

/// Colours of all pictures, light and dark.
pub const STYLE: &str = include_str!("picture.css");

/// Number of colours; the classes `k0` to `k8` of [`STYLE`].
pub const COLOURS: usize = 9;

/// Number of shapes of dots: circle, square, triangle, diamond, cross.
pub const SHAPES: usize = 5;

#[cfg(test)]
mod tests;
