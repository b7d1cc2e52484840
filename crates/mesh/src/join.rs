//! Several meshes as one.

use super::{MeshSet, TetrahedralMesh};

/// One mesh of several, whose nodes and elements follow one another. All elements of each become a set of the name that stands
/// beside it; the meshes keep their own sets, and sets of the same name are joined.
pub fn join(meshes: impl IntoIterator<Item = (String, TetrahedralMesh)>) -> TetrahedralMesh {
    let mut joined = TetrahedralMesh::default();
    for (name, mesh) in meshes {
        let (nodes, elements) = (joined.vertices.len(), joined.elements.len());
        let all = MeshSet { elements: (elements..elements + mesh.elements.len()).collect(), ..MeshSet::default() };
        joined.vertices.extend(mesh.vertices);
        joined.elements.extend(mesh.elements.into_iter().map(|element| element.map(|node| nodes + node)));
        let own = mesh.sets.into_iter().map(|(name, set)| (name, shifted(set, nodes, elements)));
        for (name, set) in own.chain(std::iter::once((name, all))) {
            joined.sets.entry(name).or_default().extend(set);
        }
    }
    joined.sets.values_mut().for_each(MeshSet::sort);
    joined
}

/// The set with its numbers shifted by these numbers of nodes and elements.
fn shifted(set: MeshSet, nodes: usize, elements: usize) -> MeshSet {
    MeshSet {
        elements: set.elements.into_iter().map(|element| elements + element).collect(),
        faces: set.faces.into_iter().map(|face| face.map(|node| nodes + node)).collect(),
        edges: set.edges.into_iter().map(|edge| edge.map(|node| nodes + node)).collect(),
        points: set.points.into_iter().map(|node| nodes + node).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::join;
    use crate::{MeshSet, Pattern, box_mesh, volumes};

    #[test]
    fn joined_meshes_follow_one_another_with_their_sets() {
        let small = box_mesh([1.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
        let mut large = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
        large.vertices.iter_mut().for_each(|vertex| vertex.y += 5.0);
        let corner = MeshSet { faces: vec![[0, 1, 4]], points: vec![3], ..MeshSet::default() };
        large.sets.insert("corner".to_owned(), corner);
        let joined = join([("small".to_owned(), small), ("large".to_owned(), large)]);
        assert_eq!((joined.vertices.len(), joined.elements.len()), (8 + 12, 6 + 12));
        assert!((volumes(&joined).iter().sum::<f64>() - 3.0).abs() < 1e-12);
        assert!(joined.elements[6..].iter().flatten().all(|&node| node >= 8));
        assert_eq!(joined.sets["small"].elements, [0, 1, 2, 3, 4, 5]);
        assert_eq!(joined.sets["large"].elements, (6..18).collect::<Vec<_>>());
        assert_eq!(
            (&joined.sets["corner"].faces[..], &joined.sets["corner"].points[..]),
            (&[[8, 9, 12]][..], &[11][..])
        );
    }
}
