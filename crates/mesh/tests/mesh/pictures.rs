//! Meshes of the shipped pictures, and of pictures that are hard to mesh.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use fem_mesh::generate::picture::{
    FromPicture, Picture, PictureMesh, PictureMeshError, contours, mesh_picture, read_picture,
};
use fem_mesh::{Mesh, triangle_quality};
use nalgebra::Vector2;

fn shipped(name: &str) -> Picture {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../data/pictures").join(format!("{name}.png"));
    read_picture(&file).unwrap_or_else(|error| panic!("{error}"))
}

fn meshed(picture: &Picture, edge: f64) -> PictureMesh {
    mesh_picture(picture, FromPicture { edge, height: 1.0, improve: 10 }).unwrap_or_else(|error| panic!("{error}"))
}

/// A picture from the inside of a shape at the centres of its pixels, without antialiasing.
fn drawn(width: usize, height: usize, inside: impl Fn(f64, f64) -> bool) -> Picture {
    let at = |k: usize| (k as f64 % width as f64 + 0.5, height as f64 - (k / width) as f64 - 0.5);
    let coverage = (0..width * height).map(|k| if inside(at(k).0, at(k).1) { 255 } else { 0 }).collect();
    Picture { width, height, coverage }
}

/// Edges of one triangle alone, in its direction.
fn boundary(mesh: &Mesh<2, 3>) -> Vec<[usize; 2]> {
    let sides = |&[a, b, c]: &[usize; 3]| [[a, b], [b, c], [c, a]];
    let all: std::collections::HashSet<[usize; 2]> = mesh.elements.iter().flat_map(sides).collect();
    let mut edges: Vec<[usize; 2]> = all.iter().filter(|[a, b]| !all.contains(&[*b, *a])).copied().collect();
    edges.sort_unstable();
    edges
}

fn euler_characteristic(mesh: &Mesh<2, 3>) -> i64 {
    let edges = (3 * mesh.elements.len() + boundary(mesh).len()) / 2;
    mesh.vertices.len() as i64 - edges as i64 + mesh.elements.len() as i64
}

fn distance(x: Vector2<f64>, [a, b]: [Vector2<f64>; 2]) -> f64 {
    let side = b - a;
    let share = ((x - a).dot(&side) / side.norm_squared().max(1e-300)).clamp(0.0, 1.0);
    (x - a - share * side).norm()
}

/// Largest distance of points along the first polylines from the second ones. A point counts no more once a side is as near as the
/// largest distance so far; the search begins at the side that was nearest to the point before.
fn one_sided(from: &[[Vector2<f64>; 2]], to: &[[Vector2<f64>; 2]]) -> f64 {
    let (mut largest, mut begin) = (0.0, 0);
    for x in from.iter().flat_map(|[a, b]| [0.0, 0.25, 0.5, 0.75].map(|share| a.lerp(b, share))) {
        let mut nearest = f64::INFINITY;
        for index in (begin..to.len()).chain(0..begin) {
            let distance = distance(x, to[index]);
            if distance < nearest {
                (nearest, begin) = (distance, index);
            }
            if nearest <= largest {
                break;
            }
        }
        largest = nearest.max(largest);
    }
    largest
}

/// Hausdorff distance between the boundary of the mesh and the contours, in pixels.
fn contour_distance(found: &PictureMesh) -> f64 {
    let boundary: Vec<_> = boundary(&found.mesh).iter().map(|edge| edge.map(|i| found.mesh.vertices[i])).collect();
    let contours: Vec<_> = found
        .contours
        .iter()
        .flat_map(|points| (0..points.len()).map(move |i| [points[i], points[(i + 1) % points.len()]]))
        .collect();
    one_sided(&boundary, &contours).max(one_sided(&contours, &boundary)) / found.pixel
}

fn assert_positive(mesh: &Mesh<2, 3>) {
    for &[a, b, c] in &mesh.elements {
        let [a, b, c] = [a, b, c].map(|i| mesh.vertices[i]);
        assert!((b - a).perp(&(c - a)) > 0.0);
    }
}

/// The shipped pictures with their Euler characteristic and two edges, m, for a height of 1 m.
const PICTURES: [(&str, i64, [f64; 2]); 7] = [
    ("donut", 0, [0.05, 0.02]),
    ("armadillo", 1, [0.015, 0.012]),
    ("bunny", 1, [0.02, 0.015]),
    ("triangle", 1, [0.05, 0.02]),
    ("square", 1, [0.05, 0.02]),
    ("letter", -1, [0.03, 0.02]),
    ("gear", 0, [0.03, 0.02]),
];

