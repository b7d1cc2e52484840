//! Simple inputs of every function, chosen so that each known mistake shows.

use std::cell::Cell;

use grader_child::{Functions, Solve};
use nalgebra::{DMatrix, DVector, Matrix3, Matrix4, Vector3, Vector4, dvector};
use nalgebra_sparse::CsrMatrix;

/// Undeformed positions: a sheared element, its neighbours, and a vertex that belongs to none.
fn vertices() -> Vec<Vector3<f64>> {
    let places = [
        [0.2, 0.1, -0.1],
        [1.3, 0.2, 0.1],
        [0.1, 1.1, 0.3],
        [0.3, 0.4, 1.2],
        [1.4, 1.2, 1.1],
        [0.4, -0.2, -1.3],
        [3.0, 3.0, 3.0],
    ];
    places.map(Vector3::from).to_vec()
}

const T: [[usize; 4]; 3] = [[4, 1, 2, 3], [0, 1, 2, 3], [5, 2, 1, 0]];
const V0: [f64; 3] = [0.31, 0.21, 0.27];

fn volume(V: &[Vector3<f64>], element: &[usize; 4]) -> f64 {
    let [a, b, c, d] = element.map(|vertex| V[vertex]);
    (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0
}

/// Positions after a motion of every vertex.
fn moved(motion: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> DVector<f64> {
    DVector::from_iterator(21, vertices().iter().flat_map(|X| motion(X).data.0[0]))
}

fn stretched() -> Matrix3<f64> {
    Matrix3::new(1.2, 0.3, -0.1, 0.1, 0.8, 0.2, 0.05, -0.3, 1.4)
}

fn squeezed() -> Matrix3<f64> {
    Matrix3::new(0.9, 0.2, 0.1, 0.0, 0.3, 0.1, 0.1, 0.0, 0.8)
}

fn states() -> [DVector<f64>; 3] {
    let bent = |X: &Vector3<f64>| stretched() * X + Vector3::new(0.1 * X.y * X.y, 0.05 * X.x * X.z, -0.1 * X.x * X.x);
    let crushed = |X: &Vector3<f64>| squeezed() * X + Vector3::new(0.02 * X.y * X.y, 0.0, 0.03 * X.x * X.y);
    [moved(bent), moved(crushed), moved(|X| Vector3::new(X.x, X.y, -X.z))]
}

fn flat(matrix: &CsrMatrix<f64>) -> Vec<f64> {
    let dense = DMatrix::from(matrix);
    let shape = [matrix.nrows() as f64, matrix.ncols() as f64];
    shape.into_iter().chain(dense.iter().copied()).collect()
}

/// Answers of an implementation on the simple inputs of one function.
pub fn answers(function: &str, table: &Functions) -> Vec<Vec<f64>> {
    let V = vertices();
    match function {
        "phi_linear_tetrahedron" => {
            let points = [Vector3::new(0.5, 0.4, 0.3), Vector3::new(2.0, -1.0, 0.7)];
            let of = |element, x| (table.phi_linear_tetrahedron)(&V, element, x).as_slice().to_vec();
            T.iter().flat_map(|element| points.iter().map(move |x| of(element, x))).collect()
        }
        "dphi_linear_tetrahedron_dX" => {
            T.iter().map(|e| (table.dphi_linear_tetrahedron_dX)(&V, e, &V[0]).as_slice().to_vec()).collect()
        }
        "psi_neo_hookean" | "dpsi_neo_hookean_dF" | "d2psi_neo_hookean_dF2" => of_material(function, table),
        "V_spring_particle_particle" | "dV_spring_particle_particle_dq" => springs(function, table),
        "T_linear_tetrahedron" | "V_linear_tetrahedron" | "dV_linear_tetrahedron_dq" | "d2V_linear_tetrahedron_dq2" => {
            of_element(function, table, &V)
        }
        "quadrature_single_point" => {
            let integrand = |X: &Vector3<f64>| dvector![1.0, X.x, X.norm(), X.x + X.y * X.z];
            vec![(table.quadrature_single_point)(&V, &T[0], 0.7, &integrand).as_slice().to_vec()]
        }
        "linearly_implicit_euler" | "newtons_method" | "implicit_euler" => with_closures(function, table),
        _ => of_mesh(function, table, &V),
    }
}

fn of_material(function: &str, table: &Functions) -> Vec<Vec<f64>> {
    let mirrored = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -0.5));
    let of = |F: &Matrix3<f64>| match function {
        "psi_neo_hookean" => vec![(table.psi_neo_hookean)(F, 2.0, 5.0)],
        "dpsi_neo_hookean_dF" => (table.dpsi_neo_hookean_dF)(F, 2.0, 5.0).as_slice().to_vec(),
        _ => (table.d2psi_neo_hookean_dF2)(F, 2.0, 5.0).as_slice().to_vec(),
    };
    // Derivatives are asked for where J > 0 only.
    let states = [stretched(), squeezed(), Matrix3::identity(), mirrored];
    states.iter().take(if function == "psi_neo_hookean" { 4 } else { 2 }).map(of).collect()
}

