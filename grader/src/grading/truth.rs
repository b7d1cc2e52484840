//! The motion that a whole simulation approximates, computed by a method that is not among those of the course: the classical
//! fourth-order method of Runge and Kutta, with a step so small that halving it changes the positions by less than [`ALLOWED`].
//! (W. Kutta, Beitrag zur näherungsweisen Integration totaler Differentialgleichungen, Zeitschrift für Mathematik und Physik 46, 1901.)

use grader_child::simulation::Scene;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::reference::REFERENCE;

/// Steps, and then twice as many.
const STEPS: usize = 200;

/// Largest change of the positions by halving the step that counts as converged, m.
const ALLOWED: f64 = 1e-6;

/// Final positions of a body.
pub struct Truth {
    /// Positions of all vertices, m.
    pub positions: DVector<f64>,
    /// Largest change by halving the step, m.
    pub uncertainty: f64,
}

/// Positions of a scene's body after the last step.
///
/// # Errors
/// The reason if halving the step changes the positions by more than [`ALLOWED`].
pub fn truth(scene: &Scene) -> Result<Truth, String> {
    let duration = scene.dt * scene.steps as f64;
    let body = Body::new(scene).ok_or("the mass matrix of the free vertices is not positive definite")?;
    let (coarse, positions) = (body.moved(duration, STEPS), body.moved(duration, 2 * STEPS));
    let uncertainty = (coarse - &positions).amax();
    if uncertainty <= ALLOWED {
        return Ok(Truth { positions, uncertainty });
    }
    Err(format!("the motion is known to {uncertainty:e} m only"))
}

/// A scene as an ordinary differential equation.
struct Body<'a> {
    scene: &'a Scene,
    /// Coordinates that move.
    free: Vec<usize>,
    mass: Cholesky<f64, Dyn>,
    weight: DVector<f64>,
}

impl<'a> Body<'a> {
    fn new(scene: &'a Scene) -> Option<Self> {
        let size = 3 * scene.V.len();
        let mass = DMatrix::from(&(REFERENCE.mass_matrix_mesh)(size, &scene.T, scene.density, &scene.v0));
        let weight = &mass * DVector::from_fn(size, |i, _| scene.gravity[i % 3]);
        let free: Vec<usize> = (0..size).filter(|i| !scene.fixed.contains(&(i / 3))).collect();
        let mass = Cholesky::new(mass.select_rows(&free).select_columns(&free))?;
        Some(Self { scene, free, mass, weight })
    }

    /// Positions after so many steps from rest.
    fn moved(&self, duration: f64, steps: usize) -> DVector<f64> {
        let dt = duration / steps as f64;
        let size = 3 * self.scene.V.len();
        let mut q = DVector::from_iterator(size, self.scene.V.iter().flat_map(|X| [X.x, X.y, X.z]));
        let mut v = DVector::zeros(size);
        for _ in 0..steps {
            let a1 = self.acceleration(&q);
            let v2 = &v + &a1 * (dt / 2.0);
            let a2 = self.acceleration(&(&q + &v * (dt / 2.0)));
            let v3 = &v + &a2 * (dt / 2.0);
            let a3 = self.acceleration(&(&q + &v2 * (dt / 2.0)));
            let v4 = &v + &a3 * dt;
            let a4 = self.acceleration(&(&q + &v3 * dt));
            q += (&v + (v2 + v3) * 2.0 + v4) * (dt / 6.0);
            v += (a1 + (a2 + a3) * 2.0 + a4) * (dt / 6.0);
        }
        q
    }

    fn acceleration(&self, q: &DVector<f64>) -> DVector<f64> {
        let Scene { V, T, v0, C, D, pulled, pull, target, .. } = self.scene;
        let mut force = (REFERENCE.assemble_forces)(q, V, T, v0, *C, *D) + &self.weight;
        for axis in 0..3 {
            let i = 3 * pulled + axis;
            force[i] -= pull * (q[i] - target[axis]);
        }
        let mut acceleration = DVector::zeros(q.len());
        for (i, a) in self.free.iter().zip(self.mass.solve(&force.select_rows(&self.free)).iter()) {
            acceleration[*i] = *a;
        }
        acceleration
    }
}

#[cfg(test)]
mod tests {
    use super::truth;
    use crate::grading::whole::scene;
    use crate::reference::REFERENCE;
    use grader_child::simulation::{Scene, simulate};

    #[test]
    fn both_eulers_of_the_course_come_closer_to_it_in_proportion_to_their_step() {
        // The first few hundredths of a second, with steps that resolve the fastest oscillation.
        let short = |integrator, dt: f64| Scene { steps: (0.03 / dt).round() as usize, ..scene(integrator, dt) };
        let truth = truth(&short(0, 0.001)).unwrap();
        for integrator in [0, 1] {
            let error = |dt: f64| {
                let passed = simulate(&REFERENCE, &short(integrator, dt), finite_elements_3d::given::solve);
                // The last one is of the display surface.
                (&passed[passed.len() - 2] - &truth.positions).amax()
            };
            let order = (error(0.0005) / error(0.00025)).log2();
            assert!((order - 1.0).abs() < 0.1, "order {order} of integrator {integrator}");
        }
    }
}