#[test]
fn every_shipped_picture_has_a_good_mesh_with_its_holes_area_contour_and_count() {
    for (name, characteristic, edges) in PICTURES {
        let picture = shipped(name);
        for edge in edges {
            let found = meshed(&picture, edge);
            let quality = triangle_quality(&found.mesh);
            let case = format!("{name} with edges of {edge} m: {quality:?}");
            assert!(quality.radius_to_edge.value <= 1.0, "worst, {case}");
            assert!(quality.radius_to_edge_99 <= 0.75, "99 %, {case}");
            assert!(quality.median_radius_to_edge <= 0.62, "median, {case}");
            assert_eq!(euler_characteristic(&found.mesh), characteristic, "{case}");
            assert!((quality.area / found.area - 1.0).abs() <= 0.005, "{} m² of pixels, {case}", found.area);
            assert!((quality.triangles as f64 / found.wish - 1.0).abs() <= 0.05, "{} wished, {case}", found.wish);
            let distance = contour_distance(&found);
            assert!(distance <= 0.5, "contour within {distance} pixels, {case}");
            assert_positive(&found.mesh);
        }
    }
}

#[test]
fn the_smoothing_lowers_its_energy_in_every_iteration_and_never_worsens_the_worst_triangle() {
    for (name, _, [edge, _]) in PICTURES {
        let steps = meshed(&shipped(name), edge).steps;
        assert!(steps.len() > 5, "{name}: {} steps", steps.len());
        for pair in steps.windows(2) {
            assert!(pair[1].energy <= pair[0].energy * (1.0 + 1e-12), "{name}: {pair:?}");
            assert!(pair[1].worst_radius_to_edge <= pair[0].worst_radius_to_edge + 1e-12, "{name}: {pair:?}");
        }
        let (first, last) = (steps[0], steps[steps.len() - 1]);
        assert!(last.energy < 0.999 * first.energy, "{name}: {first:?} {last:?}");
        assert!(last.radius_to_edge_99 < first.radius_to_edge_99, "{name}: {first:?} {last:?}");
        assert!((last.smallest_angle - (0.5 / last.worst_radius_to_edge).asin().to_degrees()).abs() < 1e-9);
    }
}

#[test]
fn a_mesh_has_the_height_that_is_asked_for_and_begins_at_the_origin() {
    let picture = shipped("gear");
    let found = mesh_picture(&picture, FromPicture { edge: 0.1, height: 2.5, improve: 2 }).unwrap();
    let range = |axis: usize| {
        let values = found.mesh.vertices.iter().map(move |x| x[axis]);
        [values.clone().fold(f64::INFINITY, f64::min), values.fold(0.0, f64::max)]
    };
    assert!(range(1)[0].abs() < 0.5 * found.pixel && (range(1)[1] - 2.5).abs() < 0.5 * found.pixel, "{:?}", range(1));
    assert!(range(0)[0].abs() < 0.5 * found.pixel, "{:?}", range(0));
}

#[test]
fn the_same_picture_gives_the_same_mesh() {
    let picture = shipped("letter");
    assert_eq!(meshed(&picture, 0.05).mesh, meshed(&picture, 0.05).mesh);
}

#[test]
fn contours_run_around_the_region_and_clockwise_around_holes() {
    let area = |points: &Vec<Vector2<f64>>| {
        (0..points.len()).map(|i| 0.5 * points[i].perp(&points[(i + 1) % points.len()])).sum::<f64>()
    };
    let found = contours(&shipped("donut"), 100_000).unwrap();
    let mut areas: Vec<f64> = found.iter().map(area).collect();
    areas.sort_by(f64::total_cmp);
    let exact = [48.0, 112.0].map(|radius: f64| std::f64::consts::PI * radius * radius);
    assert_eq!(areas.len(), 2);
    assert!(
        (areas[0] / -exact[0] - 1.0).abs() < 2e-3 && (areas[1] / exact[1] - 1.0).abs() < 1e-3,
        "{areas:?} {exact:?}"
    );
    // Sides of the square lie at 27.3 and 228.7, within a tenth of a pixel apart from its corners.
    let square = contours(&shipped("square"), 100_000).unwrap();
    let lowest = square[0].iter().map(|x| x.y).fold(f64::INFINITY, f64::min);
    assert!((lowest - 27.3).abs() < 0.1, "{lowest}");
}

#[test]
fn pixels_that_meet_at_a_corner_are_joined_if_the_mean_of_the_four_is_inside() {
    let picture = |outer: u8| Picture { width: 2, height: 2, coverage: vec![255, outer, outer, 255] };
    assert_eq!(contours(&picture(0), 100).unwrap().len(), 2);
    assert_eq!(contours(&picture(100), 100).unwrap().len(), 1);
    assert_eq!(contours(&picture(0), 3), Err(8));
}

