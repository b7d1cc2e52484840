//! Quality of the triangles of the five objects in each iteration of optimal Delaunay triangulation.

mod start;

use std::collections::HashSet;
use std::path::Path;

use fem_chart::{Axis, Chart, Dot, Guide, Series};
use fem_mesh::generate::odt::OdtStep;
use fem_mesh::generate::picture::PictureMesh;
use fem_mesh::{Mesh, triangle_quality};
use nalgebra::Vector2;

use super::object::{OBJECTS, meshed, picture};
use crate::study::{Mark, Part, Table};
use start::smoothed;

/// Iterations that are shown.
const ITERATIONS: usize = 20;
/// Length of the edges, m, for a height of 1 m.
const EDGE: f64 = 0.02;
/// Iterations of the thesis' smoothing.
const THEIRS: usize = 7;

/// Meshes each object with 20 iterations.
pub fn run(data: &Path, quick: bool) -> Result<Part, String> {
    let objects = if quick { &OBJECTS[2..3] } else { &OBJECTS[..] };
    let (mut rows, mut marks, mut series) = (Vec::new(), Vec::new(), Vec::new());
    let (mut from_scattered, mut figures) = (Vec::new(), Vec::new());
    for (number, &name) in objects.iter().enumerate() {
        let picture = picture(data, name)?;
        let before = meshed(&picture, EDGE, 0)?;
        let after = meshed(&picture, EDGE, ITERATIONS)?;
        rows.extend(all_iterations(name, &after.steps));
        let dots = after.steps.iter().enumerate().map(|(iteration, step)| {
            let title = format!("{name}, iteration {iteration}\nworst R/l {:.3}", step.worst_radius_to_edge);
            Dot::new(iteration as f64, step.worst_radius_to_edge, title)
        });
        series.push(Series::joined(name, (number, number), dots));
        marks.extend(judge(name, &before, &after));
        let scattered = smoothed(data, name)?;
        from_scattered.extend(all_iterations(name, &scattered.steps));
        marks.extend(scattered.marks());
        figures.push(scattered.figure()?);
    }
    let mut chart = Chart::new(
        "worst circumradius over shortest edge in each iteration",
        Axis::linear("iteration"),
        Axis::linear("worst R/l"),
    );
    chart.series = series;
    chart.guides = vec![
        Guide::Horizontal(1.0 / 3.0_f64.sqrt(), "equilateral, 0.577".to_owned()),
        Guide::Vertical(THEIRS as f64, "the thesis' iterations".to_owned()),
    ];
    let text = format!(
        "Circumradius over shortest edge, R/l = 1/(2 sin θ) of the smallest angle θ, for edges of {EDGE} m and a height of 1 m. The thesis gives \
         about 0.5 for the best triangle, which no triangle has: an equilateral one has 0.577. It leaves triangles of R/l > 3 out at the end and has the factor \
         1/4 of space in its energy; here nothing is left out, and boundary points slide along the contour. Only corners of triangles with \
         R/l > 0.7 move once the median is below 0.6, which ends the iterations early; \
         later rows repeat the last. The boundary's points and random ones inside, whose Delaunay triangulation does not depend on the algorithm, Bowyer–Watson or another, are a start \
         without any care: flat-mesh-scattered and the pictures."
    );
    let tables = [table("flat-mesh", &rows), table("flat-mesh-scattered", &from_scattered)];
    let part = Part::new(text).marks(marks).tables(tables).figures(figures);
    Ok(part.chart("flat-mesh", &chart, "The worst triangle of each object."))
}

/// The measures of iterations 0 to 20. Iterations after the last one that moved a vertex have its measures.
fn all_iterations<'a>(name: &'a str, steps: &[OdtStep]) -> Vec<(&'a str, usize, OdtStep)> {
    (0..=ITERATIONS).map(move |iteration| (name, iteration, steps[iteration.min(steps.len() - 1)])).collect()
}

