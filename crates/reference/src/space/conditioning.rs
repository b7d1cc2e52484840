//! Condition number of the stiffness matrix of a mesh.
//!
//! One bad tetrahedron raises the largest eigenvalue without bound, and the smallest belongs to the body and hardly depends on shapes: Shewchuk,
//! What Is a Good Linear Finite Element? (2002), §3. Iterative solvers need as many more iterations as the root of the condition number grows,
//! and explicit methods as much shorter steps as the root of the largest eigenvalue does.

use fem_engine::simulator::Simulator;
use fem_engine::simulator::double::{System, add_stiffness, add_stiffness_times};
use fem_engine::solvers::SolverChoice;
use fem_engine::solvers::lanczos::{self, irregular};
use fem_engine::vector::dot;
use fem_mesh::TetrahedralMesh;
use fem_model::{Axis, Body, Elastic, Integrator, Law, Material, Method, Preconditioner, Refusal, Region, Selector};
use fem_model::{Precision, SolverKind, SolverSettings};

/// Relative change of an eigenvalue at which Lanczos's method ends, and its largest number of iterations.
const ACCURACY: (f64, usize) = (1e-6, 400);

/// Part of the longest side of the mesh in which nodes are fixed.
const FIXED: f64 = 0.1;

/// Extreme eigenvalues of the stiffness of linear elasticity with Poisson's ratio 0.3, over Young's modulus, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditioning {
    /// The largest; a lower bound that is close.
    pub largest: f64,
    /// The smallest; an upper bound that is close.
    pub smallest: f64,
    /// Axis along which the mesh is longest, 0 to 2: nodes in the lowest tenth along it are fixed.
    pub axis: usize,
}

impl Conditioning {
    /// The condition number.
    pub fn number(&self) -> f64 {
        self.largest / self.smallest
    }
}

/// Conditioning of the stiffness matrix of a mesh that has passed the check. The smallest eigenvalue comes from a Cholesky factor.
///
/// # Errors
/// A mesh whose stiffness cannot be assembled or factored, as a sentence.
///
/// ```
/// let mesh = fem_mesh::box_mesh([1.0, 1.0, 2.0], 3, fem_mesh::Pattern::Alternating)?;
/// let found = fem_reference::space::conditioning::conditioning(&mesh).unwrap();
/// assert!(found.axis == 2 && found.number() > 100.0);
/// # Ok::<(), fem_mesh::MeshError>(())
/// ```
pub fn conditioning(mesh: &TetrahedralMesh) -> Result<Conditioning, String> {
    let bounds = |axis: usize| {
        let values = mesh.vertices.iter().map(move |x| x[axis]);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| [least.min(x), most.max(x)])
    };
    let sizes = [0, 1, 2].map(|axis| bounds(axis)[1] - bounds(axis)[0]);
    let axis = (0..3).max_by(|&a, &b| sizes[a].total_cmp(&sizes[b])).unwrap_or(0);
    let simulator = clamped(mesh, [Axis::X, Axis::Y, Axis::Z][axis], FIXED * sizes[axis]);
    let simulator = simulator.map_err(|refusal| format!("conditioning: {refusal}"))?;
    let system = simulator.system();
    let undeformed = vec![[0.0; 3]; system.nodes()];
    let times_stiffness = |x: &[[f64; 3]], y: &mut [[f64; 3]]| add_stiffness_times(system, &undeformed, x, y);
    let largest = largest_eigenvalue(system, times_stiffness);
    let mut values = vec![[[0.0; 3]; 3]; system.pattern.blocks()];
    add_stiffness(system, &undeformed, &mut values);
    let mut solver = system.solver(SolverChoice::Cholesky);
    solver.prepare(&values).map_err(|breakdown| format!("the stiffness cannot be factored: {breakdown}"))?;
    let smallest = 1.0 / largest_eigenvalue(system, |x, y| solver.apply(x, y));
    Ok(Conditioning { largest, smallest, axis })
}

/// A body of Young's modulus 1 Pa, clamped within a distance (m) of its lowest end along an axis.
fn clamped(mesh: &TetrahedralMesh, axis: Axis, below: f64) -> Result<Simulator<f64>, Refusal> {
    let (kind, preconditioner, precision) = (SolverKind::Cholesky, Preconditioner::default(), Precision::default());
    let solver = Some(SolverSettings { kind, tolerance: None, preconditioner, precision });
    let body = Body::new(mesh.clone(), Material::new(Law::Linear(Elastic::new(1.0, 0.3)), 1.0))?;
    let body = body.fix(&Selector::Region(Region::Plane { axis, below }))?;
    Simulator::new(body, &Method { solver, ..Method::new(Integrator::ImplicitEuler, 1.0) })
}

/// The largest eigenvalue of a positive definite operator on the free nodes, which `apply` adds to zero.
pub fn largest_eigenvalue(system: &System, mut apply: impl FnMut(&[[f64; 3]], &mut [[f64; 3]])) -> f64 {
    let mut start = irregular(system.nodes());
    system.dirichlet.clear_constrained(&mut start);
    let mut product = |x: &[[f64; 3]], product: &mut [[f64; 3]]| {
        product.fill([0.0; 3]);
        apply(x, product);
        system.dirichlet.clear_constrained(product);
        Some(dot(x, product))
    };
    lanczos::largest_eigenvalue(start, ACCURACY, &mut product, &mut |x| dot(x, x).sqrt()).unwrap_or(f64::NAN)
}