#[test]
fn parts_holes_and_regions_up_to_the_edge_of_the_picture_are_meshed() {
    let picture = drawn(120, 90, |x, y| {
        let ring = (x - 30.0).hypot(y - 45.0);
        (12.0..28.0).contains(&ring) || x > 80.0
    });
    let found = meshed(&picture, 0.05);
    assert_eq!(euler_characteristic(&found.mesh), 1, "a ring and a rectangle");
    let quality = triangle_quality(&found.mesh);
    assert!(quality.radius_to_edge.value <= 1.0, "{quality:?}");
    let right = found.mesh.vertices.iter().map(|x| x.x).fold(0.0, f64::max);
    assert!((right - 118.0 * found.pixel).abs() < found.pixel, "the rectangle ends at the edge of the picture");
}

#[test]
fn steps_of_a_picture_without_antialiasing_do_not_become_elements() {
    let picture = drawn(200, 200, |x, y| x > 10.0 && y > 10.0 && x + 9.3 * y < 1700.0 && y + 0.21 * x < 150.0);
    let found = meshed(&picture, 0.06);
    let quality = triangle_quality(&found.mesh);
    assert!((quality.triangles as f64 / found.wish - 1.0).abs() < 0.1, "{} wished: {quality:?}", found.wish);
    assert!(contour_distance(&found) <= 1.0);
    assert!(quality.radius_to_edge.value <= 1.0 && (quality.area / found.area - 1.0).abs() < 0.005, "{quality:?}");
}

#[test]
fn a_line_one_pixel_wide_becomes_a_row_of_triangles() {
    let picture = drawn(100, 20, |x, y| (10.0..90.0).contains(&x) && (10.0..11.0).contains(&y));
    let found = mesh_picture(&picture, FromPicture { edge: 1.0, height: 1.0, improve: 10 }).unwrap();
    let quality = triangle_quality(&found.mesh);
    assert!((60..1000).contains(&quality.triangles), "{quality:?}");
    assert_eq!(euler_characteristic(&found.mesh), 1);
    assert_positive(&found.mesh);
}

#[test]
fn specks_are_left_out_and_counted() {
    let picture = drawn(60, 60, |x, y| (x - 30.0).hypot(y - 30.0) < 20.0 || (x < 1.0 && y < 1.0));
    let found = meshed(&picture, 0.1);
    assert_eq!((found.specks, euler_characteristic(&found.mesh)), (1, 1));
}

#[test]
fn a_picture_without_region_and_edges_that_do_not_fit_are_refused() {
    let refused = |picture: &Picture, edge: f64, height: f64| {
        mesh_picture(picture, FromPicture { edge, height, improve: 1 }).unwrap_err()
    };
    assert_eq!(refused(&drawn(30, 30, |_, _| false), 0.1, 1.0), PictureMeshError::Empty);
    let disc = drawn(60, 60, |x, y| (x - 30.0).hypot(y - 30.0) < 20.0);
    for edge in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(refused(&disc, edge, 1.0), PictureMeshError::Length { .. }), "{edge}");
        assert!(matches!(refused(&disc, 0.1, edge), PictureMeshError::Length { .. }), "{edge}");
    }
    assert!(matches!(refused(&disc, 1.5, 1.0), PictureMeshError::TooCoarse { .. }));
    let PictureMeshError::TooFine { count, .. } = refused(&disc, 1e-5, 1.0) else { panic!("not too fine") };
    assert!((1e10..3e10).contains(&count), "{count}");
    // Noise, as in a photograph.
    let mut state = 7_u32;
    let mut noise = disc;
    for pixel in &mut noise.coverage {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        *pixel = (state >> 24) as u8;
    }
    let tiled = Picture { width: 60, height: 60 * 200, coverage: noise.coverage.repeat(200) };
    assert!(matches!(refused(&tiled, 0.1, 1.0), PictureMeshError::TooIntricate { .. }));
}

/// The square of the distance of a point from the centre of the circle through three others, over that of the radius.
fn from_circle([a, b, c]: [Vector2<f64>; 3], point: Vector2<f64>) -> f64 {
    let [ab, ac] = [b - a, c - a];
    let normal = |x: Vector2<f64>| Vector2::new(-x.y, x.x);
    let centre = (normal(ac) * ab.norm_squared() - normal(ab) * ac.norm_squared()) / (-2.0 * ab.perp(&ac));
    (a + centre - point).norm_squared() / centre.norm_squared()
}

