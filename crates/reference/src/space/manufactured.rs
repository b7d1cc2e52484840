//! The method of manufactured solutions: a cube with u_i = a_i sin πx sin πy sin πz, or a square with u_i = a_i sin πx sin πy, which is zero
//! on all sides.
//!
//! The body force is −Div P = −∂P/∂F : ∇∇u, exact in every point. P. J. Roache, "Code
//! verification by the method of manufactured solutions", Journal of Fluids Engineering 124, 2002.

use std::f64::consts::PI;

use fem_engine::forces::dead_load::DeadLoad;
use fem_engine::materials::AnyLaw;
use fem_engine::numbering::Numbering;
use fem_engine::simulator::{Simulator, double};
use fem_engine::tensor::{Tensor, from_fn};
use fem_mesh::{Pattern, box_mesh, rectangle_mesh};
use fem_model::element::Element;
use fem_model::simulation::{Counters, Simulation};
use fem_model::{
    Body, BodyMesh, Elastic, Integrator, Law, Material, Method, NeoHookean, NewtonSettings, Precision, Preconditioner,
    Selector, SolverKind, SolverSettings,
};
use fem_output::StressError;
use nalgebra::{DVector, Vector3};

use crate::Result;
use crate::space::points::points;

/// a, m: large enough that the neo-Hookean law is far from linear. The third belongs to the cube.
pub const AMPLITUDE: [f64; 3] = [0.06, -0.05, 0.04];

/// Orders of elements in L2 and H1: Strang and Fix, An Analysis of the Finite Element Method (1973), chapter 3.
pub fn orders(element: &Element) -> [f64; 2] {
    [element.order + 1, element.order].map(|order| order as f64)
}

/// The elements in the plural, such as `linear triangles`.
pub fn label(element: &Element) -> String {
    if element.order == 1 { format!("linear {}", element.name) } else { element.name.to_owned() }
}

/// The end of a case's name that tells its elements; empty for linear tetrahedra.
pub fn ending(element: &Element) -> &'static str {
    match (element.dimension, element.order) {
        (2, 1) => "-triangles",
        (2, _) => "-quadratic",
        (_, 1) => "",
        _ => "-quadratic-solid",
    }
}

/// The discrete solution on one mesh.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The name of law and elements.
    pub name: String,
    /// The material.
    pub material: Material,
    /// The mesh.
    pub mesh: BodyMesh,
    /// Positions of all nodes, m.
    pub q: DVector<f64>,
    /// Estimated error of the stresses.
    pub stress_error: Option<StressError>,
    /// ‖u − u_h‖ / ‖u‖ over the body.
    pub l2: f64,
    /// ‖∇u − ∇u_h‖ / ‖∇u‖ over the body.
    pub h1: f64,
    /// Counters of the solution.
    pub counters: Counters,
    /// Wall-clock time of the solution without set-up, s.
    pub seconds: f64,
}

/// The exact solution in the unit cube (3 dimensions) or in the unit square (2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exact {
    /// Number of coordinates on which it depends.
    pub dimensions: usize,
}

impl Exact {
    /// a of a component, m.
    fn amplitude(self, i: usize) -> f64 {
        if i < self.dimensions { AMPLITUDE[i] } else { 0.0 }
    }

    /// Displacement, m.
    pub fn displacement(self, X: &Vector3<f64>) -> [f64; 3] {
        let product: f64 = (0..self.dimensions).map(|k| (PI * X[k]).sin()).product();
        std::array::from_fn(|i| self.amplitude(i) * product)
    }

    /// G_ij = ∂u_i/∂X_j.
    pub fn gradient(self, X: &Vector3<f64>) -> Tensor<f64> {
        let (sin, cos) = (X.map(|x| (PI * x).sin()), X.map(|x| (PI * x).cos()));
        let all = 0..self.dimensions;
        let part = |j: usize| {
            let product: f64 = all.clone().map(|k| if k == j { cos[k] } else { sin[k] }).product();
            if j < self.dimensions { PI * product } else { 0.0 }
        };
        let parts = [part(0), part(1), part(2)];
        from_fn(|i, j| self.amplitude(i) * parts[j])
    }

    /// ∂²u_i/∂X_j∂X_l
    fn second(self, X: &Vector3<f64>, i: usize, j: usize, l: usize) -> f64 {
        if j.max(l) >= self.dimensions {
            return 0.0;
        }
        let (sin, cos) = (X.map(|x| (PI * x).sin()), X.map(|x| (PI * x).cos()));
        let factor = |k: usize| match (k == j, k == l) {
            (true, true) => -sin[k],
            (false, false) => sin[k],
            _ => cos[k],
        };
        self.amplitude(i) * PI * PI * (0..self.dimensions).map(factor).product::<f64>()
    }

    /// −Div P of a law, N/m³.
    pub fn body_force(self, law: &AnyLaw<f64>, X: &Vector3<f64>) -> [f64; 3] {
        let H = double::law(law).derivative(&self.gradient(X));
        let mut force = [0.0; 3];
        for (i, force) in force.iter_mut().enumerate() {
            for j in 0..3 {
                for k in 0..3 {
                    for l in 0..3 {
                        *force -= H[3 * i + j][3 * k + l] * self.second(X, k, l, j);
                    }
                }
            }
        }
        force
    }
}

