//! The simplices of a mesh file, before it is known whether they are a body or a surface.

use std::collections::BTreeMap;
use std::path::Path;

use nalgebra::Vector3;

use super::notes::Notes;
use crate::tidy::{leave_out_strays, leave_out_unreferenced, turn_if_all_inverted, without_empty_triangles};
use crate::{Mesh, MeshError, MeshSet, Problem, SurfaceMesh, TetrahedralMesh};

/// Different tags beyond which they number the parts of a mesh, and make no sets.
pub(super) const MOST_TAGS: usize = 1000;

/// A mesh of the kind that its file holds: tetrahedra if there are any, triangles otherwise.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyMesh {
    /// A body.
    Tetrahedra(TetrahedralMesh),
    /// A surface, or a flat body in the plane z = 0.
    Triangles(SurfaceMesh),
}

/// A mesh and what is known of its file.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFile {
    /// The mesh.
    pub mesh: AnyMesh,
    /// Remarks, one line each: what was left out of the file, and what was changed.
    pub notes: Vec<String>,
    /// The program that wrote the file, in the file's own words, where it tells.
    pub program: Option<String>,
}

impl MeshFile {
    /// The tetrahedra; a file of triangles is an error.
    pub fn tetrahedra(self, file: &Path) -> Result<TetrahedralMesh, MeshError> {
        match self.mesh {
            AnyMesh::Tetrahedra(mesh) => Ok(mesh),
            AnyMesh::Triangles(mesh) => {
                let found = format!("a mesh of {} triangles in place of tetrahedra", mesh.elements.len());
                let instead = "give tetrahedra, such as `mesh from-surface` makes inside a surface";
                Err(MeshError::in_file(file, Problem::Unsupported { found, instead }))
            }
        }
    }

    /// The triangles; a file of tetrahedra is an error.
    pub fn triangles(self, file: &Path) -> Result<SurfaceMesh, MeshError> {
        match self.mesh {
            AnyMesh::Triangles(mesh) => Ok(mesh),
            AnyMesh::Tetrahedra(mesh) => {
                let found = format!("a mesh of {} tetrahedra in place of triangles", mesh.elements.len());
                let instead = "give a surface or a plane mesh";
                Err(MeshError::in_file(file, Problem::Unsupported { found, instead }))
            }
        }
    }
}

/// A named part of a file. Triangles are faces of tetrahedra, or elements if the file has no tetrahedra.
#[derive(Clone, Debug, Default)]
pub(super) struct Parts {
    /// Indices of tetrahedra.
    pub tetrahedra: Vec<usize>,
    /// Indices of triangles.
    pub triangles: Vec<usize>,
    pub edges: Vec<[usize; 2]>,
    pub points: Vec<usize>,
}

/// The part of a mesh that an element of a file becomes. A mesh with more than 2³² nodes or elements fits into no memory.
#[derive(Clone, Copy)]
pub(super) enum Entry {
    Nothing,
    Tetrahedron(u32),
    /// The first triangle, and their number.
    Triangles(u32, u32),
    Edge([u32; 2]),
    Point(u32),
}

impl Entry {
    pub(super) fn edge(nodes: [usize; 2]) -> Self {
        Self::Edge(nodes.map(|node| node as u32))
    }
}

impl Parts {
    pub(super) fn push(&mut self, entry: Entry) {
        match entry {
            Entry::Nothing => {}
            Entry::Tetrahedron(index) => self.tetrahedra.push(index as usize),
            Entry::Triangles(first, count) => self.triangles.extend((first..first + count).map(|index| index as usize)),
            Entry::Edge(nodes) => self.edges.push(nodes.map(|node| node as usize)),
            Entry::Point(node) => self.points.push(node as usize),
        }
    }

    pub(super) fn extend(&mut self, other: Self) {
        self.tetrahedra.extend(other.tetrahedra);
        self.triangles.extend(other.triangles);
        self.edges.extend(other.edges);
        self.points.extend(other.points);
    }
}

/// All that a reader found in a file.
#[derive(Default)]
pub(super) struct Content {
    /// Positions, m; z is 0 in files of the plane.
    pub vertices: Vec<Vector3<f64>>,
    pub tetrahedra: Vec<[usize; 4]>,
    pub triangles: Vec<[usize; 3]>,
    /// Named parts.
    pub groups: BTreeMap<String, Parts>,
    /// Parts by an integer.
    pub tags: BTreeMap<i64, Parts>,
    /// Names of tags.
    pub tag_names: BTreeMap<i64, String>,
    /// There are too many different tags to be parts.
    pub has_numbering: bool,
    /// The tag of each node; empty if the file has none.
    pub node_tags: Vec<i32>,
    /// Nodes between the corners of elements: the ends of the edge of each, and its number.
    pub middles: Vec<([usize; 2], usize)>,
    /// Number of elements that have such nodes.
    pub quadratic: usize,
    /// A kind of polygons that was skipped and would be missing in a surface.
    pub skipped: Option<String>,
    /// Number of faces with fewer than three corners, which were skipped.
    pub short_faces: usize,
    /// The file is of a format for surfaces alone: its triangles are no flat body, even in a plane.
    pub is_surface: bool,
    pub notes: Notes,
}

