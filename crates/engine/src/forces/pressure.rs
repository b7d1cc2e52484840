//! Follower pressures: forces along the normal of the deformed surface.

mod edges;
mod quadratic_triangles;
mod triangles;

use std::collections::HashSet;

use fem_model::{Body, LoadCurve};

use super::{AddBlock, Energy, Follower, HessianKind, Moment, Potential};
use edges::Edges;
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;
use quadratic_triangles::QuadraticTriangles;
use triangles::Triangles;

/// Key in the statistics.
pub const NAME: &str = "pressure";

/// All pressures of a body.
struct Pressures<T>(Vec<Pressure<T>>);

/// A pressure on a part of the surface.
#[derive(Clone, Debug, PartialEq)]
struct Pressure<T> {
    /// Pa; positive pushes inward.
    pressure: T,
    curve: Option<LoadCurve>,
    surface: Surface<T>,
    /// True if the pressure has a potential.
    ///
    /// A pressure is p times the gradient of the volume behind its surface. If the surface has an edge that moves, that volume depends on
    /// the closure of the surface, and the work of the pressure along a closed path need not be zero.
    has_potential: bool,
}

/// The loaded part of the surface.
#[derive(Clone, Debug, PartialEq)]
enum Surface<T> {
    /// Of a solid body.
    Triangles(Triangles<T>),
    /// Of a solid body with nodes at the middles of its edges.
    QuadraticTriangles(QuadraticTriangles<T>),
    /// Of a flat body.
    Edges(Edges<T>),
}

/// Evaluates an expression for either kind of surface.
macro_rules! with_surface {
    ($surface:expr, $name:ident => $value:expr) => {
        match $surface {
            Surface::Triangles($name) => $value,
            Surface::QuadraticTriangles($name) => $value,
            Surface::Edges($name) => $value,
        }
    };
}

/// The pressures of a body; `None` where it has none.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    let joined = joined(&body.pressures);
    let pressures: Vec<_> = joined.iter().map(|pressure| Pressure::new(body, pressure, numbering)).collect();
    (!pressures.is_empty()).then(|| Box::new(Pressures(pressures)) as Box<dyn Potential<T>>)
}

impl<T: Real> Pressure<T> {
    fn new(body: &Body, pressure: &fem_model::Pressure, numbering: &Numbering) -> Self {
        let mesh = &body.shape.mesh;
        let engine_node = |node: usize| numbering.engine_node[node] as usize;
        let rim = match mesh.thickness() {
            None => triangles::rim(&pressure.faces),
            Some(_) => edges::rim(&pressure.faces),
        };
        let (x, faces) = (mesh.vertices(), &pressure.faces);
        let surface = match (mesh.thickness(), mesh.element().order) {
            (None, 1) => Surface::Triangles(Triangles::new(x, faces, engine_node)),
            (None, _) => Surface::QuadraticTriangles(QuadraticTriangles::new(x, faces, engine_node)),
            (Some(thickness), _) => Surface::Edges(Edges::new(x, faces, engine_node, thickness)),
        };
        Self {
            pressure: T::of(pressure.pressure),
            curve: pressure.curve.clone(),
            surface,
            has_potential: are_fixed(body, &rim),
        }
    }

    /// p times the growth of the volume behind the surface, J; `None` where the pressure has no potential.
    fn potential(&self, u: &[[T; 3]]) -> Option<f64> {
        let growth = || with_surface!(&self.surface, surface => surface.growth(u));
        self.has_potential.then(|| self.pressure.as_f64() * growth())
    }
}

impl<T: Real> Potential<T> for Pressures<T> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        let has_potential = self.0.iter().all(|pressure| pressure.has_potential);
        let note = if has_potential { "" } else { "; the edge of its surface moves, so no energy contains its work" };
        format!("[[traction]] with pressure{note}")
    }

    fn bytes(&self) -> usize {
        self.0.iter().map(|pressure| with_surface!(&pressure.surface, surface => surface.bytes())).sum()
    }

    /// The whole force follows the body.
    fn energy(&self, _: &[[T; 3]], _: Moment) -> Energy {
        Energy::default()
    }

    fn add_gradient(&self, _: &[[T; 3]], _: Moment, _: &mut [[T; 3]]) {}

    fn hessian(&self, _: &[[T; 3]], _: Moment, _: HessianKind, _: &mut AddBlock<T>) {}

    fn resultant(&self, _: Moment) -> Option<[f64; 3]> {
        Some([0.0; 3])
    }

    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        let is_finite = self.0.iter().all(|pressure| pressure.pressure.as_f64().is_finite());
        (!is_finite).then_some(("traction", "a pressure"))
    }

    fn follower(&self) -> Option<&dyn Follower<T>> {
        Some(self)
    }
}

impl<T: Real> Follower<T> for Pressures<T> {
    fn add_follower_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) {
        for pressure in &self.0 {
            let factor = pressure.pressure * T::of(moment.factor(pressure.curve.as_ref()));
            with_surface!(&pressure.surface, surface => surface.add_gradient(factor, u, gradient));
        }
    }

    fn reported_energy(&self, u: &[[T; 3]], moment: Moment) -> f64 {
        let of_one = |pressure: &Pressure<T>| Some(moment.factor(pressure.curve.as_ref()) * pressure.potential(u)?);
        self.0.iter().filter_map(of_one).sum()
    }
}

/// Tables of the same pressure and curve as one: the six sides of a box have a potential together, but not alone.
fn joined(tables: &[fem_model::Pressure]) -> Vec<fem_model::Pressure> {
    let mut joined: Vec<fem_model::Pressure> = Vec::new();
    for table in tables {
        match joined.iter_mut().find(|earlier| (earlier.pressure, &earlier.curve) == (table.pressure, &table.curve)) {
            Some(earlier) => earlier.faces.extend(table.faces.iter().cloned()),
            None => joined.push(table.clone()),
        }
    }
    joined
}

/// Returns true if all these nodes are fixed at all times.
fn are_fixed(body: &Body, nodes: &[usize]) -> bool {
    let always = body.dirichlet.iter().filter(|condition| condition.motion.is_none() && condition.until.is_none());
    let fixed: HashSet<usize> = always.flat_map(|condition| &condition.nodes).copied().collect();
    nodes.iter().all(|node| fixed.contains(node))
}
