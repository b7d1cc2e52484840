//! Energy from nothing: every method with every damping, driven in every way. The judge is the energy ledger; copies of a scene that are turned,
//! scaled, or solved by another solver are further judges.

use fem_model::simulation::{Diagnostics, Simulation};
use fem_model::{
    Axis, Body, ContactPlane, Damping, DampingForm, Integrator, LoadCurve, Method, Motion, PlaneMotion, Plasticity,
    Precision, Preconditioner, Refusal, Selector, SolverKind, SolverSettings,
};
use nalgebra::Vector3;

use super::*;
use crate::scenes::spinning;

const FAMILY: &str = "energy from nothing";

/// Simulated time, s.
const TIME: f64 = 0.6;

/// Names of the ways in which the body is driven; those from the fifth on have planes.
const DRIVES: [&str; 7] = [
    "released from a stretch",
    "thrown and spinning",
    "pulled by a sine",
    "loaded at once",
    "dropped onto a rough floor",
    "pressed between plates",
    "touching the floor",
];
const WITHOUT_PLANES: usize = 4;

/// Laws, of which the cases take one after the other; the last flows.
const LAWS: [&str; 6] = ["neo_hookean", "corotated", "stable_neo_hookean", "linear", "st_venant_kirchhoff", "hencky"];

/// Rayleigh's α in 1/s and β in s; the last brings all vibrations of the mesh to rest within a step.
const DAMPINGS: [[f64; 2]; 4] = [[0.0, 0.0], [2.0, 0.0], [0.0, 2e-3], [0.0, 0.1]];

/// A change of a scene under which the answer stays the same: the axes x, y, z become others, lengths and times are multiplied.
#[derive(Clone, Copy)]
struct Copy {
    axes: [usize; 3],
    scale: f64,
    /// Solved by preconditioned conjugate gradients.
    is_iterated: bool,
}

const ORIGINAL: Copy = Copy { axes: [0, 1, 2], scale: 1.0, is_iterated: false };

const COPIES: [(&str, Copy); 3] = [
    ("turned", Copy { axes: [1, 2, 0], ..ORIGINAL }),
    ("scaled", Copy { scale: 0.25, ..ORIGINAL }),
    ("solved otherwise", Copy { is_iterated: true, ..ORIGINAL }),
];

/// A scene of the family.
#[derive(Clone, Copy)]
struct Driven {
    integrator: Integrator,
    model: &'static str,
    drive: usize,
    damping: [f64; 2],
    dt: f64,
}

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let scenes = scenes();
    let every = if quick { 13 } else { 1 };
    cases.extend(scenes.iter().step_by(every).map(|scene| balanced(*scene)));
    let compared = scenes.iter().filter(|scene| is_compared(scene));
    let copies = compared.flat_map(|scene| COPIES.iter().map(move |copy| (*scene, *copy)));
    let usable = copies.filter(|(scene, (_, copy))| !copy.is_iterated || scene.integrator.has_newton());
    cases.extend(usable.step_by(every).map(|(scene, (name, copy))| same(scene, name, copy)));
}

/// All scenes.
fn scenes() -> Vec<Driven> {
    let mut scenes = Vec::new();
    let explicit = [Integrator::SemiImplicitEuler, Integrator::Rk2, Integrator::Rk4, Integrator::Verlet]
        .map(|name| (name, &DAMPINGS[..3], &[5e-4][..]));
    let newton = [Integrator::ImplicitEuler]
        .into_iter()
        .chain(Integrator::second_order_implicit())
        .filter(|integrator| *integrator != Integrator::Bathe);
    let newton = newton.map(|name| (name, &DAMPINGS[..], &[5e-3, 0.05][..]));
    let other = [
        (Integrator::LinearlyImplicitEuler, &DAMPINGS[..], &[2e-3][..]),
        (Integrator::Xpbd, &DAMPINGS[..2], &[5e-3][..]),
        (Integrator::Vbd, &DAMPINGS[..2], &[5e-3][..]),
        (Integrator::ProjectiveDynamics, &DAMPINGS[..2], &[5e-3][..]),
        (Integrator::Bathe, &DAMPINGS[..], &[5e-3, 0.05][..]),
    ];
    for (integrator, dampings, steps) in explicit.into_iter().chain(newton).chain(other) {
        let has_planes = integrator.facts().contact.is_some();
        let drives = if has_planes { DRIVES.len() } else { WITHOUT_PLANES };
        for (&dt, &damping) in steps.iter().flat_map(|dt| dampings.iter().map(move |damping| (dt, damping))) {
            for drive in 0..drives {
                let model = match integrator {
                    Integrator::Xpbd | Integrator::Vbd => "stable_neo_hookean",
                    Integrator::ProjectiveDynamics => "corotated",
                    _ => LAWS[scenes.len() % LAWS.len()],
                };
                scenes.push(Driven { integrator, model, drive, damping, dt });
            }
        }
    }
    scenes
}

