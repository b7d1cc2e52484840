//! The arrays of a VTK file: as text, as base64, or appended at the end, uncompressed or compressed by zlib.

use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::HashSet;
use std::io::Read;
use std::path::Path;

use base64::prelude::{BASE64_STANDARD, Engine};
use flate2::read::ZlibDecoder;
use roxmltree::Node;

use super::super::MOST_UNPACKED;
use crate::{MeshError, Problem};

/// The content of `<AppendedData>` after its underscore.
type Appended<'a> = &'a [u8];

/// Closes the file's elements after the appended data, which need not be text, has been cut off.
const CLOSE: &str = "</AppendedData></VTKFile>";

const ASCII: &str = "save it with little-endian data, uncompressed or packed by zlib (in ParaView: Data Mode Ascii)";

/// Separates a file into XML and appended data.
pub(super) fn split_appended<'a>(file: &Path, bytes: &'a [u8]) -> Result<(Cow<'a, str>, Appended<'a>), MeshError> {
    let tag = find(bytes, b"<AppendedData");
    let open = tag.and_then(|tag| find(&bytes[tag..], b">").map(|end| tag + end + 1));
    let (xml, rest) = bytes.split_at(open.unwrap_or(bytes.len()));
    let reason = "its XML is not UTF-8".to_owned();
    let xml = str::from_utf8(xml).map_err(|_| MeshError::in_file(file, Problem::Malformed { reason }))?;
    let data = find(rest, b"_").map_or(&rest[rest.len()..], |underscore| &rest[underscore + 1..]);
    let xml = xml.trim_start_matches('\u{feff}');
    Ok((if open.is_some() { Cow::Owned(xml.to_owned() + CLOSE) } else { Cow::Borrowed(xml) }, data))
}

fn find(bytes: &[u8], pattern: &[u8]) -> Option<usize> {
    bytes.windows(pattern.len()).position(|window| window == pattern)
}

/// Storage of the arrays of a file.
pub(super) struct Arrays<'a> {
    file: &'a Path,
    appended: Appended<'a>,
    /// The appended data is text in base64.
    appended_base64: bool,
    /// Offsets of the arrays in the appended data, ascending.
    starts: Vec<usize>,
    /// Offsets that have been read.
    read: RefCell<HashSet<usize>>,
    /// Bytes of each count before the data: 4 or 8.
    header: usize,
    zlib: bool,
    /// The reason why arrays that are not text cannot be read.
    unsupported: Option<String>,
}

impl<'a> Arrays<'a> {
    pub(super) fn new(file: &'a Path, root: Node, appended: Appended<'a>) -> Self {
        let (zlib, unsupported) = match (root.attribute("byte_order"), root.attribute("compressor")) {
            (Some("BigEndian"), _) => (false, Some("big-endian data".to_owned())),
            (_, None | Some("")) => (false, None),
            (_, Some("vtkZLibDataCompressor")) => (true, None),
            (_, Some(other)) => (false, Some(format!("the compressor {other}"))),
        };
        let header = if root.attribute("header_type") == Some("UInt64") { 8 } else { 4 };
        let encoding = root.children().find(|node| node.has_tag_name("AppendedData"));
        let appended_base64 = encoding.is_some_and(|node| node.attribute("encoding") != Some("raw"));
        let mut starts: Vec<usize> =
            root.descendants().filter_map(|node| node.attribute("offset")?.parse().ok()).collect();
        starts.sort_unstable();
        Self { file, appended, appended_base64, starts, read: RefCell::default(), header, zlib, unsupported }
    }

    /// A problem at a node of the file.
    pub(super) fn error(&self, node: Node, problem: Problem) -> MeshError {
        let line = node.document().text_pos_at(node.range().start).row as usize;
        MeshError::in_line(self.file, line, problem)
    }

    fn malformed(&self, node: Node, reason: String) -> MeshError {
        self.error(node, Problem::Malformed { reason })
    }

