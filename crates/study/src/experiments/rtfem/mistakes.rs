//! Mistakes of the thesis, each with three figures: by the thesis' rule, ours, and the true one.

use std::path::Path;

use fem_chart::grid;
use fem_mesh::{Pattern, TetrahedralMesh, boundary, box_mesh, distinct_edges};
use fem_model::simulation::Simulation;
use nalgebra::{DVector, Vector3};

use super::dense::{elasticity, solve, stiffness};
use super::momentum::{DENSITY, lumped, momenta};
use super::setting::{POISSON, Setting, YOUNG, equilibrium, loads, squash, supports};
use super::torus::Torus;
use crate::experiments::drawing::{Triangle, drawn};
use crate::experiments::mistake::{Mistake, marks, table};
use crate::scenes::{REPLACED, double, simulation};
use crate::study::{Figure, Part};

/// Shear diagonals of the elasticity matrix in its common factor: printed in the thesis, and right.
const PRINTED: f64 = 1.0 - 2.0 * POISSON;
const RIGHT: f64 = 0.5 * PRINTED;

/// Computes them.
pub fn run(_: &Path, _: bool) -> Result<Part, String> {
    let found = [sheared_cube()?, torus()?, turning_body()?, named_explicit()?, damper()?];
    let text = "The thesis prints an elasticity matrix with 1 − 2ν on its shear diagonal beside engineering shear strains, which doubles the shear modulus; it stands so in the thesis' final version too. The stiffness \
                V Bᵀ C B with this matrix, and with the right one, (1 − 2ν)/2, is programmed in a few lines with dense matrices; the latter is also a reference for the engine. \
                The linear strain of a rotation is not zero: a free body that turns by an angle ωt in the linear law grows by √(1 + (ωt)²), since its nodes go straight on. Its equations (1.14) and (1.15), called explicit Euler, move the positions by the new velocities and so are semi-implicit \
                Euler, whose energy stays near its first value where that of explicit Euler grows. Its damper (1.3) acts along the relative velocity and is not projected on the spring: \
                it brakes a body that turns as a whole.";
    Ok(Part::new(text).marks(marks(&found)).tables([table("rtfem-mistakes", &found)]).figures([turning_bars()?]))
}

/// Shear modulus of a cube whose nodes have the displacement γ y along x.
fn sheared_cube() -> Result<Mistake, String> {
    const STRAIN: f64 = 1e-3;
    let mesh = box_mesh([1.0, 1.0, 1.0], 3, Pattern::Kuhn).map_err(|error| error.to_string())?;
    let moved: Vec<[f64; 3]> = mesh.vertices.iter().map(|x| [STRAIN * x.y, 0.0, 0.0]).collect();
    // The forces that hold the face y = 1 against the block's own.
    let modulus = |force: &dyn Fn(usize) -> f64| -> f64 {
        let top = (0..mesh.vertices.len()).filter(|&i| mesh.vertices[i].y > 1.0 - 1e-9);
        top.map(force).sum::<f64>() / STRAIN
    };
    let K = stiffness(&mesh, &elasticity(YOUNG, POISSON, PRINTED));
    let f = K * DVector::from_iterator(3 * moved.len(), moved.iter().flatten().copied());
    let mut cube = double(&Setting::default().text(), Some(mesh.clone().into()))?;
    cube.set_state(&moved, &vec![[0.0; 3]; moved.len()]);
    let own = cube.nodal_forces().ok_or("the engine has no nodal forces")?;
    let truth = YOUNG / (2.0 * (1.0 + POISSON));
    Ok(Mistake {
        rule: "1 − 2ν on the shear diagonal",
        right: "(1 − 2ν)/2",
        quantity: "shear modulus of a sheared cube (Pa)".to_owned(),
        theirs: modulus(&|i| f[3 * i]),
        ours: modulus(&|i| -own[3 * i]),
        truth,
        tolerance: 1e-9 * truth,
    })
}

