//! Nodes, elements and sets of an input file by their numbers and names, in parts that number their own.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::super::content::{Content, Parts};
use super::Member;
use super::deck::Line;
use super::kinds::{FACES, Kind, Shape};
use crate::{MeshError, Problem};

/// The fate of an element. A mesh with more than 2³² elements fits into no memory.
#[derive(Clone, Copy)]
enum Element {
    Tetrahedron(u32),
    Triangle(u32),
    /// The first of its two triangles, a b c and a c d.
    Quadrangle(u32),
    Line([u32; 2]),
}

/// A part's own numbers and names.
#[derive(Default)]
struct Part {
    name: String,
    has_instance: bool,
    nodes: HashMap<i64, usize>,
    elements: HashMap<i64, Element>,
    node_sets: HashMap<String, Vec<i64>>,
    element_sets: HashMap<String, Vec<i64>>,
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
    /// Elements with nodes between their corners.
    quadratic: usize,
}

impl Default for Model {
    fn default() -> Self {
        let (content, parts, instances) = (Content::default(), vec![Part::default()], HashMap::new());
        Self { content, parts, part: 0, instances, columns: None, quadratic: 0 }
    }
}

impl Model {
    pub(super) fn begin_part(&mut self, name: &str) -> Result<(), MeshError> {
        self.part = self.parts.len();
        self.parts.push(Part { name: name.to_owned(), ..Part::default() });
        Ok(())
    }

    pub(super) fn end_part(&mut self) -> Result<(), MeshError> {
        self.part = 0;
        Ok(())
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
        for &node in self.parts[part].nodes.values() {
            self.content.vertices[node] = motion(self.content.vertices[node]);
        }
    }

    pub(super) fn add_node(&mut self, line: &Line, number: i64, place: Vector3<f64>) -> Result<(), MeshError> {
        match self.parts[self.part].nodes.insert(number, self.content.vertices.len()) {
            None => self.content.vertices.push(place),
            Some(_) => return Err(line.error(Problem::RepeatedTag { tag: number })),
        }
        Ok(())
    }

    pub(super) fn add_element(&mut self, line: &Line, number: i64, kind: Kind, nodes: &[i64]) -> Result<(), MeshError> {
        let part = &mut self.parts[self.part];
        let node = |&tag: &i64| part.nodes.get(&tag).copied().ok_or_else(|| line.error(Problem::UnknownTag { tag }));
        let nodes = nodes.iter().map(node).collect::<Result<Vec<_>, _>>()?;
        let element = match (kind.shape, &nodes[..]) {
            (Shape::Tetrahedron, &[a, b, c, d]) => {
                self.content.tetrahedra.push([a, b, c, d]);
                Element::Tetrahedron((self.content.tetrahedra.len() - 1) as u32)
            }
            (Shape::Quadrangle, &[a, b, c, d]) => {
                self.content.triangles.extend([[a, b, c], [a, c, d]]);
                Element::Quadrangle((self.content.triangles.len() - 2) as u32)
            }
            (Shape::Triangle, &[a, b, c]) => {
                self.content.triangles.push([a, b, c]);
                Element::Triangle((self.content.triangles.len() - 1) as u32)
            }
            _ => Element::Line([nodes[0] as u32, nodes[1] as u32]),
        };
        self.quadratic += usize::from(kind.nodes > kind.corners());
        match part.elements.insert(number, element) {
            None => Ok(()),
            Some(_) => {
                let reason = format!("the number {number} is given to two elements");
                Err(line.error(Problem::Malformed { reason }))
            }
        }
    }

    /// Adds nodes of the current part to a set.
    pub(super) fn name_nodes(&mut self, name: &str, numbers: &[i64]) -> Result<(), MeshError> {
        self.parts[self.part].node_sets.entry(name.to_uppercase()).or_default().extend(numbers);
        let group = self.group(name, self.part);
        let part = &self.parts[self.part];
        let points = numbers.iter().filter_map(|number| part.nodes.get(number));
        self.content.groups.entry(group).or_default().points.extend(points);
        Ok(())
    }

    /// Adds elements of the current part to a set.
    pub(super) fn name_elements(&mut self, name: &str, numbers: &[i64]) -> Result<(), MeshError> {
        self.parts[self.part].element_sets.entry(name.to_uppercase()).or_default().extend(numbers);
        let group = self.group(name, self.part);
        let parts = self.content.groups.entry(group).or_default();
        for element in numbers.iter().filter_map(|number| self.parts[self.part].elements.get(number)) {
            list(parts, *element);
        }
        Ok(())
    }

