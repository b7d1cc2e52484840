//! Picking: from a pixel to a line of sight, to a hit, to the vertices near it.

mod hits;

use nalgebra::{Matrix4, Vector3, Vector4};

use crate::diagnosis::switches::Switch;
use crate::reference::trial::{Input, Observed, Trial};

type Point = Vector3<f64>;
type Matrix = Matrix4<f64>;

/// The decisions on the way.
#[derive(Clone, Copy)]
pub struct Settings {
    /// Place of a pixel between −1 and 1.
    place: fn(&Point, &Vector4<f64>) -> [f64; 2],
    /// Clip depths of the two points on the line of sight, from the depth of the pixel.
    depths: fn(f64) -> [f64; 2],
    /// From the screen to the world, given view and projection.
    back: fn(&Matrix, &Matrix) -> Option<Matrix>,
    divided: fn(Vector4<f64>) -> Point,
    inside: fn(f64, f64) -> bool,
    ahead: fn(f64) -> bool,
    /// Returns true if a triangle counts. Argument: the component of its normal along the line of sight.
    side: fn(f64) -> bool,
    hit: Hit,
    from: From,
    /// The distance of two points that differ by this.
    norm: fn(&Point) -> f64,
    /// Returns true if a vertex is near. Arguments: its distance, and the radius.
    near: fn(f64, f64) -> bool,
    among: Among,
    order: Order,
}

#[derive(Clone, Copy, PartialEq)]
enum Hit {
    First,
    Last,
    All,
    FirstInList,
    LastInList,
}

#[derive(Clone, Copy)]
enum From {
    Hit,
    Centroid,
    Corner,
    /// The corner of the triangle that is nearest to the hit.
    NearestCorner,
    /// The vertex of any triangle that is nearest to the hit.
    NearestOnSurface,
    /// The vertex that is nearest to the hit.
    NearestVertex,
    Near,
    Far,
    Line,
}

#[derive(Clone, Copy)]
enum Among {
    All,
    OfTriangles,
    OfTheTriangle,
    /// All corners of triangles with a corner near the hit.
    WithTriangles,
}

#[derive(Clone, Copy)]
enum Order {
    Ascending,
    Descending,
    ByDistance,
    NearestAlone,
    FirstAlone,
}

/// The way of the course.
pub const RIGHT: Settings = Settings {
    place: |win, of| [2.0 * (win.x - of[0]) / of[2] - 1.0, 2.0 * (win.y - of[1]) / of[3] - 1.0],
    depths: |_| [-1.0, 1.0],
    back: |view, proj| (proj * view).try_inverse(),
    divided: |p| p.xyz() / p.w,
    inside: |u, v| u >= -1e-12 && v >= -1e-12 && u + v <= 1.0 + 1e-12,
    ahead: |t| t >= 0.0,
    side: |_| true,
    hit: Hit::First,
    from: From::Hit,
    norm: |d| d.norm(),
    near: |distance, radius| distance <= radius,
    among: Among::All,
    order: Order::Ascending,
};

const PIXEL: &str = "Another pixel is picked: how do pixels become coordinates between −1 and 1?";
const MATRICES: &str =
    "The line of sight is another one: which matrix takes a point of the world to the screen, and which takes it back?";
const TRIANGLE: &str =
    "Hits are counted that miss their triangle, or the other way round: check your test with a point beside each edge.";
const HIDDEN: &str = "What lies behind the first hit is hidden. Which of several hits does the eye see?";
const CENTRE: &str = "The wrong point is in the middle: from where is the radius measured?";
const RADIUS: &str =
    "The right point is hit, but too many or too few vertices are near it: which two lengths are compared?";
const LIST: &str = "The right vertices are found. In which order does the page ask for them, and for how many?";

