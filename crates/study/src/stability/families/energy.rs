//! Energy from nothing: every method with every damping, driven in every way. The judge is the energy ledger; copies of a scene that are turned,
//! scaled, or solved by another solver are further judges.

use fem_model::Integrator;
use fem_model::simulation::{Diagnostics, Simulation};
use nalgebra::Vector3;

use crate::stability::case::{Case, Finding, Outcome};
use crate::stability::march::march;
use crate::stability::scene_text::SceneText;
use crate::study::Deadline;

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
    solver: &'static str,
}

const ORIGINAL: Copy = Copy { axes: [0, 1, 2], scale: 1.0, solver: "" };

const COPIES: [(&str, Copy); 3] = [
    ("turned", Copy { axes: [1, 2, 0], ..ORIGINAL }),
    ("scaled", Copy { scale: 0.25, ..ORIGINAL }),
    (
        "solved otherwise",
        Copy { solver: "[solver]\nkind = \"pcg\"\npreconditioner = \"block_jacobi\"\ntolerance = 1e-12\n", ..ORIGINAL },
    ),
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
    let usable = copies.filter(|(scene, (_, copy))| copy.solver.is_empty() || scene.integrator.has_newton());
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
    fn text(&self, copy: Copy) -> SceneText {
        let Copy { axes, scale, solver } = copy;
        let place = |x: [f64; 3]| {
            let mut placed = [0.0; 3];
            (0..3).for_each(|i| placed[axes[i]] = x[i]);
            placed
        };
        let length = |x: [f64; 3]| place(x.map(|x| scale * x));
        let x = ["x", "y", "z"][axes[0]];
        let clamp = format!("[fixed]\nplane = {{ axis = \"{x}\", below = 1e-9 }}\n");
        let end = format!("on = {{ axis = \"{x}\", side = \"max\", within = 1e-9 }}");
        let gravity = format!("[gravity]\nacceleration = {:?}\n", place([0.0, -9.81 / scale, 0.0]));
        let plane = |height: f64, normal: f64, rest: &str| {
            let (point, normal) = (length([0.0, height, 0.0]), place([0.0, normal, 0.0]));
            format!("[[planes]]\npoint = {point:?}\nnormal = {normal:?}\nfriction = 0.4\n{rest}")
        };
        let velocity = |v: [f64; 3]| format!("[[initial_velocity]]\nvelocity = {:?}\n", place(v));
        let drive = match self.drive {
            0 => {
                let displacement = length([0.3, 0.2, 0.0]);
                format!("{clamp}[[prescribed]]\n{end}\ndisplacement = {displacement:?}\nuntil = {:?}\n", 0.1 * scale)
            }
            1 => {
                let axis = place([0.0, 0.0, 1.0]);
                let spin = format!("angular = {{ axis = {axis:?}, rate = {:?} }}\n", 6.0 / scale);
                velocity([1.0, 2.0, 0.5]) + &spin
            }
            2 => {
                let sine = format!("curve = {{ sine = {{ frequency = {:?} }} }}\n", 1.5 / scale);
                format!("{clamp}[[prescribed]]\n{end}\nvelocity = {:?}\n{sine}", place([0.8, 0.5, 0.0]))
            }
            3 => format!("{clamp}[[traction]]\n{end}\nforce_per_area = {:?}\n", place([0.0, 2e3, 1e3])),
            4 => gravity + &velocity([1.5, -2.0, 0.0]) + &plane(-0.1, 1.0, ""),
            5 => {
                let moving = format!("velocity = {:?}\nuntil = {:?}\n", place([0.0, -0.5, 0.0]), 0.3 * scale);
                plane(-0.01, 1.0, "") + &plane(1.01, -1.0, &moving)
            }
            _ => gravity + &plane(0.0, 1.0, ""),
        };
        // Its default follows lengths per second.
        let has_barrier = self.integrator.has_newton() && self.drive >= WITHOUT_PLANES;
        let friction = if has_barrier { "[contact]\ntransition_speed = 1e-3\n" } else { "" };
        let [alpha, beta] = [self.damping[0] / scale, self.damping[1] * scale];
        let damping = format!("[damping]\nalpha = {alpha:?}\nbeta = {beta:?}\n");
        let plastic = "[plasticity]\nmodel = \"j2\"\nyield_stress = 1e4\nhardening = 1e4\n";
        let size = length([2.0, 1.0, 1.0]);
        SceneText {
            mesh: format!(
                "box = {{ size = {size:?}, pattern = \"kuhn\", cells_per_unit = {} }}",
                (1.0 / scale).round()
            ),
            dt: self.dt * scale,
            ..SceneText::small(self.integrator, self.model)
        }
        .with(&drive)
        .with(friction)
        .with(if self.damping == DAMPINGS[0] { "" } else { &damping })
        .with(if self.model == "hencky" { plastic } else { "" })
        .with(if self.integrator.is_explicit() { "[mass]\nlumped = true\n" } else { "" })
        .with(if self.integrator.has_newton() { "[newton]\ntolerance = 1e-11\n" } else { "" })
        .with(if [Integrator::Xpbd, Integrator::Vbd].contains(&self.integrator) {
            "[iterations]\ncount = 100\n"
        } else {
            ""
        })
        .with(solver)
    }
}

/// A scene that gains no energy from nothing.
fn balanced(scene: Driven) -> Case {
    let text = scene.text(ORIGINAL);
    Case {
        margin_is: "gain of energy / 5 % of the energy supplied; must be at most 1",
        ..text.clone().case(FAMILY, DRIVES[scene.drive], scene.parameters(), move |deadline| {
            let mut simulation = text.build()?;
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
        ..scene.text(ORIGINAL).case(FAMILY, case, parameters, move |deadline| {
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
    let mut simulation = scene.text(copy).build()?;
    let end = march(&mut simulation, scene.steps(), deadline).endurance();
    if end.outcome != Outcome::Survives {
        return Err(end);
    }
    let (q, shape) = (simulation.positions(), simulation.shape());
    let back = |x: Vector3<f64>| Vector3::from(copy.axes.map(|axis| x[axis] / copy.scale));
    let of_node = |(node, X): (usize, &Vector3<f64>)| (back(*X), back(q.fixed_rows::<3>(3 * node) - X));
    Ok(shape.mesh.vertices().iter().enumerate().map(of_node).collect())
}
