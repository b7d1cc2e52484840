//! A body with its material and time step, and the motions that all methods are measured by: beams of 4 × 1 × 1 m and strips of 4 × 1 m whose
//! inner nodes lie on lattices that are isotropic for springs, clamped at one end and bent by their weight.

use fem_engine::simulator::Simulator;
use fem_mesh::{SurfaceMesh, TetrahedralMesh};
use fem_model::simulation::Simulation;
use fem_model::{Axis, Body, BodyMesh, Integrator, Material, Method, NewtonSettings, PlaneState, Region, Selector};
use nalgebra::{DVector, Vector3};

use crate::scenes::{SPRINGS, material};
use crate::study::{Problem, Result};
use fem_reference::time::{Equations, reference};

/// Density, kg/m³, and gravity, m/s².
pub const DENSITY: f64 = 1000.0;
pub const GRAVITY: f64 = 9.81;

/// The law of all elements.
pub const LAW: &str = "corotated";

/// Longest time of a reference, s.
const PATIENCE: f64 = 60.0;

/// A body that bends under its weight from rest.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its shape, and its cells across.
    pub shape: Shape,
    pub cells: usize,
    /// Young's modulus (Pa), Poisson's ratio.
    pub young: f64,
    pub poisson: f64,
    /// Steps of a second, and of the run.
    pub rate: usize,
    pub steps: usize,
}

impl Case {
    /// The case in words.
    pub fn name(&self) -> String {
        format!("{}, E = {:e} Pa, ν = {:.4}, dt = 1/{} s", self.shape.name(), self.young, self.poisson, self.rate)
    }

    /// Cells of tables: the body, E, ν, dt.
    pub fn cells(&self) -> [String; 4] {
        let poisson = format!("{:.4}", self.poisson);
        [self.shape.name().to_owned(), format!("{:e}", self.young), poisson, format!("1/{}", self.rate)]
    }

    /// The body of a law, or of springs in its place.
    pub fn body(&self, law: &str) -> Result<Body> {
        let (mesh, clamp) = self.shape.mesh(self.cells);
        let (down, is_elastic_strip) = match self.shape {
            Shape::Beam => ([0.0, 0.0, -GRAVITY], false),
            Shape::Strip => ([0.0, -GRAVITY, 0.0], law != SPRINGS),
        };
        let plane = if is_elastic_strip { PlaneState::Stress } else { PlaneState::Strain };
        let material = Material { plane, ..material(law, self.young, self.poisson, DENSITY)? };
        let clamp = Selector::Region(Region::Plane { axis: Axis::X, below: clamp });
        let body = Body::new(mesh, material)?.gravity(down)?.fix(&clamp)?;
        Ok(Body { lumped_mass: true, ..body })
    }

    /// Time step, s.
    pub fn dt(&self) -> f64 {
        1.0 / self.rate as f64
    }

    /// Positions at the start and at the end of a run of the elements, m.
    pub fn ends(&self, method: &Method) -> Result<[DVector<f64>; 2]> {
        let mut simulation = Simulator::<f64>::new(self.body(LAW)?, method)?;
        let rest = simulation.positions();
        for _ in 0..self.steps {
            simulation.step()?;
        }
        Ok([rest, simulation.positions()])
    }

    /// The same with implicit Euler and Newton's method to round-off.
    pub fn converged(&self) -> Result<[DVector<f64>; 2]> {
        let newton = NewtonSettings { tolerance: Some(1e-14), ..NewtonSettings::default() };
        self.ends(&Method { newton, ..Method::new(Integrator::ImplicitEuler, self.dt()) })
    }

    /// Positions at the end of the equations of motion of a law, integrated to round-off, m.
    fn exact(&self, law: &str) -> Result<DVector<f64>> {
        Ok(reference(&Equations::new(self.body(law)?)?, self.steps as f64 / self.rate as f64, PATIENCE)?.q)
    }

    /// The motions that the errors of this case are distances from.
    pub fn measures(&self) -> Result<Measures> {
        let find = || {
            let [rest, converged] = self.converged()?;
            Ok(Measures { rest, converged, exact: self.exact(LAW)?, springs: self.exact(SPRINGS)? })
        };
        find().map_err(|problem: Problem| format!("{}: {problem}", self.name()).into())
    }
}

/// Motions at the end of a run, positions in m.
pub struct Measures {
    rest: DVector<f64>,
    /// Implicit Euler with Newton's method to round-off, at the time step of the case.
    converged: DVector<f64>,
    /// The equations of motion of the elements, and of springs in their place.
    exact: DVector<f64>,
    springs: DVector<f64>,
}

impl Measures {
    /// Distance of an end from the converged steps of implicit Euler, over their largest displacement.
    pub fn solver_error(&self, end: &DVector<f64>) -> f64 {
        distance(end, &self.converged) / distance(&self.converged, &self.rest)
    }

    /// Distance of an end from the exact motion of the elements, over its largest displacement.
    pub fn total_error(&self, end: &DVector<f64>) -> f64 {
        distance(end, &self.exact) / distance(&self.exact, &self.rest)
    }

    /// The part of the total error that converged implicit Euler has.
    pub fn time_error(&self) -> f64 {
        self.total_error(&self.converged)
    }

    /// The part of the total error that springs have however small their steps.
    pub fn model_error(&self) -> f64 {
        self.total_error(&self.springs)
    }
}