fn springs(function: &str, table: &Functions) -> Vec<Vec<f64>> {
    let o = Vector3::new(0.1, 0.2, 0.3);
    let d = Vector3::new(0.3, 0.4, -1.2);
    let ends = [(d, 0.5), (d, 2.0), (d, 0.0), (Vector3::zeros(), 0.7), (d * 1e-5, 1.0), (d * 1e-8, 0.0)];
    let of = |(d, l0): (Vector3<f64>, f64)| match function {
        "V_spring_particle_particle" => vec![(table.V_spring_particle_particle)(&o, &(o + d), l0, 30.0)],
        _ => (table.dV_spring_particle_particle_dq)(&o, &(o + d), l0, 30.0).as_slice().to_vec(),
    };
    ends.into_iter().map(of).collect()
}

fn of_element(function: &str, table: &Functions, V: &[Vector3<f64>]) -> Vec<Vec<f64>> {
    let of = |q: &DVector<f64>, e: &[usize; 4]| match function {
        "T_linear_tetrahedron" => vec![(table.T_linear_tetrahedron)(q, e, 3.0, 0.7)],
        "V_linear_tetrahedron" => vec![(table.V_linear_tetrahedron)(q, V, e, volume(V, e), 2.0, 5.0)],
        "dV_linear_tetrahedron_dq" => {
            (table.dV_linear_tetrahedron_dq)(q, V, e, volume(V, e), 2.0, 5.0).as_slice().to_vec()
        }
        _ => (table.d2V_linear_tetrahedron_dq2)(q, V, e, volume(V, e), 2.0, 5.0).as_slice().to_vec(),
    };
    let inverted = function == "V_linear_tetrahedron";
    states().iter().take(if inverted { 3 } else { 2 }).flat_map(|q| [of(q, &T[0]), of(q, &T[1])]).collect()
}

fn of_mesh(function: &str, table: &Functions, V: &[Vector3<f64>]) -> Vec<Vec<f64>> {
    let [bent, crushed, _] = &states();
    match function {
        "mass_matrix_linear_tetrahedron" => {
            vec![(table.mass_matrix_linear_tetrahedron)(3.0, 0.7).as_slice().to_vec()]
        }
        "mass_matrix_mesh" => vec![flat(&(table.mass_matrix_mesh)(21, &T, 3.0, &V0))],
        "assemble_forces" => {
            [bent, crushed].map(|q| (table.assemble_forces)(q, V, &T, &V0, 2.0, 5.0).as_slice().to_vec()).to_vec()
        }
        "assemble_stiffness" => {
            [bent, crushed].map(|q| flat(&(table.assemble_stiffness)(q, V, &T, &V0, 2.0, 5.0))).to_vec()
        }
        "build_skinning_matrix" => {
            surfaces(V).map(|V_skin| flat(&(table.build_skinning_matrix)(V, &T, &V_skin))).to_vec()
        }
        "fixed_point_constraints" => {
            let lists: [&[usize]; 5] = [&[0, 2], &[3, 1], &[1, 1], &[], &[0, 1, 2, 3]];
            lists.map(|indices| flat(&(table.fixed_point_constraints)(12, indices))).to_vec()
        }
        "pick_nearest_vertices" => clicks(table),
        _ => Vec::new(),
    }
}

/// Display vertices inside, outside and on the boundary of elements; and none.
fn surfaces(V: &[Vector3<f64>]) -> [Vec<Vector3<f64>>; 4] {
    let middle = |vertices: &[usize]| vertices.iter().map(|&i| V[i]).sum::<Vector3<f64>>() / vertices.len() as f64;
    let near_vertex = V[0] * 0.9 + V[1] * 0.04 + V[2] * 0.03 + V[3] * 0.03;
    let inside = vec![middle(&T[0]), middle(&T[1]), near_vertex];
    let outside = vec![V[0] - Vector3::new(0.3, 0.1, 0.0), V[6], Vector3::new(2.0, 0.0, -1.0)];
    let boundary = vec![V[4], V[5], middle(&[1, 2, 3])];
    [inside, outside, boundary, Vec::new()]
}

/// Two squares behind each other, the second turned away, and one behind the eye.
fn clicks(table: &Functions) -> Vec<Vec<f64>> {
    let square = |z: f64| [[-1.0, -1.2], [1.0, -1.2], [1.0, 0.8], [-1.0, 0.8]].map(|[x, y]| Vector3::new(x, y, z));
    let V: Vec<Vector3<f64>> = [4.0, -1.0, -2.0].into_iter().flat_map(square).collect();
    let face = |i: usize| [[i, i + 1, i + 2], [i, i + 2, i + 3]];
    let F = [face(0), face(4), face(8).map(|[a, b, c]| [a, c, b])].concat();
    let view = Matrix4::look_at_rh(&[0.0, 0.0, 2.0].into(), &[0.1, 0.0, 0.0].into(), &Vector3::y());
    let cameras =
        [Matrix4::new_perspective(1.2, 1.0, 0.1, 100.0), Matrix4::new_orthographic(-2.0, 2.0, -2.0, 2.0, 0.1, 9.0)];
    let viewport = Vector4::new(20.0, 10.0, 100.0, 100.0);
    let mut found = Vec::new();
    let pixels = [(70.0, 50.0), (50.0, 40.0), (75.0, 35.0), (22.0, 108.0)];
    for (camera, (x, y)) in cameras.iter().flat_map(|camera| pixels.map(|pixel| (camera, pixel))) {
        let win = Vector3::new(x, y, 0.0);
        for (F, radius) in [&F[..], &F[4..]].into_iter().flat_map(|F| [0.01, 1.2, 1.7, 2.5].map(|radius| (F, radius))) {
            let picked = (table.pick_nearest_vertices)(&win, &view, camera, &viewport, &V, F, radius);
            found.push(picked.into_iter().map(|vertex| vertex as f64).collect());
        }
    }
    found
}

