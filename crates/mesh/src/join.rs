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
