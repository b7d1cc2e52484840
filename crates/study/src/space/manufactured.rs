//! The method of manufactured solutions: a cube with u_i = a_i sin πx sin πy sin πz, which is zero on all faces.
//!
//! The body force is −Div P = −∂P/∂F : ∇∇u, exact in every point. P. J. Roache, "Code
//! verification by the method of manufactured solutions", Journal of Fluids Engineering 124, 2002.

use std::f64::consts::PI;
use std::path::Path;

use nalgebra::{DVector, Vector3};

use crate::space::quadrature::Rule;
use fem_engine::forces::dead_load::DeadLoad;
use fem_engine::integrators::{Integrator, Statics};
use fem_engine::materials::AnyLaw;
use fem_engine::model::numbering::Numbering;
use fem_engine::model::state::State;
use fem_engine::model::system::System;
use fem_engine::newton::{Newton, NewtonLimits};
use fem_engine::solvers::{Solver, SolverChoice};
use fem_engine::tensor::{Tensor, from_fn};
use fem_mesh::{TetrahedralMesh, volumes};
use fem_scene::simulation::Counters;
use fem_scene::tables::FixedTable;
use fem_scene::{Body, Projection, Scene, body, parse};

/// a, m: large enough that the neo-Hookean law is far from linear.
pub const AMPLITUDE: [f64; 3] = [0.06, -0.05, 0.04];

/// Index of the quadrature rule of the body force and the errors.
const RULE: u32 = 3;

/// The discrete solution on one mesh.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The scene.
    pub scene: Scene,
    /// The mesh.
    pub mesh: TetrahedralMesh,
    /// Positions of all nodes, m.
    pub q: DVector<f64>,
    /// ‖u − u_h‖ / ‖u‖ over the cube.
    pub l2: f64,
    /// ‖∇u − ∇u_h‖ / ‖∇u‖ over the cube.
    pub h1: f64,
    /// Counters of the solution.
    pub counters: Counters,
    /// Wall-clock time of the solution without set-up, s.
    pub seconds: f64,
}

/// Exact displacement, m.
pub fn displacement(X: &Vector3<f64>) -> [f64; 3] {
    let product: f64 = X.iter().map(|x| (PI * x).sin()).product();
    AMPLITUDE.map(|a| a * product)
}

/// G_ij = ∂u_i/∂X_j.
pub fn gradient(X: &Vector3<f64>) -> Tensor<f64> {
    let (sin, cos) = (X.map(|x| (PI * x).sin()), X.map(|x| (PI * x).cos()));
    let part = |j: usize| PI * (0..3).map(|k| if k == j { cos[k] } else { sin[k] }).product::<f64>();
    from_fn(|i, j| AMPLITUDE[i] * part(j))
}

/// ∂²u_i/∂X_j∂X_l
fn second(X: &Vector3<f64>, i: usize, j: usize, l: usize) -> f64 {
    let (sin, cos) = (X.map(|x| (PI * x).sin()), X.map(|x| (PI * x).cos()));
    let factor = |k: usize| match (k == j, k == l) {
        (true, true) => -sin[k],
        (false, false) => sin[k],
        _ => cos[k],
    };
    AMPLITUDE[i] * PI * PI * (0..3).map(factor).product::<f64>()
}

/// −Div P, N/m³.
fn body_force(law: &AnyLaw<f64>, X: &Vector3<f64>) -> [f64; 3] {
    let G = gradient(X);
    let H = law.as_law().derivative(&G);
    let mut force = [0.0; 3];
    for (i, force) in force.iter_mut().enumerate() {
        for j in 0..3 {
            for k in 0..3 {
                for l in 0..3 {
                    *force -= H[3 * i + j][3 * k + l] * second(X, k, l, j);
                }
            }
        }
    }
    force
}

/// Solves on a mesh of `cells` cells in each direction.
pub fn solve(model: &str, cells: usize) -> Result<Solved, String> {
    let (scene, body) = cube(model, cells)?;
    let mesh = body.shape.mesh.solid().cloned().ok_or("a box is made of tetrahedra")?;
    let lacks = "the material lacks its parameters";
    let load = nodal_load(&AnyLaw::new(&scene.material).ok_or(lacks)?, &mesh);
    let law = AnyLaw::new(&scene.material).ok_or(lacks)?;
    let in_order = |numbering: &Numbering| numbering.mesh_node.iter().map(|&node| load[node as usize]).collect();
    let system = System::<f64>::with_forces(body, law, SolverChoice::Cholesky, &|numbering| {
        vec![Box::new(DeadLoad::new(in_order(numbering)))]
    });
    let mut counters = Counters::default();
    let mut state = State::at_rest(system.nodes());
    let projection = Projection::WhenNeeded;
    let limits = NewtonLimits { max_iterations: 50, tolerance: 1e-13, projection, solver_tolerance: 1e-12 };
    let rest: Vec<[f64; 3]> = system.rest[..system.free()].iter().map(|x| (*x).into()).collect();
    let solver = Solver::new(SolverChoice::Cholesky, &system.pattern, &rest);
    let newton = Newton::new(limits, solver, system.nodes(), system.pattern.blocks());
    let mut method = Statics::new(newton, &system, 1);
    let start = std::time::Instant::now();
    method.step(&system, &mut state, 1.0, &mut counters).map_err(|cause| format!("no equilibrium: {cause:?}"))?;
    counters.steps = 1;
    let seconds = start.elapsed().as_secs_f64();
    let u = system.numbering.to_mesh(&state.u);
    let (l2, h1) = errors(&mesh, &u);
    let q = DVector::from_fn(3 * u.len(), |i, _| mesh.vertices[i / 3][i % 3] + u[i / 3][i % 3]);
    Ok(Solved { scene, mesh, q, l2, h1, counters, seconds })
}

