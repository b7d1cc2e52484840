//! Nodes, elements and sets of an input file by their numbers and names, in parts that number their own.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::super::content::{Content, EDGES, Entry};
use super::Member;
use super::deck::Line;
use super::kinds::{FACES, Kind, Shape};
use crate::{MeshError, Problem};

/// The numbers that a set is of.
#[derive(Clone, Copy)]
pub(super) enum Of {
    Nodes,
    Elements,
}

/// A part's own numbers and names, of nodes and of elements.
#[derive(Default)]
struct Part {
    name: String,
    has_instance: bool,
    known: [HashMap<i64, Entry>; 2],
    sets: [HashMap<String, Vec<i64>>; 2],
}

/// The first part has what stands outside of parts.
pub(super) struct Model {
    pub content: Content,
    parts: Vec<Part>,
    /// The current part.
    pub part: usize,
    instances: HashMap<String, usize>,
    /// Entries in the first row of a node; each has as many.
    pub columns: Option<usize>,
}

impl Default for Model {
    fn default() -> Self {
        let (content, parts, instances) = (Content::default(), vec![Part::default()], HashMap::new());
        Self { content, parts, part: 0, instances, columns: None }
    }
}

impl Model {
    pub(super) fn begin_part(&mut self, name: &str) {
        self.part = self.parts.len();
        self.parts.push(Part { name: name.to_owned(), ..Part::default() });
    }

    /// Begins an instance of a part, whose own nodes and elements may follow.
    pub(super) fn begin_instance(&mut self, line: &Line, name: &str, part: Option<&str>) -> Result<usize, MeshError> {
        let of_name = |part: &&str| self.parts.iter().skip(1).position(|found| found.name.eq_ignore_ascii_case(part));
        let Some(found) = part.as_ref().and_then(of_name) else {
            let word = part.unwrap_or_default().to_owned();
            return Err(line.error(Problem::NotA { word, expected: "the name of a part" }));
        };
        let found = found + 1;
        if std::mem::replace(&mut self.parts[found].has_instance, true) {
            let found = format!("a second instance of the part {}", self.parts[found].name);
            let instead = "give each instance a part of its own (Abaqus/CAE: Copy Part)";
            return Err(line.error(Problem::Unsupported { found, instead }));
        }
        self.instances.insert(name.to_uppercase(), found);
        self.part = found;
        Ok(found)
    }

    /// The part of an instance.
    pub(super) fn instance(&self, line: &Line, name: &str) -> Result<usize, MeshError> {
        let problem = || Problem::NotA { word: name.to_owned(), expected: "the name of an instance" };
        self.instances.get(&name.to_uppercase()).copied().ok_or_else(|| line.error(problem()))
    }

    /// Moves the nodes of a part.
    pub(super) fn place(&mut self, part: usize, motion: &impl Fn(Vector3<f64>) -> Vector3<f64>) {
        for node in self.parts[part].known[Of::Nodes as usize].values() {
            if let Entry::Point(node) = *node {
                self.content.vertices[node as usize] = motion(self.content.vertices[node as usize]);
            }
        }
    }

    pub(super) fn add_node(&mut self, line: &Line, number: i64, place: Vector3<f64>) -> Result<(), MeshError> {
        let node = Entry::Point(self.content.vertices.len() as u32);
        self.content.vertices.push(place);
        match self.parts[self.part].known[Of::Nodes as usize].insert(number, node) {
            None => Ok(()),
            Some(_) => Err(line.error(Problem::RepeatedTag { tag: number })),
        }
    }

    pub(super) fn add_element(&mut self, line: &Line, number: i64, kind: Kind, nodes: &[i64]) -> Result<(), MeshError> {
        let [known, elements] = &mut self.parts[self.part].known;
        let node = |&tag: &i64| match known.get(&tag) {
            Some(Entry::Point(node)) => Ok(*node as usize),
            _ => Err(line.error(Problem::UnknownTag { tag })),
        };
        let (nodes, middles) = nodes.split_at(kind.corners());
        let nodes = nodes.iter().map(node).collect::<Result<Vec<_>, _>>()?;
        let middles = middles.iter().map(node).collect::<Result<Vec<_>, _>>()?.into_iter();
        match kind.shape {
            _ if middles.len() == 0 => {}
            Shape::Tetrahedron => self.content.add_middles(&nodes, &EDGES, middles),
            Shape::Line => self.content.add_middles(&nodes, &[[0, 1]], middles),
            Shape::Triangle | Shape::Quadrangle => self.content.add_middles_of_polygon(&nodes, middles),
        }
        let element = match (kind.shape, &nodes[..]) {
            (Shape::Tetrahedron, &[a, b, c, d]) => self.content.tetrahedron([a, b, c, d]),
            (Shape::Line, nodes) => Entry::edge([nodes[0], nodes[1]]),
            (_, nodes) => self.content.polygon(nodes),
        };
        match elements.insert(number, element) {
            None => Ok(()),
            Some(_) => {
                let reason = format!("the number {number} is given to two elements");
                Err(line.error(Problem::Malformed { reason }))
            }
        }
    }

    /// Adds nodes or elements of a part to a set.
    pub(super) fn name(&mut self, of: Of, name: &str, part: usize, numbers: &[i64]) {
        let group = self.group(name, part);
        let Part { known, sets, .. } = &mut self.parts[part];
        sets[of as usize].entry(name.to_uppercase()).or_default().extend(numbers);
        let parts = self.content.groups.entry(group).or_default();
        numbers.iter().filter_map(|number| known[of as usize].get(number)).for_each(|&entry| parts.push(entry));
    }

