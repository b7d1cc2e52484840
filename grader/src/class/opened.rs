//! A class as a folder, or as the archive that a platform gives for download.

use std::fs::{self, File};
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use zip::ZipArchive;

use super::{ClassError, at};

/// All files of a class, bytes.
const MOST_BYTES: u64 = 8 << 30;

/// Files and folders of a class.
const MOST_ENTRIES: usize = 200_000;

/// The folder of a class. That of an archive is temporary, and is removed with this value.
pub struct Opened {
    pub folder: PathBuf,
    _unpacked: Option<TempDir>,
}

/// Unpacks a class that is a `.zip`, and takes a folder as it is.
pub fn open(class: &Path) -> Result<Opened, ClassError> {
    let is_zip = class.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("zip"));
    if !(is_zip && class.is_file()) {
        return Ok(Opened { folder: class.to_owned(), _unpacked: None });
    }
    let room = tempfile::tempdir().map_err(at(class))?;
    unpack(class, room.path()).map_err(at(class))?;
    Ok(Opened { folder: room.path().to_owned(), _unpacked: Some(room) })
}

/// Writes the files of an archive below `room`. Links are left out, and a path that leads out of the archive is refused.
fn unpack(archive: &Path, room: &Path) -> io::Result<()> {
    let mut archive = ZipArchive::new(BufReader::new(File::open(archive)?)).map_err(io::Error::other)?;
    if archive.len() > MOST_ENTRIES {
        return Err(io::Error::other(format!(
            "it holds more than {MOST_ENTRIES} files; unpack it, and name the folder"
        )));
    }
    let mut left = MOST_BYTES;
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).map_err(io::Error::other)?;
        let Some(path) = entry.enclosed_name() else {
            return Err(io::Error::other("it holds a path that leads out of it; download it again"));
        };
        let place = room.join(path);
        if entry.is_dir() {
            fs::create_dir_all(&place)?;
        } else if !entry.is_symlink() {
            fs::create_dir_all(place.parent().unwrap_or(room))?;
            let copied = io::copy(&mut entry.by_ref().take(left + 1), &mut File::create_new(&place)?)?;
            left = left.checked_sub(copied).ok_or_else(|| {
                io::Error::other(format!(
                    "it unpacks to more than {} GiB; unpack it, and name the folder",
                    MOST_BYTES >> 30
                ))
            })?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use zip::write::SimpleFileOptions;

    use super::*;

    fn opened(paths: &[&str]) -> Result<Opened, ClassError> {
        let folder = tempfile::tempdir().unwrap();
        let archive = folder.path().join("submissions.ZIP");
        let mut zip = zip::ZipWriter::new(File::create(&archive).unwrap());
        for path in paths {
            zip.start_file(*path, SimpleFileOptions::default()).unwrap();
            zip.write_all(b"text").unwrap();
        }
        zip.finish().unwrap();
        open(&archive)
    }

    #[test]
    fn a_class_in_an_archive_is_unpacked_as_long_as_it_is_needed() {
        let class = opened(&["Jane Doe_1_assignsubmission_file_/src/psi_neo_hookean.rs", "roster.csv"]).unwrap();
        let folder = class.folder.clone();
        assert_eq!(fs::read(folder.join("Jane Doe_1_assignsubmission_file_/src/psi_neo_hookean.rs")).unwrap(), b"text");
        drop(class);
        assert!(!folder.exists());
        assert!(opened(&["../evil.rs"]).is_err_and(|error| error.to_string().contains("leads out")));
        let place = tempfile::tempdir().unwrap();
        assert_eq!(open(place.path()).unwrap().folder, place.path());
    }
}