/// Returns true for a scene that is compared with its copies.
fn is_compared(scene: &Driven) -> bool {
    let is_exact = scene.integrator.has_newton() || scene.integrator == Integrator::Verlet;
    is_exact && scene.dt < 0.01 && (scene.damping == DAMPINGS[0] || scene.damping == DAMPINGS[2])
}

impl Driven {
    fn steps(&self) -> usize {
        (TIME / self.dt).round() as usize
    }

    fn parameters(&self) -> String {
        let [alpha, beta] = self.damping;
        format!("alpha = {alpha} 1/s, beta = {beta} s, dt = {:.0e} s, {} steps", self.dt, self.steps())
    }

    /// The scene, or a copy of it.
    fn setup(self, copy: Copy) -> Setup {
        let [x, y, z] = copy.length([2.0, 1.0, 1.0]);
        let grid = Grid::Solid([x, y, z], (1.0 / copy.scale).round() as usize);
        let mut setup = Setup { grid, dt: self.dt * copy.scale, ..Setup::small(self.integrator, self.model) }
            .newton(1e-11)
            .with_if(self.integrator.is_explicit(), lump)
            .with(move |body, method| self.driven(body, method, copy));
        if [Integrator::Xpbd, Integrator::Vbd].contains(&self.integrator) {
            setup = setup.iterations(100);
        }
        if copy.is_iterated {
            let (kind, preconditioner, precision) = (SolverKind::Pcg, Preconditioner::BlockJacobi, Precision::F32);
            let solver = SolverSettings { kind, tolerance: Some(1e-12), preconditioner, precision };
            setup = setup.set(move |method| method.solver = Some(solver.clone()));
        }
        setup
    }

    /// The body with its drive, damping and plastic flow.
    fn driven(self, body: Body, method: &Method, copy: Copy) -> Result<Body, Refusal> {
        let scale = copy.scale;
        let end = Selector::most([Axis::X, Axis::Y, Axis::Z][copy.axes[0]]);
        let clamp = |body: Body| body.fix(&Selector::least([Axis::X, Axis::Y, Axis::Z][copy.axes[0]]));
        let gravity = |body: Body| body.gravity(copy.place([0.0, -9.81 / scale, 0.0]));
        let plane = |height: f64, normal: f64| {
            let (point, normal) = (copy.length([0.0, height, 0.0]), copy.place([0.0, normal, 0.0]));
            ContactPlane { friction: 0.4, ..ContactPlane::new(point.into(), normal.into()) }
        };
        let (mut body, planes) = match self.drive {
            0 => {
                let pulled = Motion::by(copy.length([0.3, 0.2, 0.0]));
                let mut body = clamp(body)?.prescribe(&end, [true; 3], pulled)?;
                body.dirichlet[1].until = Some(0.1 * scale);
                (body, Vec::new())
            }
            1 => {
                let body = body.velocity(copy.place([1.0, 2.0, 0.5]))?;
                (spinning(body, copy.place([0.0, 0.0, 1.0]), 6.0 / scale), Vec::new())
            }
            2 => {
                let sine = LoadCurve::Sine { frequency: 1.5 / scale, phase: 0.0 };
                // A velocity times the integral of its factor is the displacement.
                let curve = Some(LoadCurve::Integral(Some(Box::new(sine))));
                let motion = Motion { curve, ..Motion::by(copy.place([0.8, 0.5, 0.0])) };
                (clamp(body)?.prescribe(&end, [true; 3], motion)?, Vec::new())
            }
            3 => (clamp(body)?.traction(&end, copy.place([0.0, 2e3, 1e3]))?, Vec::new()),
            4 => (gravity(body)?.velocity(copy.place([1.5, -2.0, 0.0]))?, vec![plane(-0.1, 1.0)]),
            5 => {
                let velocity = copy.place([0.0, -0.5, 0.0]).into();
                let motion = PlaneMotion::Uniform { velocity, until: 0.3 * scale };
                (body, vec![plane(-0.01, 1.0), ContactPlane { motion, ..plane(1.01, -1.0) }])
            }
            _ => (gravity(body)?, vec![plane(0.0, 1.0)]),
        };
        if !planes.is_empty() {
            let mut contact = body.contact_with(planes, method)?;
            if self.integrator.has_newton() {
                // Its default follows lengths per second.
                contact.transition_speed = 1e-3;
            }
            body.contact = Some(contact);
        }
        if self.model == "hencky" {
            body.plasticity = Some(Plasticity::J2 { yield_stress: 1e4, hardening: 1e4 });
        }
        let [alpha, beta] = [self.damping[0] / scale, self.damping[1] * scale];
        body.damping(Damping { alpha, beta, form: DampingForm::default() })
    }
}

