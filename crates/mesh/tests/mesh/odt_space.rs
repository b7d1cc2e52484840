//! Improvement of tetrahedra: what must fall, what must rise, and what must stay.

use std::collections::BTreeSet;

use approx::assert_relative_eq;
use fem_mesh::generate::delaunay::tetrahedralize;
use fem_mesh::generate::odt::{Improved, improve_inside, improve_tetrahedra};
use fem_mesh::generate::{Solid, stuff};
use fem_mesh::{MeshSet, Pattern, TetrahedralMesh, boundary, box_mesh, check, quality, read_surface, volumes};
use nalgebra::Vector3;

fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A box whose inner vertices are moved by up to a part of the cell; the mesh stays valid up to 0.3.
fn shaken_box(cells: usize, part: f64, seed: u64) -> TetrahedralMesh {
    let mut mesh = box_mesh([1.0, 1.0, 1.0], cells, Pattern::Alternating).unwrap();
    let mut next = random(seed);
    for x in &mut mesh.vertices {
        if x.iter().all(|&x| x > 0.01 && x < 0.99) {
            *x += Vector3::from_fn(|_, _| (next() - 0.5) * part / cells as f64);
        }
    }
    mesh
}

/// The Delaunay tetrahedra of random points in a box and of a grid on its sides.
fn cloud(points: usize, seed: u64) -> TetrahedralMesh {
    let mut next = random(seed);
    let on_side = |x: &Vector3<f64>| x.iter().any(|&x| x == 0.0 || x == 1.0);
    let grid = box_mesh([1.0, 1.0, 1.0], 6, Pattern::Alternating).unwrap().vertices.into_iter().filter(on_side);
    let inside = (0..points).map(|_| Vector3::from_fn(|_, _| 0.08 + 0.84 * next()));
    tetrahedralize(&grid.chain(inside).collect::<Vec<_>>(), &|_| ()).unwrap().mesh
}

fn faces(mesh: &TetrahedralMesh) -> BTreeSet<[usize; 3]> {
    let sorted = |mut face: [usize; 3]| {
        face.sort_unstable();
        face
    };
    boundary(mesh).into_iter().map(sorted).collect()
}

/// Panics unless an improvement satisfies the guarantees of the method.
fn is_sound(before: &TetrahedralMesh, improved: &Improved) {
    let mesh = &improved.mesh;
    check(mesh, "improved".as_ref()).unwrap();
    assert_eq!(faces(before), faces(mesh));
    for face in boundary(before).iter().flatten() {
        assert_eq!(before.vertices[*face], mesh.vertices[*face]);
    }
    let [old, new] = [before, mesh].map(|mesh| volumes(mesh).iter().sum::<f64>());
    assert!((new / old - 1.0).abs() < 1e-12, "{old} {new}");
    let (old, new) = (quality(before), quality(mesh));
    assert!(new.dihedral_angles[0].value >= old.dihedral_angles[0].value);
    assert!(new.dihedral_angles[1].value <= old.dihedral_angles[1].value);
    assert!(new.radius_ratio.value >= old.radius_ratio.value);
    for pair in improved.smoothing.windows(2) {
        assert!(pair[1].energy <= pair[0].energy * (1.0 + 1e-12), "{pair:?}");
    }
    for pair in improved.smoothing.windows(2).chain(improved.polishing.windows(2)) {
        assert!(pair[1].angles[0] >= pair[0].angles[0] - 1e-9, "{pair:?}");
        assert!(pair[1].largest_angle <= pair[0].largest_angle + 1e-9, "{pair:?}");
        assert!(pair[1].radius_ratio >= pair[0].radius_ratio - 1e-12, "{pair:?}");
    }
}

#[test]
fn the_energy_falls_the_worst_element_rises_and_the_boundary_stays() {
    for seed in 1..=6 {
        let mesh = if seed % 2 == 0 { shaken_box(6, 0.6, seed) } else { cloud(150, seed) };
        let improved = improve_tetrahedra(&mesh, 6, &|_| ());
        is_sound(&mesh, &improved);
        let energy = |i: usize| improved.smoothing[i].energy;
        assert!(energy(6) < 0.98 * energy(0), "seed {seed}: {} {}", energy(0), energy(6));
        let [old, new] = [&mesh, &improved.mesh].map(|mesh| quality(mesh).dihedral_angles[0].value);
        assert!(new > 1.2 * old, "seed {seed}: {old} {new}");
    }
}

#[test]
fn the_tetrahedra_inside_a_surface_lose_their_worst_angles() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../data/stanford/armadillo_12k.obj");
    let mesh = stuff(&read_surface(file.as_ref()).unwrap(), 0.05).unwrap();
    let improved = improve_tetrahedra(&mesh, 5, &|_| ());
    is_sound(&mesh, &improved);
    let [old, new] = [&mesh, &improved.mesh].map(|mesh| quality(mesh).dihedral_angles[0].value);
    assert!(new > 1.4 * old, "{old} {new}");
}

#[test]
fn the_boundary_slides_on_the_surface_and_gains_more() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../data/stanford/armadillo_12k.obj");
    let surface = read_surface(file.as_ref()).unwrap();
    let (mesh, solid) = (stuff(&surface, 0.05).unwrap(), Solid::new(&surface));
    let improved = improve_inside(&mesh, 5, &solid, &|_| ()).mesh;
    check(&improved, "improved".as_ref()).unwrap();
    assert_eq!(faces(&mesh), faces(&improved));
    for vertex in boundary(&improved).into_iter().flatten() {
        let x = improved.vertices[vertex];
        let distance = (solid.closest(&x).unwrap() - x).norm();
        assert!(distance < 1e-7, "{vertex}: {distance:e}");
    }
    let [old, new] = [&mesh, &improved].map(|mesh| volumes(mesh).iter().sum::<f64>());
    assert!((new / old - 1.0).abs() < 0.01, "{old} {new}");
    let angles = quality(&improved).dihedral_angles.map(|angle| angle.value);
    assert!(angles[0] > 25.0 && angles[1] < 140.0, "{angles:?}");
}