/// Solves on a mesh of `cells` cells in each direction.
pub fn solve(model: &str, element: &Element, cells: usize) -> Result<Solved> {
    let body = fixed_body(model, element, cells)?;
    let exact = Exact { dimensions: element.dimension };
    let (mesh, material) = (body.shape.mesh.clone(), body.material);
    let lacks = "a body of springs has no stress";
    let load = nodal_load(&AnyLaw::new(&material).ok_or(lacks)?, &mesh, exact);
    let in_order = |numbering: &Numbering| numbering.mesh_node.iter().map(|&node| load[node as usize]).collect();
    let mut simulation = Simulator::<f64>::with_forces(body, &method(), &|numbering| {
        vec![Box::new(DeadLoad::new(in_order(numbering)))]
    })?;
    let start = std::time::Instant::now();
    simulation.step().map_err(|failure| format!("no equilibrium: {failure}"))?;
    let seconds = start.elapsed().as_secs_f64();
    let u = simulation.system().numbering.to_mesh(&simulation.state().u);
    let (l2, h1) = errors(&mesh, &u, exact);
    let q = DVector::from_fn(3 * u.len(), |i, _| mesh.vertices()[i / 3][i % 3] + u[i / 3][i % 3]);
    let stress_error = StressError::of(&simulation);
    let name = format!("manufactured-{}{}", material.law.name().replace('_', "-"), ending(element));
    Ok(Solved { name, material, mesh, q, stress_error, l2, h1, counters: simulation.counters(), seconds })
}

/// Equilibrium to round-off, by a direct solver.
fn method() -> Method {
    let (kind, preconditioner, precision) = (SolverKind::Cholesky, Preconditioner::default(), Precision::default());
    Method {
        newton: NewtonSettings { max_iterations: Some(50), tolerance: Some(1e-13), ..NewtonSettings::default() },
        solver: Some(SolverSettings { kind, tolerance: None, preconditioner, precision }),
        ..Method::new(Integrator::Static, 1.0)
    }
}

/// The unit cube or square with fixed sides.
fn fixed_body(model: &str, element: &Element, cells: usize) -> Result<Body> {
    let law = match model {
        "neo_hookean" => Law::NeoHookean(NeoHookean::Moduli { C: 1e4, D: 3e4 }),
        _ => Law::Linear(Elastic::new(1e5, 0.3)),
    };
    let mesh = match element.dimension {
        3 => BodyMesh::from(box_mesh([1.0; 3], cells, Pattern::Kuhn)?),
        _ => BodyMesh::flat(rectangle_mesh([1.0; 2], cells, Pattern::Kuhn)?, 1.0),
    };
    let body = Body::new(mesh.of_order(element.order).ok_or("there is no such element")?, Material::new(law, 1000.0))?;
    let is_inside = |x: &Vector3<f64>| (0..element.dimension).all(|i| x[i] > 0.0 && x[i] < 1.0);
    let vertices = body.shape.mesh.vertices();
    let sides = (0..vertices.len()).filter(|&node| !is_inside(&vertices[node])).collect();
    Ok(body.fix(&Selector::Nodes(sides))?)
}

/// Nodal loads ∫ b φ, N.
fn nodal_load(law: &AnyLaw<f64>, mesh: &BodyMesh, exact: Exact) -> Vec<[f64; 3]> {
    let points = points(mesh);
    let mut load = vec![[0.0; 3]; mesh.vertices().len()];
    for (nodes, volume) in mesh.corners().zip(mesh.volumes()) {
        for point in &points {
            let force = exact.body_force(law, &point.place(mesh, nodes));
            for (&node, value) in nodes.iter().zip(&point.values) {
                for i in 0..3 {
                    load[node][i] += volume * point.weight * value * force[i];
                }
            }
        }
    }
    load
}

/// Relative errors in L2 and in the seminorm of H1.
fn errors(mesh: &BodyMesh, u: &[[f64; 3]], exact: Exact) -> (f64, f64) {
    let points = points(mesh);
    let [mut l2, mut h1, mut size, mut slope] = [0.0; 4];
    for (element, (nodes, volume)) in mesh.corners().zip(mesh.volumes()).enumerate() {
        for point in &points {
            let X = point.place(mesh, nodes);
            let (is, steep, found) = (
                exact.displacement(&X),
                exact.gradient(&X),
                mesh.displacement_gradient_at(element, &point.barycentric, |node| u[node].into()),
            );
            let weight = volume * point.weight;
            for i in 0..3 {
                let here: f64 = nodes.iter().zip(&point.values).map(|(&node, value)| value * u[node][i]).sum();
                l2 += weight * (here - is[i]).powi(2);
                size += weight * is[i].powi(2);
                for j in 0..3 {
                    h1 += weight * (found[(i, j)] - steep[i][j]).powi(2);
                    slope += weight * steep[i][j].powi(2);
                }
            }
        }
    }
    ((l2 / size).sqrt(), (h1 / slope).sqrt())
}
