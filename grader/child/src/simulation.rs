//! A whole simulation made of a submission's functions alone: a body under gravity with constrained vertices and an anchor spring.

use nalgebra::{DVector, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use crate::wire::Wire;
use crate::{Functions, GivenSolve};

/// The scene; SI units.
#[derive(Clone)]
pub struct Scene {
    /// Undeformed positions, m.
    pub V: Vec<Vector3<f64>>,
    /// Elements.
    pub T: Vec<[usize; 4]>,
    /// Undeformed volumes, m³.
    pub v0: Vec<f64>,
    /// Constrained vertices.
    pub fixed: Vec<usize>,
    /// The vertex that a spring of zero rest length pulls.
    pub pulled: usize,
    /// Target of the spring, m.
    pub target: Vector3<f64>,
    /// Stiffness of the spring, N/m.
    pub pull: f64,
    /// Material constants, Pa.
    pub C: f64,
    /// Material constants, Pa.
    pub D: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Acceleration of gravity, m/s².
    pub gravity: Vector3<f64>,
    /// Time step, s.
    pub dt: f64,
    /// Number of steps.
    pub steps: usize,
    /// 0: linearly implicit Euler, 1: implicit Euler.
    pub integrator: usize,
    /// Display vertices, m.
    pub V_skin: Vec<Vector3<f64>>,
}

impl Wire for Scene {
    fn put(&self, out: &mut Vec<u8>) {
        (self.V.clone(), self.T.clone()).put(out);
        (self.v0.clone(), self.fixed.clone()).put(out);
        (self.pulled, self.target).put(out);
        (self.pull, self.C).put(out);
        (self.D, self.density).put(out);
        (self.gravity, self.dt).put(out);
        (self.steps, self.integrator).put(out);
        self.V_skin.put(out);
    }

    fn get(input: &mut &[u8]) -> Option<Self> {
        let (V, T) = Wire::get(input)?;
        let (v0, fixed) = Wire::get(input)?;
        let (pulled, target) = Wire::get(input)?;
        let (pull, C) = Wire::get(input)?;
        let (D, density) = Wire::get(input)?;
        let (gravity, dt) = Wire::get(input)?;
        let (steps, integrator) = Wire::get(input)?;
        let V_skin = Wire::get(input)?;
        Some(Self { V, T, v0, fixed, pulled, target, pull, C, D, density, gravity, dt, steps, integrator, V_skin })
    }
}

/// Positions after each step, m, and after the last of them those of the display vertices.
pub fn simulate(functions: &Functions, scene: &Scene, solve: GivenSolve) -> Vec<DVector<f64>> {
    let size = 3 * scene.V.len();
    let rest = DVector::from_iterator(size, scene.V.iter().flat_map(|X| [X.x, X.y, X.z]));
    let P = (functions.fixed_point_constraints)(size, &scene.fixed);
    let Pt = P.transpose();
    let constrained = &rest - &Pt * (&P * &rest);
    let whole_mass = (functions.mass_matrix_mesh)(size, &scene.T, scene.density, &scene.v0);
    let weight = &whole_mass * DVector::from_fn(size, |i, _| scene.gravity[i % 3]);
    let mass = &P * whole_mass * &Pt;
    let forces = Forces { functions, scene, weight };

    let positions = |q: &DVector<f64>| &constrained + &Pt * q;
    let force = |q: &DVector<f64>, _: &DVector<f64>| &P * forces.force(&positions(q));
    let stiffness = |q: &DVector<f64>, _: &DVector<f64>| &P * forces.stiffness(&positions(q)) * &Pt;
    let (mut q, mut qdot) = (&P * &rest, DVector::zeros(P.nrows()));
    let mut passed = Vec::new();
    for _ in 0..scene.steps {
        if scene.integrator == 0 {
            (functions.linearly_implicit_euler)(&mut q, &mut qdot, scene.dt, &mass, &force, &stiffness, &solve);
        } else {
            let (old_q, old_v) = (q.clone(), qdot.clone());
            let energy = |v: &DVector<f64>| {
                let gained = v - &old_v;
                0.5 * gained.dot(&(&mass * &gained)) + forces.energy(&positions(&(&old_q + v * scene.dt)))
            };
            (functions.implicit_euler)(&mut q, &mut qdot, scene.dt, &mass, &energy, &force, &stiffness, &solve);
        }
        passed.push(positions(&q));
    }
    let N = (functions.build_skinning_matrix)(&scene.V, &scene.T, &scene.V_skin);
    let last = passed.last().unwrap_or(&rest);
    let coordinate = |axis: usize| &N * DVector::from_fn(scene.V.len(), |vertex, _| last[3 * vertex + axis]);
    let skin = [coordinate(0), coordinate(1), coordinate(2)];
    passed.push(DVector::from_fn(3 * N.nrows(), |i, _| skin[i % 3][i / 3]));
    passed
}

struct Forces<'a> {
    functions: &'a Functions,
    scene: &'a Scene,
    weight: DVector<f64>,
}

impl Forces<'_> {
    fn pull(&self, q: &DVector<f64>) -> (f64, Vector3<f64>) {
        let scene = self.scene;
        let at = q.fixed_rows::<3>(3 * scene.pulled).into_owned();
        let gradient = (self.functions.dV_spring_particle_particle_dq)(&scene.target, &at, 0.0, scene.pull);
        let energy = (self.functions.V_spring_particle_particle)(&scene.target, &at, 0.0, scene.pull);
        (energy, gradient.fixed_rows::<3>(3).into_owned())
    }

    fn force(&self, q: &DVector<f64>) -> DVector<f64> {
        let Scene { V, T, v0, C, D, pulled, .. } = self.scene;
        let mut f = (self.functions.assemble_forces)(q, V, T, v0, *C, *D) + &self.weight;
        let mut on_pulled = f.fixed_rows_mut::<3>(3 * pulled);
        on_pulled -= self.pull(q).1;
        f
    }

    fn stiffness(&self, q: &DVector<f64>) -> CsrMatrix<f64> {
        let Scene { V, T, v0, C, D, pulled, pull, .. } = self.scene;
        let mut spring = CooMatrix::new(q.len(), q.len());
        for i in 3 * pulled..3 * pulled + 3 {
            spring.push(i, i, -pull);
        }
        (self.functions.assemble_stiffness)(q, V, T, v0, *C, *D) + CsrMatrix::from(&spring)
    }

    fn energy(&self, q: &DVector<f64>) -> f64 {
        let Scene { V, T, v0, C, D, .. } = self.scene;
        let elements = T.iter().zip(v0);
        let elastic: f64 =
            elements.map(|(e, &volume)| (self.functions.V_linear_tetrahedron)(q, V, e, volume, *C, *D)).sum();
        elastic + self.pull(q).0 - self.weight.dot(q)
    }
}