    /// The first child of that name.
    pub(super) fn child<'n>(&self, node: Node<'n, 'n>, name: &str) -> Result<Node<'n, 'n>, MeshError> {
        let child = node.children().find(|child| child.has_tag_name(name));
        child.ok_or_else(|| self.malformed(node, format!("{} has no {name}", node.tag_name().name())))
    }

    /// The child array of that name.
    pub(super) fn named<'n>(&self, node: Node<'n, 'n>, name: &str) -> Result<Node<'n, 'n>, MeshError> {
        let child = node.children().find(|child| child.attribute("Name") == Some(name));
        child.ok_or_else(|| self.malformed(node, format!("{} has no array {name}", node.tag_name().name())))
    }

    /// Returns an error if the file announces another count than it has.
    pub(super) fn check_count(
        &self,
        node: Node,
        attribute: &str,
        what: &'static str,
        found: usize,
    ) -> Result<(), MeshError> {
        match node.attribute(attribute).map(|word| (word, word.trim().parse::<usize>())) {
            None => Ok(()),
            Some((_, Ok(announced))) if announced == found => Ok(()),
            Some((_, Ok(announced))) => Err(self.error(node, Problem::WrongCount { what, announced, found })),
            Some((word, Err(_))) => {
                Err(self.error(node, Problem::NotA { word: word.to_owned(), expected: "a number of entries" }))
            }
        }
    }

    /// The numbers of a floating-point array.
    pub(super) fn floats(&self, array: Node) -> Result<Vec<f64>, MeshError> {
        if array.attribute("format") == Some("ascii") {
            return self.words(array, "a number");
        }
        let bytes = self.bytes(array)?;
        match array.attribute("type") {
            Some("Float32") => Ok(numbers(&bytes, |b| f32::from_le_bytes(b).into())),
            Some("Float64") => Ok(numbers(&bytes, f64::from_le_bytes)),
            other => Err(self.unsupported_type(array, other)),
        }
    }

    /// The numbers of an integer array.
    pub(super) fn integers(&self, array: Node) -> Result<Vec<i64>, MeshError> {
        if array.attribute("format") == Some("ascii") {
            return self.words(array, "an integer");
        }
        let bytes = self.bytes(array)?;
        match array.attribute("type") {
            Some("Int8") => Ok(numbers(&bytes, |b| i8::from_le_bytes(b).into())),
            Some("UInt8") => Ok(numbers(&bytes, |b| u8::from_le_bytes(b).into())),
            Some("Int16") => Ok(numbers(&bytes, |b| i16::from_le_bytes(b).into())),
            Some("UInt16") => Ok(numbers(&bytes, |b| u16::from_le_bytes(b).into())),
            Some("Int32") => Ok(numbers(&bytes, |b| i32::from_le_bytes(b).into())),
            Some("UInt32") => Ok(numbers(&bytes, |b| u32::from_le_bytes(b).into())),
            Some("Int64") => Ok(numbers(&bytes, i64::from_le_bytes)),
            // A number that does not fit becomes a negative one, which is no index either.
            Some("UInt64") => Ok(numbers(&bytes, |b| u64::from_le_bytes(b) as i64)),
            other => Err(self.unsupported_type(array, other)),
        }
    }

    fn unsupported_type(&self, array: Node, found: Option<&str>) -> MeshError {
        let found = format!("an array of the type {}", found.unwrap_or("(none)"));
        let instead = "use Float32 or Float64 for points, Int32, Int64 or UInt8 for cells";
        self.error(array, Problem::Unsupported { found, instead })
    }

    fn words<T: std::str::FromStr>(&self, array: Node, expected: &'static str) -> Result<Vec<T>, MeshError> {
        let not_a = |word: &str| self.error(array, Problem::NotA { word: word.to_owned(), expected });
        let text = text_of(array);
        text.split_whitespace().map(|word| word.parse().map_err(|_| not_a(word))).collect()
    }

    fn bytes(&self, array: Node) -> Result<Vec<u8>, MeshError> {
        if let Some(found) = self.unsupported.clone() {
            return Err(self.error(array, Problem::Unsupported { found, instead: ASCII }));
        }
        let stored = match array.attribute("format") {
            Some("binary") => decode_base64(text_of(array).as_bytes()).map(Cow::Owned),
            Some("appended") => self.appended_bytes(array),
            _ => Err("an array is neither ascii nor binary nor appended".to_owned()),
        };
        let unpack =
            |bytes: Cow<[u8]>| if self.zlib { unzip(&bytes, self.header) } else { uncount(bytes, self.header) };
        stored.and_then(unpack).map_err(|reason| self.malformed(array, reason))
    }

    fn appended_bytes(&self, array: Node) -> Result<Cow<'a, [u8]>, String> {
        let offset = array.attribute("offset").and_then(|word| word.parse::<usize>().ok());
        let offset =
            offset.filter(|&offset| offset < self.appended.len()).ok_or("an array's offset is not in the file")?;
        // Arrays at one place could stand for more memory than the file has.
        if !self.read.borrow_mut().insert(offset) {
            return Err("two arrays have the same offset".to_owned());
        }
        let next = self.starts.iter().copied().find(|&start| start > offset).unwrap_or(usize::MAX);
        let data = &self.appended[offset..next.min(self.appended.len())];
        if !self.appended_base64 {
            return Ok(Cow::Borrowed(data));
        }
        decode_base64(data.split(|&byte| byte == b'<').next().unwrap_or(data)).map(Cow::Owned)
    }
}