/// Corners of the edges of a tetrahedron with 10 nodes, in the order of the nodes at their middles, in VTK's and Abaqus's files and in Gmsh's.
pub(super) const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
pub(super) const GMSH_EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [2, 3], [1, 3]];

/// Part of an edge by which a node may lie beside its middle, as rounding errors of a file.
const STRAIGHT: f64 = 1e-6;

impl Content {
    /// Adds the nodes between the corners of an element with these edges.
    pub(super) fn add_middles(
        &mut self,
        corners: &[usize],
        edges: &[[usize; 2]],
        middles: impl Iterator<Item = usize>,
    ) {
        self.quadratic += 1;
        self.middles.extend(edges.iter().map(|edge| edge.map(|corner| corners[corner])).zip(middles));
    }

    /// Adds the nodes between the corners of a polygon.
    pub(super) fn add_middles_of_polygon(&mut self, corners: &[usize], middles: impl Iterator<Item = usize>) {
        let edges: Vec<[usize; 2]> = (0..corners.len()).map(|i| [i, (i + 1) % corners.len()]).collect();
        self.add_middles(corners, &edges, middles);
    }

    pub(super) fn tetrahedron(&mut self, corners: [usize; 4]) -> Entry {
        self.tetrahedra.push(corners);
        Entry::Tetrahedron(self.tetrahedra.len() as u32 - 1)
    }

