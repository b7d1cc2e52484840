//! VTK's old unstructured grids, text and binary. Source: VTK file formats, section «Simple legacy formats».

use std::path::Path;

use nalgebra::Vector3;

use super::cells;
use crate::{MeshError, Problem, TetrahedralMesh};

const GRID: &str = "save it as an unstructured grid (ParaView: .vtu)";

/// Reads the tetrahedra among the cells, in the layout before version 5 and since. Cells without volume are skipped; other
/// volume cells are an error.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<TetrahedralMesh, MeshError> {
    let mut reader = Reader { file, bytes, at: 0, is_binary: false };
    read_header(&mut reader)?;
    let (mut points, mut offsets, mut connectivity, mut kinds) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    while let Some(keyword) = reader.word() {
        match &keyword.to_ascii_uppercase()[..] {
            "POINTS" => points = read_points(&mut reader)?,
            "CELLS" => (offsets, connectivity) = read_cells(&mut reader)?,
            "CELL_TYPES" => {
                let count = reader.count("the number of cell types")?;
                kinds = reader.integers(count, "int")?;
            }
            "METADATA" => reader.skip_paragraph(),
            "FIELD" => skip_field(&mut reader)?,
            // Data of points and cells end the grid.
            "POINT_DATA" | "CELL_DATA" => break,
            _ => return Err(reader.malformed(format!("`{keyword}` is no keyword of an unstructured grid"))),
        }
    }
    let elements = tetrahedra(&offsets, &connectivity, &kinds, points.len());
    Ok(TetrahedralMesh::new(points, elements.map_err(|problem| MeshError::in_file(file, problem))?))
}

/// A line of version, a line of title, `ASCII` or `BINARY`, and the kind of data set.
fn read_header(reader: &mut Reader) -> Result<(), MeshError> {
    let unsupported = |reader: &Reader, found: String| reader.error(Problem::Unsupported { found, instead: GRID });
    if !reader.line().starts_with("# vtk DataFile Version") {
        return Err(unsupported(reader, "a .vtk file that does not begin with `# vtk DataFile Version`".to_owned()));
    }
    reader.line();
    let encoding = reader.expected("ASCII or BINARY")?;
    reader.is_binary = match &encoding.to_ascii_uppercase()[..] {
        "ASCII" => false,
        "BINARY" => true,
        _ => return Err(reader.error(Problem::NotA { word: encoding, expected: "ASCII or BINARY" })),
    };
    let (keyword, kind) = (reader.expected("the keyword DATASET")?, reader.expected("the kind of data set")?);
    if !keyword.eq_ignore_ascii_case("DATASET") || !kind.eq_ignore_ascii_case("UNSTRUCTURED_GRID") {
        return Err(unsupported(reader, format!("the data set `{keyword} {kind}`")));
    }
    Ok(())
}

/// `<points> <type>`, then three coordinates of each.
fn read_points(reader: &mut Reader) -> Result<Vec<Vector3<f64>>, MeshError> {
    let count = reader.count("the number of points")?;
    let kind = reader.expected("the type of the points")?;
    let start = reader.clone();
    let places = reader.reals(count.saturating_mul(3), &kind)?;
    match places.iter().position(|x| !x.is_finite()) {
        Some(i) => Err(start.error(Problem::VertexNotFinite { vertex: i / 3 })),
        None => Ok(places.chunks_exact(3).map(Vector3::from_column_slice).collect()),
    }
}

/// Ends of the cells in the connectivity, beginning with 0, and the connectivity.
type Cells = (Vec<i64>, Vec<i64>);

