//! From a picture to a mesh: contours, sizes, boundary points, constrained Delaunay triangulation, refinement, smoothing.

use std::time::{Duration, Instant};

use nalgebra::Vector2;
use thiserror::Error;

use super::region::Region;
use super::{Picture, contours};
use crate::Mesh;
use crate::generate::odt::{OdtStep, relax};
use crate::generate::outline::Curve;

/// Largest number of triangles.
const MOST: f64 = 1e8;
/// Largest number of places where a contour passes between two pixels, and of contours.
const MOST_CROSSINGS: usize = 400_000;
const MOST_CONTOURS: usize = 2_000;
/// Contours around a smaller area are specks, square pixels.
const SPECK: f64 = 2.0;

/// Circumradius over shortest edge above which a triangle is smoothed; an equilateral one has 0.577.
const MOVED_ABOVE: f64 = 0.7;

/// Options of [`mesh_picture`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FromPicture {
    /// Mean length of an edge, m. The number of triangles is the area over that of an equilateral triangle with this edge.
    pub edge: f64,
    /// Height of the region, m.
    pub height: f64,
    /// Number of iterations of the smoothing.
    pub improve: usize,
}

/// A mesh of a picture's region. Its lower left corner is the origin.
#[derive(Clone, Debug)]
pub struct PictureMesh {
    /// Triangles, counter-clockwise, m.
    pub mesh: Mesh<2, 3>,
    /// The contours of the picture, m, with the region to their left; corners are rounded as the pixels round them.
    pub contours: Vec<Vec<Vector2<f64>>>,
    /// Side of a pixel, m.
    pub pixel: f64,
    /// Place of the mesh's origin in the picture, in pixels from the lower left.
    pub origin: Vector2<f64>,
    /// Area of the region as the picture's pixels cover it, m².
    pub area: f64,
    /// Number of triangles that the edge asks for.
    pub wish: f64,
    /// Measures before the smoothing and after each of its iterations.
    pub steps: Vec<OdtStep>,
    /// Number of contours around less than two pixels, which are left out.
    pub specks: usize,
    /// Time from the shape and the sizes of the boundary to the mesh.
    pub meshing: Duration,
}

/// Reason why a picture has no mesh.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)] // the messages are the documentation of the fields
pub enum PictureMeshError {
    /// No pixel is inside.
    #[error("the picture has no region: no pixel is opaque (or dark); check the picture")]
    Empty,
    /// The edge or the height is no length.
    #[error("{what} of {length} m; give a length above 0")]
    Length { what: &'static str, length: f64 },
    /// The edge is longer than the region.
    #[error("an edge of {edge} m is longer than the region, which measures {} × {} m; take shorter edges", size[0], size[1])]
    TooCoarse { edge: f64, size: [f64; 2] },
    /// Too many triangles.
    #[error(
        "with edges of {edge} m the region would have {count:.1e} triangles, and {most:.0e} is the most; take longer edges"
    )]
    TooFine { edge: f64, count: f64, most: f64 },
    /// The picture is no silhouette.
    #[error("the picture has {count} {what}, and {most} is the most; give it a plain background, or blur it")]
    TooIntricate { count: usize, what: &'static str, most: usize },
}

/// Triangles inside the region of a picture, with about the edges of the options. Where the contour is curved or the region thin, edges are shorter,
/// and longer elsewhere, so that the number of triangles is as the edge asks for; a contour that needs more triangles gets them.
///
/// # Errors
/// An empty picture, one that is no silhouette, edges too long or too short for the region.
pub fn mesh_picture(picture: &Picture, options: FromPicture) -> Result<PictureMesh, PictureMeshError> {
    let FromPicture { edge, height, improve } = options;
    for (what, length) in [("an edge", edge), ("a height", height)] {
        if !(length > 0.0 && length.is_finite()) {
            return Err(PictureMeshError::Length { what, length });
        }
    }
    let (found, specks) = without_specks(picture)?;
    let [least, largest] = bounds(&found);
    let pixel = height / (largest.y - least.y);
    let size = (largest - least) * pixel;
    if edge > size.max() {
        return Err(PictureMeshError::TooCoarse { edge, size: size.into() });
    }
    let area: f64 = found.iter().map(|points| Curve::new(points.clone()).area()).sum();
    let wish = area * pixel * pixel / (0.75_f64.sqrt() / 2.0 * edge * edge);
    if !(wish <= MOST) {
        return Err(PictureMeshError::TooFine { edge, count: wish, most: MOST });
    }
    let region = Region::new(picture, &found, edge / pixel, wish);
    let start = Instant::now();
    let mut sized = region.mesh(wish);
    let size_at = |_: u32, x: Vector2<f64>| sized.sizes.at(x, sized.largest);
    let steps = relax(&mut sized.mesh, &mut sized.outline, size_at, improve, MOVED_ABOVE);
    let to_metres = |x: &Vector2<f64>| (x - least) * pixel;
    let mut mesh = sized.mesh.into_mesh();
    let meshing = start.elapsed();
    mesh.vertices.iter_mut().for_each(|x| *x = to_metres(x));
    let contours = found.iter().map(|points| points.iter().map(to_metres).collect()).collect();
    let area = picture.area() * pixel * pixel;
    Ok(PictureMesh { mesh, contours, pixel, origin: least, area, wish, steps, specks, meshing })
}

/// Points of each contour of a picture.
type Contours = Vec<Vec<Vector2<f64>>>;

/// The contours around two pixels and more, and the number of the others.
fn without_specks(picture: &Picture) -> Result<(Contours, usize), PictureMeshError> {
    let found = contours(picture, MOST_CROSSINGS).map_err(|count| PictureMeshError::TooIntricate {
        count,
        what: "places where a contour passes between two pixels",
        most: MOST_CROSSINGS,
    })?;
    let all = found.len();
    let kept: Vec<_> = found.into_iter().filter(|points| Curve::new(points.clone()).area().abs() >= SPECK).collect();
    if kept.len() > MOST_CONTOURS {
        return Err(PictureMeshError::TooIntricate { count: kept.len(), what: "contours", most: MOST_CONTOURS });
    }
    let specks = all - kept.len();
    if kept.is_empty() { Err(PictureMeshError::Empty) } else { Ok((kept, specks)) }
}

fn bounds(contours: &[Vec<Vector2<f64>>]) -> [Vector2<f64>; 2] {
    let none = [Vector2::repeat(f64::INFINITY), Vector2::repeat(f64::NEG_INFINITY)];
    contours.iter().flatten().fold(none, |[least, largest], x| [least.inf(x), largest.sup(x)])
}
