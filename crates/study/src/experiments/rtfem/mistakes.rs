//! Mistakes of the thesis, each with three figures: by the thesis' rule, ours, and the true one.

use std::path::Path;

use fem_chart::grid;
use fem_engine::simulator::Simulator;
use fem_engine::tensor::inverse;
use fem_mesh::{Pattern, TetrahedralMesh, boundary, box_mesh, distinct_edges};
use fem_model::simulation::{Diagnostics, Simulation};
use fem_model::{Axis, Body, EdgeStiffness, Integrator, Law, Material, Method, Selector};
use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, SMatrix, Vector3};

use super::momentum::{DENSITY, lumped, momenta};
use super::setting::{POISSON, Setting, YOUNG, equilibrium, loads, squash, supports};
use super::torus::Torus;
use crate::experiments::drawing::{Triangle, drawn};
use crate::experiments::mistake::{Mistake, marks, table};
use crate::scenes::{material, simulator, spinning, thrown};
use crate::study::{Figure, Part, Result, pairs};

/// Shear diagonals of the elasticity matrix in its common factor: printed in the thesis, and right.
const PRINTED: f64 = 1.0 - 2.0 * POISSON;
const RIGHT: f64 = 0.5 * PRINTED;

/// Computes them.
pub fn run(_: &Path, _: bool) -> Result<Part> {
    let found = [sheared_cube()?, torus()?, turning_body()?, named_explicit()?, damper()?];
    let text = "The thesis prints an elasticity matrix with 1 − 2ν on its shear diagonal beside engineering shear strains, which doubles the shear modulus; it stands so in the thesis' final version too. The stiffness \
                V Bᵀ C B with this matrix, and with the right one, (1 − 2ν)/2, is programmed in a few lines with dense matrices; the latter is also a reference for the engine. \
                The linear strain of a rotation is not zero: a free body that turns by an angle ωt in the linear law grows by √(1 + (ωt)²), since its nodes go straight on. Its equations (1.14) and (1.15), called explicit Euler, move the positions by the new velocities and so are semi-implicit \
                Euler, whose energy stays near its first value where that of explicit Euler grows. Its damper (1.3) acts along the relative velocity and is not projected on the spring: \
                it brakes a body that turns as a whole.";
    Ok(Part::new(text).marks(marks(&found)).tables([table("rtfem-mistakes", &found)]).figures([turning_bars()?]))
}

