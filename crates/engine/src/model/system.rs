//! What never changes in a run: the undeformed body, what it is made of, what holds it and what acts on it.

use std::sync::Arc;

use nalgebra::Vector3;

use crate::boundary::dirichlet::{DirichletConditions, fully_constrained_nodes};
use crate::elements::Elements;
use crate::forces::acting::Acting;
use crate::forces::dead_load;
use crate::forces::pressure::Pressure;
use crate::forces::pulls::AnchorSpring;
use crate::forces::springs::Spring;
use crate::materials::{AnyLaw, Projected};
use crate::model::mass::Mass;
use crate::model::numbering::Numbering;
use crate::number::Real;
use crate::profile::Work;
use crate::solvers::SolverChoice;
use crate::sparse::{Block, Pattern};
use fem_scene::simulation::Shape;
use fem_scene::{Body, Drag, Motion, RayleighDamping};

/// A body in the engine's order of nodes: free ones first, those that are held wholly last.
pub struct System<T: Real> {
    /// Name of the scene.
    pub name: String,
    /// Undeformed meshes, in their own order.
    pub shape: Arc<Shape>,
    /// The engine's numbers of the nodes.
    pub order: Numbering,
    /// Undeformed positions in the engine's order, m.
    pub rest: Vec<Vector3<f64>>,
    /// Undeformed elements.
    pub elements: Elements<T, 3, 4>,
    /// Where the blocks of the stiffness are; its rows are the free nodes.
    pub pattern: Arc<Pattern>,
    /// Constitutive law.
    pub law: AnyLaw<T::Lanes>,
    /// Factor of its moduli in each of the mesh's elements; empty for none.
    pub stiffer: Vec<f64>,
    /// Mass of all nodes.
    pub mass: Mass<T>,
    /// Mass of each node with its share of its neighbours, kg; empty where something is held.
    pub node_masses: Vec<T>,
    /// Mass of all nodes together, kg.
    pub total_mass: f64,
    /// What holds nodes.
    pub held: DirichletConditions,
    /// Forces that stay as they are, such as weight, N; `None` where the scene names none.
    pub dead_load: Option<Vec<[T; 3]>>,
    /// Springs between nodes.
    pub springs: Vec<Spring<T>>,
    /// Pressures that follow the surface.
    pub pressures: Vec<Pressure<T>>,
    /// Rayleigh's damping; `None` where the scene names none, or none that is not zero.
    pub damping: Option<RayleighDamping>,
    /// The scene's scripted drag, with the engine's number of its node.
    pub drag: Option<Drag>,
    /// Longest edge of the undeformed body's bounding box, m.
    pub length: f64,
    /// What its parts have done so far.
    pub work: Work,
}

/// An energy, and the size of what was added up to it, which says how exact it is; J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// The sum.
    pub value: f64,
    /// Sum of the magnitudes of its terms.
    pub terms: f64,
}

impl Energy {
    /// A single term.
    pub fn of(value: f64) -> Self {
        Self { value, terms: value.abs() }
    }
}

impl std::ops::Add for Energy {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, terms: self.terms + other.terms }
    }
}

