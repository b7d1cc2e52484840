//! Mutated bytes for every reader of scenes: scene files, overrides, and velocities of the nodes. Each is read or refused with
//! one line of text, without a panic, without a hang, and without memory beyond what is stated here.

#[path = "../../../mesh/tests/fuzz/mutation.rs"]
mod mutation;

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use fem_mesh::{Pattern, TetrahedralMesh, box_mesh, rectangle_mesh};
use fem_model::BodyMesh;
use fem_scene::{Override, Scene, SceneError, body_of, load, load_with, warnings};
use tempfile::tempdir;

use self::mutation::{fuzz, write_over};

/// Most memory for a scene file, as a multiple of it: TOML keeps each value in a tree of its own, with its place, beside the scene.
const TOML: u64 = 128;

/// Every table that a scene may have.
const ALL: &str = r#"about = "all tables"
pipeline = "engine"
[mesh]
box = { size = [2, 1, 1], cells_per_unit = 2 }
scale = 1.5
refine = 1
[material]
model = "neo_hookean"
young = 1e5
poisson = 0.3
density = 1000
[[materials]]
box = { min = [0, 0, 0], max = [1, 1, 1] }
model = "neo_hookean"
young = 2e5
poisson = 0.25
density = 900
[mass]
lumped = true
[gravity]
acceleration = [0, 0, -9.81]
curve = { table = [[0, 0], [1, 1], [2, 0.5]] }
[body_force]
density = [1, 2, 3]
curve = { sine = { frequency = 2, phase = 0.5 } }
[[force]]
nodes = [1]
value = [0, 1, 0]
[[traction]]
on = { axis = "x", side = "max", within = 1e-6 }
force_per_area = [0, 0, 10]
[[traction]]
on = { axis = "z", side = "max", within = 1e-6 }
pressure = 5
[[springs]]
nodes = [1, 2]
stiffness = 100
[fixed]
plane = { axis = "x", below = 1e-9 }
[[prescribed]]
on = { axis = "x", side = "max", within = 1e-6 }
displacement = [0.1, 0, 0]
over = 1

[[initial_velocity]]
velocity = [1, 0, 0]
angular = { axis = [0, 0, 1], rate = 2 }
[damping]
alpha = 0.1
beta = 0.01
[time]
dt = 0.01
integrator = "implicit_euler"
[newton]
max_iterations = 20
[solver]
kind = "pcg"
"#;

/// The scenes that come with the program, and one with all tables.
fn scenes() -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/scenes");
    let mut files: Vec<PathBuf> = folder.read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let files = files.into_iter().map(|path| fs::read(path).unwrap());
    files.chain([ALL.as_bytes().to_vec(), BOX.as_bytes().to_vec()]).collect()
}

/// Asserts that an error is one line, and that a body of finite numbers comes of a scene, or an error.
fn go_on(found: Result<Scene, SceneError>) {
    let mut scene = match found {
        Ok(scene) => scene,
        Err(error) => return assert_readable(&error),
    };
    scene.mesh.refine = scene.mesh.refine.min(1);
    let triangles = rectangle_mesh([2.0, 1.0], 2, Pattern::Alternating).unwrap();
    let flat = BodyMesh::flat(triangles, 1.0);
    for mesh in [BodyMesh::solid(solid()), flat] {
        match body_of(&scene, mesh, Path::new("no data")) {
            Ok(body) => {
                let vertices = body.shape.mesh.vertices();
                assert!(vertices.iter().chain(&body.initial_velocity).flatten().all(|x| x.is_finite()));
                assert!(warnings(&scene, &body).iter().all(|text| text.lines().count() == 1));
            }
            Err(error) => assert_readable(&error),
        }
    }
}

fn assert_readable(error: &SceneError) {
    let message = error.to_string();
    assert!(message.len() < 1000 && message.lines().count() == 1, "{message}");
}