/// Approach of the loaded sides of the smallest torus.
fn torus() -> Result<Mistake, String> {
    let mesh = Torus::of_size(182)?.mesh;
    let supports = supports(&mesh);
    let of_axis = |(axis, nodes): (usize, &Vec<usize>)| nodes.iter().map(|node| 3 * node + axis).collect::<Vec<_>>();
    let constrained: Vec<usize> = supports.iter().enumerate().flat_map(of_axis).collect();
    let dense = |shear: f64| -> Result<f64, String> {
        let K = stiffness(&mesh, &elasticity(YOUNG, POISSON, shear));
        Ok(squash(&mesh, &solve(&K, &loads(&mesh), &constrained)?).0)
    };
    let truth = dense(RIGHT)?;
    Ok(Mistake {
        rule: "1 − 2ν on the shear diagonal",
        right: "(1 − 2ν)/2",
        quantity: "approach of the loaded sides of the torus of 182 elements (m)".to_owned(),
        theirs: dense(PRINTED)?,
        ours: squash(&mesh, &equilibrium(&Setting::default(), &mesh)?).0,
        truth,
        tolerance: 1e-9 * truth,
    })
}

/// Length of a free bar that has turned by an angle of 1, over its length at rest.
fn turning_body() -> Result<Mistake, String> {
    Ok(Mistake {
        rule: "linear strain of a body that turns",
        right: "corotated strain",
        quantity: "length of a free bar that has turned by about 57°, over its length at rest".to_owned(),
        theirs: turned("linear")?,
        ours: turned("corotated")?,
        truth: 1.0,
        tolerance: 1e-4,
    })
}

fn turned(law: &str) -> Result<f64, String> {
    let mesh = bar_mesh()?;
    let q = turned_by(&mesh, law, 5000)?;
    let middle = |x: f64| -> Vector3<f64> {
        let nodes: Vec<usize> = (0..mesh.vertices.len()).filter(|&i| (mesh.vertices[i].x - x).abs() < 1e-9).collect();
        nodes.iter().map(|&i| q.fixed_rows::<3>(3 * i).into_owned()).sum::<Vector3<f64>>() / nodes.len() as f64
    };
    Ok((middle(2.0) - middle(0.0)).norm() / 2.0)
}

fn bar_mesh() -> Result<TetrahedralMesh, String> {
    box_mesh([2.0, 0.5, 0.5], 2, Pattern::Kuhn).map_err(|error| error.to_string())
}

/// Positions of a free bar that turns at 1 rad/s, after so many steps of 0.2 ms.
fn turned_by(mesh: &TetrahedralMesh, law: &str, steps: usize) -> Result<DVector<f64>, String> {
    let material = format!("model = \"{law}\"\nyoung = 1e8\npoisson = {POISSON}\ndensity = 1000");
    let spin = "[[initial_velocity]]\nangular = { axis = [0, 0, 1], rate = 1 }\n";
    let text = crate::scenes::text(REPLACED, &material, "integrator = \"verlet\"\ndt = 2e-4", spin);
    let mut bar = simulation(&text, mesh.clone())?;
    for _ in 0..steps {
        bar.step().map_err(|failure| failure.to_string())?;
    }
    Ok(bar.positions())
}

/// The bar in the linear law and in the corotated one, as it turns.
fn turning_bars() -> Result<Figure, String> {
    let mesh = bar_mesh()?;
    let mut pictures = Vec::new();
    for steps in [0, 2500, 5000, 7500] {
        for law in ["linear", "corotated"] {
            let q = turned_by(&mesh, law, steps)?;
            let place = |i: usize| [q[3 * i], q[3 * i + 1], q[3 * i + 2]];
            let faces: Vec<Triangle> = boundary(&mesh).into_iter().map(|face| face.map(place)).collect();
            let label = format!("{law}, {:.0}°", (2e-4 * steps as f64).to_degrees());
            pictures.push(drawn(&label, &faces, [[-0.7, -1.6, -0.2], [2.6, 2.1, 0.7]])?);
        }
    }
    let caption = "A free bar that turns at 1 rad/s: in the linear law it grows, its angle by which its nodes have gone being arctan ωt; in the corotated one it turns.";
    Ok(Figure {
        name: "rtfem-turning".to_owned(),
        picture: grid("a bar that turns", 2, &pictures),
        caption: caption.to_owned(),
    })
}

