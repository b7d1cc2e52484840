//! Quality of the triangles of the five objects in each iteration of optimal Delaunay triangulation, also from a plain start: scattered points, as
//! in the thesis' figures 4.9 to 4.11.

use std::collections::HashSet;
use std::path::Path;

use fem_chart::{Axis, Chart, Dot, Guide, Picture as Drawing, Series, distribution, grid, region};
use fem_mesh::generate::delaunay::triangulate;
use fem_mesh::generate::odt::{OdtStep, improve_triangles};
use fem_mesh::generate::picture::PictureMesh;
use fem_mesh::{Mesh, SurfaceMesh, triangle_distributions, triangle_quality};
use nalgebra::Vector2;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::object::{OBJECTS, meshed, picture};
use crate::experiments::drawing::{CELL, Triangle, drawn};
use crate::study::{Figure, Mark, Part, Result, Table};

/// Iterations that are shown.
const ITERATIONS: usize = 20;
/// Length of the edges, m, for a height of 1 m.
const EDGE: f64 = 0.02;
/// Iterations of the thesis' smoothing.
const THEIRS: usize = 7;

/// Meshes each object with 20 iterations.
pub fn run(data: &Path, quick: bool) -> Result<Part> {
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

/// Length of the edges, m, for a height of 1 m.
const SCATTERED_EDGE: f64 = 0.06;
/// Twice the area of a triangle of the boundary's points alone, over the square of an edge, up to which it is flat.
const FLAT: f64 = 1e-6;

/// An object whose inner vertices were scattered at random.
struct Smoothed {
    name: &'static str,
    contours: Vec<Vec<Vector2<f64>>>,
    /// The Delaunay triangulation, and the mesh after the thesis' seven iterations.
    start: Mesh<2, 3>,
    seventh: Mesh<2, 3>,
    /// Measures of all iterations.
    steps: Vec<OdtStep>,
}

/// Triangulates an object's boundary and as many scattered points inside as its mesh has, and smooths the result.
fn smoothed(data: &Path, name: &'static str) -> Result<Smoothed> {
    let found = meshed(&picture(data, name)?, SCATTERED_EDGE, 0)?;
    let start = scattered(&found.mesh, &found.contours)?;
    let improved = |iterations| improve_triangles(&start, iterations).map_err(|error| format!("{name}: {error}"));
    let (seventh, steps) = (improved(THEIRS)?.mesh, improved(ITERATIONS)?.steps);
    Ok(Smoothed { name, contours: found.contours, start, seventh, steps })
}

/// The Delaunay triangulation of a mesh's boundary and of as many points inside as the mesh has, scattered evenly.
fn scattered(mesh: &Mesh<2, 3>, contours: &[Vec<Vector2<f64>>]) -> Result<Mesh<2, 3>> {
    let edges = boundary(mesh);
    let mut points: Vec<Vector2<f64>> = edges.iter().map(|edge| edge[0]).collect();
    let largest = mesh.vertices.iter().fold(Vector2::zeros(), |a: Vector2<f64>, x| a.sup(x));
    let mut random = ChaCha8Rng::seed_from_u64(0);
    while points.len() < mesh.vertices.len() {
        let x = Vector2::new(random.random::<f64>() * largest.x, random.random::<f64>() * largest.y);
        // In no circle around an edge of the boundary, so that the triangulation has all of these edges.
        let is_free = edges.iter().all(|[a, b]| (x - 0.5 * (a + b)).norm() > 0.5 * (a - b).norm());
        if is_free && is_inside(x, contours) {
            points.push(x);
        }
    }
    let Mesh { vertices, mut elements, .. } = triangulate(&points)?.mesh;
    elements.retain(|triangle| {
        let [a, b, c] = triangle.map(|i| vertices[i]);
        // Points on a straight part of the boundary have triangles without area.
        (b - a).perp(&(c - a)) > FLAT * SCATTERED_EDGE * SCATTERED_EDGE && is_inside((a + b + c) / 3.0, contours)
    });
    Ok(Mesh::new(vertices, elements))
}

/// Returns true if a horizontal ray from the point crosses the closed lines an odd number of times.
fn is_inside(x: Vector2<f64>, lines: &[Vec<Vector2<f64>>]) -> bool {
    let crosses = |a: Vector2<f64>, b: Vector2<f64>| {
        (a.y > x.y) != (b.y > x.y) && x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    let of_line =
        |line: &Vec<Vector2<f64>>| (0..line.len()).filter(|&i| crosses(line[i], line[(i + 1) % line.len()])).count();
    lines.iter().map(of_line).sum::<usize>() % 2 == 1
}

impl Smoothed {
    /// Statements that must be true of it.
    fn marks(&self) -> [Mark; 2] {
        let name = self.name;
        let (first, seventh) = (self.steps[0], self.steps[THEIRS.min(self.steps.len() - 1)]);
        let falls = self.steps.windows(2).all(|pair| pair[1].energy <= pair[0].energy * (1.0 + 1e-12));
        let kept = [&self.start, &self.seventh].map(|mesh| mesh.elements.len());
        let [worst, median] = [
            [first, seventh].map(|step| step.worst_radius_to_edge),
            [first, seventh].map(|step| step.median_radius_to_edge),
        ];
        let both = "the energy falls in every iteration, and no triangle is left out";
        let told = format!("{:.2} → {:.2}, median {:.3} → {:.3}", worst[0], worst[1], median[0], median[1]);
        let fallen = format!("{name}, from scattered points: the worst R/l falls in {THEIRS} iterations");
        [
            Mark::new(
                format!("{name}, from scattered points: {both}"),
                format!("{} and {} triangles", kept[0], kept[1]),
                falls && kept[0] == kept[1],
            ),
            Mark::new(fallen, told, worst[1] < worst[0]),
        ]
    }

    /// The picture, the start and the seventh iteration, with histograms of R/l below.
    fn figure(&self) -> Result<Figure> {
        let lines: Vec<Vec<[f64; 2]>> =
            self.contours.iter().map(|line| line.iter().map(|x| (*x).into()).collect()).collect();
        let (mut parts, mut histograms) = (vec![region("the picture", &lines).scaled(CELL)], Vec::new());
        for (label, mesh) in [("Delaunay triangulation", &self.start), ("after 7 iterations", &self.seventh)] {
            let surface = SurfaceMesh::new(mesh.vertices.iter().map(|x| x.push(0.0)).collect(), mesh.elements.clone());
            let triangles: Vec<Triangle> =
                surface.elements.iter().map(|triangle| triangle.map(|i| surface.vertices[i].into())).collect();
            let origin = surface.vertices[0].into();
            parts.push(drawn(label, &triangles, [origin, origin])?);
            histograms.push(histogram(&format!("R/l: {label}"), &surface).scaled(CELL));
        }
        parts.push(grid("", 1, &histograms));
        let caption = format!(
            "{}: boundary points and scattered ones, smoothed from their plain Delaunay triangulation; R/l of its triangles.",
            self.name
        );
        Ok(Figure::new(format!("flat-mesh-{}", self.name), grid(self.name, 2, &parts), caption))
    }
}

/// A histogram of circumradius over shortest edge. Every second end of a bin is written.
fn histogram(label: &str, mesh: &SurfaceMesh) -> Drawing {
    let Some(ratios) = triangle_distributions(mesh).pop() else { return distribution(label, &[], &[]) };
    let counts = ratios.counts();
    let ends = (0..counts.len()).map(|bin| if bin % 2 == 1 { ratios.ends(bin)[0].clone() } else { String::new() });
    distribution(label, &ends.collect::<Vec<_>>(), &counts)
}
