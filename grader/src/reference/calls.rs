//! Calls functions: the input of each function, and the conversion of its answer to numbers.

use std::cell::Cell;

use grader::implementation::{Answer, Implementation, Trouble};
use nalgebra::{DVector, Vector3};
use nalgebra_sparse::CsrMatrix;

use super::systems::{Objective, solve};
use super::trial::{Elastic, Input, Integrand, Mesh, Observed, Pick, Step, Trial};

impl Trial {
    /// Calls the function of an implementation.
    pub fn run(&self, who: &dyn Implementation) -> Answer<Observed> {
        call(self.function, &self.input, who).unwrap_or(Err(Trouble::Missing))
    }
}

/// Calls a function; `None` if it does not take such input.
fn call(function: &str, input: &Input, who: &dyn Implementation) -> Option<Answer<Observed>> {
    let number = |x: f64| Observed::vector(vec![x]);
    Some(match (function, input) {
        ("phi_linear_tetrahedron", Input::Shape { V, element, x }) => {
            who.phi_linear_tetrahedron(V, element, x).map(|phi| Observed::vector(phi.as_slice().to_vec()))
        }
        ("dphi_linear_tetrahedron_dX", Input::Shape { V, element, x }) => {
            who.dphi_linear_tetrahedron_dX(V, element, x).map(|m| Observed::matrix(4, 3, |i, j| m[(i, j)]))
        }
        ("psi_neo_hookean", Input::Density { F, C, D }) => who.psi_neo_hookean(F, *C, *D).map(number),
        ("dpsi_neo_hookean_dF", Input::Density { F, C, D }) => {
            who.dpsi_neo_hookean_dF(F, *C, *D).map(|P| Observed::vector(P.as_slice().to_vec()))
        }
        ("d2psi_neo_hookean_dF2", Input::Density { F, C, D }) => {
            who.d2psi_neo_hookean_dF2(F, *C, *D).map(|H| Observed::matrix(9, 9, |i, j| H[(i, j)]))
        }
        ("T_linear_tetrahedron", Input::Kinetic { qdot, element, density, volume }) => {
            who.T_linear_tetrahedron(qdot, element, *density, *volume).map(number)
        }
        ("quadrature_single_point", Input::Quadrature { V, element, volume, integrand }) => {
            quadrature(who, V, element, *volume, integrand)
        }
        ("V_spring_particle_particle", Input::Spring { q0, q1, l0, stiffness }) => {
            who.V_spring_particle_particle(q0, q1, *l0, *stiffness).map(number)
        }
        ("dV_spring_particle_particle_dq", Input::Spring { q0, q1, l0, stiffness }) => {
            who.dV_spring_particle_particle_dq(q0, q1, *l0, *stiffness).map(|f| Observed::vector(f.as_slice().to_vec()))
        }
        ("mass_matrix_linear_tetrahedron", Input::ElementMass { density, volume }) => {
            who.mass_matrix_linear_tetrahedron(*density, *volume).map(|M| Observed::matrix(12, 12, |i, j| M[(i, j)]))
        }
        (_, Input::Elastic(elastic)) => return on_element(function, elastic, who),
        _ => return on_mesh(function, input, who),
    })
}

fn on_element(function: &str, of: &Elastic, who: &dyn Implementation) -> Option<Answer<Observed>> {
    let Elastic { q, V, element, volume, C, D } = of;
    Some(match function {
        "V_linear_tetrahedron" => {
            who.V_linear_tetrahedron(q, V, element, *volume, *C, *D).map(|energy| Observed::vector(vec![energy]))
        }
        "dV_linear_tetrahedron_dq" => who
            .dV_linear_tetrahedron_dq(q, V, element, *volume, *C, *D)
            .map(|gradient| Observed::vector(gradient.as_slice().to_vec())),
        "d2V_linear_tetrahedron_dq2" => who
            .d2V_linear_tetrahedron_dq2(q, V, element, *volume, *C, *D)
            .map(|H| Observed::matrix(12, 12, |i, j| H[(i, j)])),
        _ => return None,
    })
}

fn on_mesh(function: &str, input: &Input, who: &dyn Implementation) -> Option<Answer<Observed>> {
    Some(match (function, input) {
        ("mass_matrix_mesh", Input::MeshMass { q_size, T, density, v0 }) => {
            who.mass_matrix_mesh(*q_size, T, *density, v0).map(|M| Observed::sparse(&M))
        }
        ("assemble_forces", Input::Mesh(Mesh { q, V, T, v0, C, D })) => {
            who.assemble_forces(q, V, T, v0, *C, *D).map(|f| Observed::vector(f.as_slice().to_vec()))
        }
        ("assemble_stiffness", Input::Mesh(Mesh { q, V, T, v0, C, D })) => {
            who.assemble_stiffness(q, V, T, v0, *C, *D).map(|K| Observed::sparse(&K))
        }
        ("build_skinning_matrix", Input::Skinning { V, T, V_skin }) => {
            who.build_skinning_matrix(V, T, V_skin).map(|N| Observed::sparse(&N))
        }
        ("fixed_point_constraints", Input::Fixed { q_size, indices }) => {
            who.fixed_point_constraints(*q_size, indices).map(|P| Observed::sparse(&P))
        }
        ("pick_nearest_vertices", Input::Pick(Pick { win, view, proj, viewport, V, F, radius })) => who
            .pick_nearest_vertices(win, view, proj, viewport, V, F, *radius)
            .map(|found| Observed::vector(found.iter().map(|&vertex| vertex as f64).collect())),
        ("linearly_implicit_euler", Input::Step(step)) => linearly_implicit(who, step),
        ("implicit_euler", Input::Step(step)) => implicit(who, step),
        ("newtons_method", Input::Minimum { objective, start, max_steps }) => {
            minimise(who, objective, start, *max_steps)
        }
        _ => return None,
    })
}

