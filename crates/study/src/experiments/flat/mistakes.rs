//! Mistakes of the thesis, each with three figures: by the thesis' rule, ours, and the true one.

use std::path::Path;

use fem_engine::materials::{Corotated, Law};
use fem_engine::plasticity::Additive;
use fem_engine::tensor::{Tensor, dot, zero};
use fem_mesh::generate::delaunay::triangulate;
use fem_mesh::{Mesh, Pattern, rectangle_mesh, triangle_quality};
use fem_model::simulation::{Diagnostics, Simulation};
use fem_model::{Axis, Body, BodyMesh, ContactPlane, Damping, DampingForm, Integrator, Method, Selector};
use nalgebra::{Matrix2, Vector2, Vector3};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::contact::block;
use super::modulus::{STRAIN, YOUNG, modulus};
use super::object::{LAME, material, meshed, picture};
use super::plasticity::relaxation::relaxation;
use crate::experiments::mistake::{Mistake, marks, table};
use crate::scenes::{simulator, step, steps, thrown};
use crate::study::{Part, Problem, Result};

/// Computes all of them.
pub fn run(data: &Path, quick: bool) -> Result<Part> {
    let mut found = vec![thirds()?, best()];
    found.push(energy_factor(data)?);
    found.extend(friction(quick)?);
    found.push(creep()?);
    found.push(cap());
    found.push(first_vertex());
    found.push(projection()?);
    found.push(slivers(data)?);
    found.push(verlet()?);
    let text = "The thesis' rules, programmed in a few lines each, beside this program. Two figures are not computed but printed in the thesis: the best R/l of 0.5 and the \
                order 4 of Verlet. The thesis does not say which norms it compares; the row of the cap takes the Frobenius norm for the yield and the spectral norm for the cap.";
    Ok(Part::new(text).marks(marks(&found)).tables([table("flat-mistakes", &found)]))
}

/// Nodal forces of a stretched strip with ν = 0, divided by 3 in place of 2.
fn thirds() -> Result<Mistake> {
    Ok(Mistake {
        rule: "the force of a triangle's edges divided by 3",
        right: "divided by 2",
        quantity: "modulus of a stretched strip over E".to_owned(),
        theirs: strip(3.0)? / YOUNG,
        ours: modulus("corotated")? / YOUNG,
        truth: 1.0,
        tolerance: 1e-10,
    })
}

/// Force of a strip of 2 × 1 m with constant stress on the nodes of its end, over area and strain, Pa. Each node has the forces of the two
/// edges that meet in it, divided by `divisor`.
fn strip(divisor: f64) -> Result<f64> {
    let mesh = rectangle_mesh([2.0, 1.0], 3, Pattern::Kuhn)?;
    let stress = YOUNG * STRAIN;
    let mut force = 0.0;
    for triangle in &mesh.elements {
        for i in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|k| mesh.vertices[triangle[(i + k) % 3]]);
            if a.x < 2.0 - 1e-9 {
                continue;
            }
            // Outward normals of the edges ab and ca, times their lengths, along x.
            force -= stress * ((b.y - a.y) + (a.y - c.y)) / divisor;
        }
    }
    Ok(force.abs() / STRAIN)
}

/// The elastic energy of a deformed triangle whose vertices are numbered in three ways.
fn first_vertex() -> Mistake {
    let rest = [[0.0, 0.0], [1.0, 0.0], [0.2, 0.9]].map(Vector2::from);
    let F = Matrix2::new(1.2, 0.5, -0.1, 0.9);
    let now = rest.map(|x| F * x);
    let spread = |energy: &dyn Fn([Vector2<f64>; 3], [Vector2<f64>; 3]) -> f64| {
        let of = |first: usize| [0, 1, 2].map(|k| (first + k) % 3);
        let energies = [0, 1, 2].map(|first| energy(of(first).map(|i| rest[i]), of(first).map(|i| now[i])));
        let (low, high) = energies.iter().fold((f64::INFINITY, 0.0f64), |(a, b), &x| (a.min(x), b.max(x)));
        (high - low) / high
    };
    Mistake {
        rule: "corotation by QR of the edges",
        right: "by polar decomposition",
        quantity: "relative spread of a triangle's energy over its first vertex".to_owned(),
        theirs: spread(&by_qr),
        ours: spread(&by_polar),
        truth: 0.0,
        tolerance: 1e-13,
    }
}