impl<T: Real> System<T> {
    /// Builds what the scene names, and nothing else; rows and blocks as the solver wants them.
    pub fn new(body: Body, law: AnyLaw<T::Lanes>, choice: SolverChoice) -> Self {
        let mesh = &body.shape.mesh;
        let order = Numbering::new(choice.ordering(), &mesh.vertices, &mesh.elements, &fully_constrained_nodes(&body));
        let corners = order.elements(&mesh.elements);
        let rest: Vec<_> = order.mesh_node.iter().map(|&node| mesh.vertices[node as usize]).collect();
        let springs = node_springs(&body, &order);
        let joined: Vec<[u32; 2]> = springs.iter().map(|spring| spring.nodes.map(|node| node as u32)).collect();
        let pattern = Pattern::joined(order.free, &corners, &joined, choice.stored());
        let volumes = fem_mesh::volumes(mesh);
        // Of the scene's density.
        let denser = |element: usize| body.density_factors.get(element).copied().unwrap_or(1.0);
        let filled: Vec<f64> = volumes.iter().enumerate().map(|(element, volume)| denser(element) * volume).collect();
        let mass = Mass::new(rest.len(), &corners, &filled, body.material.density, body.lumped_mass);
        let dead_load = dead_load::dead(&body, &order, &mass, &corners, &volumes);
        let pressures = Pressure::all(&body, &order);
        let held = DirichletConditions::new(&body, &order);
        let drag = body.drag.map(|drag| Drag { node: order.engine_node[drag.node] as usize, ..drag });
        Self {
            name: body.name,
            elements: Elements::stiffened(&rest, &corners, &body.stiffness_factors, &pattern),
            length: length(&rest),
            total_mass: body.material.density * filled.iter().sum::<f64>(),
            stiffer: body.stiffness_factors,
            node_masses: if held.is_nothing(rest.len()) { mass.lumped() } else { Vec::new() },
            held,
            shape: Arc::new(body.shape),
            pattern: Arc::new(pattern),
            order,
            rest,
            law,
            mass,
            dead_load,
            springs,
            pressures,
            damping: body.damping,
            drag,
            work: Work::default(),
        }
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.rest.len()
    }

    /// Number of nodes that are not held wholly.
    pub fn free(&self) -> usize {
        self.order.free
    }

    /// Whether nothing is held.
    pub fn is_unheld(&self) -> bool {
        self.held.is_nothing(self.nodes())
    }

    /// What acts where loads are dead and applied in full.
    pub fn acting<'a>(&'a self, pulls: &'a [AnchorSpring<T>]) -> Acting<'a, T> {
        Acting { pulls, load: self.dead_load.as_deref() }
    }

    /// Potential energy: elastic energy, that of springs, less the work of loads from rest on.
    pub fn potential(&self, u: &[[T; 3]], acting: Acting<T>) -> Energy {
        let elastic = self.elements.energy(self.law.as_law(), u);
        Energy::of(elastic) + Energy::of(self.spring_energy(u)) + acting.potential(u)
    }

    /// Size of what cancels in the elastic energy where the body has turned, J. A turn alone has no energy, but that of its
    /// rounding.
    pub fn cancelled(&self, u: &[[T; 3]]) -> f64 {
        self.law.size() * self.elements.squares(u)
    }

    /// Energy and gradient of [`potential`](Self::potential), the latter in `gradient`, N.
    pub fn potential_and_gradient(&self, u: &[[T; 3]], acting: Acting<T>, gradient: &mut [[T; 3]]) -> Energy {
        gradient.fill([T::default(); 3]);
        let elastic = self.work.energies.time(|| self.elements.add_energy_and_gradient(self.law.as_law(), u, gradient));
        self.add_outer_gradient(u, acting, gradient);
        Energy::of(elastic) + Energy::of(self.spring_energy(u)) + acting.potential(u)
    }

    /// Gradient of the potential energy, N: minus the force on each node.
    pub fn gradient(&self, u: &[[T; 3]], acting: Acting<T>, gradient: &mut [[T; 3]]) {
        gradient.fill([T::default(); 3]);
        self.work.forces.time(|| self.elements.add_gradient(self.law.as_law(), u, gradient));
        self.add_outer_gradient(u, acting, gradient);
    }

    /// Adds `factor` K(u), the Hessian of the body's own energy, N/m.
    pub fn add_stiffness(&self, factor: T, u: &[[T; 3]], values: &mut [Block<T, 3>]) {
        self.work.stiffness.time(|| self.elements.add_stiffness(self.law.as_law(), factor, u, values));
        self.add_spring_stiffness(factor, u, false, values);
    }

    /// The same with each element and spring projected to positive semi-definite.
    pub fn add_projected_stiffness(&self, factor: T, u: &[[T; 3]], values: &mut [Block<T, 3>]) {
        self.work.projection.time(|| self.elements.add_stiffness(&Projected(self.law.as_law()), factor, u, values));
        self.add_spring_stiffness(factor, u, true, values);
    }