    /// Adds a polygon as triangles around its first corner.
    pub(super) fn polygon(&mut self, corners: &[usize]) -> Entry {
        let first = self.triangles.len() as u32;
        self.triangles.extend(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]));
        Entry::Triangles(first, self.triangles.len() as u32 - first)
    }

    /// Adds an entry to the part of a tag.
    pub(super) fn tag(&mut self, tag: i64, entry: Entry) {
        self.tagged(tag).into_iter().for_each(|parts| parts.push(entry));
    }

    /// The part of a tag; `None` for the tag 0, which stands for no part.
    pub(super) fn tagged(&mut self, tag: i64) -> Option<&mut Parts> {
        if self.tags.len() >= MOST_TAGS && !self.tags.contains_key(&tag) {
            self.has_numbering = true;
        }
        (tag != 0 && !self.has_numbering).then(|| self.tags.entry(tag).or_default())
    }

    /// Reads the names of tags from comments such as `# set 3 clamped`, which this library writes.
    pub(super) fn name_tags_from(&mut self, text: &str) {
        for comment in text.lines().filter_map(|line| line.strip_prefix("# set ")) {
            if let Some((number, name)) = comment.split_once(' ')
                && let Ok(number) = number.parse()
            {
                self.tag_names.insert(number, name.trim().to_owned());
            }
        }
    }

    /// The tetrahedra if there are any, and the triangles otherwise, without what belongs to no element.
    pub(super) fn finish(mut self, file: &Path, program: Option<String>) -> Result<MeshFile, MeshError> {
        let in_file = |problem| MeshError::in_file(file, problem);
        if self.tetrahedra.is_empty() {
            if let Some(found) = self.skipped {
                return Err(in_file(Problem::Unsupported {
                    found,
                    instead: "split the polygons into triangles first",
                }));
            }
            if self.triangles.is_empty() {
                let what = if self.is_surface { "faces" } else { "tetrahedra or triangles" };
                return Err(in_file(Problem::Empty { what }));
            }
        } else if let Some(found) = self.skipped.take() {
            self.notes.unread(found);
        }
        self.name_tags();
        self.leave_out_middles();
        if self.short_faces > 0 {
            self.notes.tell(format!("{} faces with fewer than three corners are left out", self.short_faces));
        }
        let (mesh, notes) =
            if self.tetrahedra.is_empty() { self.into_triangles(file)? } else { self.into_tetrahedra() };
        Ok(MeshFile { mesh, notes: notes.into_lines(), program })
    }

    /// Makes named parts of tags.
    fn name_tags(&mut self) {
        let mut tags = std::mem::take(&mut self.tags);
        if self.has_numbering {
            self.notes.unread(format!("tags of over {MOST_TAGS} different values, which name no parts"));
            tags.clear();
        }
        // Tags of faces and edges name nodes more exactly than those of the nodes do.
        let has_faces =
            |parts: &Parts| !parts.edges.is_empty() || (!parts.triangles.is_empty() && !self.tetrahedra.is_empty());
        let by_faces: Vec<i64> = tags.iter().filter(|(_, parts)| has_faces(parts)).map(|(tag, _)| *tag).collect();
        for (node, tag) in self.node_tags.iter().map(|tag| i64::from(*tag)).enumerate().filter(|(_, tag)| *tag != 0) {
            if !by_faces.contains(&tag) && (tags.len() < MOST_TAGS || tags.contains_key(&tag)) {
                tags.entry(tag).or_default().points.push(node);
            }
        }
        for (tag, parts) in tags {
            let name = self.tag_names.get(&tag).cloned().unwrap_or_else(|| tag.to_string());
            self.groups.entry(name).or_default().extend(parts);
        }
    }

    /// Leaves out the nodes between corners. A set of nodes that has one, and the ends of its edge, gets the edge.
    fn leave_out_middles(&mut self) {
        if self.quadratic == 0 {
            return;
        }
        self.middles.sort_unstable_by_key(|(_, middle)| *middle);
        self.middles.dedup_by_key(|(_, middle)| *middle);
        let middles = &self.middles;
        let edge_of = |node: &usize| Some(middles[middles.binary_search_by_key(node, |(_, middle)| *middle).ok()?].0);
        for parts in self.groups.values_mut().filter(|parts| !parts.points.is_empty()) {
            parts.points.sort_unstable();
            let points = std::mem::take(&mut parts.points);
            let has = |node: &usize| points.binary_search(node).is_ok();
            let edges = points.iter().filter_map(edge_of).filter(|ends| ends.iter().all(has));
            parts.edges.extend(edges);
            parts.points = points.into_iter().filter(|node| edge_of(node).is_none()).collect();
        }
        let beside = |&([a, b], middle): &([usize; 2], usize)| {
            let [a, b, middle] = [a, b, middle].map(|node| self.vertices[node]);
            ((middle - 0.5 * (a + b)).norm(), (a - b).norm())
        };
        let far = middles.iter().map(beside).filter(|(distance, length)| *distance > STRAIGHT * length);
        let far = far.map(|(distance, _)| distance).fold(0.0, f64::max);
        let count = self.quadratic;
        let bent = if far > 0.0 {
            format!(
                "; edges become straight, and in the file such a node lies {far:.3e} m beside the middle of its edge"
            )
        } else {
            String::new()
        };
        self.notes.tell(format!(
            "nodes between the corners of {count} elements are not read; `order = 2` in `[mesh]` makes them anew, on the middles of \
             their edges{bent}"
        ));
        // A node that is a corner of another element stays.
        let mut is_corner = vec![false; self.vertices.len()];
        let corners = match &self.tetrahedra[..] {
            [] => self.triangles.as_flattened(),
            tetrahedra => tetrahedra.as_flattened(),
        };
        corners.iter().for_each(|&node| is_corner[node] = true);
        self.middles.retain(|(_, middle)| !is_corner[*middle]);
    }

    fn into_tetrahedra(self) -> (AnyMesh, Notes) {
        let (triangles, mut notes) = (self.triangles, self.notes);
        let set = |(name, parts): (String, Parts)| {
            let faces = parts.triangles.into_iter().map(|triangle| triangles[triangle]).collect();
            (name, sorted(MeshSet { elements: parts.tetrahedra, faces, edges: parts.edges, points: parts.points }))
        };
        let sets = self.groups.into_iter().map(set).collect();
        let mut mesh = TetrahedralMesh { vertices: self.vertices, elements: self.tetrahedra, sets };
        clear(&mut mesh, self.middles.len(), &mut notes);
        if let Some(count) = turn_if_all_inverted(&mut mesh) {
            notes.tell(format!(
                "all {count} tetrahedra had a negative volume; each is turned by swapping two of its nodes"
            ));
        }
        (AnyMesh::Tetrahedra(mesh), notes)
    }

    fn into_triangles(self, file: &Path) -> Result<(AnyMesh, Notes), MeshError> {
        let mut notes = self.notes;
        let set = |(name, parts): (String, Parts)| {
            let set = MeshSet { elements: parts.triangles, faces: vec![], edges: parts.edges, points: parts.points };
            (name, sorted(set))
        };
        let sets = self.groups.into_iter().map(set).collect();
        let mut mesh = SurfaceMesh { vertices: self.vertices, elements: self.triangles, sets };
        let is_plane = !self.is_surface && mesh.vertices.iter().all(|x| x.z == 0.0);
        if !is_plane {
            // An element of a flat body without an area is refused where the body is checked: it may be a gap.
            let (kept, left_out) = without_empty_triangles(mesh);
            left_out.into_iter().for_each(|line| notes.tell(line));
            mesh = kept;
            if mesh.elements.is_empty() {
                return Err(MeshError::in_file(file, Problem::Empty { what: "triangles with an area" }));
            }
        }
        if self.is_surface {
            leave_out_strays(&mut mesh).into_iter().for_each(|line| notes.tell(line));
        } else {
            clear(&mut mesh, self.middles.len(), &mut notes);
        }
        if is_plane && let Some(count) = turn_if_all_inverted(&mut mesh) {
            notes.tell(format!("all {count} triangles were clockwise; each is turned by swapping two of its nodes"));
        }
        Ok((AnyMesh::Triangles(mesh), notes))
    }
}

fn sorted(mut set: MeshSet) -> MeshSet {
    set.sort();
    set
}

/// Leaves out parts of sets and nodes that belong to no element. The nodes between corners are not told.
fn clear<const N: usize>(mesh: &mut Mesh<3, N>, middles: usize, notes: &mut Notes) {
    leave_out_strays(mesh).into_iter().for_each(|line| notes.tell(line));
    let count = leave_out_unreferenced(mesh).saturating_sub(middles);
    if count > 0 {
        notes.tell(format!("{count} nodes belong to no element and are left out"));
    }
}
