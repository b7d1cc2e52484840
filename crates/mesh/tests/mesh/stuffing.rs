//! Tetrahedra inside surfaces: clean ones against closed forms, dirty ones against the volumes that they enclose.

use std::collections::{BTreeSet, HashMap};
use std::f64::consts::PI;

use fem_mesh::generate::{Solid, StuffingError, stuff, stuff_graded};
use fem_mesh::{SurfaceMesh, TetrahedralMesh, boundary, check, coincident_nodes, quality, surface_quality, volumes};
use nalgebra::Vector3;

/// A sphere of radius 1 about a centre: an octahedron, each of whose triangles is cut into four several times.
pub fn sphere(cuts: u32, centre: Vector3<f64>) -> SurfaceMesh {
    let x = Vector3::x;
    let mut vertices = vec![x(), -x(), Vector3::y(), -Vector3::y(), Vector3::z(), -Vector3::z()];
    let mut elements = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..cuts {
        let mut middles = HashMap::new();
        let mut middle = |a: usize, b: usize| {
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                vertices.push((vertices[a] + vertices[b]).normalize());
                vertices.len() - 1
            })
        };
        let cut = |[a, b, c]: [usize; 3]| {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        elements = elements.into_iter().flat_map(cut).collect();
    }
    SurfaceMesh::new(vertices.into_iter().map(|x| x + centre).collect(), elements)
}

