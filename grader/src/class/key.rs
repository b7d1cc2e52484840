//! A hash of everything that a grade depends on: as long as it stays the same, the grade stands.

use std::fs::{self, File};
use std::io;
use std::path::Path;
use std::process::Command;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use grader::submission::{MAX_FILE_BYTES, entries};

use super::{ClassError, at};
use crate::archive::{self, MAX_ARCHIVE_BYTES};
use crate::rubric::Rubric;

/// Settings that all grades of a class share.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Identity {
    /// Hash of the grader's program.
    pub grader: String,
    /// Output of `rustc --version`.
    pub toolchain: String,
    pub seed: u64,
    /// Hash of the part of the rubric that decides what checks find. Points and deadlines are not in it: a change of them counts
    /// without a new grading.
    pub rubric: Option<String>,
    /// Further arguments of the grader.
    pub extra: Vec<String>,
}

impl Identity {
    /// Reads the program and asks the toolchain.
    pub fn of(grader: &Path, seed: u64, rubric: &Rubric, extra: &[String]) -> Result<Self, ClassError> {
        let hashed = |path: &Path| {
            let mut hash = Sha256::new();
            add_file(&mut hash, path).map_err(at(path))?;
            Ok(hex(hash))
        };
        let rubric = Some(hex(Sha256::new_with_prefix(rubric.judging())));
        Ok(Self { grader: hashed(grader)?, toolchain: toolchain()?, seed, rubric, extra: extra.to_vec() })
    }

    /// The key of one submission. Its name counts, since its reports show it: two students with one answer get two reports.
    pub fn key(&self, name: &str, submission: &Path) -> io::Result<String> {
        let mut hash = Sha256::new();
        let seed = self.seed.to_string();
        let rubric = self.rubric.as_deref().unwrap_or_default();
        for text in [&self.grader, &self.toolchain, &seed, rubric, &self.extra.join("\0"), name] {
            add(&mut hash, text.as_bytes());
        }
        add_path(&mut hash, submission, DEPTH, MAX_ARCHIVE_BYTES)?;
        Ok(hex(hash))
    }
}

/// The shard, from 1 to n, of a student: the same on every machine and in every class.
pub fn shard(student: &str, n: usize) -> usize {
    let digest = Sha256::digest(student.as_bytes());
    let rest = digest.iter().fold(0, |rest: u128, byte| (rest * 256 + u128::from(*byte)) % n as u128);
    rest as usize + 1
}

fn toolchain() -> Result<String, ClassError> {
    let output = Command::new("rustc").arg("--version").output().map_err(|e| ClassError::Toolchain(e.to_string()))?;
    if !output.status.success() {
        return Err(ClassError::Toolchain(output.status.to_string()));
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_string())
}

/// Adds bytes with their length, so that different lists of texts have different hashes.
fn add(hash: &mut Sha256, bytes: &[u8]) {
    hash.update((bytes.len() as u64).to_le_bytes());
    hash.update(bytes);
}

fn add_file(hash: &mut Sha256, path: &Path) -> io::Result<()> {
    let mut file = File::open(path)?;
    hash.update(file.metadata()?.len().to_le_bytes());
    let mut block = vec![0; 1 << 16];
    loop {
        let read = io::Read::read(&mut file, &mut block)?;
        if read == 0 {
            return Ok(());
        }
        hash.update(&block[..read]);
    }
}

/// A grader looks for `NAME.rs` in so many folders of a submission and no deeper.
const DEPTH: usize = entries::DEPTH + 1;

/// With more entries than this, a grader looks at none of a folder.
const MOST_ENTRIES: usize = 10_000;

/// Adds the files below `path` that a grader may look at, by name; of those that are larger than it reads, the size alone.
/// Of a link its path is hashed: links are not followed, because their targets may be outside the submission.
fn add_path(hash: &mut Sha256, path: &Path, depth: usize, largest: u64) -> io::Result<()> {
    let metadata = fs::symlink_metadata(path)?;
    let kind = metadata.file_type();
    if kind.is_symlink() {
        add(hash, b"link");
        add(hash, fs::read_link(path)?.as_os_str().as_encoded_bytes());
    } else if kind.is_dir() {
        add(hash, b"folder");
        let most = if depth == 0 { 0 } else { MOST_ENTRIES + 1 };
        let listing = fs::read_dir(path)?.take(most);
        let mut names = listing.map(|entry| Ok(entry?.file_name())).collect::<io::Result<Vec<_>>>()?;
        if names.len() > MOST_ENTRIES {
            add(hash, b"too many");
            return Ok(());
        }
        // Folders of cargo and git are large and never graded.
        names.retain(|name| !entries::is_passed_over(&name.to_string_lossy()) || !path.join(name).is_dir());
        names.sort();
        hash.update((names.len() as u64).to_le_bytes());
        for name in names {
            add(hash, name.as_encoded_bytes());
            let is_archive = archive::stem(&name.to_string_lossy()).is_some();
            let largest = if is_archive { MAX_ARCHIVE_BYTES } else { MAX_FILE_BYTES };
            add_path(hash, &path.join(name), depth - 1, largest)?;
        }
    } else if kind.is_file() {
        add(hash, b"file");
        if metadata.len() > largest {
            hash.update(metadata.len().to_le_bytes());
        } else {
            add_file(hash, path)?;
        }
    } else {
        // Reading a pipe or a device could never end, and it is no submission.
        add(hash, b"other");
    }
    Ok(())
}

fn hex(hash: Sha256) -> String {
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