    /// Adds members to a set of a part, which has to have them.
    pub(super) fn add(&mut self, of: Of, name: &str, part: usize, members: &[Member]) -> Result<(), MeshError> {
        let numbers = self.numbers(of, part, members)?;
        let known = &self.parts[part].known[of as usize];
        if let Some((line, number)) = numbers.iter().find(|(_, number)| !known.contains_key(number)) {
            return Err(line.error(match of {
                Of::Nodes => Problem::UnknownTag { tag: *number },
                Of::Elements => no_element(*number),
            }));
        }
        self.name(of, name, part, &numbers.iter().map(|(_, number)| *number).collect::<Vec<_>>());
        Ok(())
    }

    /// Adds a side of elements to a surface.
    pub(super) fn add_sides(&mut self, name: &str, member: &Member, side: usize) -> Result<(), MeshError> {
        let members = std::slice::from_ref(member);
        let (part, member) = self.scope_of(self.part, member);
        let numbers = match member {
            Some(set) => set.iter().map(|number| (line_of(&members[0]), *number)).collect(),
            None => self.numbers(Of::Elements, part, members)?,
        };
        let group = self.group(name, part);
        for (line, number) in numbers {
            let element = self.parts[part].known[Of::Elements as usize].get(&number).copied();
            let element = element.ok_or_else(|| line.error(no_element(number)))?;
            let no_side = || line.error(Problem::NotA { word: format!("S{side}"), expected: "a side of the element" });
            let parts = self.content.groups.entry(group.clone()).or_default();
            match element {
                Entry::Tetrahedron(index) => {
                    let face = FACES.get(side - 1).ok_or_else(no_side)?;
                    let tetrahedron = self.content.tetrahedra[index as usize];
                    parts.triangles.push(self.content.triangles.len());
                    self.content.triangles.push(face.map(|corner| tetrahedron[corner]));
                }
                Entry::Triangles(index, 1) if (1..=3).contains(&side) => {
                    let triangle = self.content.triangles[index as usize];
                    parts.edges.push([triangle[side - 1], triangle[side % 3]]);
                }
                Entry::Triangles(index, 2) if (1..=4).contains(&side) => {
                    let [[a, b, c], [.., d]] = [0, 1].map(|half| self.content.triangles[index as usize + half]);
                    let corners = [a, b, c, d];
                    parts.edges.push([corners[side - 1], corners[side % 4]]);
                }
                _ => return Err(no_side()),
            }
        }
        Ok(())
    }

    /// The set of elements that a surface of the assembly names, such as `_Surf-1_S2`, wherever it is.
    fn scope_of(&self, part: usize, member: &Member) -> (usize, Option<Vec<i64>>) {
        let Member::Name(_, name) = member else { return (part, None) };
        let plain = name.rsplit('.').next().unwrap_or(name).to_uppercase();
        let scopes = std::iter::once(part).chain(0..self.parts.len());
        let found = scopes.map(|part| (part, self.parts[part].sets[Of::Elements as usize].get(&plain)));
        found.filter_map(|(part, set)| Some((part, Some(set?.clone())))).next().unwrap_or((part, None))
    }

    /// The numbers of members; names are those of earlier sets, with the name of an instance before them or not.
    fn numbers<'a>(&self, of: Of, part: usize, members: &[Member<'a>]) -> Result<Vec<(Line<'a>, i64)>, MeshError> {
        let expected = match of {
            Of::Nodes => "the name of a set of nodes",
            Of::Elements => "the name of a set of elements",
        };
        let mut numbers = Vec::new();
        for member in members {
            match member {
                Member::Number(line, number) => numbers.push((*line, *number)),
                Member::Name(line, name) => {
                    let plain = name.rsplit('.').next().unwrap_or(name).to_uppercase();
                    let problem = || Problem::NotA { word: (*name).to_owned(), expected };
                    let set = self.parts[part].sets[of as usize].get(&plain).ok_or_else(|| line.error(problem()))?;
                    numbers.extend(set.iter().map(|number| (*line, *number)));
                }
            }
        }
        Ok(numbers)
    }

    /// The name of a set in the mesh: that of its part before it if there are several parts.
    fn group(&self, name: &str, part: usize) -> String {
        let name = if part > 0 && self.parts.len() > 2 {
            format!("{}.{name}", self.parts[part].name)
        } else {
            name.to_owned()
        };
        // Capitals do not tell names apart.
        self.content.groups.keys().find(|known| known.eq_ignore_ascii_case(&name)).cloned().unwrap_or(name)
    }

    pub(super) fn finish(self) -> Result<Content, MeshError> {
        let mut content = self.content;
        // Internal sets of Abaqus/CAE, which its surfaces are made of.
        content.groups.retain(|name, _| !name.rsplit('.').next().unwrap_or(name).starts_with("_"));
        Ok(content)
    }
}

fn line_of<'a>(member: &Member<'a>) -> Line<'a> {
    match member {
        Member::Number(line, _) | Member::Name(line, _) => *line,
    }
}

fn no_element(number: i64) -> Problem {
    Problem::Malformed { reason: format!("the file has no element with the number {number}") }
}