    /// Adds `factor` K(u) d, without a matrix, N.
    pub fn add_stiffness_times(&self, factor: T, u: &[[T; 3]], d: &[[T; 3]], product: &mut [[T; 3]]) {
        self.elements.add_stiffness_times(self.law.as_law(), factor, u, d, product);
        for spring in &self.springs {
            spring.add_stiffness_times(factor, u, d, product);
        }
    }

    /// Adds `factor` times the forces of pressures on the surface as it is, N.
    pub fn add_pressures(&self, factor: T, u: &[[T; 3]], force: &mut [[T; 3]]) {
        if self.pressures.is_empty() {
            return;
        }
        self.work.pressure.time(|| self.pressures.iter().for_each(|pressure| pressure.add_force(factor, u, force)));
    }

    /// Adds `factor` M x.
    pub fn add_mass_times(&self, factor: T, x: &[[T; 3]], product: &mut [[T; 3]]) {
        self.work.mass.time(|| self.mass.add_times(factor, x, product));
    }

    /// Writes the step that held directions make, and leaves the others: see [`DirichletConditions::lead`].
    pub fn lead(&self, fraction: impl Fn(&Motion) -> f64, start: &[[T; 3]], step: &mut [[T; 3]]) {
        if !self.held.leads() {
            return self.held.clear(step);
        }
        self.work.prescribed.time(|| self.held.lead(&self.rest, fraction, start, step));
    }

    /// Potential of the pressures that have one, zero at rest, J.
    pub fn pressure_potential(&self, u: &[[T; 3]]) -> f64 {
        self.pressures.iter().filter_map(|pressure| pressure.potential(u)).sum()
    }

    fn spring_energy(&self, u: &[[T; 3]]) -> f64 {
        self.springs.iter().map(|spring| spring.energy(u)).sum()
    }

    fn add_spring_stiffness(&self, factor: T, u: &[[T; 3]], projected: bool, values: &mut [Block<T, 3>]) {
        if self.springs.is_empty() {
            return;
        }
        let add = |spring: &Spring<T>| spring.add_stiffness(factor, u, projected, &self.pattern, &mut *values);
        self.work.springs.time(|| self.springs.iter().for_each(add));
    }

    fn add_outer_gradient(&self, u: &[[T; 3]], acting: Acting<T>, gradient: &mut [[T; 3]]) {
        if !self.springs.is_empty() {
            self.work.springs.time(|| self.springs.iter().for_each(|spring| spring.add_gradient(u, &mut *gradient)));
        }
        if acting.load.is_some() {
            // Pressures without dead loads are gathered into loads all the same.
            let meter = if self.dead_load.is_some() { &self.work.dead_load } else { &self.work.pressure };
            meter.time(|| acting.add_load_gradient(gradient));
        }
        if !acting.pulls.is_empty() {
            self.work.drag.time(|| acting.add_pull_gradient(u, gradient));
        }
    }
}

fn node_springs<T: Real>(body: &Body, order: &Numbering) -> Vec<Spring<T>> {
    let spring = |table: &fem_scene::Spring| {
        let [a, b] = table.nodes.map(|node| body.shape.mesh.vertices[node]);
        let edge = b - a;
        Spring {
            nodes: table.nodes.map(|node| order.engine_node[node] as usize),
            edge: [T::of(edge.x), T::of(edge.y), T::of(edge.z)],
            stiffness: T::of(table.stiffness),
            length: T::of(table.rest_length),
            // Rounding of the length that the scene leaves out is no stretch.
            excess: T::of(if table.is_initially_relaxed {
                0.0
            } else {
                edge.norm_squared() - table.rest_length * table.rest_length
            }),
        }
    };
    body.springs.iter().map(spring).collect()
}

/// a · b, in double.
pub fn dot<T: Real>(a: &[T; 3], b: &[T; 3]) -> f64 {
    a.iter().zip(b).map(|(&a, &b)| a.as_f64() * b.as_f64()).sum()
}

/// Longest edge of the bounding box, m.
fn length(x: &[Vector3<f64>]) -> f64 {
    let (least, most) = x.iter().fold((x[0], x[0]), |(least, most), x| (least.inf(x), most.sup(x)));
    (most - least).max()
}