/// Shear modulus of a cube whose nodes have the displacement γ y along x.
fn sheared_cube() -> Result<Mistake> {
    const STRAIN: f64 = 1e-3;
    let mesh = box_mesh([1.0, 1.0, 1.0], 3, Pattern::Kuhn)?;
    let moved: Vec<[f64; 3]> = mesh.vertices.iter().map(|x| [STRAIN * x.y, 0.0, 0.0]).collect();
    // The forces that hold the face y = 1 against the block's own.
    let modulus = |force: &dyn Fn(usize) -> f64| -> f64 {
        let top = (0..mesh.vertices.len()).filter(|&i| mesh.vertices[i].y > 1.0 - 1e-9);
        top.map(force).sum::<f64>() / STRAIN
    };
    let K = stiffness(&mesh, &elasticity(YOUNG, POISSON, PRINTED));
    let f = K * DVector::from_iterator(3 * moved.len(), moved.iter().flatten().copied());
    let setting = Setting::default();
    let mut cube = simulator(setting.body(mesh.clone())?, &setting.method())?;
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
fn torus() -> Result<Mistake> {
    let mesh = Torus::of_size(182)?.mesh;
    let supports = supports(&mesh);
    let of_axis = |(axis, nodes): (usize, &Vec<usize>)| nodes.iter().map(|node| 3 * node + axis).collect::<Vec<_>>();
    let constrained: Vec<usize> = supports.iter().enumerate().flat_map(of_axis).collect();
    let dense = |shear: f64| -> Result<f64> {
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
fn turning_body() -> Result<Mistake> {
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

fn turned(law: &str) -> Result<f64> {
    let mesh = bar_mesh()?;
    let q = turned_by(&mesh, law, 5000)?;
    let middle = |x: f64| -> Vector3<f64> {
        let nodes: Vec<usize> = (0..mesh.vertices.len()).filter(|&i| (mesh.vertices[i].x - x).abs() < 1e-9).collect();
        nodes.iter().map(|&i| q.fixed_rows::<3>(3 * i).into_owned()).sum::<Vector3<f64>>() / nodes.len() as f64
    };
    Ok((middle(2.0) - middle(0.0)).norm() / 2.0)
}

fn bar_mesh() -> Result<TetrahedralMesh> {
    Ok(box_mesh([2.0, 0.5, 0.5], 2, Pattern::Kuhn)?)
}

/// Positions of a free bar that turns at 1 rad/s, after so many steps of 0.2 ms.
fn turned_by(mesh: &TetrahedralMesh, law: &str, steps: usize) -> Result<DVector<f64>> {
    let body = Body::new(mesh.clone(), material(law, 1e8, POISSON, 1000.0)?)?;
    let mut bar = simulator(spinning(body, [0.0, 0.0, 1.0], 1.0), &Method::new(Integrator::Verlet, 2e-4))?;
    for _ in 0..steps {
        bar.step()?;
    }
    Ok(bar.positions())
}

/// The bar in the linear law and in the corotated one, as it turns.
fn turning_bars() -> Result<Figure> {
    let mesh = bar_mesh()?;
    let mut pictures = Vec::new();
    for (steps, law) in pairs([0, 2500, 5000, 7500], ["linear", "corotated"]) {
        let q = turned_by(&mesh, law, steps)?;
        let place = |i: usize| [q[3 * i], q[3 * i + 1], q[3 * i + 2]];
        let faces: Vec<Triangle> = boundary(&mesh).into_iter().map(|face| face.map(place)).collect();
        let label = format!("{law}, {:.0}°", (2e-4 * steps as f64).to_degrees());
        pictures.push(drawn(&label, &faces, [[-0.7, -1.6, -0.2], [2.6, 2.1, 0.7]])?);
    }
    let caption = "A free bar that turns at 1 rad/s: in the linear law it grows, its angle by which its nodes have gone being arctan ωt; in the corotated one it turns.";
    Ok(Figure::new("rtfem-turning", grid("a bar that turns", 2, &pictures), caption))
}

/// Energy of a vibrating bar after a thousand steps of the equations (1.14) and (1.15).
fn named_explicit() -> Result<Mistake> {
    const STEPS: usize = 1000;
    let body = Body::new(bar_mesh()?, material("linear", 1e6, POISSON, 1000.0)?)?;
    let body = thrown(body, &Selector::most(Axis::X), [0.1, 0.0, 0.0])?;
    let bar = |dt: f64| simulator(body.clone(), &Method::new(Integrator::SemiImplicitEuler, dt));
    let limit = bar(1.0)?.critical_time_step().ok_or("the bar has no stiffness")?;
    // The share of the limit, z = ω dt = 0.1 of the fastest vibration.
    let z = 0.1;
    let mut bar = bar(0.5 * z * limit)?;
    let before = bar.energies().total();
    for _ in 0..STEPS {
        bar.step()?;
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
fn damper() -> Result<Mistake> {
    const DAMPING: f64 = 20.0;
    let mesh = bar_mesh()?;
    let masses = lumped(&mesh);
    let law = Law::MassSpring { stiffness: EdgeStiffness::Young(1e6), damping: DAMPING };
    let body = spinning(Body::new(mesh.clone(), Material::new(law, DENSITY))?, [0.0, 0.0, 1.0], 1.0);
    let body = Body { lumped_mass: true, ..body };
    // A rigid rotation by ω has Σ d |r|² ω as the moment of the printed dampers along r, across the axis.
    let across = |x: Vector3<f64>| x.xy().norm_squared();
    let pairs = |of: &[usize; 4]| [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)].map(|(a, b)| [of[a], of[b]]);
    let springs = distinct_edges(mesh.elements.iter().flat_map(pairs));
    let brake: f64 = springs.iter().map(|&[a, b]| DAMPING * across(mesh.vertices[a] - mesh.vertices[b])).sum();
    let centre = Vector3::new(1.0, 0.25, 0.25);
    let inertia: f64 = masses.iter().zip(&mesh.vertices).map(|(mass, x)| mass * across(x - centre)).sum();
    let mut bar = Simulator::<f64>::new(body, &Method::new(Integrator::Verlet, 2e-4))?;
    let before = momenta(&bar, &masses).1.z;
    for _ in 0..5000 {
        bar.step()?;
    }
    let time = bar.time();
    Ok(Mistake {
        rule: "damper (1.3) along the relative velocity",
        right: "projected on the spring",
        quantity: format!("angular momentum of a free body of springs after {time:.0} s, over that at the start"),
        theirs: (-brake / inertia * time).exp(),
        ours: momenta(&bar, &masses).1.z / before,
        truth: 1.0,
        tolerance: 1e-9,
    })
}

// Linear elasticity as textbooks and the thesis write it, with dense matrices and apart from the engine: strains ε = B u in engineering
// notation (xx, yy, zz, xy, yz, zx), element stiffness V Bᵀ C B.

/// Elasticity matrix, Pa. Engineering shear strains need the shear modulus on its diagonal, (1 − 2ν)/2 in the common factor
/// E/((1 + ν)(1 − 2ν)); the thesis prints 1 − 2ν.
fn elasticity(young: f64, poisson: f64, shear: f64) -> Matrix6<f64> {
    let factor = young / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let entry = |i: usize, j: usize| match i == j {
        true if i < 3 => 1.0 - poisson,
        true => shear,
        false if i < 3 && j < 3 => poisson,
        false => 0.0,
    };
    Matrix6::from_fn(|i, j| factor * entry(i, j))
}

/// Stiffness of the mesh, N/m.
fn stiffness(mesh: &TetrahedralMesh, C: &Matrix6<f64>) -> DMatrix<f64> {
    let size = 3 * mesh.vertices.len();
    let mut K = DMatrix::zeros(size, size);
    for element in &mesh.elements {
        let [a, b, c, d] = element.map(|i| mesh.vertices[i]);
        let edges = Matrix3::from_columns(&[b - a, c - a, d - a]);
        let volume = edges.determinant() / 6.0;
        let inverse = inverse(&edges);
        // Rows of the inverse are the gradients of the last three barycentric coordinates.
        let rest: [Vector3<f64>; 3] = std::array::from_fn(|i| inverse.row(i).transpose());
        let gradients = [-(rest[0] + rest[1] + rest[2]), rest[0], rest[1], rest[2]];
        let B = strain_matrix(&gradients);
        let of_element = B.transpose() * C * B * volume;
        for (row, &i) in element.iter().enumerate() {
            for (column, &j) in element.iter().enumerate() {
                let block = of_element.fixed_view::<3, 3>(3 * row, 3 * column);
                let mut place = K.fixed_view_mut::<3, 3>(3 * i, 3 * j);
                place += block;
            }
        }
    }
    K
}

fn strain_matrix(gradients: &[Vector3<f64>; 4]) -> SMatrix<f64, 6, 12> {
    let mut B = SMatrix::zeros();
    for (node, g) in gradients.iter().enumerate() {
        let rows =
            [[g.x, 0.0, 0.0], [0.0, g.y, 0.0], [0.0, 0.0, g.z], [g.y, g.x, 0.0], [0.0, g.z, g.y], [g.z, 0.0, g.x]];
        for (i, row) in rows.iter().enumerate() {
            for j in 0..3 {
                B[(i, 3 * node + j)] = row[j];
            }
        }
    }
    B
}

/// Displacements (m) under nodal forces (N), with some of the 3n components zero.
fn solve(K: &DMatrix<f64>, forces: &[Vector3<f64>], constrained: &[usize]) -> Result<Vec<Vector3<f64>>> {
    let mut K = K.clone();
    let mut f = DVector::from_iterator(K.nrows(), forces.iter().flat_map(|f| f.iter().copied()));
    for &i in constrained {
        K.row_mut(i).fill(0.0);
        K.column_mut(i).fill(0.0);
        K[(i, i)] = 1.0;
        f[i] = 0.0;
    }
    let factor = K.cholesky().ok_or("the stiffness is not positive definite; the body can move freely")?;
    let u = factor.solve(&f);
    Ok((0..forces.len()).map(|i| u.fixed_rows::<3>(3 * i).into_owned()).collect())
}