/// The edges from the first vertex as columns.
fn edges([a, b, c]: [Vector2<f64>; 3]) -> Matrix2<f64> {
    Matrix2::from_columns(&[b - a, c - a])
}

fn inverse(A: &Matrix2<f64>) -> Matrix2<f64> {
    Matrix2::new(A.m22, -A.m12, -A.m21, A.m11) / A.determinant()
}

/// Corotated energy density with the rotation of the first edge, J/m³: the QR decomposition of the edges has it as Q.
fn by_qr(rest: [Vector2<f64>; 3], now: [Vector2<f64>; 3]) -> f64 {
    let (before, after) = (edges(rest), edges(now));
    let frame = |edges: &Matrix2<f64>| {
        let first = edges.column(0).normalize();
        Matrix2::new(first.x, -first.y, first.y, first.x)
    };
    let R = frame(&after) * frame(&before).transpose();
    let S = R.transpose() * after * inverse(&before);
    let strain = 0.5 * (S + S.transpose()) - Matrix2::identity();
    LAME * strain.norm_squared() + 0.5 * LAME * strain.trace().powi(2)
}

/// The engine's corotated energy density, J/m³.
fn by_polar(rest: [Vector2<f64>; 3], now: [Vector2<f64>; 3]) -> f64 {
    let F = edges(now) * inverse(&edges(rest)) - Matrix2::identity();
    let G: Tensor<f64> = [[F.m11, F.m12, 0.0], [F.m21, F.m22, 0.0], [0.0; 3]];
    Corotated { mu: LAME, lambda: LAME }.energy(&G)
}

/// The elastic strain at constant strain after half a second.
fn creep() -> Result<Mistake> {
    let found = relaxation(0.05)?;
    let at = found.instants.iter().find(|at| at.time >= 0.5 - 1e-9).ok_or("the relaxation is too short")?;
    Ok(Mistake {
        rule: "creep flows by the whole strain",
        right: "by the elastic excess over the yield",
        quantity: "|εᵉ| after 0.5 s of constant strain".to_owned(),
        theirs: at.theirs,
        ours: at.elastic,
        truth: at.closed_form,
        tolerance: 1e-6,
    })
}

const YIELD: f64 = 0.05;
const MAXIMUM: f64 = 0.1;

/// The plastic strain of a body that is stretched in both directions until its bound stops it.
fn cap() -> Mistake {
    let strain: Tensor<f64> = [[0.3, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0; 3]];
    let mut of = Additive { mu: 1.0, lambda: 1.0, plastic: zero(), is_in_plane: true };
    for _ in 0..100 {
        of.plastic = of.flow(&strain, YIELD, 0.1, MAXIMUM).0.plastic;
    }
    Mistake {
        rule: "the cap compares another norm than the yield",
        right: "one norm",
        quantity: "bounded |εᵖ| over the maximum".to_owned(),
        theirs: spectral_cap() / MAXIMUM,
        ours: dot(&of.plastic, &of.plastic).sqrt() / MAXIMUM,
        truth: 1.0,
        tolerance: 1e-12,
    }
}

/// |εᵖ| in the Frobenius norm, whose bound is on its largest eigenvalue; equal strains along x and y.
fn spectral_cap() -> f64 {
    let (strain, mut plastic) = (0.3, 0.0f64);
    for _ in 0..100 {
        if (strain - plastic) * 2f64.sqrt() > YIELD {
            plastic = (plastic + 0.1 * (strain - plastic)).min(MAXIMUM);
        }
    }
    plastic * 2f64.sqrt()
}

/// The observed order of Verlet's method on a vibrating strip, and on an oscillator.
fn verlet() -> Result<Mistake> {
    Ok(Mistake {
        rule: "Verlet called of fourth order",
        right: "of second order",
        quantity: "observed order".to_owned(),
        theirs: 4.0,
        ours: vibrating_strip()?,
        truth: oscillator(),
        tolerance: 0.02,
    })
}

