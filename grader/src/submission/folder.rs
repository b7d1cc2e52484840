//! The entries of a folder. Only the 22 files are read, so that build products and meshes take no time.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::MAX_FILE_BYTES;
use super::entries::{Content, DEPTH, Entry, Unreadable, is_passed_over, may_be_taken};

/// A submission with more entries than this in the folders that are looked into is refused.
const MAX_ENTRIES: usize = 10_000;

/// The entries of a folder, level by level, down to the uppermost `src` that has one of the 22 files.
pub fn entries(folder: &Path) -> Result<Vec<Entry>, Unreadable> {
    let unreadable = |error: io::Error| Unreadable(format!("the folder cannot be read: {error}"));
    let (mut found, mut room) = (Vec::new(), MAX_ENTRIES);
    let mut level = vec![(String::new(), folder.to_owned())];
    for _ in 0..=DEPTH {
        // With a `src` on this level the folders beside it, which may be large, are not looked into.
        let (sources, others): (Vec<_>, Vec<_>) = level.into_iter().partition(|(prefix, _)| prefix.ends_with("src/"));
        let mut next = Vec::new();
        for (prefix, folder) in &sources {
            next.extend(add(prefix, folder, &mut room, &mut found).map_err(unreadable)?);
        }
        if found
            .iter()
            .any(|(path, _)| may_be_taken(path) && sources.iter().any(|(prefix, _)| path.starts_with(prefix)))
        {
            break;
        }
        for (prefix, folder) in &others {
            next.extend(add(prefix, folder, &mut room, &mut found).map_err(unreadable)?);
        }
        level = next;
    }
    Ok(found)
}

/// Adds what is in a folder, and returns the folders in it that may be looked into, with their prefixes.
fn add(prefix: &str, folder: &Path, room: &mut usize, found: &mut Vec<Entry>) -> io::Result<Vec<(String, PathBuf)>> {
    let mut folders = Vec::new();
    for (name, path) in listing(folder, room)? {
        let whole = format!("{prefix}{name}");
        if is_folder(&path) && !may_be_taken(&whole) {
            if !is_passed_over(&name) {
                folders.push((format!("{whole}/"), path));
            }
            found.push((whole, Content::Unread));
        } else if whole == "src" {
            return Err(io::Error::other("src is a link or a file; hand in the folder itself"));
        } else {
            let content = if may_be_taken(&whole) { content(&path) } else { Content::Unread };
            found.push((whole, content));
        }
    }
    Ok(folders)
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