/// All text of an array; its other children describe it.
fn text_of<'a>(array: Node<'a, 'a>) -> Cow<'a, str> {
    let mut texts = array.children().filter(Node::is_text).filter_map(|node| node.text());
    let first = Cow::Borrowed(texts.next().unwrap_or_default());
    texts.fold(first, |text, more| text + more)
}

/// VTK may encode counts and data one after the other, so padding can stand in the middle.
fn decode_base64(text: &[u8]) -> Result<Vec<u8>, String> {
    let mut text = Cow::Borrowed(text.trim_ascii());
    if text.iter().any(u8::is_ascii_whitespace) {
        text.to_mut().retain(|byte| !byte.is_ascii_whitespace());
    }
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let mut rest = &text[..];
    while !rest.is_empty() {
        // padding fills the last group of four of what was encoded at once
        let padding = rest.iter().position(|&byte| byte == b'=').unwrap_or(rest.len());
        let (segment, next) = rest.split_at((padding / 4 * 4 + 4).min(rest.len()));
        let decoded = BASE64_STANDARD.decode_vec(segment, &mut bytes);
        decoded.map_err(|error| format!("an array is not base64 ({error})"))?;
        rest = next;
    }
    Ok(bytes)
}

/// A count of bytes, then as many bytes.
fn uncount(bytes: Cow<[u8]>, width: usize) -> Result<Vec<u8>, String> {
    let length = count(&bytes, 0, width)?;
    let end = width.checked_add(length).filter(|&end| end <= bytes.len());
    let end = end.ok_or_else(|| format!("an array announces {length} bytes and has {}", bytes.len() - width))?;
    Ok(match bytes {
        Cow::Borrowed(bytes) => bytes[width..end].to_vec(),
        Cow::Owned(mut bytes) => {
            bytes.truncate(end);
            bytes.drain(..width);
            bytes
        }
    })
}

/// Counts: blocks, bytes of each, bytes of the last (0: as the others), packed bytes of each; then the packed blocks.
fn unzip(bytes: &[u8], width: usize) -> Result<Vec<u8>, String> {
    if count(bytes, 0, width)? == 0 {
        return Ok(Vec::new());
    }
    let (blocks, size, last) = (count(bytes, 0, width)?, count(bytes, 1, width)?, count(bytes, 2, width)?);
    let mut start =
        blocks.checked_add(3).and_then(|counts| counts.checked_mul(width)).ok_or("an array's header is broken")?;
    let mut unpacked = Vec::new();
    for block in 0..blocks {
        let end = start.checked_add(count(bytes, 3 + block, width)?);
        let packed = end.and_then(|end| bytes.get(start..end)).ok_or("a packed array is cut short")?;
        start += packed.len();
        let expected = if block + 1 == blocks && last > 0 { last } else { size };
        if expected as u64 > MOST_UNPACKED.saturating_mul(packed.len() as u64) {
            return Err("a packed array announces far too many bytes".to_owned());
        }
        let found = ZlibDecoder::new(packed).take(expected as u64).read_to_end(&mut unpacked);
        let found = found.map_err(|error| format!("a packed array is damaged ({error})"))?;
        if found != expected {
            return Err(format!("a packed array announces {expected} bytes and has {found}"));
        }
    }
    Ok(unpacked)
}

/// The i-th count before an array.
fn count(bytes: &[u8], i: usize, width: usize) -> Result<usize, String> {
    let start = i.checked_mul(width).ok_or("an array's header is broken")?;
    let bytes = bytes.get(start..).and_then(|rest| rest.get(..width)).ok_or("an array is cut short")?;
    let value = bytes.iter().rev().fold(0_u64, |value, &byte| value << 8 | u64::from(byte));
    usize::try_from(value).map_err(|_| "an array's count is too large".to_owned())
}

fn numbers<T, const N: usize>(bytes: &[u8], number: impl Fn([u8; N]) -> T) -> Vec<T> {
    bytes.as_chunks().0.iter().map(|&chunk| number(chunk)).collect()
}
