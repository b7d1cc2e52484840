//! A submission: the files `src/NAME.rs` of the 22 functions in a folder or an archive, as text.
//!
//! Everything else – its manifest, build script, toolchain, tests – is ignored and never reaches a compiler.

pub mod entries;
mod folder;
mod mentions;
pub mod scan;
mod stub;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use sha2::{Digest, Sha256};

pub use entries::Unreadable;
pub use grader_child::NAMES;
pub use mentions::mentions;
use scan::Macros;
pub use scan::with_tokens;
pub use stub::is_stub;

/// A file may have as many bytes as this; a function of the course has a few thousand.
pub const MAX_FILE_BYTES: u64 = 1 << 20;

/// Text in the handout's empty file of a function that this assignment does not ask for.
pub const LATER: &str = "a later assignment asks for it";

/// First line of a function that an assignment gives solved.
pub const GIVEN: &str = "// Given solved in this assignment; changes in this file are not taken.\n";

/// The submission's source of one function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// Not written; the reason.
    Missing(String),
    /// Refused.
    Refused {
        /// Line, counted from one; `None` if the whole file is refused.
        line: Option<usize>,
        /// The problem and the remedy.
        reason: String,
    },
    /// The file's text, without a byte-order mark and with `\n` at the end of each line.
    Written(String),
}

/// One submission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// Its folder's or archive's name without the ending.
    pub name: String,
    /// All 22, by name.
    pub functions: BTreeMap<&'static str, Source>,
    /// A sentence for each ignored file whose author may expect otherwise.
    pub remarks: Vec<String>,
}

impl Submission {
    /// Reads a folder that holds `src/NAME.rs`, itself or in a folder in it, or `NAME.rs` alone. Never follows a symbolic link.
    pub fn read_folder(folder: &Path) -> Result<Self, Unreadable> {
        let entries = folder::entries(folder)?;
        Self::from_entries(display_name(folder), entries)
    }

    /// A hash of the files that are written or refused, in hexadecimal digits. It does not depend on the submission's name.
    pub fn hash(&self) -> String {
        let mut hasher = Sha256::new();
        for (name, source) in &self.functions {
            let (kind, text) = match source {
                Source::Missing(_) => continue,
                Source::Refused { reason, .. } => ("refused", reason),
                Source::Written(text) => ("written", text),
            };
            hasher.update(format!("{name} {kind} {}\n", text.len()));
            hasher.update(text);
        }
        hasher.finalize().iter().fold(String::new(), |mut digits, byte| {
            // Writing to a string cannot fail.
            let _ = write!(digits, "{byte:02x}");
            digits
        })
    }
}

/// The name of a folder, also if its path is `.`.
fn display_name(folder: &Path) -> String {
    let full = folder.canonicalize();
    let path = full.as_deref().unwrap_or(folder);
    path.file_name().map_or_else(|| "submission".to_owned(), |name| name.to_string_lossy().into_owned())
}

/// A file's text without a byte-order mark and with `\n` at the end of each line.
fn plain(text: &str) -> String {
    text.trim_start_matches('\u{feff}').replace("\r\n", "\n")
}

/// The macros that some files define.
fn macros<'a>(files: impl Iterator<Item = &'a [u8]>) -> Macros {
    let texts: Vec<_> = files.filter_map(|bytes| std::str::from_utf8(bytes).ok()).map(plain).collect();
    Macros::of(texts.iter().map(String::as_str))
}

/// Reads and scans one file, next to the `macros` of all files of its submission.
pub fn source(name: &str, bytes: &[u8], macros: &Macros) -> Source {
    let refused = |line, reason: &str| Source::Refused { line, reason: reason.to_owned() };
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return refused(None, "the file is larger than 1 MiB; shorten it");
    }
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => plain(text),
        Err(error) => {
            let line = bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count() + 1;
            return refused(Some(line), "the file is not UTF-8 text; save it as UTF-8");
        }
    };
    if text.trim().is_empty() {
        return Source::Missing(format!("src/{name}.rs is empty"));
    }
    if is_stub(name, &text) && text.contains(LATER) {
        return Source::Missing(LATER.to_owned());
    }
    if is_stub(name, &text) {
        return Source::Missing(format!("src/{name}.rs still holds the `todo!` of the handout"));
    }
    match scan::scan(&text, macros) {
        Some(found) => Source::Refused { line: Some(found.line), reason: found.reason },
        None => Source::Written(text),
    }
}
