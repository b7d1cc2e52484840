//! Submissions as archives: `.zip`, `.tar.gz`, `.tgz` and `.tar`, unpacked into memory, within limits, and never onto the disk.

use std::fs::{DirEntry, File};
use std::io::{self, Read};
use std::path::Path;

use flate2::read::MultiGzDecoder;
use grader::submission::entries::{Content, Entry, may_be_taken};
use grader::submission::{MAX_FILE_BYTES, Source, Submission, Unreadable};

/// All that is unpacked of one archive, bytes.
const MAX_BYTES: u64 = 64 << 20;

/// The largest archive that is opened, bytes: a table of contents is read whole.
pub const MAX_ARCHIVE_BYTES: u64 = 128 << 20;

/// The longest path in an archive, bytes.
const MAX_PATH_BYTES: usize = 1024;

/// Files, folders and links of one archive.
const MAX_ENTRIES: usize = 10_000;

/// The endings of archives, longest first.
const ENDINGS: [&str; 4] = [".tar.gz", ".tgz", ".tar", ".zip"];

/// Reads a submission: a folder, an archive, or a folder with an archive in it, as Moodle gives one for each student.
pub fn read_submission(path: &Path) -> Result<Submission, Unreadable> {
    if !path.is_dir() {
        return read_archive(path);
    }
    let refused = match Submission::read_folder(path) {
        Ok(submission) if submission.functions.values().any(|source| !matches!(source, Source::Missing(_))) => {
            return Ok(submission);
        }
        refused => refused,
    };
    let archives = archives_in(path);
    let Some(archive) = latest(&archives) else {
        return match archives.len() {
            0 => refused,
            _ => Err(unreadable(format!("it holds several archives ({}); hand in one", archives.join(", ")))),
        };
    };
    let mut submission = read_archive(&path.join(archive))?;
    submission.name = name(path);
    Ok(submission)
}

/// The archives in a folder, by name.
fn archives_in(folder: &Path) -> Vec<String> {
    let Ok(listing) = folder.read_dir() else { return Vec::new() };
    let is_file = |entry: &DirEntry| entry.file_type().is_ok_and(|kind| kind.is_file());
    let names = listing.flatten().filter(is_file).map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut names: Vec<_> = names.filter(|name| !name.starts_with('.') && stem(name).is_some()).collect();
    names.sort();
    names
}

/// The last attempt among archives of one name; `None` among different names.
fn latest(archives: &[String]) -> Option<&String> {
    let numbered = |name: &String| attempt(stem(name).map_or(name, |(stem, _)| stem)).1;
    let base = |name: &String| attempt(stem(name).map_or(name, |(stem, _)| stem)).0.to_owned();
    let is_same = archives.windows(2).all(|pair| base(&pair[0]) == base(&pair[1]));
    archives.iter().filter(|_| is_same).max_by_key(|name| numbered(name))
}

/// A name without the number that a browser adds to a second download or upload of it, as in `anna (1)`, and that number.
pub fn attempt(name: &str) -> (&str, u64) {
    let parts = name.strip_suffix(')').and_then(|rest| rest.rsplit_once('('));
    let parts = parts.map(|(base, number)| (base.trim_end(), number.parse()));
    match parts {
        Some((base, Ok(number))) if !base.is_empty() => (base, number),
        _ => (name, 0),
    }
}

fn read_archive(path: &Path) -> Result<Submission, Unreadable> {
    let Some((name, ending)) = ending(path) else {
        return Err(unreadable("it is neither a folder nor a .zip, .tar.gz, .tgz or .tar; hand in one of these"));
    };
    let file = File::open(path).map_err(|error| unreadable(format!("it cannot be opened: {error}")))?;
    let is_large = file.metadata().is_ok_and(|metadata| metadata.len() > MAX_ARCHIVE_BYTES);
    if is_large {
        return Err(unreadable("the archive is larger than 128 MiB; hand in `src` alone"));
    }
    let entries = match ending {
        ".zip" => zip_entries(file),
        ".tar" => tar_entries(file),
        _ => tar_entries(MultiGzDecoder::new(file)),
    };
    Submission::from_entries(name, entries?)
}

/// The name of a submission: its file name without the ending of an archive.
pub fn name(path: &Path) -> String {
    let full = path.canonicalize();
    let path = full.as_deref().unwrap_or(path);
    let whole = || path.file_name().map_or_else(|| "submission".to_owned(), |name| name.to_string_lossy().into_owned());
    ending(path).map_or_else(whole, |(name, _)| name)
}

/// A path's file name without the ending of an archive, and that ending.
fn ending(path: &Path) -> Option<(String, &'static str)> {
    let name = path.file_name()?.to_string_lossy().into_owned();
    stem(&name).map(|(stem, ending)| (stem.to_owned(), ending))
}

/// A file's name without the ending of an archive, and that ending.
pub fn stem(name: &str) -> Option<(&str, &'static str)> {
    let lower = name.to_ascii_lowercase();
    // Lower case has the same length, in ASCII.
    let ending = ENDINGS.into_iter().find(|ending| lower.ends_with(ending) && lower.len() > ending.len())?;
    Some((name.get(..name.len() - ending.len())?, ending))
}

