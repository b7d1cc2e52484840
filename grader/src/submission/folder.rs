//! The entries of a folder. Only `src` is read, so that build products and meshes take no time.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::MAX_FILE_BYTES;
use super::entries::{Content, Entry, Unreadable, may_be_taken};

/// A submission with more entries than this in the folders that are looked into is refused.
const MAX_ENTRIES: usize = 10_000;

/// The entries of a folder, of its `src`, and of the `src` of its folders.
pub fn entries(folder: &Path) -> Result<Vec<Entry>, Unreadable> {
    let unreadable = |error: io::Error| Unreadable(format!("the folder cannot be read: {error}"));
    let mut found = Vec::new();
    let mut room = MAX_ENTRIES;
    for (name, path) in listing(folder, &mut room).map_err(unreadable)? {
        if name == "src" {
            found.extend(source_files("src/", &path, &mut room).map_err(unreadable)?);
        } else if is_folder(&path) && !name.starts_with('.') && name != "target" {
            // Possibly a wrapping folder; only its `src` is read.
            let src = path.join("src");
            if is_folder(&src) {
                found.extend(source_files(&format!("{name}/src/"), &src, &mut room).map_err(unreadable)?);
                found.extend(other_files(&format!("{name}/"), &path, &mut room).map_err(unreadable)?);
            }
            found.push((name, Content::Unread));
        } else {
            found.push((name, Content::Unread));
        }
    }
    Ok(found)
}

/// Names and paths of what is in a folder, sorted, as far as there is room for them.
fn listing(folder: &Path, room: &mut usize) -> io::Result<Vec<(String, PathBuf)>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        *room = room
            .checked_sub(1)
            .ok_or_else(|| io::Error::other(format!("it holds more than {MAX_ENTRIES} files; hand in `src` alone")))?;
        found.push((entry.file_name().to_string_lossy().into_owned(), entry.path()));
    }
    found.sort();
    Ok(found)
}

fn is_folder(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|metadata| metadata.is_dir())
}

fn other_files(prefix: &str, folder: &Path, room: &mut usize) -> io::Result<Vec<Entry>> {
    let names = listing(folder, room)?.into_iter().filter(|(name, _)| name != "src");
    Ok(names.map(|(name, _)| (format!("{prefix}{name}"), Content::Unread)).collect())
}

fn source_files(prefix: &str, folder: &Path, room: &mut usize) -> io::Result<Vec<Entry>> {
    if !is_folder(folder) {
        return Err(io::Error::other("src is a link or a file; hand in the folder itself"));
    }
    let files = listing(folder, room)?.into_iter().map(|(name, path)| {
        let whole = format!("{prefix}{name}");
        let content = if may_be_taken(&whole) { content(&path) } else { Content::Unread };
        (whole, content)
    });
    Ok(files.collect())
}

/// Reads a plain file up to the limit of its size. Other kinds of files are not opened.
fn content(path: &Path) -> Content {
    let metadata = match fs::symlink_metadata(path) {
        Ok(metadata) => metadata,
        Err(error) => return Content::Broken(error.to_string()),
    };
    if metadata.is_symlink() {
        return Content::Link;
    }
    if !metadata.is_file() {
        return Content::Broken("it is no plain file".to_owned());
    }
    if metadata.len() > MAX_FILE_BYTES {
        return Content::Unread;
    }
    let mut bytes = Vec::new();
    match fs::File::open(path).and_then(|file| file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)) {
        Ok(_) => Content::File(bytes),
        Err(error) => Content::Broken(error.to_string()),
    }
}