/// A hardening spring on each of two masses.
fn with_closures(function: &str, table: &Functions) -> Vec<Vec<f64>> {
    let mass = CsrMatrix::from(&DMatrix::from_row_slice(2, 2, &[2.0, 0.5, 0.5, 1.0]));
    let elimination = |A: &CsrMatrix<f64>, b: &DVector<f64>| {
        DMatrix::from(A).lu().solve(b).unwrap_or_else(|| DVector::from_element(b.len(), f64::NAN))
    };
    let half = |A: &CsrMatrix<f64>, b: &DVector<f64>| elimination(A, b) * 0.5;
    if function == "newtons_method" {
        return [&elimination as Solve, &half].into_iter().flat_map(|solve| objectives(table, solve)).collect();
    }
    let force = |q: &DVector<f64>, v: &DVector<f64>| q.map(|x| -30.0 * x - 200.0 * x.powi(3)) - v * 0.0;
    let stiffness = |q: &DVector<f64>, _: &DVector<f64>| {
        CsrMatrix::from(&DMatrix::from_diagonal(&q.map(|x| -30.0 - 600.0 * x * x)))
    };
    let solves = Cell::new(0);
    let counted = |A: &CsrMatrix<f64>, b: &DVector<f64>| {
        solves.set(solves.get() + 1);
        elimination(A, b)
    };
    let dt = 0.2;
    let (q0, v0) = (dvector![0.4, -0.7], dvector![1.0, 2.0]);
    let potential = |q: &DVector<f64>| q.iter().map(|x| 15.0 * x * x + 50.0 * x.powi(4)).sum::<f64>();
    let energy = |v: &DVector<f64>| 0.5 * (v - &v0).dot(&(&mass * (v - &v0))) + potential(&(&q0 + v * dt));
    [&counted as Solve, &half]
        .into_iter()
        .map(|solve| {
            let (mut q, mut v) = (q0.clone(), v0.clone());
            if function == "implicit_euler" {
                (table.implicit_euler)(&mut q, &mut v, dt, &mass, &energy, &force, &stiffness, solve);
            } else {
                (table.linearly_implicit_euler)(&mut q, &mut v, dt, &mass, &force, &stiffness, solve);
            }
            [q.as_slice(), v.as_slice(), &[f64::from(solves.get())]].concat()
        })
        .collect()
}

/// A function of one variable: value, slope and curvature.
type Curve = [fn(f64) -> f64; 3];

const ARCTANGENT: Curve = [|x| x * x.atan() - 0.5 * (1.0 + x * x).ln(), f64::atan, |x| 1.0 / (1.0 + x * x)];
const LOGARITHM: Curve = [|x| x - x.ln(), |x| 1.0 - 1.0 / x, |x| 1.0 / (x * x)];
/// The gradient has the wrong sign, so every step increases the value.
const UPHILL: Curve = [|x| x * x, |x| -2.0 * x, |_| 2.0];
const TINY: Curve = [|x| 1e-9 * x.exp() - 1e-9 * x, |x| 1e-9 * x.exp_m1(), |x| 1e-9 * x.exp()];

/// Curves, each with a start and a number of steps.
const LOADS: [(Curve, f64, usize); 8] = [
    (ARCTANGENT, 3.0, 20),
    (ARCTANGENT, 3.0, 2),
    (ARCTANGENT, 1.0, 0),
    (ARCTANGENT, 0.0, 5),
    (ARCTANGENT, 1.38, 3),
    (LOGARITHM, 3.0, 20),
    (UPHILL, 1.0, 5),
    (TINY, 2.0, 20),
];

fn objectives(table: &Functions, solve: Solve) -> Vec<Vec<f64>> {
    let of = |([f, g, h], start, steps): (Curve, f64, usize)| {
        let hessians = Cell::new(0);
        let H = |x: &DVector<f64>| {
            hessians.set(hessians.get() + 1);
            CsrMatrix::from(&DMatrix::from_element(1, 1, h(x[0])))
        };
        let mut x = dvector![start];
        let value = (table.newtons_method)(&mut x, &|x| f(x[0]), &|x| dvector![g(x[0])], &H, solve, steps);
        vec![x[0], value, f64::from(hessians.get())]
    };
    LOADS.into_iter().map(of).collect()
}
