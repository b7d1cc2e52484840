//! Elements with nodes between their corners: read by their corners, and written.

use fem_mesh::write::write_quadratic;
use fem_mesh::{AnyMesh, Mesh, MeshSet, Pattern, TetrahedralMesh, box_mesh, distinct_edges, read_file};
use nalgebra::Vector3;

/// Edges of a tetrahedron in VTK's order of the nodes at their middles.
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];

fn linear() -> TetrahedralMesh {
    let mut mesh = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let end = |x: &Vector3<f64>| x.x == 0.0;
    let nodes: Vec<usize> = (0..mesh.vertices.len()).filter(|&node| end(&mesh.vertices[node])).collect();
    let faces = fem_mesh::boundary(&mesh).into_iter().filter(|face| face.iter().all(|node| nodes.contains(node)));
    let mut faces: Vec<[usize; 3]> = faces.collect();
    faces.iter_mut().for_each(|face| face.sort_unstable());
    faces.sort_unstable();
    let set = MeshSet { faces, ..MeshSet::default() };
    mesh.sets.insert("end".to_owned(), set);
    mesh.sets.insert("nodes".to_owned(), MeshSet { points: nodes, ..MeshSet::default() });
    mesh.sets.insert("some".to_owned(), MeshSet { elements: vec![0, 3], ..MeshSet::default() });
    mesh
}

/// The mesh with a node at the middle of each edge, moved by `bend`; those at the end are in the set of nodes too.
fn quadratic(bend: f64) -> Mesh<3, 10> {
    let linear = linear();
    let ends = |nodes: &[usize; 4]| EDGES.map(|edge| edge.map(|corner| nodes[corner]));
    let edges = distinct_edges(linear.elements.iter().flat_map(ends));
    let count = linear.vertices.len();
    let mut vertices = linear.vertices.clone();
    let bend = Vector3::new(0.0, bend, 0.0);
    vertices.extend(edges.iter().map(|&[a, b]| 0.5 * (linear.vertices[a] + linear.vertices[b]) + bend));
    let element = |nodes: &[usize; 4]| {
        let middle = |edge: [usize; 2]| {
            let [a, b] = edge.map(|corner| nodes[corner]);
            count + edges.binary_search(&[a.min(b), a.max(b)]).unwrap()
        };
        std::array::from_fn(|i| if i < 4 { nodes[i] } else { middle(EDGES[i - 4]) })
    };
    let mut mesh = Mesh { elements: linear.elements.iter().map(element).collect(), vertices, sets: linear.sets };
    let set = mesh.sets.get_mut("nodes").unwrap();
    set.points.extend((count..mesh.vertices.len()).filter(|&node| mesh.vertices[node].x == 0.0));
    mesh
}

#[test]
fn files_of_quadratic_tetrahedra_have_their_nodes_in_the_order_of_the_format_and_are_read_by_their_corners() {
    let folder = tempfile::tempdir().unwrap();
    for (name, kind) in [("m.inp", "C3D10"), ("m.msh", " 11 "), ("m.vtk", "\n24\n"), ("m.vtu", ""), ("m.msh.gz", "")] {
        let path = folder.path().join(name);
        write_quadratic(&path, &quadratic(0.0)).unwrap();
        assert!(kind.is_empty() || std::fs::read_to_string(&path).unwrap().contains(kind), "{name}");
        let found = read_file(&path).unwrap();
        let AnyMesh::Tetrahedra(mesh) = &found.mesh else { panic!("{name} has no tetrahedra") };
        let expected = linear();
        assert_eq!((&mesh.vertices, &mesh.elements), (&expected.vertices, &expected.elements), "{name}");
        assert_eq!(mesh.sets["end"], expected.sets["end"], "{name}");
        assert_eq!(mesh.sets["some"], expected.sets["some"], "{name}");
        // Middles become edges: `order = 2` finds their nodes again.
        assert_eq!(mesh.sets["nodes"].points, expected.sets["nodes"].points, "{name}");
        assert_eq!(mesh.sets["nodes"].edges.len(), 5, "{name}");
        let [note] = &found.notes[..] else { panic!("{name}: {:?}", found.notes) };
        assert!(note.starts_with("nodes between the corners of 12 elements"), "{name}: {note}");
        assert!(note.contains("`order = 2` in `[mesh]`") && !note.contains("straight"), "{name}: {note}");
    }
}

#[test]
fn bent_edges_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.inp");
    write_quadratic(&path, &quadratic(0.05)).unwrap();
    let notes = read_file(&path).unwrap().notes;
    assert!(
        notes[0].contains("edges become straight") && notes[0].contains("5.000e-2 m beside the middle"),
        "{notes:?}"
    );
}

#[test]
fn gmsh_has_the_last_two_middles_in_the_other_order() {
    let x = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector3::from);
    let middles = EDGES.map(|[a, b]| 0.5 * (x[a] + x[b]));
    let mesh = Mesh::new([&x[..], &middles].concat(), vec![[0, 1, 2, 3, 4, 5, 6, 7, 8, 9]]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.msh");
    write_quadratic(&path, &mesh).unwrap();
    assert!(std::fs::read_to_string(&path).unwrap().contains("1 1 2 3 4 5 6 7 8 10 9\n"));
    // Read in the wrong order, the middles would lie beside their edges.
    let notes = read_file(&path).unwrap().notes;
    assert!(!notes[0].contains("straight"), "{notes:?}");
}

#[test]
fn flat_meshes_are_written_and_read_in_the_same_way() {
    let x = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];
    let mesh = Mesh::new(x.map(|[x, y]| Vector3::new(x, y, 0.0)).to_vec(), vec![[0, 1, 2, 3, 4, 5]]);
    let folder = tempfile::tempdir().unwrap();
    for name in ["m.inp", "m.msh", "m.vtk", "m.vtu"] {
        let path = folder.path().join(name);
        write_quadratic(&path, &mesh).unwrap();
        let found = read_file(&path).unwrap();
        let AnyMesh::Triangles(triangles) = &found.mesh else { panic!("{name} has no triangles") };
        assert_eq!((triangles.vertices.len(), &triangles.elements[..]), (3, &[[0, 1, 2]][..]), "{name}");
        assert!(found.notes[0].starts_with("nodes between the corners of 1 elements"), "{name}: {:?}", found.notes);
    }
}

#[test]
fn formats_without_quadratic_elements_refuse_them() {
    for name in ["m.node", "m.mesh", "m.obj", "m.xyz"] {
        let error = write_quadratic(name.as_ref(), &quadratic(0.0)).unwrap_err().to_string();
        assert!(
            error.contains("quadratic elements") && error.contains("write it as .inp, .msh, .vtu or .vtk"),
            "{error}"
        );
    }
}