/// Energy of a vibrating bar after a thousand steps of the equations (1.14) and (1.15).
fn named_explicit() -> Result<Mistake, String> {
    const STEPS: usize = 1000;
    let material = format!("model = \"linear\"\nyoung = 1e6\npoisson = {POISSON}\ndensity = 1000");
    let stretched =
        "[[initial_velocity]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nvelocity = [0.1, 0, 0]\n";
    let text = |dt: f64| {
        let time = format!("integrator = \"semi_implicit_euler\"\ndt = {dt:e}");
        crate::scenes::text(REPLACED, &material, &time, stretched)
    };
    let mesh = bar_mesh()?;
    let limit = simulation(&text(1.0), mesh.clone())?.critical_time_step().ok_or("the bar has no stiffness")?;
    // The share of the limit, z = ω dt = 0.1 of the fastest vibration.
    let z = 0.1;
    let mut bar = simulation(&text(0.5 * z * limit), mesh)?;
    let before = bar.energies().total();
    for _ in 0..STEPS {
        bar.step().map_err(|failure| failure.to_string())?;
    }
    Ok(Mistake {
        rule: "equations (1.14) and (1.15) called explicit Euler",
        right: "semi-implicit Euler",
        quantity: format!(
            "energy of the fastest vibration after {STEPS} steps with ω dt = {z}, over that at the start"
        ),
        // Each step of explicit Euler multiplies the energy of an oscillator by 1 + (ω dt)².
        theirs: (1.0_f64 + z * z).powi(STEPS as i32),
        ours: bar.energies().total() / before,
        truth: 1.0,
        tolerance: z,
    })
}

/// Angular momentum of a turning body of springs, with dampers along the springs and with dampers along the relative velocities.
fn damper() -> Result<Mistake, String> {
    const DAMPING: f64 = 20.0;
    let mesh = bar_mesh()?;
    let masses = lumped(&mesh);
    let material = format!(
        "model = \"mass_spring\"\nyoung = 1e6\ndamping = {DAMPING}\ndensity = {DENSITY}\n[mass]\nlumped = true"
    );
    let spin = "[[initial_velocity]]\nangular = { axis = [0, 0, 1], rate = 1 }\n";
    let text = crate::scenes::text(REPLACED, &material, "integrator = \"verlet\"\ndt = 2e-4", spin);
    // A rigid rotation by ω has Σ d |r|² ω as the moment of the printed dampers along r, across the axis.
    let across = |x: Vector3<f64>| x.xy().norm_squared();
    let pairs = |of: &[usize; 4]| [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)].map(|(a, b)| [of[a], of[b]]);
    let springs = distinct_edges(mesh.elements.iter().flat_map(pairs));
    let brake: f64 = springs.iter().map(|&[a, b]| DAMPING * across(mesh.vertices[a] - mesh.vertices[b])).sum();
    let centre = Vector3::new(1.0, 0.25, 0.25);
    let inertia: f64 = masses.iter().zip(&mesh.vertices).map(|(mass, x)| mass * across(x - centre)).sum();
    let mut bar = simulation(&text, mesh)?;
    let turning = |bar: &dyn Simulation| momenta(bar, &masses).1.z;
    let before = turning(&*bar);
    for _ in 0..5000 {
        bar.step().map_err(|failure| failure.to_string())?;
    }
    Ok(Mistake {
        rule: "damper (1.3) along the relative velocity",
        right: "projected on the spring",
        quantity: format!(
            "angular momentum of a free body of springs after {:.0} s, over that at the start",
            bar.time()
        ),
        theirs: (-brake / inertia * bar.time()).exp(),
        ours: turning(&*bar) / before,
        truth: 1.0,
        tolerance: 1e-9,
    })
}