/// Largest distance of a node, m. NaN if a position is NaN.
pub fn distance(a: &DVector<f64>, b: &DVector<f64>) -> f64 {
    let nodes = (0..a.len() / 3).map(|node| (a.fixed_rows::<3>(3 * node) - b.fixed_rows::<3>(3 * node)).norm());
    nodes.fold(0.0, |largest: f64, found| if found.is_nan() { found } else { largest.max(found) })
}

/// Length and height of a body, m.
pub const LENGTH: usize = 4;

/// Thickness of a strip, m.
const THICKNESS: f64 = 0.2;

/// Dimensions of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A beam of tetrahedra on a body-centred cubic lattice.
    Beam,
    /// A strip of equilateral triangles in plane stress.
    Strip,
}

impl Shape {
    /// The word in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Beam => "beam",
            Self::Strip => "strip",
        }
    }

    /// The mesh with this many cells across, and the x (m) up to which its nodes are fixed.
    pub fn mesh(self, cells: usize) -> (BodyMesh, f64) {
        match self {
            Self::Beam => (BodyMesh::solid(block([LENGTH * cells, cells, cells], 1.0 / cells as f64)), 1e-9),
            Self::Strip => (strip(LENGTH * 3 * cells, 3 * cells, 1.0 / (3 * cells) as f64), 0.51 / (3 * cells) as f64),
        }
    }
}

/// A box of cubes with edges of `edge` m. Every cube has a node at its centre: tetrahedra join the centres of two cubes to each edge of their
/// common face, and a centre to two triangles of a face of the boundary.
pub fn block(cells: [usize; 3], edge: f64) -> TetrahedralMesh {
    let [nx, ny, nz] = cells;
    let corner = |x: [usize; 3]| x[0] + (nx + 1) * (x[1] + (ny + 1) * x[2]);
    let corners = (nx + 1) * (ny + 1) * (nz + 1);
    let center = |x: [usize; 3]| corners + x[0] + nx * (x[1] + ny * x[2]);
    let grid = |[nx, ny, nz]: [usize; 3]| {
        (0..nz).flat_map(move |k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])))
    };
    let at = |x: [usize; 3]| Vector3::from(x.map(|x| x as f64));
    let mut vertices: Vec<_> = grid([nx + 1, ny + 1, nz + 1]).map(at).collect();
    vertices.extend(grid(cells).map(|x| at(x) + Vector3::repeat(0.5)));
    vertices.iter_mut().for_each(|x| *x *= edge);
    let mut elements = Vec::new();
    for x in grid(cells) {
        for axis in 0..3 {
            for side in 0..2 {
                let face = face_of(x, axis, side).map(corner);
                if side == 0 && x[axis] > 0 {
                    let mut before = x;
                    before[axis] -= 1;
                    elements.extend((0..4).map(|i| [face[i], face[(i + 1) % 4], center(x), center(before)]));
                } else if [0, cells[axis] - 1][side] == x[axis] {
                    elements.extend([[face[0], face[1], face[2], center(x)], [face[0], face[2], face[3], center(x)]]);
                }
            }
        }
    }
    oriented(vertices, elements)
}

/// The corners of a face of a cube, one after the other around it.
fn face_of(mut x: [usize; 3], axis: usize, side: usize) -> [[usize; 3]; 4] {
    let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
    x[axis] += side;
    [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[s, t]| {
        let mut place = x;
        (place[b], place[c]) = (x[b] + s, x[c] + t);
        place
    })
}

/// The mesh with every tetrahedron of positive volume.
fn oriented(vertices: Vec<Vector3<f64>>, mut elements: Vec<[usize; 4]>) -> TetrahedralMesh {
    for element in &mut elements {
        let [a, b, c, d] = element.map(|node| vertices[node]);
        if (b - a).cross(&(c - a)).dot(&(d - a)) < 0.0 {
            element.swap(2, 3);
        }
    }
    TetrahedralMesh::new(vertices, elements)
}

/// Equilateral triangles in rows, every other of which begins half an edge further right.
fn strip(columns: usize, rows: usize, edge: f64) -> BodyMesh {
    let place =
        |i: usize, j: usize| Vector3::new(i as f64 + 0.5 * (j % 2) as f64, 0.75f64.sqrt() * j as f64, 0.0) * edge;
    let node = |i: usize, j: usize| i + (columns + 1) * j;
    let vertices = (0..=rows).flat_map(|j| (0..=columns).map(move |i| place(i, j))).collect();
    let pair = |(i, j): (usize, usize)| {
        let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
        if j % 2 == 0 { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] }
    };
    let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    BodyMesh::flat(SurfaceMesh::new(vertices, cells.flat_map(pair).collect()), THICKNESS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_beam_and_a_strip_fill_their_shape_with_elements_of_one_size() {
        let beam = Shape::Beam.mesh(3).0;
        let volumes = beam.volumes();
        assert!((volumes.iter().sum::<f64>() - 4.0).abs() < 1e-12, "{volumes:?}");
        assert!(volumes.iter().all(|volume| (volume * 12.0 * 27.0 - 1.0).abs() < 1e-12), "{volumes:?}");
        let strip = Shape::Strip.mesh(2).0;
        let area = 0.75f64.sqrt() * 4.0 * 0.2;
        assert!((strip.volumes().iter().sum::<f64>() - area).abs() < 1e-12);
    }
}