impl Integrand {
    /// The numbers at a point.
    pub fn at(&self, X: &Vector3<f64>) -> DVector<f64> {
        let value = |c: &[f64; 5]| c[0] + c[1] * X.x + c[2] * X.y + c[3] * X.z + c[4] * X.x * X.y;
        DVector::from_iterator(self.terms.len(), self.terms.iter().map(value))
    }
}

fn quadrature(
    who: &dyn Implementation,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: &Integrand,
) -> Answer<Observed> {
    let answer = who.quadrature_single_point(V, element, volume, &|X| integrand.at(X))?;
    Ok(Observed::vector(answer.as_slice().to_vec()))
}

/// Counts calls of a closure.
#[derive(Default)]
struct Counter(Cell<usize>);

impl Counter {
    fn count<T>(&self, result: T) -> T {
        self.0.set(self.0.get() + 1);
        result
    }
}

fn linearly_implicit(who: &dyn Implementation, step: &Step) -> Answer<Observed> {
    let (mut q, mut v, system) = (step.q.clone(), step.qdot.clone(), &step.system);
    let [forces, stiffnesses, solves] = [(); 3].map(|()| Counter::default());
    who.linearly_implicit_euler(
        &mut q,
        &mut v,
        step.dt,
        &CsrMatrix::from(&system.mass),
        &|q, v| forces.count(system.force(q, v)),
        &|q, _| stiffnesses.count(system.stiffness(q)),
        &|A, b| solves.count(solve(A, b)),
    )?;
    let calls = vec![("force", forces.0.get()), ("stiffness", stiffnesses.0.get()), ("solve", solves.0.get())];
    Ok(Observed { calls, ..Observed::vector(q.iter().chain(&v).copied().collect()) })
}

fn implicit(who: &dyn Implementation, step: &Step) -> Answer<Observed> {
    let (mut q, mut v, system, dt) = (step.q.clone(), step.qdot.clone(), &step.system, step.dt);
    let [stiffnesses, solves] = [(); 2].map(|()| Counter::default());
    let energy = |v: &DVector<f64>| {
        let gained = v - &step.qdot;
        0.5 * gained.dot(&(&system.mass * &gained)) + system.potential(&(&step.q + v * dt))
    };
    who.implicit_euler(
        &mut q,
        &mut v,
        dt,
        &CsrMatrix::from(&system.mass),
        &energy,
        &|q, v| system.force(q, v),
        &|q, _| stiffnesses.count(system.stiffness(q)),
        &|A, b| solves.count(solve(A, b)),
    )?;
    let gradient = |v: &DVector<f64>| &system.mass * (v - &step.qdot) - system.force(&(&step.q + v * dt), v) * dt;
    // The shape shows a velocity of the wrong size.
    let fits = v.len() == step.qdot.len();
    let residual = fits.then(|| relative(gradient(&v).norm(), gradient(&step.qdot).norm()));
    let calls = vec![("stiffness", stiffnesses.0.get()), ("solve", solves.0.get())];
    Ok(Observed { calls, residual, ..Observed::vector(q.iter().chain(&v).copied().collect()) })
}

fn minimise(who: &dyn Implementation, f: &Objective, start: &DVector<f64>, max_steps: usize) -> Answer<Observed> {
    let mut x = start.clone();
    let [hessians, solves] = [(); 2].map(|()| Counter::default());
    let value = who.newtons_method(
        &mut x,
        &|x| f.value(x),
        &|x| f.gradient(x),
        &|x| hessians.count(f.hessian(x)),
        &|A, b| solves.count(solve(A, b)),
        max_steps,
    )?;
    let fits = x.len() == start.len();
    let residual = fits.then(|| relative(f.gradient(&x).norm(), f.gradient(start).norm()));
    let calls = vec![("H", hessians.0.get()), ("solve", solves.0.get())];
    Ok(Observed { calls, residual, ..Observed::vector(std::iter::once(value).chain(x.iter().copied()).collect()) })
}

fn relative(left: f64, at_start: f64) -> f64 {
    if left == 0.0 { 0.0 } else { left / at_start }
}