/// The order at which the end of a strip's vibration changes as the time step is halved.
fn vibrating_strip() -> Result<f64> {
    let end = |dt: f64| {
        let mesh = BodyMesh::flat(rectangle_mesh([2.0, 1.0], 2, Pattern::Kuhn)?, 1.0);
        let body = thrown(Body::new(mesh, material(LAME))?, &Selector::most(Axis::X), [1.0, 0.2, 0.0])?;
        let mut simulation = simulator(body, &Method::new(Integrator::Verlet, dt))?;
        steps(&mut simulation, (0.05 / dt).round() as usize)?;
        Ok::<_, Problem>(simulation.positions())
    };
    let [coarse, middle, fine] = [end(1e-3)?, end(5e-4)?, end(2.5e-4)?];
    Ok(((&coarse - &middle).amax() / (&middle - &fine).amax()).log2())
}

/// The order of the error of x'' = −x at t = 1, by Störmer's formula.
fn oscillator() -> f64 {
    let error = |steps: i32| {
        let dt = 1.0 / f64::from(steps);
        // The exact second value, so that the error is that of the formula.
        let (mut before, mut x) = (1.0, dt.cos());
        for _ in 1..steps {
            (before, x) = (x, 2.0 * x - before - dt * dt * x);
        }
        (x - 1f64.cos()).abs()
    };
    (error(1000) / error(2000)).log2()
}

/// Frames in a second.
const FRAMES: f64 = 60.0;
const GRAVITY: f64 = 9.81;

/// The way to rest on a level floor with 1, 10 and 40 substeps a frame.
fn friction(quick: bool) -> Result<Vec<Mistake>> {
    let counts: &[usize] = if quick { &[1, 10] } else { &[1, 10, 40] };
    let row = |&substeps: &usize| {
        let dt = 1.0 / FRAMES / substeps as f64;
        // The contact's part judges how the error falls with the step.
        let tolerance = (block::VELOCITY * dt).max(0.01 * block::STOPPING);
        Ok(Mistake {
            rule: "friction multiplies the tangential velocity in each substep",
            right: "Coulomb's law",
            quantity: format!("way to rest with {substeps} substeps a frame (m)"),
            theirs: multiplied(dt),
            ours: block::way(Integrator::ImplicitEuler, dt)?,
            truth: block::STOPPING,
            tolerance,
        })
    };
    counts.iter().map(row).collect()
}

/// The way of a sliding body whose velocity each substep multiplies by 1 − μ, m.
fn multiplied(dt: f64) -> f64 {
    let (mut x, mut v) = (0.0, block::VELOCITY);
    while v > 1e-12 {
        v *= 1.0 - block::FRICTION;
        x += v * dt;
    }
    x
}

/// Substeps of a frame in the fall.
const SUBSTEPS: f64 = 10.0;

/// The largest depth below a floor after a substep of a fall of 1 m.
fn projection() -> Result<Mistake> {
    let dt = 1.0 / FRAMES / SUBSTEPS;
    let method = Method::new(Integrator::SemiImplicitEuler, dt);
    let damping = Damping { alpha: 0.0, beta: 1e-3, form: DampingForm::default() };
    let floor = ContactPlane::new(Vector3::new(0.0, -1.0, 0.0), Vector3::y());
    let square = BodyMesh::flat(rectangle_mesh([1.0, 1.0], 2, Pattern::Kuhn)?, 1.0);
    let body = Body::new(square, material(LAME))?.gravity([0.0, -GRAVITY, 0.0])?.damping(damping)?;
    let mut simulation = simulator(body.obstacles(vec![floor], &method)?, &method)?;
    let mut depth = 0.0f64;
    for _ in 0..600 {
        step(&mut simulation)?;
        depth = depth.max(-simulation.contacts()[0].smallest_gap);
    }
    Ok(Mistake {
        rule: "positions projected before the integration",
        right: "no penetration after a step",
        quantity: "largest depth after a fall of 1 m with 10 substeps (m)".to_owned(),
        theirs: projected_first(dt),
        ours: depth,
        truth: 0.0,
        tolerance: 0.0,
    })
}

/// The largest depth of a point after a substep that begins with its projection, m.
fn projected_first(dt: f64) -> f64 {
    let (mut y, mut v, mut depth) = (1.0, 0.0, 0.0f64);
    for _ in 0..600 {
        if y < 0.0 {
            (y, v) = (0.0, 0.0);
        }
        v -= GRAVITY * dt;
        y += v * dt;
        depth = depth.max(-y);
    }
    depth
}