#[test]
fn the_triangulation_is_delaunay_and_fills_the_region_with_the_triangles_of_the_lattice() {
    let picture = drawn(200, 200, |x, y| (10.0..190.0).contains(&x) && (x - 80.0).hypot(y - 110.0) > 30.0);
    let found = mesh_picture(&picture, FromPicture { edge: 0.04, height: 1.0, improve: 0 }).unwrap();
    let mesh = &found.mesh;
    assert_positive(mesh);
    let at = |i: usize| mesh.vertices[i];
    let sides = boundary(mesh);
    assert_eq!(mesh.elements.len(), 2 * mesh.vertices.len() - sides.len(), "Euler's formula for a region with a hole");
    let area: f64 = mesh.elements.iter().map(|&[a, b, c]| 0.5 * (at(b) - at(a)).perp(&(at(c) - at(a)))).sum();
    let enclosed: f64 = sides.iter().map(|&[a, b]| 0.5 * at(a).perp(&at(b))).sum();
    assert!((area / enclosed - 1.0).abs() < 1e-12, "{area} {enclosed}");
    let opposite = |&[a, b, c]: &[usize; 3]| [([a, b], c), ([b, c], a), ([c, a], b)];
    let beyond: HashMap<[usize; 2], usize> = mesh.elements.iter().flat_map(opposite).collect();
    let mut regular = 0;
    for element in &mesh.elements {
        let corners = element.map(at);
        for [a, b] in [[0, 1], [1, 2], [2, 0]].map(|side| side.map(|i| element[i])) {
            if let Some(&corner) = beyond.get(&[b, a]) {
                assert!(from_circle(corners, at(corner)) > 1.0 - 1e-9, "{element:?} and {corner}");
            }
        }
        let lengths = [[0, 1], [1, 2], [2, 0]].map(|[i, j]: [usize; 2]| (corners[j] - corners[i]).norm());
        regular += usize::from(lengths.iter().all(|length| (length / lengths[0] - 1.0).abs() < 1e-9));
    }
    assert!(regular > 300, "{regular} of {}", mesh.elements.len());
}

#[test]
fn a_lattice_without_sites_leaves_the_region_to_its_boundary() {
    for size in [4, 12] {
        let found = meshed(&drawn(size, size, |_, _| true), 1.0);
        assert_positive(&found.mesh);
        assert_eq!(euler_characteristic(&found.mesh), 1);
        assert_eq!(boundary(&found.mesh).len(), found.mesh.vertices.len(), "{size} pixels");
    }
}

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("pictures").join(name)
}

#[test]
fn pictures_of_every_kind_have_the_same_region() {
    // A dark bar of 32 × 8 pixels on a light ground of 48 × 32; the last is turned by its EXIF entry.
    for name in ["cmyk.jpg", "palette.png", "grey16.png"] {
        let picture = read_picture(&sample(name)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!([picture.width, picture.height], [48, 32], "{name}");
        assert!((picture.area() - 256.0).abs() < 10.0, "{name}: {}", picture.area());
        assert!(picture.at(20, 20) > 250 && picture.at(20, 4) < 5, "{name}");
    }
    let turned = read_picture(&sample("rotated.jpg")).unwrap();
    assert_eq!([turned.width, turned.height], [32, 48]);
    assert!(turned.at(20, 20) > 250 && turned.at(4, 20) < 5);
}

#[test]
fn a_transparent_pixel_makes_the_opacity_decide() {
    // One of the two colours of the palette is transparent; the other, whichever it is, is the region.
    let picture = read_picture(&sample("palette_alpha.png")).unwrap();
    let luminance = read_picture(&sample("palette.png")).unwrap();
    let share = picture.area() / (48.0 * 32.0);
    assert!((share - 1.0 / 6.0).abs() < 0.01 || (share - 5.0 / 6.0).abs() < 0.01, "{share}");
    assert!((luminance.area() / (48.0 * 32.0) - 1.0 / 6.0).abs() < 0.01);
}

#[test]
fn files_that_are_no_pictures_are_refused_with_their_name_and_a_remedy() {
    let whole = std::fs::read(sample("grey16.png")).unwrap();
    let mut flat = Vec::new();
    image::GrayImage::from_pixel(9, 9, image::Luma([7]))
        .write_to(&mut std::io::Cursor::new(&mut flat), image::ImageFormat::Png)
        .unwrap();
    let mut wide = whole.clone();
    // The width in the header, with a checksum that does not fit any more, and one of a text.
    wide[16..20].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff]);
    let cases: [(&str, &[u8], &str); 6] = [
        ("truncated.png", &whole[..whole.len() / 2], "damaged"),
        ("empty.png", b"", "neither"),
        ("text.png", b"a picture of a donut", "neither"),
        ("gif.png", b"GIF89a\x01\x00\x01\x00\x00\x00\x00;", "neither"),
        ("flat.png", &flat, "one colour"),
        ("wide.png", &wide, ""),
    ];
    for (name, bytes, word) in cases {
        let (_folder, file) = crate::folder_with(&[(name, bytes)]);
        let error = read_picture(&file).unwrap_err().to_string();
        assert!(error.contains(name) && error.contains(word), "{error}");
    }
    let missing = read_picture(Path::new("missing.png")).unwrap_err().to_string();
    assert!(missing.contains("missing.png: there is no such file"), "{missing}");
}