/// A torus with radii 1 and 0.4 about the z-axis.
pub fn torus(around: usize, across: usize) -> SurfaceMesh {
    let place = |i: usize, j: usize| {
        let (u, v) = (2.0 * PI * i as f64 / around as f64, 2.0 * PI * j as f64 / across as f64);
        let r = 1.0 + 0.4 * v.cos();
        Vector3::new(r * u.cos(), r * u.sin(), 0.4 * v.sin())
    };
    let vertices = (0..around).flat_map(|i| (0..across).map(move |j| place(i, j))).collect();
    let at = |i: usize, j: usize| (i % around) * across + j % across;
    let squares =
        (0..around).flat_map(|i| (0..across).map(move |j| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    let elements = squares.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    SurfaceMesh::new(vertices, elements)
}

pub fn joined(a: SurfaceMesh, b: SurfaceMesh) -> SurfaceMesh {
    let first = a.vertices.len();
    let elements = b.elements.into_iter().map(|element| element.map(|i| i + first));
    SurfaceMesh::new([a.vertices, b.vertices].concat(), a.elements.into_iter().chain(elements).collect())
}

fn turned(mut surface: SurfaceMesh) -> SurfaceMesh {
    surface.elements.iter_mut().for_each(|element| element.swap(1, 2));
    surface
}

/// Every nth triangle of a surface, beginning with the kth.
fn every(surface: &SurfaceMesh, n: usize, k: usize) -> impl Iterator<Item = usize> {
    (k..surface.elements.len()).step_by(n)
}

/// Panics unless a mesh satisfies the guarantees of the method: valid, angles within the bounds, closed. Returns its volume and Euler
/// characteristic.
fn is_sound(mesh: &TetrahedralMesh) -> (f64, i64) {
    check(mesh, "stuffed".as_ref()).unwrap();
    assert_eq!(coincident_nodes(&mesh.vertices), None);
    let [smallest, largest] = quality(mesh).dihedral_angles.map(|angle| angle.value);
    assert!(smallest >= 10.7 && largest <= 164.8, "{smallest} {largest}");
    let surface = surface_quality(&SurfaceMesh::new(mesh.vertices.clone(), boundary(mesh)));
    assert_eq!((surface.open_edges, surface.flipped_edges), (0, 0));
    (volumes(mesh).iter().sum(), surface.euler_characteristic)
}

/// Distances between a mesh and the surface that it fills, m: root mean square and largest, of the centres and edges' middles of its faces from the
/// surface and of the surface's vertices from its faces.
fn distances(mesh: &TetrahedralMesh, surface: &SurfaceMesh) -> [f64; 2] {
    let faces = SurfaceMesh::new(mesh.vertices.clone(), boundary(mesh));
    let places = |mesh: &SurfaceMesh, weights: &[[f64; 3]]| -> Vec<Vector3<f64>> {
        let place = |face: &[usize; 3], w: &[f64; 3]| (0..3).map(|i| mesh.vertices[face[i]] * w[i]).sum();
        mesh.elements.iter().flat_map(|face| weights.iter().map(move |w| place(face, w))).collect()
    };
    let of_faces = [[1.0 / 3.0; 3], [0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]];
    let each = |points: Vec<Vector3<f64>>, to: &SurfaceMesh| -> Vec<f64> {
        let solid = Solid::new(to);
        points.iter().map(|x| (solid.closest(x).unwrap() - x).norm()).collect()
    };
    let both = [each(places(&faces, &of_faces), surface), each(surface.vertices.clone(), &faces)];
    let mean_square = both.iter().map(|all| all.iter().map(|x| x * x).sum::<f64>() / all.len() as f64);
    [(mean_square.sum::<f64>() / 2.0).sqrt(), both.iter().flatten().copied().fold(0.0, f64::max)]
}

#[test]
fn the_distance_to_a_smooth_surface_falls_with_the_square_of_the_edge() {
    let centre = Vector3::new(0.3, -0.2, 0.1);
    for (name, surface, euler) in [("ball", sphere(6, centre), 2), ("torus", torus(160, 80), 0)] {
        let edges = [0.2, 0.1, 0.05];
        let found = edges.map(|edge| {
            let mesh = stuff(&surface, edge).unwrap();
            assert_eq!(is_sound(&mesh).1, euler, "{name}");
            distances(&mesh, &surface)
        });
        let order = (found[0][0] / found[2][0]).log2() / 2.0;
        assert!((1.8..2.2).contains(&order), "{name}: {order} {found:?}");
        for (edge, [_, largest]) in edges.iter().zip(found) {
            assert!(largest < 1.2 * edge * edge, "{name}: {edge} {found:?}");
        }
    }
}

#[test]
fn a_shell_between_two_spheres_keeps_its_cavity() {
    let mut inner = turned(sphere(4, Vector3::zeros()));
    inner.vertices.iter_mut().for_each(|x| *x *= 0.6);
    let (volume, euler) = is_sound(&stuff(&joined(sphere(4, Vector3::zeros()), inner), 0.1).unwrap());
    assert_eq!(euler, 4);
    assert!((volume / (4.0 / 3.0 * PI * (1.0 - 0.6_f64.powi(3))) - 1.0).abs() < 0.02, "{volume}");
}

#[test]
fn a_graded_mesh_has_the_boundary_of_the_uniform_one_and_fewer_elements() {
    let surface = sphere(5, Vector3::zeros());
    let uniform = stuff(&surface, 0.08).unwrap();
    let places = |mesh: &TetrahedralMesh| {
        let place = |face: [usize; 3]| {
            let mut places: [[u64; 3]; 3] = face.map(|i| mesh.vertices[i].map(f64::to_bits).into());
            places.sort_unstable();
            places
        };
        boundary(mesh).into_iter().map(place).collect::<BTreeSet<_>>()
    };
    for doublings in [1, 3, 60] {
        let graded = stuff_graded(&surface, 0.08, doublings, &|_| ()).unwrap();
        is_sound(&graded);
        assert!(places(&graded) == places(&uniform), "{doublings}");
        assert!(graded.elements.len() * 3 < uniform.elements.len() * 2, "{doublings}: {}", graded.elements.len());
    }
    assert_eq!(stuff_graded(&surface, 0.08, 0, &|_| ()).unwrap(), uniform);
}

#[test]
fn a_torus_keeps_its_hole_and_its_volume() {
    let mesh = stuff(&torus(60, 30), 0.12).unwrap();
    let (volume, euler) = is_sound(&mesh);
    assert_eq!(euler, 0);
    let exact = 2.0 * PI * PI * 0.4 * 0.4;
    assert!((volume / exact - 1.0).abs() < 0.03, "{volume} {exact}");
}

#[test]
fn edges_have_the_length_that_is_asked_for() {
    for edge in [0.1, 0.3] {
        let mesh = stuff(&sphere(3, Vector3::zeros()), edge).unwrap();
        let pairs = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
        let lengths =
            mesh.elements.iter().flat_map(|e| pairs.map(|[a, b]| (mesh.vertices[e[a]] - mesh.vertices[e[b]]).norm()));
        let mean = lengths.sum::<f64>() / (6 * mesh.elements.len()) as f64;
        assert!((mean / edge - 1.0).abs() < 0.1, "{mean} {edge}");
    }
}

#[test]
fn dirty_surfaces_give_the_body_that_they_mean() {
    let ball = || sphere(3, Vector3::zeros());
    let mut holes = ball();
    let removed: Vec<usize> = every(&holes, 17, 3).collect();
    let mut place = 0;
    holes.elements.retain(|_| {
        place += 1;
        !removed.contains(&(place - 1))
    });
    let mut flipped = ball();
    every(&ball(), 23, 5).for_each(|i| flipped.elements[i].swap(0, 1));
    let mut repeated = ball();
    repeated.elements.extend(every(&ball(), 50, 7).map(|i| ball().elements[i]).collect::<Vec<_>>());
    let shifted = sphere(3, Vector3::new(1.0, 0.05, 0.02));
    let small = |radius: f64| {
        let mut surface = ball();
        surface.vertices.iter_mut().for_each(|x| *x *= radius);
        surface
    };
    let one = 4.0 / 3.0 * PI;
    // Two balls at the distance d overlap in a lens of π (4 + d) (2 − d)² / 12.
    let d: f64 = Vector3::new(1.0, 0.05, 0.02).norm();
    let union = 2.0 * one - PI * (4.0 + d) * (2.0 - d).powi(2) / 12.0;
    let loose = joined(
        ball(),
        SurfaceMesh::new(vec![Vector3::zeros(), Vector3::x() * 3.0, Vector3::y() * 3.0], vec![[0, 1, 2]]),
    );
    for (name, surface, volume, tolerance) in [
        ("clean", ball(), one, 0.04),
        ("holes", holes, one, 0.06),
        ("flipped triangles", flipped, one, 0.15),
        ("turned inside out", turned(ball()), one, 0.04),
        ("triangles twice", repeated, one, 0.06),
        ("two shells that cross", joined(ball(), shifted.clone()), union, 0.05),
        ("apart", joined(ball(), sphere(3, Vector3::new(3.0, 0.0, 0.0))), 2.0 * one, 0.04),
        ("a cavity", joined(ball(), turned(small(0.6))), one * (1.0 - 0.6_f64.powi(3)), 0.05),
        ("a shell within a shell", joined(ball(), small(0.6)), one, 0.04),
        ("a loose triangle", loose, one, 0.06),
        (
            "vertices without triangles",
            SurfaceMesh::new([ball().vertices, vec![Vector3::repeat(2.0)]].concat(), ball().elements),
            one,
            0.04,
        ),
    ] {
        let mesh = stuff(&surface, 0.15).unwrap_or_else(|error| panic!("{name}: {error}"));
        let (found, _) = is_sound(&mesh);
        assert!((found / volume - 1.0).abs() < tolerance, "{name}: {found} {volume}");
    }
}

#[test]
fn a_surface_without_an_inside_and_numbers_without_a_sense_are_refused() {
    let ball = sphere(2, Vector3::zeros());
    assert!(matches!(stuff(&ball, 0.0), Err(StuffingError::Edge { .. })));
    assert!(matches!(stuff(&ball, f64::NAN), Err(StuffingError::Edge { .. })));
    assert!(matches!(stuff(&ball, -1.0), Err(StuffingError::Edge { .. })));
    let fine = stuff(&ball, 1e-4).unwrap_err();
    assert!(fine.to_string().contains("would have 7") && fine.to_string().contains("e13 tetrahedra"), "{fine}");
    assert!(matches!(stuff(&ball, 1e-300), Err(StuffingError::TooFine { .. })));
    let mut broken = ball.clone();
    broken.vertices[4].y = f64::NAN;
    assert_eq!(stuff(&broken, 0.1).unwrap_err(), StuffingError::NotFinite { vertex: 4 });
    let sheet =
        SurfaceMesh::new([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Vector3::from).to_vec(), vec![[0, 1, 2]]);
    let message = stuff(&sheet, 0.1).unwrap_err().to_string();
    assert!(message.contains("no point of the lattice lies inside the surface"), "{message}");
    assert!(matches!(stuff(&SurfaceMesh::default(), 0.1), Err(StuffingError::Empty { .. })));
}