/// Circumradius over shortest edge of the best triangle.
fn best() -> Mistake {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.75f64.sqrt()]].map(Vector2::from);
    Mistake {
        rule: "R/l of the best triangle is about 0.5",
        right: "R/l = 1/(2 sin θ) of the smallest angle θ",
        quantity: "R/l of an equilateral triangle".to_owned(),
        theirs: 0.5,
        ours: triangle_quality(&Mesh::new(corners.to_vec(), vec![[0, 1, 2]])).radius_to_edge.value,
        truth: 1.0 / 3f64.sqrt(),
        tolerance: 1e-14,
    }
}

/// Length of the edges of the square, m.
const EDGE: f64 = 0.1;

/// The error of the interpolant of |x|² that optimal Delaunay triangulation lowers, after smoothing and before.
fn energy_factor(data: &Path) -> Result<Mistake> {
    let square = picture(data, "square")?;
    let [before, after] = [meshed(&square, EDGE, 0)?, meshed(&square, EDGE, 20)?];
    let steps = &after.steps;
    let of_vertices = |factor: f64| interpolated(&after.mesh, factor) / interpolated(&before.mesh, factor);
    Ok(Mistake {
        rule: "factor 1/4 in the energy of optimal Delaunay triangulation",
        right: "1/(d + 1) = 1/3 in the plane",
        quantity: "energy of a square's mesh after smoothing over that before".to_owned(),
        theirs: of_vertices(0.25),
        ours: steps[steps.len() - 1].energy / steps[0].energy,
        truth: error(&after.mesh) / error(&before.mesh),
        tolerance: 1e-9,
    })
}

/// `factor` Σᵢ |xᵢ|² |Ωᵢ| − ∫ |x|², m⁴; the mid-edge rule is exact for the integral.
fn interpolated(mesh: &Mesh<2, 3>, factor: f64) -> f64 {
    let share = |triangle: &[usize; 3]| {
        let [a, b, c] = triangle.map(|i| mesh.vertices[i]);
        let area = 0.5 * (b - a).perp(&(c - a));
        let corners: f64 = [a, b, c].iter().map(Vector2::norm_squared).sum();
        let middles: f64 = [a + b, b + c, c + a].iter().map(|sum| (0.5 * sum).norm_squared()).sum();
        area * (factor * corners - middles / 3.0)
    };
    mesh.elements.iter().map(share).sum()
}

/// ∫ (u_I − u) of u = |x|² by the mid-edge rule, which is exact, m⁴.
fn error(mesh: &Mesh<2, 3>) -> f64 {
    let share = |triangle: &[usize; 3]| {
        let [a, b, c] = triangle.map(|i| mesh.vertices[i]);
        let at_middle = |a: Vector2<f64>, b: Vector2<f64>| {
            0.5 * (a.norm_squared() + b.norm_squared()) - (0.5 * (a + b)).norm_squared()
        };
        0.5 * (b - a).perp(&(c - a)) / 3.0 * (at_middle(a, b) + at_middle(b, c) + at_middle(c, a))
    };
    mesh.elements.iter().map(share).sum()
}

/// Largest R/l that the thesis keeps.
const KEPT: f64 = 3.0;

/// The area that is left of a square of 1 m².
fn slivers(data: &Path) -> Result<Mistake> {
    let mut random = ChaCha8Rng::seed_from_u64(0);
    let mut points: Vec<Vector2<f64>> = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vector2::from).into();
    points.extend((0..200).map(|_| Vector2::new(random.random(), random.random())));
    let mesh = triangulate(&points)?.mesh;
    let area = |triangle: &[usize; 3]| {
        let quality = triangle_quality(&Mesh::new(mesh.vertices.clone(), vec![*triangle]));
        if quality.radius_to_edge.value > KEPT { 0.0 } else { quality.area }
    };
    let square = meshed(&picture(data, "square")?, EDGE, 20)?;
    Ok(Mistake {
        rule: "triangles with R/l > 3 deleted at the end",
        right: "nothing is deleted, the boundary stays",
        quantity: "area of a square's mesh over that of the square".to_owned(),
        theirs: mesh.elements.iter().map(area).sum(),
        ours: triangle_quality(&square.mesh).area / square.area,
        truth: 1.0,
        tolerance: 5e-3,
    })
}