    pub(super) fn add_nodes(&mut self, name: &str, part: usize, members: &[Member]) -> Result<(), MeshError> {
        let numbers = self.numbers(part, members, |part| &part.node_sets, "the name of a set of nodes")?;
        let known = |(line, tag): &(Line, i64)| match self.parts[part].nodes.contains_key(tag) {
            true => Ok(*tag),
            false => Err(line.error(Problem::UnknownTag { tag: *tag })),
        };
        let numbers = numbers.iter().map(known).collect::<Result<Vec<_>, _>>()?;
        let current = std::mem::replace(&mut self.part, part);
        let added = self.name_nodes(name, &numbers);
        self.part = current;
        added
    }

    pub(super) fn add_elements(&mut self, name: &str, part: usize, members: &[Member]) -> Result<(), MeshError> {
        let numbers = self.numbers(part, members, |part| &part.element_sets, "the name of a set of elements")?;
        let known = |(line, number): &(Line, i64)| match self.parts[part].elements.contains_key(number) {
            true => Ok(*number),
            false => Err(line.error(no_element(*number))),
        };
        let numbers = numbers.iter().map(known).collect::<Result<Vec<_>, _>>()?;
        let current = std::mem::replace(&mut self.part, part);
        let added = self.name_elements(name, &numbers);
        self.part = current;
        added
    }

    /// Adds a side of elements to a surface.
    pub(super) fn add_sides(&mut self, name: &str, member: &Member, side: usize) -> Result<(), MeshError> {
        let members = std::slice::from_ref(member);
        let (part, member) = self.scope_of(self.part, member);
        let numbers = match member {
            Some(set) => set.iter().map(|number| (line_of(&members[0]), *number)).collect(),
            None => self.numbers(part, members, |part| &part.element_sets, "the name of a set of elements")?,
        };
        let group = self.group(name, part);
        for (line, number) in numbers {
            let element =
                self.parts[part].elements.get(&number).copied().ok_or_else(|| line.error(no_element(number)))?;
            let no_side = || line.error(Problem::NotA { word: format!("S{side}"), expected: "a side of the element" });
            let parts = self.content.groups.entry(group.clone()).or_default();
            match element {
                Element::Tetrahedron(index) => {
                    let face = FACES.get(side - 1).ok_or_else(no_side)?;
                    let tetrahedron = self.content.tetrahedra[index as usize];
                    parts.triangles.push(self.content.triangles.len());
                    self.content.triangles.push(face.map(|corner| tetrahedron[corner]));
                }
                Element::Triangle(index) if (1..=3).contains(&side) => {
                    let triangle = self.content.triangles[index as usize];
                    parts.edges.push([triangle[side - 1], triangle[side % 3]]);
                }
                Element::Quadrangle(index) if (1..=4).contains(&side) => {
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
        let found = scopes.map(|part| (part, self.parts[part].element_sets.get(&plain)));
        found.filter_map(|(part, set)| Some((part, Some(set?.clone())))).next().unwrap_or((part, None))
    }

    /// The numbers of members; names are those of earlier sets, with the name of an instance before them or not.
    fn numbers<'a>(
        &self,
        part: usize,
        members: &[Member<'a>],
        sets: fn(&Part) -> &HashMap<String, Vec<i64>>,
        expected: &'static str,
    ) -> Result<Vec<(Line<'a>, i64)>, MeshError> {
        let mut numbers = Vec::new();
        for member in members {
            match member {
                Member::Number(line, number) => numbers.push((*line, *number)),
                Member::Name(line, name) => {
                    let plain = name.rsplit('.').next().unwrap_or(name).to_uppercase();
                    let problem = || Problem::NotA { word: (*name).to_owned(), expected };
                    let set = sets(&self.parts[part]).get(&plain).ok_or_else(|| line.error(problem()))?;
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
        if self.quadratic > 0 {
            let count = self.quadratic;
            content.notes.tell(format!(
                "{count} elements have nodes between their corners, which are not read: they become linear"
            ));
        }
        // Internal sets of Abaqus/CAE, which its surfaces are made of.
        content.groups.retain(|name, _| !name.rsplit('.').next().unwrap_or(name).starts_with("_"));
        Ok(content)
    }
}

fn list(parts: &mut Parts, element: Element) {
    match element {
        Element::Tetrahedron(index) => parts.tetrahedra.push(index as usize),
        Element::Triangle(index) => parts.triangles.push(index as usize),
        Element::Quadrangle(index) => parts.triangles.extend([index as usize, index as usize + 1]),
        Element::Line(edge) => parts.edges.push(edge.map(|node| node as usize)),
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
