//! Mistakes of the thesis, each with three figures: by the thesis' rule, ours, and the true one.

use std::path::Path;

use fem_mesh::{Pattern, box_mesh};
use fem_model::simulation::Simulation;
use nalgebra::Vector3;

use super::dense::{elasticity, solve, stiffness};
use super::setting::{POISSON, Setting, YOUNG, equilibrium, loads, squash, supports};
use super::torus::Torus;
use crate::experiments::mistake::{Mistake, marks, table};
use crate::scenes::{REPLACED, double, simulation};
use crate::study::Part;

/// Shear diagonals of the elasticity matrix in its common factor: printed in the thesis, and right.
const PRINTED: f64 = 1.0 - 2.0 * POISSON;
const RIGHT: f64 = 0.5 * PRINTED;

/// Computes them.
pub fn run(_: &Path, _: bool) -> Result<Part, String> {
    let found = [sheared_cube()?, torus()?, turning_body()?];
    let text = "The thesis prints an elasticity matrix with 1 − 2ν on its shear diagonal beside engineering shear strains, which doubles the shear modulus. The stiffness \
                V Bᵀ C B with this matrix, and with the right one, (1 − 2ν)/2, is programmed in a few lines with dense matrices; the latter is also a reference for the engine. \
                The linear strain of a rotation is not zero: a free body that turns by an angle ωt in the linear law grows by √(1 + (ωt)²), since its nodes go straight on.";
    Ok(Part::new(text).marks(marks(&found)).tables([table("rtfem-mistakes", &found)]))
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
    let f = K * nalgebra::DVector::from_iterator(3 * moved.len(), moved.iter().flatten().copied());
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
    let mesh = box_mesh([2.0, 0.5, 0.5], 2, Pattern::Kuhn).map_err(|error| error.to_string())?;
    let material = format!("model = \"{law}\"\nyoung = 1e8\npoisson = {POISSON}\ndensity = 1000");
    let spin = "[[initial_velocity]]\nangular = { axis = [0, 0, 1], rate = 1 }\n";
    let text = crate::scenes::text(REPLACED, &material, "integrator = \"verlet\"\ndt = 2e-4", spin);
    let mut bar = simulation(&text, mesh.clone())?;
    for _ in 0..5000 {
        bar.step().map_err(|failure| failure.to_string())?;
    }
    let q = bar.positions();
    let middle = |x: f64| -> Vector3<f64> {
        let nodes: Vec<usize> = (0..mesh.vertices.len()).filter(|&i| (mesh.vertices[i].x - x).abs() < 1e-9).collect();
        nodes.iter().map(|&i| q.fixed_rows::<3>(3 * i).into_owned()).sum::<Vector3<f64>>() / nodes.len() as f64
    };
    Ok((middle(2.0) - middle(0.0)).norm() / 2.0)
}