/// Before version 5: `<cells> <numbers>`, then the number of points and the points of each cell. Since then: `<offsets>
/// <numbers>`, and the two arrays `OFFSETS` and `CONNECTIVITY`, each with its type.
fn read_cells(reader: &mut Reader) -> Result<Cells, MeshError> {
    let (count, size) = (reader.count("the number of cells")?, reader.count("the number of numbers")?);
    let mut ahead = reader.clone();
    if ahead.word().is_some_and(|word| word.eq_ignore_ascii_case("OFFSETS")) {
        *reader = ahead;
        let kind = reader.expected("the type of the offsets")?;
        let offsets = reader.integers(count, &kind)?;
        let keyword = reader.expected("the keyword CONNECTIVITY")?;
        if !keyword.eq_ignore_ascii_case("CONNECTIVITY") {
            return Err(reader.error(Problem::NotA { word: keyword, expected: "the keyword CONNECTIVITY" }));
        }
        let kind = reader.expected("the type of the connectivity")?;
        return Ok((offsets, reader.integers(size, &kind)?));
    }
    let numbers = reader.integers(size, "int")?;
    let (mut offsets, mut connectivity, mut rest) = (vec![0], Vec::new(), &numbers[..]);
    while let Some((&points, cell)) = rest.split_first() {
        let Some((points, next)) = usize::try_from(points).ok().and_then(|points| cell.split_at_checked(points)) else {
            let reason =
                format!("cell {} announces {points} points and {} numbers are left", offsets.len() - 1, cell.len());
            return Err(reader.malformed(reason));
        };
        connectivity.extend_from_slice(points);
        offsets.push(connectivity.len() as i64);
        rest = next;
    }
    match offsets.len() - 1 {
        found if found == count => Ok((offsets, connectivity)),
        found => Err(reader.error(Problem::WrongCount { what: "cells", announced: count, found })),
    }
}

fn tetrahedra(offsets: &[i64], connectivity: &[i64], kinds: &[i64], points: usize) -> Result<Vec<[usize; 4]>, Problem> {
    let cells = offsets.len().saturating_sub(1);
    if kinds.len() != cells {
        return Err(Problem::WrongCount { what: "cells", announced: kinds.len(), found: cells });
    }
    let mut tetrahedra = Vec::new();
    for (cell, (ends, &kind)) in offsets.windows(2).zip(kinds).enumerate() {
        let range = usize::try_from(ends[0]).ok().zip(usize::try_from(ends[1]).ok());
        let corners =
            range.and_then(|(start, end)| connectivity.get(start..end)).ok_or_else(|| Problem::Malformed {
                reason: format!(
                    "cell {cell} is {} to {} of a connectivity of {}",
                    ends[0],
                    ends[1],
                    connectivity.len()
                ),
            })?;
        tetrahedra.extend(cells::tetrahedron(cell, kind, corners, points)?);
    }
    Ok(tetrahedra)
}

/// `<name> <arrays>`, then `<name> <components> <tuples> <type>` and the numbers of each array.
fn skip_field(reader: &mut Reader) -> Result<(), MeshError> {
    reader.expected("the name of a field")?;
    for _ in 0..reader.count("the number of arrays of a field")? {
        reader.expected("the name of an array")?;
        let components = reader.count("the number of components")?;
        let tuples = reader.count("the number of tuples")?;
        let kind = reader.expected("the type of an array")?;
        reader.skip_array(components.saturating_mul(tuples), &kind)?;
    }
    Ok(())
}