/// The mistakes.
pub const SWITCHES: &[Switch<Settings>] = &[
    ("upside down", "Pixels are counted from the lower left here, not from the top.", |s| {
        s.place = |win, of| [2.0 * (win.x - of[0]) / of[2] - 1.0, 1.0 - 2.0 * (win.y - of[1]) / of[3]];
    }),
    ("upside down", "Pixels are counted from the lower left of the window here, not from the top.", |s| {
        s.place = |win, of| [2.0 * (win.x - of[0]) / of[2] - 1.0, 2.0 * (of[3] - win.y - of[1]) / of[3] - 1.0];
    }),
    ("mirrored", PIXEL, |s| {
        s.place = |win, of| [1.0 - 2.0 * (win.x - of[0]) / of[2], 2.0 * (win.y - of[1]) / of[3] - 1.0]
    }),
    (
        "corner of the viewport left out",
        "Right where the picture fills the window. Where does the picture begin otherwise?",
        |s| {
            s.place = |win, of| [2.0 * win.x / of[2] - 1.0, 2.0 * win.y / of[3] - 1.0];
        },
    ),
    ("pixels from 0 to 1", PIXEL, |s| s.place = |win, of| [(win.x - of[0]) / of[2], (win.y - of[1]) / of[3]]),
    ("pixels from 0 to 2", PIXEL, |s| {
        s.place = |win, of| [2.0 * (win.x - of[0]) / of[2], 2.0 * (win.y - of[1]) / of[3]]
    }),
    ("pixels as they are", PIXEL, |s| s.place = |win, _| [win.x, win.y]),
    ("pixels not doubled", PIXEL, |s| {
        s.place = |win, of| [(win.x - of[0]) / of[2] - 1.0, (win.y - of[1]) / of[3] - 1.0]
    }),
    ("pixels less one half", PIXEL, |s| {
        s.place = |win, of| [(win.x - of[0]) / of[2] - 0.5, (win.y - of[1]) / of[3] - 0.5]
    }),
    ("width and height swapped", PIXEL, |s| {
        s.place = |win, of| [2.0 * (win.x - of[0]) / of[3] - 1.0, 2.0 * (win.y - of[1]) / of[2] - 1.0]
    }),
    ("width for height", PIXEL, |s| {
        s.place = |win, of| [2.0 * (win.x - of[0]) / of[2] - 1.0, 2.0 * (win.y - of[1]) / of[2] - 1.0]
    }),
    ("x and y swapped", PIXEL, |s| {
        s.place = |win, of| [2.0 * (win.y - of[1]) / of[3] - 1.0, 2.0 * (win.x - of[0]) / of[2] - 1.0]
    }),
    ("middle of the viewport", PIXEL, |s| s.place = |_, _| [0.0, 0.0]),
    ("pixels doubled", PIXEL, |s| {
        s.place = |win, of| [2.0 * (2.0 * win.x - of[0]) / of[2] - 1.0, 2.0 * (2.0 * win.y - of[1]) / of[3] - 1.0]
    }),
    ("corner added", PIXEL, |s| {
        s.place = |win, of| [2.0 * (win.x + of[0]) / of[2] - 1.0, 2.0 * (win.y + of[1]) / of[3] - 1.0]
    }),
    ("viewport as two corners", PIXEL, |s| {
        s.place =
            |win, of| [2.0 * (win.x - of[0]) / (of[2] - of[0]) - 1.0, 2.0 * (win.y - of[1]) / (of[3] - of[1]) - 1.0];
    }),
    (
        "clip depth 0 to 1",
        "Triangles close to the eye are missed: which depth does the near plane have in OpenGL?",
        |s| s.depths = |_| [0.0, 1.0],
    ),
    ("depth of the pixel", "The line of sight begins behind the surface: which depth does it begin at?", |s| {
        s.depths = |z| [z, 1.0]
    }),
    ("depth of the pixel", "The line of sight begins behind the surface: which depth does it begin at?", |s| {
        s.depths = |z| [2.0 * z - 1.0, 1.0]
    }),
    ("from far to near", "The line of sight runs towards the eye.", |s| s.depths = |_| [1.0, -1.0]),
    (
        "matrices in the wrong order",
        "A point first goes to the eye and then to the screen. Which matrix stands next to the point?",
        |s| {
            s.back = |view, proj| (view * proj).try_inverse();
        },
    ),
    ("matrices not inverted", MATRICES, |s| s.back = |view, proj| Some(proj * view)),
    ("view left out", MATRICES, |s| s.back = |_, proj| proj.try_inverse()),
    ("projection left out", MATRICES, |s| s.back = |view, _| view.try_inverse()),
    ("view not inverted", MATRICES, |s| s.back = |view, proj| Some(view * proj.try_inverse()?)),
    ("matrices transposed", MATRICES, |s| s.back = |view, proj| (proj.transpose() * view.transpose()).try_inverse()),
    ("matrices transposed", MATRICES, |s| s.back = |view, proj| Some((proj * view).try_inverse()?.transpose())),
    ("inverses in the wrong order", MATRICES, |s| {
        s.back = |view, proj| Some(proj.try_inverse()? * view.try_inverse()?)
    }),
    (
        "no perspective division",
        "Right for parallel projection only: a point has four coordinates on the way, and the fourth means something.",
        |s| {
            s.divided = |p| p.xyz();
        },
    ),
    ("planes for triangles", TRIANGLE, |s| s.inside = |_, _| true),
    ("parallelograms for triangles", TRIANGLE, |s| {
        s.inside = |u, v| (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v)
    }),
    ("third edge only", TRIANGLE, |s| s.inside = |u, v| u + v <= 1.0),
    ("two edges only", TRIANGLE, |s| s.inside = |u, v| u >= 0.0 && v >= 0.0),
    ("beside the triangle", TRIANGLE, |s| s.inside = |u, v| !(u >= 0.0 && v >= 0.0 && u + v <= 1.0)),
    ("one edge left out", TRIANGLE, |s| s.inside = |u, v| u >= 0.0 && u + v <= 1.0),
    ("one edge left out", TRIANGLE, |s| s.inside = |u, v| v >= 0.0 && u + v <= 1.0),
    ("behind the eye", "A triangle behind the eye was hit. The line of sight begins somewhere.", |s| {
        s.ahead = |_| true
    }),
    ("only behind the eye", "Only what is behind the eye is hit.", |s| s.ahead = |t| t < 0.0),
    ("only from the front", "A triangle counts from both of its sides.", |s| s.side = |along| along < 0.0),
    ("only from behind", "A triangle counts from both of its sides.", |s| s.side = |along| along > 0.0),
    (
        "all hits instead of the first",
        "What lies behind the first hit is hidden, and a mouse does not take hold of it.",
        |s| s.hit = Hit::All,
    ),
    ("last hit", "The hit that is farthest away was taken. Which one does the eye see?", |s| s.hit = Hit::Last),
    ("first triangle of the list", HIDDEN, |s| s.hit = Hit::FirstInList),
    ("last triangle of the list", HIDDEN, |s| s.hit = Hit::LastInList),
    ("distance from the middle of the triangle", CENTRE, |s| s.from = From::Centroid),
    ("distance from a corner of the triangle", CENTRE, |s| s.from = From::Corner),
    ("distance from the nearest corner of the triangle", CENTRE, |s| s.from = From::NearestCorner),
    ("distance from the nearest vertex", CENTRE, |s| s.from = From::NearestVertex),
    ("distance from the nearest vertex", CENTRE, |s| s.from = From::NearestOnSurface),
    ("distance from the near plane", CENTRE, |s| s.from = From::Near),
    ("distance from the far plane", CENTRE, |s| s.from = From::Far),
    (
        "distance to the line of sight",
        "Vertices on the far side were taken too: measure from the point that was hit.",
        |s| s.from = From::Line,
    ),
    ("box for the ball", RADIUS, |s| s.norm = |d| d.amax()),
    ("sum of the coordinates for the distance", RADIUS, |s| s.norm = |d| d.abs().sum()),
    ("distance without z", RADIUS, |s| s.norm = |d| d.xy().norm()),
    ("radius for its square", RADIUS, |s| s.near = |distance, radius| distance * distance <= radius),
    ("square of the radius", RADIUS, |s| s.near = |distance, radius| distance <= radius * radius),
    ("diameter for radius", RADIUS, |s| s.near = |distance, radius| distance <= 0.5 * radius),
    ("radius doubled", RADIUS, |s| s.near = |distance, radius| distance <= 2.0 * radius),
    ("beyond the radius", RADIUS, |s| s.near = |distance, radius| distance > radius),
    ("radius left out", RADIUS, |s| s.near = |_, _| true),
    ("only the surface", "A vertex within the radius counts whether or not it belongs to a triangle.", |s| {
        s.among = Among::OfTriangles
    }),
    (
        "only the triangle that is hit",
        "Other vertices than those of the triangle that is hit may lie within the radius.",
        |s| s.among = Among::OfTheTriangle,
    ),
    ("whole triangles", RADIUS, |s| s.among = Among::WithTriangles),
    (
        "no radius",
        "The corners of the triangle that was hit were returned. The page asks for the vertices within the radius.",
        |s| {
            s.among = Among::OfTheTriangle;
            s.near = |_, _| true;
        },
    ),
    ("descending", LIST, |s| s.order = Order::Descending),
    ("sorted by distance", LIST, |s| s.order = Order::ByDistance),
    ("only the nearest vertex", "One vertex was returned. The page asks for all vertices within the radius.", |s| {
        s.order = Order::NearestAlone
    }),
    ("only the first vertex", "One vertex was returned. The page asks for all vertices within the radius.", |s| {
        s.order = Order::FirstAlone
    }),
    (
        "nearest vertex without radius",
        "One vertex was returned. The page asks for all vertices within the radius.",
        |s| {
            s.order = Order::NearestAlone;
            s.near = |_, _| true;
        },
    ),
];

/// The vertices that are found with these settings.
pub fn run(s: &Settings, trial: &Trial) -> Option<Observed> {
    let Input::Pick(pick) = &trial.input else { return None };
    let found = hits::line(s, pick).map_or(Vec::new(), |ends| hits::found(s, pick, ends));
    Some(Observed::vector(found.into_iter().map(|vertex| vertex as f64).collect()))
}
