//! Writing a mesh and reading it gives the mesh, bit for bit.

use std::fs;

use fem_mesh::{Mesh, TetrahedralMesh, read_surface, read_tetrahedra, write_surface, write_tetrahedra};
use nalgebra::Vector3;
use proptest::prelude::*;
use tempfile::tempdir;

use crate::{fixed_seed, two_tetrahedra};

pub const TETRAHEDRAL_FILES: [&str; 6] = ["a.node", "b.ele", "c.mesh", "d.msh", "e.vtu", "f.vtk"];

fn bits(vertices: &[Vector3<f64>]) -> Vec<u64> {
    vertices.iter().flatten().map(|x| x.to_bits()).collect()
}

fn assert_round_trip(mesh: &TetrahedralMesh) {
    let folder = tempdir().unwrap();
    for name in TETRAHEDRAL_FILES {
        let path = folder.path().join(name);
        write_tetrahedra(&path, mesh).unwrap();
        let back = read_tetrahedra(&path).unwrap();
        assert_eq!(bits(&back.vertices), bits(&mesh.vertices), "{name}");
        assert_eq!(back.elements, mesh.elements, "{name}");
    }
}

/// Coordinates with all digits, none of them so small that an area vanishes.
fn vertex() -> impl Strategy<Value = Vector3<f64>> {
    [-1e3..1e3_f64, -1e3..1e3, -1e-3..1e-3].prop_map(Vector3::from)
}

/// A mesh of the nodes that elements use, of which the first is positive.
fn tidy<const N: usize>(vertices: &[Vector3<f64>], mut elements: Vec<[usize; N]>) -> Mesh<3, N> {
    let mut used: Vec<usize> = elements.concat();
    used.sort_unstable();
    used.dedup();
    elements.iter_mut().flatten().for_each(|node| *node = used.binary_search(node).unwrap());
    elements.sort_unstable();
    elements.dedup();
    let mut mesh = Mesh::new(used.iter().map(|&node| vertices[node]).collect(), elements);
    if N == 4 {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| mesh.vertices[mesh.elements[0][i]]);
        if (b - a).cross(&(c - a)).dot(&(d - a)) < 0.0 {
            mesh.elements[0].swap(0, 1);
        }
    }
    mesh
}

fn vertices_and_elements<const N: usize>() -> impl Strategy<Value = (Vec<Vector3<f64>>, Vec<[usize; N]>)> {
    prop::collection::vec(vertex(), 4..30).prop_flat_map(|vertices| {
        let all: Vec<usize> = (0..vertices.len()).collect();
        let element = prop::sample::subsequence(all, N).prop_shuffle().prop_map(|e| <[usize; N]>::try_from(e).unwrap());
        (Just(vertices), prop::collection::vec(element, 1..40))
    })
}

#[test]
fn two_tetrahedra_come_back() {
    assert_round_trip(&two_tetrahedra());
}

#[test]
fn a_written_file_leaves_no_unfinished_one_beside_it() {
    let folder = tempdir().unwrap();
    for name in TETRAHEDRAL_FILES {
        write_tetrahedra(&folder.path().join(name), &two_tetrahedra()).unwrap();
    }
    let mut names: Vec<String> =
        fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["a.ele", "a.node", "b.ele", "b.node", "c.mesh", "d.msh", "e.vtu", "f.vtk"]);
}

proptest! {
    #![proptest_config(fixed_seed(64))]

    #[test]
    fn any_tetrahedral_mesh_comes_back_from_every_format((vertices, elements) in vertices_and_elements::<4>()) {
        assert_round_trip(&tidy(&vertices, elements));
    }

    #[test]
    fn any_surface_comes_back((vertices, elements) in vertices_and_elements::<3>()) {
        let mut elements: Vec<[usize; 3]> = elements;
        elements.iter_mut().for_each(|element| element.sort_unstable());
        let mesh = tidy(&vertices, elements);
        let folder = tempdir().unwrap();
        let path = folder.path().join("a.OBJ");
        write_surface(&path, &mesh).unwrap();
        let back = read_surface(&path).unwrap();
        prop_assert_eq!(bits(&back.vertices), bits(&mesh.vertices));
        prop_assert_eq!(back.elements, mesh.elements);
    }
}
