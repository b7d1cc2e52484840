//! Abaqus's and CalculiX's input files. Source: Abaqus Keywords Reference Guide; G. Dhondt, CalculiX CrunchiX user's manual, «Input deck
//! format».

mod deck;
mod kinds;
mod model;

use std::path::Path;

use nalgebra::{Rotation3, Unit, Vector3};

use self::deck::{Deck, Keyword, Line};
pub(crate) use self::kinds::FACES;
use self::kinds::kind;
use self::model::{Model, Of};
use super::content::Content;
use crate::{MeshError, Problem};

/// Reads nodes, linear and quadratic tetrahedra, triangles and quadrangles (cut into two triangles) by their corners, sets of nodes and elements, and surfaces, of parts with one
/// instance each. Materials, steps and the like are skipped.
pub(super) fn read(file: &Path, text: String) -> Result<Content, MeshError> {
    let deck = Deck::read(file, text)?;
    let mut model = Model::default();
    let mut lines = deck.lines().peekable();
    while let Some(line) = lines.next() {
        let Some(keyword) = line.keyword() else { continue };
        let mut rows = std::iter::from_fn(|| lines.next_if(|line| !line.is_keyword()));
        section(&mut model, &keyword, &mut rows)?;
        rows.for_each(drop);
    }
    model.finish()
}

/// The rows of data after a keyword.
type Rows<'r, 'a> = &'r mut dyn Iterator<Item = Line<'a>>;

fn section(model: &mut Model, keyword: &Keyword, rows: Rows) -> Result<(), MeshError> {
    let name = |key| keyword.required(key);
    match &keyword.name[..] {
        "NODE" => nodes(model, keyword, rows),
        "ELEMENT" => elements(model, keyword, rows),
        "NSET" => set(model, keyword, rows, Of::Nodes),
        "ELSET" => set(model, keyword, rows, Of::Elements),
        "SURFACE" => surface(model, keyword, rows),
        "INSTANCE" => {
            let part = model.begin_instance(&keyword.line, name("NAME")?, keyword.parameter("PART"))?;
            model.place(part, &motion(rows)?);
            Ok(())
        }
        other => {
            match other {
                "PART" => model.begin_part(name("NAME")?),
                "END PART" | "END INSTANCE" => model.part = 0,
                "HEADING" | "ASSEMBLY" | "END ASSEMBLY" | "PREPRINT" | "INCLUDE" => {}
                _ => model.content.notes.unread(format!("*{other}")),
            }
            Ok(())
        }
    }
}

/// A set of nodes or elements; one of the assembly is of an instance.
fn set(model: &mut Model, keyword: &Keyword, rows: Rows, of: Of) -> Result<(), MeshError> {
    let members = members(keyword, rows)?;
    let name = keyword.required(if matches!(of, Of::Nodes) { "NSET" } else { "ELSET" })?;
    let part = match keyword.parameter("INSTANCE") {
        Some(instance) => model.instance(&keyword.line, instance)?,
        None => model.part,
    };
    model.add(of, name, part, &members)
}

/// `<number>, <x>, <y>, <z>`, without z in the plane.
fn nodes(model: &mut Model, keyword: &Keyword, rows: Rows) -> Result<(), MeshError> {
    if keyword.parameter("SYSTEM").is_some_and(|system| !system.eq_ignore_ascii_case("R")) {
        let found = "*NODE with SYSTEM=C or S".to_owned();
        return Err(keyword.line.error(Problem::Unsupported { found, instead: "give rectangular coordinates" }));
    }
    let (mut numbers, set) = (Vec::new(), keyword.parameter("NSET"));
    for row in rows {
        let entries: Vec<&str> = row.entries().collect();
        let number = row.integer(entries[0], "the number of a node")?;
        let columns = *model.columns.get_or_insert(entries.len().clamp(3, 4));
        if entries.len() < columns {
            return Err(row.error(Problem::Ends { expected: "a coordinate" }));
        }
        if let Some(word) = entries.get(columns) {
            let last = if columns == 4 {
                "the three coordinates of a node"
            } else {
                "as many coordinates as the first node has"
            };
            return Err(row.error(Problem::RowTooLong { word: (*word).to_owned(), last }));
        }
        let z = entries.get(3).map_or(Ok(0.0), |z| row.real(z))?;
        let place = Vector3::new(row.real(entries[1])?, row.real(entries[2])?, z);
        model.add_node(&row, number, place)?;
        numbers.extend(set.map(|_| number));
    }
    set.into_iter().for_each(|name| model.name(Of::Nodes, name, model.part, &numbers));
    Ok(())
}