/// The rest of a file: words and lines of text, and arrays as text or as big-endian numbers.
#[derive(Clone)]
struct Reader<'a> {
    file: &'a Path,
    bytes: &'a [u8],
    at: usize,
    is_binary: bool,
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// The line of the last word in a text file, the byte after it in a binary one.
    fn error(&self, problem: Problem) -> MeshError {
        if self.is_binary {
            return MeshError::in_byte(self.file, self.at, problem);
        }
        let line = 1 + self.bytes[..self.at].iter().filter(|&&byte| byte == b'\n').count();
        MeshError::in_line(self.file, line, problem)
    }

    fn malformed(&self, reason: String) -> MeshError {
        self.error(Problem::Malformed { reason })
    }

    fn word(&mut self) -> Option<String> {
        let blanks = self.rest().iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        let word = self.rest()[blanks..].split(|byte| byte.is_ascii_whitespace()).next().unwrap_or_default();
        self.at += blanks + word.len();
        (!word.is_empty()).then(|| String::from_utf8_lossy(word).into_owned())
    }

    fn expected(&mut self, expected: &'static str) -> Result<String, MeshError> {
        self.word().ok_or_else(|| self.error(Problem::Ends { expected }))
    }

    /// Never allocate by a count: the file may hold less.
    fn count(&mut self, expected: &'static str) -> Result<usize, MeshError> {
        let word = self.expected(expected)?;
        word.parse().map_err(|_| self.error(Problem::NotA { word, expected }))
    }

    fn line(&mut self) -> String {
        let line = self.rest().split(|&byte| byte == b'\n').next().unwrap_or_default();
        self.at = (self.at + line.len() + 1).min(self.bytes.len());
        String::from_utf8_lossy(line).trim_end().to_owned()
    }

    /// Skips up to the next empty line.
    fn skip_paragraph(&mut self) {
        self.line();
        while !self.rest().is_empty() && !self.line().is_empty() {}
    }

    fn skip_array(&mut self, count: usize, kind: &str) -> Result<(), MeshError> {
        match kind {
            _ if !self.is_binary => (0..count).try_for_each(|_| self.expected("an entry of a field").map(drop)),
            "float" | "double" => self.reals(count, kind).map(drop),
            _ => self.integers(count, kind).map(drop),
        }
    }

    fn reals(&mut self, count: usize, kind: &str) -> Result<Vec<f64>, MeshError> {
        match kind {
            _ if !self.is_binary => self.words(count, "a number"),
            "float" => self.numbers(count, |bytes| f32::from_be_bytes(bytes).into()),
            "double" => self.numbers(count, f64::from_be_bytes),
            _ => Err(self.unsupported_type(kind)),
        }
    }

    fn integers(&mut self, count: usize, kind: &str) -> Result<Vec<i64>, MeshError> {
        match kind {
            _ if !self.is_binary => self.words(count, "an integer"),
            "char" | "unsigned_char" => self.numbers(count, |[byte]| byte.into()),
            "short" | "unsigned_short" => self.numbers(count, |bytes| i16::from_be_bytes(bytes).into()),
            "int" | "unsigned_int" | "vtkIdType" | "vtktypeint32" => {
                self.numbers(count, |bytes| i32::from_be_bytes(bytes).into())
            }
            "long" | "unsigned_long" | "vtktypeint64" => self.numbers(count, i64::from_be_bytes),
            _ => Err(self.unsupported_type(kind)),
        }
    }

    fn unsupported_type(&self, kind: &str) -> MeshError {
        let found = format!("an array of the type {kind}");
        self.error(Problem::Unsupported {
            found,
            instead: "use float or double for points, int or vtktypeint64 for cells",
        })
    }

    fn words<T: std::str::FromStr>(&mut self, count: usize, expected: &'static str) -> Result<Vec<T>, MeshError> {
        let mut values = Vec::new();
        for _ in 0..count {
            let word = self.expected(expected)?;
            values.push(word.parse().map_err(|_| self.error(Problem::NotA { word, expected }))?);
        }
        Ok(values)
    }

    /// Numbers after the end of the line.
    fn numbers<T, const N: usize>(&mut self, count: usize, number: impl Fn([u8; N]) -> T) -> Result<Vec<T>, MeshError> {
        self.line();
        let array = count.checked_mul(N).and_then(|length| self.rest().get(..length)).ok_or_else(|| {
            self.malformed(format!(
                "an array of {count} numbers of {N} bytes is cut short: {} bytes are left",
                self.rest().len()
            ))
        })?;
        self.at += array.len();
        Ok(array.as_chunks().0.iter().map(|&chunk| number(chunk)).collect())
    }
}