impl Copy {
    /// A vector in the axes of the copy.
    fn place(self, x: [f64; 3]) -> [f64; 3] {
        let mut placed = [0.0; 3];
        (0..3).for_each(|i| placed[self.axes[i]] = x[i]);
        placed
    }

    /// The same of a length, m.
    fn length(self, x: [f64; 3]) -> [f64; 3] {
        self.place(x.map(|x| self.scale * x))
    }
}

/// A scene that gains no energy from nothing.
fn balanced(scene: Driven) -> Case {
    Case {
        margin_is: "gain of energy / 5 % of the energy supplied; must be at most 1",
        ..scene.setup(ORIGINAL).case(FAMILY, DRIVES[scene.drive], scene.parameters(), move |setup, deadline| {
            let mut simulation = setup.build()?;
            let found = march(&mut simulation, scene.steps(), deadline).endurance();
            let ledger = simulation.energy_ledger().unwrap_or_default();
            let part = if ledger.gain > 0.0 { ledger.gain / (0.05 * ledger.turned_over) } else { 0.0 };
            let note = format!("{}; supplied {:.3e} J, gained {:.1e} J", found.note, ledger.turned_over, ledger.gain);
            match found.outcome {
                Outcome::Survives => Ok(Finding::within(part, note)),
                _ => Err(Finding { note, ..found }),
            }
        })
    }
}

/// Largest difference of displacements between copies, in lengths of the body.
const SAME: f64 = 1e-5;

/// A scene and its copy, whose answers are the same.
fn same(scene: Driven, name: &str, copy: Copy) -> Case {
    let parameters = scene.parameters();
    let case = format!("{}, {name}", DRIVES[scene.drive]);
    Case {
        margin_is: "largest difference / 1e-5 of the length; must be at most 1",
        ..scene.setup(ORIGINAL).case(FAMILY, case, parameters, move |_, deadline| {
            let (a, b) = (answer(scene, ORIGINAL, deadline)?, answer(scene, copy, deadline)?);
            let difference = |(X, u): &Moved| {
                let nearest = b.iter().min_by(|(a, _), (b, _)| (a - X).norm().total_cmp(&(b - X).norm()));
                nearest.map_or(f64::NAN, |(_, other)| (u - other).norm())
            };
            let largest = a.iter().map(difference).fold(0.0, f64::max);
            Ok(Finding::within(largest / (2.0 * SAME), format!("difference {largest:.1e} m")))
        })
    }
}

/// The rest position and the displacement of a node, m.
type Moved = (Vector3<f64>, Vector3<f64>);

/// Those of all nodes at the end, as the original has them.
fn answer(scene: Driven, copy: Copy, deadline: Deadline) -> Result<Vec<Moved>, Finding> {
    let mut simulation = scene.setup(copy).build()?;
    let end = march(&mut simulation, scene.steps(), deadline).endurance();
    if end.outcome != Outcome::Survives {
        return Err(end);
    }
    let (q, shape) = (simulation.positions(), simulation.shape());
    let back = |x: Vector3<f64>| Vector3::from(copy.axes.map(|axis| x[axis] / copy.scale));
    let of_node = |(node, X): (usize, &Vector3<f64>)| (back(*X), back(q.fixed_rows::<3>(3 * node) - X));
    Ok(shape.mesh.vertices().iter().enumerate().map(of_node).collect())
}
