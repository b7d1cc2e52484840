//! The meshes in `data`, compared with their PROVENANCE.md.

use std::collections::HashSet;
use std::path::PathBuf;

use fem_mesh::{boundary, check, quality, read_surface, read_tetrahedra, volumes};

use crate::box_rule::{assert_closed, enclosed_volume};

pub fn data(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../data").join(name)
}

/// File, nodes, tetrahedra.
const CAGES: [(&str, usize, usize); 7] = [
    ("stanford/armadillo_coarse.node", 258, 699),
    ("stanford/armadillo_medium.node", 552, 1683),
    ("stanford/armadillo_fine.node", 1306, 4589),
    ("stanford/bunny_coarse.node", 377, 1295),
    ("stanford/bunny_medium.node", 576, 2102),
    ("stanford/bunny_fine.node", 1370, 5665),
    ("own/armadillo_own_coarse.ele", 220, 602),
];

/// File, vertices, triangles.
const SURFACES: [(&str, usize, usize); 5] = [
    ("stanford/armadillo_26k.obj", 13002, 26000),
    ("stanford/armadillo_12k.obj", 6002, 12000),
    ("stanford/bunny_20k.obj", 10002, 20000),
    ("stanford/bunny_10k.obj", 5002, 10000),
    ("own/armadillo_own_37k.obj", 18454, 36904),
];

#[test]
fn every_cage_passes_the_check_with_the_counts_of_its_provenance() {
    for (name, nodes, tetrahedra) in CAGES {
        let mesh = read_tetrahedra(&data(name)).unwrap();
        assert_eq!((mesh.vertices.len(), mesh.elements.len()), (nodes, tetrahedra), "{name}");
        check(&mesh, &data(name)).unwrap();
    }
}

#[test]
fn every_cage_has_a_closed_boundary_of_euler_characteristic_2_around_its_volume() {
    for (name, ..) in CAGES {
        let mesh = read_tetrahedra(&data(name)).unwrap();
        let faces = boundary(&mesh);
        assert_closed(&faces);
        let vertices: HashSet<usize> = faces.iter().flatten().copied().collect();
        assert_eq!(vertices.len() + faces.len() - 3 * faces.len() / 2, 2, "{name}");
        let volume: f64 = volumes(&mesh).iter().sum();
        approx::assert_relative_eq!(enclosed_volume(&mesh, &faces), volume, max_relative = 1e-12);
    }
}

#[test]
fn every_cage_has_dihedral_angles_between_16_and_141_degrees() {
    for (name, ..) in CAGES {
        let quality = quality(&read_tetrahedra(&data(name)).unwrap());
        let [smallest, largest] = quality.dihedral_angles;
        assert!(smallest.value > 16.0 && largest.value < 141.0, "{name}\n{quality}");
    }
}

#[test]
fn every_surface_has_the_counts_of_its_provenance() {
    for (name, vertices, triangles) in SURFACES {
        let mesh = read_surface(&data(name)).unwrap();
        assert_eq!((mesh.vertices.len(), mesh.elements.len()), (vertices, triangles), "{name}");
    }
}
