//! The standard load on which a function's time is taken: one call of ordinary size, made many times in a row.

use grader_child::Exercise;
use grader_child::wire::Argument;
use nalgebra::{DVector, Matrix3, Matrix4, Vector3, Vector4};

const C: f64 = 1e5;
const D: f64 = 2e5;
const DENSITY: f64 = 1000.0;

/// Display vertices of the skinning.
const DISPLAY: usize = 64;

struct Body(Vec<u8>);

impl Body {
    fn with<'a>(mut self, argument: impl Argument<'a>) -> Self {
        argument.append(&mut self.0);
        self
    }
}

/// A function, the arguments of the call, and how often it is made; `None` if no function has this name.
pub fn load(name: &str) -> Option<(Exercise, Vec<u8>, u64)> {
    load_of(name, 3)
}

/// The same with a cube of so many cells a side.
pub fn load_of(name: &str, cells: usize) -> Option<(Exercise, Vec<u8>, u64)> {
    let function = Exercise::from_name(name)?;
    let (V, T, v0) = cube(cells);
    let F = Matrix3::new(1.1, 0.1, 0.0, -0.05, 0.9, 0.02, 0.0, 0.1, 1.05);
    let q = DVector::from_iterator(3 * V.len(), V.iter().flat_map(|X| <[f64; 3]>::from(F * X)));
    let inside = Vector3::new(0.31, 0.42, 0.53);
    let start = Body(Vec::new());
    let (body, times) = match name {
        "phi_linear_tetrahedron" | "dphi_linear_tetrahedron_dX" => (start.with(&V[..]).with(&T[0]).with(&inside), 4000),
        "psi_neo_hookean" | "dpsi_neo_hookean_dF" | "d2psi_neo_hookean_dF2" => (start.with(&F).with(C).with(D), 4000),
        "T_linear_tetrahedron" => (start.with(&q).with(&T[0]).with(DENSITY).with(v0[0]), 4000),
        "V_linear_tetrahedron" | "dV_linear_tetrahedron_dq" | "d2V_linear_tetrahedron_dq2" => {
            (start.with(&q).with(&V[..]).with(&T[0]).with(v0[0]).with(C).with(D), 2000)
        }
        "V_spring_particle_particle" | "dV_spring_particle_particle_dq" => {
            (start.with(&V[0]).with(&inside).with(0.2).with(100.0), 4000)
        }
        "mass_matrix_linear_tetrahedron" => (start.with(DENSITY).with(v0[0]), 4000),
        "mass_matrix_mesh" => (start.with(q.len()).with(&T[..]).with(DENSITY).with(&v0[..]), 20),
        "assemble_forces" | "assemble_stiffness" => {
            (start.with(&q).with(&V[..]).with(&T[..]).with(&v0[..]).with(C).with(D), 20)
        }
        "build_skinning_matrix" => {
            // As many on every mesh, so that the reference's search through all elements grows as n¹.
            let some = V.iter().step_by((V.len() / DISPLAY).max(1)).take(DISPLAY);
            let display: Vec<Vector3<f64>> = some.map(|X| X * 0.9 + inside * 0.1).collect();
            (start.with(&V[..]).with(&T[..]).with(&display[..]), 20)
        }
        "fixed_point_constraints" => {
            let fixed: Vec<usize> = (0..V.len()).rev().step_by(16).collect();
            (start.with(q.len()).with(&fixed[..]), 200)
        }
        "pick_nearest_vertices" => {
            let view = Matrix4::new_translation(&Vector3::new(-0.5, -0.5, -3.0));
            let proj = Matrix4::new_perspective(1.0, 0.8, 0.1, 10.0);
            let faces: Vec<[usize; 3]> = T.iter().map(|element| [element[0], element[1], element[2]]).collect();
            let body = start.with(&Vector3::new(50.0, 50.0, 0.0)).with(&view).with(&proj);
            (body.with(&Vector4::new(0.0f32, 0.0, 100.0, 100.0)).with(&V[..]).with(&faces[..]).with(0.3), 50)
        }
        // The child brings the closures' problem itself.
        "quadrature_single_point" => (start, 4000),
        _ => (start, 20),
    };
    Some((function, body.0, times))
}

/// A unit cube of `n`³ cells, six tetrahedra each: vertices, elements, volumes.
pub fn cube(n: usize) -> (Vec<Vector3<f64>>, Vec<[usize; 4]>, Vec<f64>) {
    let index = |[i, j, k]: [usize; 3]| i + (n + 1) * (j + (n + 1) * k);
    let mut V = Vec::new();
    let mut T = Vec::new();
    for k in 0..=n {
        for j in 0..=n {
            for i in 0..=n {
                V.push(Vector3::new(i as f64, j as f64, k as f64) / n as f64);
                if i.max(j).max(k) < n {
                    for (order, is_even) in [
                        ([0, 1, 2], true),
                        ([0, 2, 1], false),
                        ([1, 0, 2], false),
                        ([1, 2, 0], true),
                        ([2, 0, 1], true),
                        ([2, 1, 0], false),
                    ] {
                        let mut corner = [i, j, k];
                        let mut element = [index(corner); 4];
                        for (place, axis) in order.into_iter().enumerate() {
                            corner[axis] += 1;
                            element[place + 1] = index(corner);
                        }
                        if !is_even {
                            element.swap(2, 3);
                        }
                        T.push(element);
                    }
                }
            }
        }
    }
    let volume = 1.0 / (6 * n * n * n) as f64;
    let v0 = vec![volume; T.len()];
    (V, T, v0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use grader_child::NAMES;
    use grader_child::wire::Wire;

    #[test]
    fn every_function_has_a_standard_load() {
        for name in NAMES {
            assert!(load(name).is_some(), "{name}");
        }
        let mut body = &load("psi_neo_hookean").unwrap().1[..];
        assert!(<Matrix3<f64> as Wire>::get(&mut body).is_some());
        assert_eq!(body.len(), 16);
    }

    #[test]
    fn the_cube_is_filled_by_elements_of_positive_volume() {
        let (V, T, v0) = cube(2);
        for (element, v) in T.iter().zip(v0) {
            let [a, b, c, d] = element.map(|vertex| V[vertex]);
            assert!(((b - a).cross(&(c - a)).dot(&(d - a)) / 6.0 - v).abs() < 1e-15);
        }
    }
}