fn unreadable(reason: impl Into<String>) -> Unreadable {
    Unreadable(reason.into())
}

fn broken(error: impl ToString) -> Unreadable {
    let why: String = error.to_string().chars().filter(|c| !c.is_control()).take(200).collect();
    unreadable(format!("the archive is damaged: {why}; pack it again"))
}

/// Counts what is unpacked, and stops at the limits.
struct Unpacked {
    entries: Vec<Entry>,
    bytes: u64,
}

impl Unpacked {
    fn new() -> Self {
        Self { entries: Vec::new(), bytes: 0 }
    }

    /// Adds an entry; `content` is only read where it may be taken.
    fn add(&mut self, path: &str, is_link: bool, content: impl Read) -> Result<(), Unreadable> {
        if self.entries.len() >= MAX_ENTRIES {
            return Err(unreadable(format!("the archive holds more than {MAX_ENTRIES} files; hand in `src` alone")));
        }
        let path = inner_path(path)?;
        let content = match (is_link, may_be_taken(&path)) {
            (true, _) => Content::Link,
            (false, false) => Content::Unread,
            (false, true) => self.read(content)?,
        };
        self.entries.push((path, content));
        Ok(())
    }

    fn read(&mut self, content: impl Read) -> Result<Content, Unreadable> {
        let mut bytes = Vec::new();
        content.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(broken)?;
        self.count(bytes.len() as u64)?;
        Ok(if bytes.len() as u64 > MAX_FILE_BYTES { Content::Unread } else { Content::File(bytes) })
    }

    fn count(&mut self, bytes: u64) -> Result<(), Unreadable> {
        self.bytes = self.bytes.saturating_add(bytes);
        match self.bytes <= MAX_BYTES {
            true => Ok(()),
            false => Err(unreadable("the archive unpacks to more than 64 MiB; hand in `src` alone")),
        }
    }
}

/// A path in an archive with `/` between its parts and no `./`. An archive with a path out of it is refused as a
/// whole, because such paths are not packed by accident.
fn inner_path(path: &str) -> Result<String, Unreadable> {
    if path.len() > MAX_PATH_BYTES {
        return Err(unreadable("the archive holds a path of more than 1024 bytes; hand in `src` alone"));
    }
    let path = path.replace('\\', "/");
    let has_drive = path.as_bytes().get(1) == Some(&b':');
    let mut parts = path.split('/');
    if path.starts_with('/') || has_drive || parts.any(|part| part == "..") {
        return Err(unreadable("the archive holds a path that leads out of it; pack it again from the folder itself"));
    }
    let parts: Vec<_> = path.split('/').filter(|part| !part.is_empty() && *part != ".").collect();
    Ok(parts.join("/"))
}

fn zip_entries(file: File) -> Result<Vec<Entry>, Unreadable> {
    let mut archive = zip::ZipArchive::new(io::BufReader::new(file)).map_err(broken)?;
    if archive.has_duplicate_names() {
        // Of several entries with one name, this library shows only the last; other programs show the first.
        return Err(unreadable("the archive holds a file twice under one path; pack it again from the folder itself"));
    }
    let mut unpacked = Unpacked::new();
    for index in 0..archive.len() {
        let raw = archive.by_index_raw(index).map_err(broken)?;
        let (path, is_folder, is_encrypted) = (raw.name().map_err(broken)?.into_owned(), raw.is_dir(), raw.encrypted());
        let is_link = raw.is_symlink();
        drop(raw);
        if is_folder {
            continue;
        }
        if is_encrypted {
            return Err(unreadable("the archive asks for a password; pack it without"));
        }
        if is_link || !may_be_taken(&inner_path(&path)?) {
            unpacked.add(&path, is_link, io::empty())?;
        } else {
            let content = archive.by_index(index).map_err(broken)?;
            unpacked.add(&path, false, content)?;
        }
    }
    Ok(unpacked.entries)
}

fn tar_entries(stream: impl Read) -> Result<Vec<Entry>, Unreadable> {
    // All data between the files of a submission must be unpacked, so the stream itself is limited.
    let mut archive = tar::Archive::new(stream.take(MAX_BYTES));
    let mut unpacked = Unpacked::new();
    for entry in archive.entries().map_err(broken)? {
        let entry = entry.map_err(broken)?;
        unpacked.count(entry.size())?;
        let kind = entry.header().entry_type();
        let path = String::from_utf8_lossy(&entry.path_bytes()).into_owned();
        if kind.is_file() || kind.is_contiguous() || kind.is_gnu_sparse() {
            unpacked.add(&path, false, entry)?;
        } else if !kind.is_dir() && !kind.is_pax_global_extensions() {
            unpacked.add(&path, true, io::empty())?;
        }
    }
    if unpacked.entries.is_empty() {
        return Err(unreadable("the archive is empty or damaged; pack it again"));
    }
    Ok(unpacked.entries)
}

#[cfg(test)]
mod tests;
