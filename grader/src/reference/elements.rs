//! Trials of the functions of one element, one deformation gradient or one spring.

use nalgebra::{DVector, Matrix3, Vector3, Vector4};

use super::random::Random;
use super::scales;
use super::trial::{Elastic, Input, Integrand, Trial};

/// Vertices of a mesh, most of which the element does not use.
const VERTICES: usize = 9;

/// An element anywhere among other vertices: any shape, size, orientation and order.
struct Place {
    V: Vec<Vector3<f64>>,
    element: [usize; 4],
    volume: f64,
    size: f64,
}

fn place(random: &mut Random) -> Place {
    let size = random.size();
    let (shape, offset) = (random.deformation(), random.vector(-3.0..3.0));
    let element = random.four_of(VERTICES);
    let mut V: Vec<_> = (0..VERTICES).map(|_| random.vector(-3.0..3.0) * size).collect();
    let corners = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    for (vertex, corner) in element.into_iter().zip(corners) {
        V[vertex] = (shape * corner + offset) * size;
    }
    Place { V, element, volume: shape.determinant().abs() * size.powi(3) / 6.0, size }
}

pub(super) fn trial(function: &'static str, name: &'static str, input: Input, scale: f64) -> Trial {
    Trial { function, name, edge: false, input, scales: vec![scale] }
}

/// `phi_linear_tetrahedron` and `dphi_linear_tetrahedron_dX`.
pub fn shapes(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let one = |index: usize| {
        let Place { V, element, .. } = place(random);
        let (name, phi) = match index {
            0..4 => ("at a vertex", Vector4::from_fn(|i, _| if i == index { 1.0 } else { 0.0 })),
            4 => ("at the centroid", Vector4::repeat(0.25)),
            5..25 => ("inside", Vector4::from_fn(|_, _| random.number(0.0..1.0))),
            _ => {
                let weights = [-1.0, 1.5, random.number(0.5..2.0), random.number(0.5..2.0)];
                ("outside", Vector4::from_fn(|i, _| weights[(i + index) % 4]))
            }
        };
        let phi = phi / phi.sum();
        let x = (0..4).map(|i| V[element[i]] * phi[i]).sum();
        let scale = match function {
            "phi_linear_tetrahedron" => 1.0 + phi.amax(),
            _ => scales::steepest(&scales::gradients(&V, &element)),
        };
        trial(function, name, Input::Shape { V, element, x }, scale)
    };
    (0..40).map(one).collect()
}

/// `psi_neo_hookean` and its derivatives.
pub fn densities(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let mut trials = Vec::new();
    for index in 0..40 {
        let ((name, F), (C, D)) = (random.deformation_of(index), random.constants());
        let scale = match function {
            "psi_neo_hookean" => scales::energy(&F, C, D),
            "dpsi_neo_hookean_dF" => scales::stress(&F, C, D),
            _ => scales::stiffness(&F, C, D),
        };
        trials.push(trial(function, name, Input::Density { F, C, D }, scale));
    }
    if function == "psi_neo_hookean" {
        let flat = Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 0.0));
        let mirrored = random.deformation() * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0));
        for (name, F) in [("flat", flat), ("inside out", mirrored), ("shrunk to a point", Matrix3::zeros())] {
            let (C, D) = random.constants();
            trials.push(Trial { edge: true, ..trial(function, name, Input::Density { F, C, D }, 1.0) });
        }
    }
    trials
}

/// `T_linear_tetrahedron`.
pub fn kinetic(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let one = |index: usize| {
        let Place { element, volume, .. } = place(random);
        let speed = random.size();
        let density = random.number(1.0..5000.0);
        let (name, qdot) = match index {
            0 => ("at rest", DVector::zeros(3 * VERTICES)),
            1..4 => {
                let v = random.vector(-speed..speed);
                ("all as fast", DVector::from_fn(3 * VERTICES, |i, _| v[i % 3]))
            }
            _ => ("any velocities", random.numbers(3 * VERTICES, -speed..speed)),
        };
        trial(function, name, Input::Kinetic { qdot, element, density, volume }, density * volume * speed * speed)
    };
    (0..30).map(one).collect()
}

/// `quadrature_single_point`.
pub fn quadratures(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let one = |index: usize| {
        let Place { V, element, volume, .. } = place(random);
        let (name, length) = match index {
            0..4 => ("a constant", 1),
            4..16 => ("a polynomial", 1),
            _ => ("several numbers", 1 + random.below(5)),
        };
        let mut terms = || {
            let mut terms = [(); 5].map(|()| random.number(-1.0..1.0));
            if name == "a constant" {
                terms[1..].fill(0.0);
            }
            terms
        };
        let integrand = Integrand { terms: (0..length).map(|_| terms()).collect() };
        let far = element.iter().map(|&vertex| V[vertex].amax()).fold(0.0, f64::max);
        let size = if name == "a constant" { 1.0 } else { 1.0 + 3.0 * far + far * far };
        trial(function, name, Input::Quadrature { V, element, volume, integrand }, volume * size)
    };
    (0..30).map(one).collect()
}

/// Energy, gradient and Hessian of an element.
pub fn elastic(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let derivatives = match function {
        "V_linear_tetrahedron" => 0,
        "dV_linear_tetrahedron_dq" => 1,
        _ => 2,
    };
    let one = |index: usize| {
        let Place { V, element, volume, size } = place(random);
        let (name, F) = random.deformation_of(index);
        let shift = random.vector(-3.0..3.0) * size;
        let mut q = random.numbers(3 * VERTICES, -3.0 * size..3.0 * size);
        for vertex in element {
            q.fixed_rows_mut::<3>(3 * vertex).copy_from(&(F * V[vertex] + shift));
        }
        let (C, D) = random.constants();
        let elastic = Elastic { q, V, element, volume, C, D };
        let scale = scales::elastic(&elastic, derivatives);
        trial(function, name, Input::Elastic(elastic), scale)
    };
    (0..40).map(one).collect()
}

/// Energy and gradient of a spring.
pub fn springs(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let one = |index: usize| {
        let (size, stiffness) = (random.size(), 10f64.powf(random.number(0.0..6.0)));
        let q0 = random.vector(-1.0..1.0) * size;
        let (name, q1, l0) = match index {
            0 | 1 => ("no length", q0, random.number(0.5..1.5) * size),
            2 => ("no length and no rest length", q0, 0.0),
            3..8 => ("no rest length", q0 + random.vector(-1.0..1.0) * size, 0.0),
            _ => ("any length", q0 + random.vector(-1.0..1.0) * size, random.number(0.1..2.0) * size),
        };
        let length = (q1 - q0).norm() + l0;
        // Rounded positions make a length that is wrong by some 1e-16 of the size, so the size counts too.
        let length = if length > 0.0 { length } else { size };
        let scale = stiffness * if function == "V_spring_particle_particle" { length * length } else { length };
        let input = Input::Spring { q0, q1, l0, stiffness };
        Trial { edge: index < 3, ..trial(function, name, input, scale) }
    };
    (0..30).map(one).collect()
}

/// `mass_matrix_linear_tetrahedron`.
pub fn masses(function: &'static str, random: &mut Random) -> Vec<Trial> {
    let one = |_| {
        let (density, volume) = (random.number(1.0..5000.0), random.size().powi(3));
        trial(function, "any element", Input::ElementMass { density, volume }, density * volume / 10.0)
    };
    (0..20).map(one).collect()
}