fn solid() -> TetrahedralMesh {
    box_mesh([2.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap()
}

#[test]
fn the_scene_with_all_tables_is_read() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("all.toml");
    for text in [ALL, BOX] {
        fs::write(&path, text).unwrap();
        load(path.to_str().unwrap(), folder.path()).unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn mutated_scenes_are_read_or_refused() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.toml");
    let prepare = |bytes: &[u8]| write_over(&path, bytes);
    let read = |_: &()| load(path.to_str().unwrap(), folder.path());
    fuzz("toml", &scenes(), <[u8]>::len, prepare, read, go_on);
}

#[test]
fn mutated_overrides_are_read_or_refused() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.toml");
    fs::write(&path, ALL).unwrap();
    let texts =
        ["time.dt=0.01\nmesh.box.size.0=3\ntraction.0.pressure=5", "material={ model = \"a\" }\nmaterials.1.young=1e9"];
    let files: Vec<Vec<u8>> = texts.iter().map(|text| text.as_bytes().to_vec()).collect();
    let prepare = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let read = |text: &String| {
        let overrides: Vec<Override> = text.lines().filter_map(|line| line.parse().ok()).collect();
        load_with(path.to_str().unwrap(), folder.path(), &overrides)
    };
    fuzz("overrides", &files, |bytes| bytes.len() + ALL.len(), prepare, read, go_on);
}

#[test]
fn mutated_velocities_are_read_or_refused() {
    let folder = tempdir().unwrap();
    let (scene, velocities) = (folder.path().join("m.toml"), folder.path().join("v.csv"));
    fs::write(&scene, format!("{BOX}[[initial_velocity]]\nper_node = \"v.csv\"\n")).unwrap();
    let scene = load(scene.to_str().unwrap(), folder.path()).unwrap();
    let nodes = solid().vertices.len();
    let rows: String =
        (0..nodes).map(|i| format!("{},{},{}\n", (i as f64).sin(), (2.5 * i as f64).cos(), -3e-4)).collect();
    let files = [rows.clone().into_bytes(), format!("x,y,z\n{rows}").into_bytes()];
    let prepare = |bytes: &[u8]| write_over(&velocities, bytes);
    let read = |_: &()| body_of(&scene, solid(), folder.path());
    let go_on = |found: Result<fem_model::Body, SceneError>| match found {
        Ok(body) => assert!(body.initial_velocity.iter().flatten().all(|x| x.is_finite())),
        Err(error) => assert_readable(&error),
    };
    fuzz("velocities", &files, <[u8]>::len, prepare, read, go_on);
}

#[test]
fn a_file_that_is_too_large_for_a_scene_is_refused() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.toml");
    fs::write(&path, vec![b'\n'; (1 << 20) + 1]).unwrap();
    let error = load(path.to_str().unwrap(), folder.path()).unwrap_err().to_string();
    assert!(
        error.contains("m.toml, line 1: the file has more than 1048576 bytes; name many nodes by a set"),
        "{error}"
    );
}

#[test]
fn a_large_scene_takes_memory_in_proportion() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.toml");
    let (mut springs, mut table) =
        (BOX.to_owned(), format!("{BOX}[gravity]\nacceleration = [0, 0, -9]\ncurve = {{ table = ["));
    for i in 0..4000 {
        let _ = write!(springs, "[[springs]]\nnodes = [{}, {}]\nstiffness = {}\n", i % 11, i % 7 + 11, 100 + i);
        let _ = write!(table, "[{i},1],");
    }
    for text in [springs, table + "] }\n"] {
        fs::write(&path, &text).unwrap();
        let used = allocation_counter::measure(|| drop(load(path.to_str().unwrap(), folder.path()).unwrap())).bytes_max;
        println!("toml: {} bytes, memory {:.1} times the file", text.len(), used as f64 / text.len() as f64);
        assert!(used <= TOML * text.len() as u64, "{used} bytes of memory for a scene of {}", text.len());
    }
}

/// The smallest scene.
const BOX: &str = r#"pipeline = "engine"
[mesh]
box = { size = [2, 1, 1], cells_per_unit = 2 }
[material]
model = "neo_hookean"
young = 1e5
poisson = 0.3
density = 1000
[time]
dt = 0.01
integrator = "implicit_euler"
"#;
