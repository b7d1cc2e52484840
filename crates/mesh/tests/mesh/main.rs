//! Meshes: valid and damaged files, the check, the boundary, the box, refinement, and files for other programs.

mod bodies_of_chance;
mod boundaries;
mod box_rule;
mod boxes;
mod cages;
mod checks;
mod connected;
mod delaunay;
mod delaunay_sets;
mod distributions;
mod errors;
mod every_format;
mod features;
mod formats;
mod garbage;
mod gmsh;
mod joined;
mod matrix;
mod odt_space;
mod oriented;
mod other_programs;
mod packed;
mod pictures;
mod progress;
mod quadratic;
mod refined;
mod round_trip;
mod self_intersections;
mod sets_kept;
mod shapes;
mod shipped;
mod sides;
mod solids;
mod stuffing;
mod surface_quality;
mod surfaces;
mod triangles;
mod untidy;
mod vtk;
mod written;

use std::fs;
use std::path::PathBuf;

use fem_mesh::TetrahedralMesh;
use nalgebra::Vector3;
use proptest::test_runner::{Config, RngSeed};
use tempfile::TempDir;

/// A folder that lasts as long as the test, with these files in it, and the path of the first.
fn folder_with(files: &[(&str, &[u8])]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        fs::write(folder.path().join(name), content).unwrap();
    }
    let first = folder.path().join(files[0].0);
    (folder, first)
}

/// Two tetrahedra that share a face, with coordinates that need many decimal digits.
fn two_tetrahedra() -> TetrahedralMesh {
    let places =
        [[0.0, 0.0, 0.0], [1.0 / 3.0, 0.0, -0.0], [0.0, 2.0_f64.sqrt(), 1e-300], [0.1, 0.1, 1.0], [0.2, 0.3, -1e5]];
    TetrahedralMesh::new(places.map(Vector3::from).to_vec(), vec![[0, 1, 2, 3], [0, 2, 1, 4]])
}

/// Random cases that are the same in every run.
fn fixed_seed(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(20), failure_persistence: None, ..Config::default() }
}