#[test]
fn without_iterations_the_mesh_is_the_same() {
    let mesh = shaken_box(3, 0.4, 1);
    assert_eq!(improve_tetrahedra(&mesh, 0, &|_| ()).mesh, mesh);
}

#[test]
fn improvement_ends_when_it_gains_nothing_whatever_the_number_of_iterations() {
    let mesh = shaken_box(3, 0.4, 1);
    let improved = improve_tetrahedra(&mesh, usize::MAX, &|_| ());
    is_sound(&mesh, &improved);
    assert!(improved.smoothing.len() < 500 && improved.polishing.len() < 500);
    let one = TetrahedralMesh::new(mesh.elements[0].map(|i| mesh.vertices[i]).to_vec(), vec![[0, 1, 2, 3]]);
    assert_eq!(improve_tetrahedra(&one, 10, &|_| ()).mesh, one);
    assert_eq!(improve_tetrahedra(&TetrahedralMesh::default(), 10, &|_| ()).mesh, TetrahedralMesh::default());
}

#[test]
fn the_same_mesh_is_improved_in_the_same_way() {
    let mesh = cloud(60, 9);
    assert_eq!(improve_tetrahedra(&mesh, 3, &|_| ()), improve_tetrahedra(&mesh, 3, &|_| ()));
}

#[test]
fn sets_keep_their_volumes_and_the_faces_edges_and_points_that_they_name() {
    let mut mesh = cloud(200, 3);
    let left = |mesh: &TetrahedralMesh, element: &[usize; 4]| {
        element.iter().map(|&i| mesh.vertices[i].x).sum::<f64>() < 4.0 * 0.4
    };
    let elements = |is_left: bool| {
        let wanted = |i: &usize| left(&mesh, &mesh.elements[*i]) == is_left;
        MeshSet { elements: (0..mesh.elements.len()).filter(wanted).collect(), ..MeshSet::default() }
    };
    let (west, east) = (elements(true), elements(false));
    let mut own = mesh.elements[mesh.elements.len() / 2];
    own.sort_unstable();
    let named = MeshSet {
        faces: vec![[own[0], own[1], own[2]]],
        edges: vec![[own[1], own[3]]],
        points: vec![230],
        ..MeshSet::default()
    };
    mesh.sets = [("west", west), ("east", east), ("named", named)].map(|(name, set)| (name.to_owned(), set)).into();
    check(&mesh, "sets".as_ref()).unwrap();
    let improved = improve_tetrahedra(&mesh, 5, &|_| ());
    is_sound(&mesh, &improved); // its check refuses a set with a face or an edge that is no part of the mesh
    assert_eq!(improved.mesh.sets["named"], mesh.sets["named"]);
    assert_eq!(improved.mesh.vertices[230], mesh.vertices[230]);
    for name in ["west", "east"] {
        let part = |mesh: &TetrahedralMesh| {
            let elements = mesh.sets[name].elements.iter().map(|&i| mesh.elements[i]);
            TetrahedralMesh::new(mesh.vertices.clone(), elements.collect())
        };
        assert_eq!(faces(&part(&mesh)), faces(&part(&improved.mesh)), "{name}");
        let volume = |mesh: &TetrahedralMesh| volumes(&part(mesh)).iter().sum::<f64>();
        assert!((volume(&improved.mesh) / volume(&mesh) - 1.0).abs() < 1e-12, "{name}");
    }
}

fn one_tetrahedron() -> TetrahedralMesh {
    let corners = [[0.1, 0.0, 0.2], [1.0, 0.1, 0.0], [0.3, 1.2, 0.1], [0.2, 0.4, 0.9]].map(Vector3::from);
    TetrahedralMesh::new(corners.to_vec(), vec![[0, 1, 2, 3]])
}

#[test]
fn the_measures_are_those_of_the_mesh_quality() {
    let found = improve_tetrahedra(&one_tetrahedron(), 0, &|_| ()).smoothing[0];
    let known = quality(&one_tetrahedron());
    assert_relative_eq!(found.radius_ratio, known.radius_ratio.value, max_relative = 1e-13);
    let [smallest, largest] = known.dihedral_angles.map(|angle| angle.value);
    assert_relative_eq!(found.angles[0], smallest, max_relative = 1e-12);
    assert_relative_eq!(found.largest_angle, largest, max_relative = 1e-12);
}

#[test]
fn the_energy_is_a_quarter_of_the_stars_volumes_times_the_squares_less_the_integral_of_the_square() {
    // The integral of |x|² over a tetrahedron by the rule with the vertices and the centroid of degree 2: V (Σ x²/20 + 16/20 c²).
    let mesh = one_tetrahedron();
    let (x, volume) = (&mesh.vertices, volumes(&mesh)[0]);
    let squares: f64 = x.iter().map(Vector3::norm_squared).sum();
    let centroid = x.iter().sum::<Vector3<f64>>() / 4.0;
    let integral = volume * (squares / 20.0 + 0.8 * centroid.norm_squared());
    let energy = improve_tetrahedra(&mesh, 0, &|_| ()).smoothing[0].energy;
    assert_relative_eq!(energy, volume * squares / 4.0 - integral, max_relative = 1e-13);
}
