//! Surfaces in the formats of Stanford (.ply) and of stereolithography (.stl).

use fem_mesh::{SurfaceMesh, read_surface, write_surface};
use nalgebra::Vector3;
use tempfile::tempdir;

use crate::folder_with;

/// A square pyramid: four triangles and a square, with colours and with an element that has no meaning here.
pub const TEXT_PLY: &str = "ply\nformat ascii 1.0\ncomment a pyramid\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
    property uchar red\nelement face 5\nproperty list uchar int vertex_indices\nproperty float quality\nelement camera 1\n\
    property list uchar float pose\nend_header\n0 0 0 255\n1 0 0 255\n1 1 0 255\n0 1 0 255\n0.5 0.5 1 0\n4 3 2 1 0 0.5\n3 0 1 4 1\n\
    3 1 2 4 1\n3 2 3 4 1\n3 3 0 4 1\n2 0.5 0.25\n";

/// Two triangles that share an edge.
pub const TEXT_STL: &str = "solid a b\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1.5e0 0 0\n   vertex 0 1 0\n  endloop\n endfacet\n\
     FACET NORMAL 0 0 1\n  OUTER LOOP\n   VERTEX 1.5 0 0\n   VERTEX 1.5 1 -0\n   VERTEX 0 1 0\n  ENDLOOP\n ENDFACET\nendsolid\n";

fn read(name: &str, bytes: &[u8]) -> SurfaceMesh {
    read_surface(&folder_with(&[(name, bytes)]).1).unwrap()
}

fn refusal(name: &str, bytes: &[u8]) -> String {
    read_surface(&folder_with(&[(name, bytes)]).1).unwrap_err().to_string()
}

/// [`TEXT_PLY`]'s shape in binary.
fn binary_ply(is_big: bool) -> Vec<u8> {
    let order = if is_big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 5\nproperty double z\nproperty short x\nproperty float32 y\n\
         element face 1\nproperty list uint8 uint vertex_index\nend_header\n"
    )
    .into_bytes();
    let mut put = |number: &[u8]| {
        let mut number = number.to_vec();
        if is_big {
            number.reverse();
        }
        bytes.extend(number);
    };
    for [x, y, z] in [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [7, 8, 9_i16]] {
        put(&f64::from(z).to_le_bytes());
        put(&x.to_le_bytes());
        put(&f32::from(y).to_le_bytes());
    }
    put(&[4]);
    for i in 0..4_u32 {
        put(&i.to_le_bytes());
    }
    bytes
}

#[test]
fn a_polygon_file_gives_places_and_fans_and_leaves_the_rest() {
    let mesh = read("s.ply", TEXT_PLY.as_bytes());
    assert_eq!(mesh.vertices[4], Vector3::new(0.5, 0.5, 1.0));
    assert_eq!(mesh.elements, [[3, 2, 1], [3, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]);
    assert_eq!(read("s.ply", TEXT_PLY.replace('\n', "\r\n").as_bytes()), mesh);
    for is_big in [false, true] {
        let mesh = read("s.ply", &binary_ply(is_big));
        assert_eq!(mesh.vertices[4], Vector3::new(7.0, 8.0, 9.0));
        assert_eq!(mesh.elements, [[0, 1, 2], [0, 2, 3]]);
    }
}

#[test]
fn equal_corners_of_a_stereolithography_file_are_one_vertex() {
    let mesh = read("s.stl", TEXT_STL.as_bytes());
    let places = [[0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 1.0, 0.0], [1.5, 1.0, 0.0]];
    assert_eq!(mesh.vertices, places.map(Vector3::from));
    assert_eq!(mesh.elements, [[0, 1, 2], [1, 3, 2]]);
}

#[test]
fn a_surface_that_is_written_is_read_again() {
    let mesh = read("s.ply", TEXT_PLY.as_bytes());
    let folder = tempdir().unwrap();
    for name in ["s.obj", "s.ply", "s.stl", "s.ply.gz", "s.stl.gz"] {
        let path = folder.path().join(name);
        write_surface(&path, &mesh).unwrap();
        let found = read_surface(&path).unwrap();
        let corners = |mesh: &SurfaceMesh| -> Vec<[Vector3<f64>; 3]> {
            mesh.elements.iter().map(|element| element.map(|i| mesh.vertices[i])).collect()
        };
        assert_eq!(corners(&found), corners(&mesh), "{name}");
        assert_eq!(found.vertices.len(), mesh.vertices.len(), "{name}");
    }
}

#[test]
fn a_binary_file_whose_title_begins_with_solid_is_read() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("s.stl");
    let mesh = read("s.stl", TEXT_STL.as_bytes());
    write_surface(&path, &mesh).unwrap();
    let mut bytes = std::fs::read(&path).unwrap();
    bytes[..6].copy_from_slice(b"solid ");
    assert_eq!(read("s.stl", &bytes), mesh);
}

#[test]
fn a_damaged_surface_is_refused_with_its_place() {
    let refused = |name: &str, from: &str, to: &str| {
        let text = if name == "s.ply" { TEXT_PLY } else { TEXT_STL };
        assert!(text.contains(from));
        refusal(name, text.replacen(from, to, 1).as_bytes())
    };
    assert!(refused("s.ply", "ply\n", "plx\n").contains("does not begin with `ply`"));
    assert!(refused("s.ply", "0.5 0.5 1 0", "0.5 half 1 0").contains("line 19: `half` is not a number"));
    assert!(refused("s.ply", "4 3 2 1 0 0.5", "4 3 2 1 9 0.5").contains("vertex 9 does not exist"));
    assert!(refused("s.ply", "4 3 2 1 0 0.5", "4 3 2 1 0.5 0.5").contains("`0.5` is not the index of a vertex"));
    assert!(
        refused("s.ply", "element vertex 5", "element vertex 5000000000000")
            .contains("line 20: `0` stands after the last property")
    );
    assert!(
        refused("s.ply", "property uchar red", "property colour red").contains("line 8: `property colour red` is not")
    );
    assert!(refused("s.ply", "property float z\n", "").contains("not finite"));
    assert!(refused("s.ply", "end_header\n", "").contains("is not a line of a .ply header"));
    assert!(refused("s.stl", "1.5e0", "nan").contains("line 5: the coordinate `nan` is not finite"));
    assert!(refused("s.stl", "   VERTEX 0 1 0\n", "").contains("the third vertex of a facet is missing"));
    assert!(refusal("s.stl", b"solid nothing\nendsolid\n").contains("the mesh has no faces"));
    assert!(refusal("s.stl", &[0; 40]).contains("a file of 40 bytes that does not begin with `solid`"));
    let mut short = vec![0; 84];
    short[80] = 9;
    assert!(refusal("s.stl", &short).contains("announces 9 triangles and holds 0"));
}