/// `<number>, <nodes …>`, over several lines that end in a comma.
fn elements(model: &mut Model, keyword: &Keyword, rows: Rows) -> Result<(), MeshError> {
    let name = keyword.required("TYPE")?;
    let Some(kind) = kind(name).map_err(|problem| keyword.line.error(problem))? else {
        model.content.notes.unread(format!("elements of the type {name}"));
        return Ok(());
    };
    let (mut numbers, set) = (Vec::new(), keyword.parameter("ELSET"));
    while let Some(row) = rows.next() {
        let mut entries: Vec<&str> = row.entries().collect();
        let mut last = row;
        while entries.len() < 1 + kind.nodes && last.goes_on() {
            let ends = || row.error(Problem::Ends { expected: "a node of the element" });
            last = rows.next().ok_or_else(ends)?;
            entries.extend(last.entries());
        }
        let expected = "the number of a node or of an element";
        let found = entries.iter().map(|word| row.integer(word, expected)).collect::<Result<Vec<i64>, _>>()?;
        let (number, nodes) = (found[0], &found[1..]);
        if nodes.len() < kind.nodes {
            return Err(row.error(Problem::Ends { expected: "a node of the element" }));
        }
        if let Some(more) = nodes.get(kind.nodes) {
            return Err(row.error(Problem::RowTooLong { word: more.to_string(), last: "the nodes of the element" }));
        }
        model.add_element(&row, number, kind, nodes)?;
        numbers.extend(set.map(|_| number));
    }
    set.into_iter().for_each(|name| model.name(Of::Elements, name, model.part, &numbers));
    Ok(())
}

/// Members of a set: a number, or the name of another set.
enum Member<'a> {
    Number(Line<'a>, i64),
    Name(Line<'a>, &'a str),
}

/// Numbers and names, or with `GENERATE` the first number, the last and the step in each row.
fn members<'a>(keyword: &Keyword, rows: Rows<'_, 'a>) -> Result<Vec<Member<'a>>, MeshError> {
    let mut found = Vec::new();
    for row in rows {
        let entries = row.entries().filter(|entry| !entry.is_empty());
        if keyword.parameter("GENERATE").is_none() {
            // A name may have the name of an instance before it.
            found.extend(entries.map(|entry| match entry.parse() {
                Ok(number) => Member::Number(row, number),
                Err(_) => Member::Name(row, entry.trim_matches('"')),
            }));
            continue;
        }
        let numbers = entries.map(|entry| row.integer(entry, "a number")).collect::<Result<Vec<_>, _>>()?;
        let (first, last, step) = match numbers[..] {
            [first] => (first, first, 1),
            [first, last] => (first, last, 1),
            [first, last, step] if step > 0 => (first, last, step),
            _ => {
                let expected = "a first number, a last one and a positive step";
                return Err(row.error(Problem::NotA { word: format!("{numbers:?}"), expected }));
            }
        };
        let mut number = first;
        while number <= last {
            // A set without end stops at the first number that the file has not.
            found.push(Member::Number(row, number));
            if found.len() > MOST_MEMBERS {
                let reason = format!("the set has over {MOST_MEMBERS} members");
                return Err(row.error(Problem::Malformed { reason }));
            }
            number += step;
        }
    }
    Ok(found)
}

/// Members of a set that is written as a range, beyond which no file has as many.
const MOST_MEMBERS: usize = 100_000_000;

/// `<elements>, S1` in each row, or of nodes with `TYPE=NODE`.
fn surface(model: &mut Model, keyword: &Keyword, rows: Rows) -> Result<(), MeshError> {
    let name = keyword.required("NAME")?;
    if keyword.parameter("TYPE").is_some_and(|kind| kind.eq_ignore_ascii_case("NODE")) {
        let members = members(keyword, rows)?;
        return model.add(Of::Nodes, name, model.part, &members);
    }
    for row in rows {
        let mut entries = row.entries();
        let (elements, side) = (entries.next().unwrap_or_default(), entries.next().unwrap_or_default());
        let is_side = side.strip_prefix(['S', 's']).and_then(|side| side.parse().ok()).filter(|side| *side > 0);
        let Some(side) = is_side else {
            let problem = Problem::NotA { word: side.to_owned(), expected: "a side of the elements, such as S1" };
            return Err(row.error(problem));
        };
        let member = match elements.parse() {
            Ok(number) => Member::Number(row, number),
            Err(_) => Member::Name(row, elements),
        };
        model.add_sides(name, &member, side)?;
    }
    Ok(())
}

/// The motion of an instance: a shift, then a turn by an angle in degrees about the axis from one point to another.
fn motion(rows: Rows) -> Result<impl Fn(Vector3<f64>) -> Vector3<f64> + use<>, MeshError> {
    let numbers = |row: Line| row.entries().map(|word| row.real(word)).collect::<Result<Vec<f64>, _>>();
    let first = rows.next().map(numbers).transpose()?.unwrap_or_default();
    let turn = rows.next().map(numbers).transpose()?.unwrap_or_default();
    let vector = |list: &[f64], i: usize| Vector3::from_fn(|k, _| list.get(i + k).copied().unwrap_or(0.0));
    let (shift, a, b) = (vector(&first, 0), vector(&turn, 0), vector(&turn, 3));
    let angle = turn.get(6).copied().unwrap_or(0.0).to_radians();
    let rotation =
        Unit::try_new(b - a, 0.0).map_or(Rotation3::identity(), |axis| Rotation3::from_axis_angle(&axis, angle));
    Ok(move |x| a + rotation * (x + shift - a))
}