/// The unit cube with fixed faces.
fn cube(model: &str, cells: usize) -> Result<(Scene, Body), String> {
    let moduli = match model {
        "neo_hookean" => "model = \"neo_hookean\"\nC = 1e4\nD = 3e4",
        _ => "model = \"linear\"\nyoung = 1e5\npoisson = 0.3",
    };
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [1, 1, 1], cells_per_unit = {cells} }}\n[material]\n{moduli}\n\
         density = 1000.0\n[time]\ndt = 1.0\nintegrator = \"static\"\nsteps = 1\n"
    );
    let name = if model == "neo_hookean" { "manufactured-neo-hookean" } else { "manufactured-linear" };
    let mut scene = parse(&text, Path::new(&format!("{name}.toml"))).map_err(|error| error.to_string())?;
    let per_edge = cells + 1;
    let is_inside = |node: usize| {
        [node % per_edge, node / per_edge % per_edge, node / per_edge / per_edge].iter().all(|&i| i > 0 && i < cells)
    };
    let sides = (0..per_edge.pow(3)).filter(|&node| !is_inside(node)).collect();
    scene.fixed = Some(FixedTable { nodes: Some(sides), ..FixedTable::default() });
    let body = body(&scene, Path::new("")).map_err(|error| error.to_string())?;
    Ok((scene, body))
}

/// Nodal loads ∫ b φ, N.
fn nodal_load(law: &AnyLaw<f64>, mesh: &TetrahedralMesh) -> Vec<[f64; 3]> {
    let rule = Rule::of_index(RULE);
    let mut load = vec![[0.0; 3]; mesh.vertices.len()];
    for (element, volume) in mesh.elements.iter().zip(volumes(mesh)) {
        for (at, weight) in &rule.points {
            let force = body_force(law, &place(mesh, element, at));
            for (corner, &node) in element.iter().enumerate() {
                for i in 0..3 {
                    load[node][i] += volume * weight * at[corner] * force[i];
                }
            }
        }
    }
    load
}

fn place(mesh: &TetrahedralMesh, element: &[usize; 4], at: &[f64; 4]) -> Vector3<f64> {
    element.iter().zip(at).map(|(&node, &weight)| mesh.vertices[node] * weight).sum()
}

/// Relative errors in L2 and in the seminorm of H1.
fn errors(mesh: &TetrahedralMesh, u: &[[f64; 3]]) -> (f64, f64) {
    let rule = Rule::of_index(RULE);
    let [mut l2, mut h1, mut size, mut slope] = [0.0; 4];
    for (element, volume) in mesh.elements.iter().zip(volumes(mesh)) {
        let found = element_gradient(mesh, element, u);
        for (at, weight) in &rule.points {
            let X = place(mesh, element, at);
            let (exact, steep) = (displacement(&X), gradient(&X));
            for i in 0..3 {
                let here: f64 = (0..4).map(|corner| at[corner] * u[element[corner]][i]).sum();
                l2 += volume * weight * (here - exact[i]).powi(2);
                size += volume * weight * exact[i].powi(2);
                for j in 0..3 {
                    h1 += volume * weight * (found[i][j] - steep[i][j]).powi(2);
                    slope += volume * weight * steep[i][j].powi(2);
                }
            }
        }
    }
    ((l2 / size).sqrt(), (h1 / slope).sqrt())
}

/// Displacement gradient of an element.
pub fn element_gradient(mesh: &TetrahedralMesh, element: &[usize; 4], u: &[[f64; 3]]) -> Tensor<f64> {
    let edge = |of: &dyn Fn(usize) -> Vector3<f64>| {
        let origin = of(element[0]);
        nalgebra::Matrix3::from_columns(&[of(element[1]) - origin, of(element[2]) - origin, of(element[3]) - origin])
    };
    let (rest, moved) = (edge(&|node| mesh.vertices[node]), edge(&|node| Vector3::from(u[node])));
    let G = moved * rest.try_inverse().unwrap_or_default();
    from_fn(|i, j| G[(i, j)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_body_force_is_minus_the_divergence_of_the_stress() {
        for model in ["linear", "neo_hookean"] {
            let law = AnyLaw::<f64>::new(&cube(model, 1).unwrap().0.material).unwrap();
            let X = Vector3::new(0.31, 0.62, 0.27);
            let stress = |X: &Vector3<f64>| law.as_law().stress(&gradient(X));
            let h = 1e-5;
            for (i, force) in body_force(&law, &X).into_iter().enumerate() {
                let slope = |j: usize| {
                    let step = Vector3::ith(j, h);
                    (stress(&(X + step))[i][j] - stress(&(X - step))[i][j]) / (2.0 * h)
                };
                let divergence: f64 = (0..3).map(slope).sum();
                assert!((force + divergence).abs() < 1e-6 * force.abs(), "{model:?}: {force} {divergence}");
            }
        }
    }

    #[test]
    fn errors_converge_under_refinement() {
        for model in ["linear", "neo_hookean"] {
            let [coarse, fine] = [4, 8].map(|cells| solve(model, cells).unwrap());
            assert!(coarse.l2 / fine.l2 > 3.0 && coarse.h1 / fine.h1 > 1.75, "{} {}", coarse.l2, fine.l2);
        }
    }
}