fn table(name: &str, rows: &[(&str, usize, OdtStep)]) -> Table {
    Table::of(
        name,
        rows,
        &[
            ("object", &|(name, ..)| (*name).to_owned()),
            (">iteration", &|(_, iteration, _)| iteration.to_string()),
            (">smallest angle (°)", &|(.., step)| format!("{:.2}", step.smallest_angle)),
            (">R/l median", &|(.., step)| format!("{:.4}", step.median_radius_to_edge)),
            (">R/l 99 %", &|(.., step)| format!("{:.4}", step.radius_to_edge_99)),
            (">R/l worst", &|(.., step)| format!("{:.4}", step.worst_radius_to_edge)),
            (">energy", &|(.., step)| format!("{:.10e}", step.energy)),
        ],
    )
}

fn judge(name: &str, before: &PictureMesh, after: &PictureMesh) -> Vec<Mark> {
    let falls = after.steps.windows(2).all(|pair| pair[1].energy <= pair[0].energy * (1.0 + 1e-12));
    let kept = (before.mesh.elements.len(), after.mesh.elements.len());
    let worst = |mesh: &PictureMesh| triangle_quality(&mesh.mesh).radius_to_edge.value;
    let area = triangle_quality(&after.mesh).area / after.area - 1.0;
    let distance = contour_distance(after);
    let [first, last] = [before, after].map(worst);
    vec![
        Mark::new(format!("{name}: the energy falls in every iteration"), "", falls),
        Mark::new(
            format!("{name}: worst R/l at most 1, and no worse than before"),
            format!("{first:.3} → {last:.3}"),
            last <= 1.0 && last <= first + 1e-12,
        )
        .beside("8.7 → “0.5”"),
        Mark::new(format!("{name}: boundary within half a pixel"), format!("{distance:.3} pixels"), distance <= 0.5),
        Mark::new(format!("{name}: area within 0.5 %"), format!("{:+.3} %", 100.0 * area), area.abs() <= 0.005),
        Mark::new(format!("{name}: no triangle is left out"), format!("{} and {}", kept.0, kept.1), kept.0 == kept.1)
            .beside("R/l > 3 deleted"),
    ]
}

/// The ends of each edge of the boundary, in the order of the triangles.
fn boundary(mesh: &Mesh<2, 3>) -> Vec<[Vector2<f64>; 2]> {
    let sides = |&[a, b, c]: &[usize; 3]| [[a, b], [b, c], [c, a]];
    let all: HashSet<[usize; 2]> = mesh.elements.iter().flat_map(sides).collect();
    let outer = mesh.elements.iter().flat_map(sides).filter(|[a, b]| !all.contains(&[*b, *a]));
    outer.map(|edge| edge.map(|i| mesh.vertices[i])).collect()
}

/// Hausdorff distance between the boundary of a mesh and the contours of its picture, in pixels.
fn contour_distance(found: &PictureMesh) -> f64 {
    let boundary = boundary(&found.mesh);
    let closed = |points: &Vec<Vector2<f64>>| {
        (0..points.len()).map(|i| [points[i], points[(i + 1) % points.len()]]).collect::<Vec<_>>()
    };
    let contours: Vec<_> = found.contours.iter().flat_map(closed).collect();
    largest_distance(&boundary, &contours).max(largest_distance(&contours, &boundary)) / found.pixel
}

/// Largest distance of points along the first lines from the second ones, m.
fn largest_distance(from: &[[Vector2<f64>; 2]], to: &[[Vector2<f64>; 2]]) -> f64 {
    let points = from.iter().flat_map(|[a, b]| [0.0, 0.5].map(|share| a.lerp(b, share)));
    points.map(|x| to.iter().map(|side| distance(x, *side)).fold(f64::INFINITY, f64::min)).fold(0.0, f64::max)
}

fn distance(x: Vector2<f64>, [a, b]: [Vector2<f64>; 2]) -> f64 {
    let side = b - a;
    let share = ((x - a).dot(&side) / side.norm_squared().max(1e-300)).clamp(0.0, 1.0);
    (x - a - share * side).norm()
}
