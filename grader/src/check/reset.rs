//! Puts a function back as it was handed out.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::CheckError;
use crate::properties::FUNCTIONS;

/// Files as they were handed out, below the repository.
pub const HANDED_OUT: &str = "grader/handed_out";

/// Folder of the files that were put aside, beside `src`, which is handed in.
const KEPT: &str = "old";

/// Result of a reset.
#[derive(Debug, PartialEq, Eq)]
pub enum Done {
    /// The file is as it was handed out, and was so before.
    Unchanged,
    /// There was no file.
    New,
    /// The file that was there is kept under this name.
    Kept(PathBuf),
}

/// Puts the file of a function back, and keeps the present one in the folder `old`.
///
/// # Errors
/// The reason if no function has this name, if the repository is not one of `handout`, or if a file cannot be written.
pub fn reset(folder: &Path, name: &str) -> Result<Done, CheckError> {
    if !FUNCTIONS.iter().any(|(found, _)| *found == name) {
        return Err(CheckError::Unknown(name.to_owned()));
    }
    let (file, empty) = (folder.join(format!("src/{name}.rs")), folder.join(HANDED_OUT).join(format!("{name}.rs")));
    let text = fs::read(&empty).map_err(|error| CheckError::NotHandedOut { path: empty, error })?;
    let done = match fs::read(&file) {
        Ok(present) if present == text => return Ok(Done::Unchanged),
        Ok(present) => Done::Kept(keep(folder, name, &present)?),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Done::New,
        Err(error) => return Err(error.into()),
    };
    fs::write(&file, text)?;
    Ok(done)
}

/// Writes a text into the first of `old/NAME.rs`, `old/NAME.2.rs`, … that is free or holds it already.
fn keep(folder: &Path, name: &str, text: &[u8]) -> io::Result<PathBuf> {
    fs::create_dir_all(folder.join(KEPT))?;
    let mut number = 1;
    loop {
        let file = if number == 1 { format!("{name}.rs") } else { format!("{name}.{number}.rs") };
        let path = folder.join(KEPT).join(file);
        match fs::File::create_new(&path).and_then(|mut file| file.write_all(text)) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && fs::read(&path)? != text => number += 1,
            Err(error) if error.kind() != io::ErrorKind::AlreadyExists => return Err(error),
            _ => return Ok(path),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reset_keeps_every_earlier_file_outside_of_src_and_refuses_unknown_names() {
        let folder = tempfile::tempdir().unwrap();
        let (src, handed_out) = (folder.path().join("src"), folder.path().join(HANDED_OUT));
        fs::create_dir_all(&src).unwrap();
        let file = src.join("psi_neo_hookean.rs");
        fs::write(&file, "first").unwrap();
        assert!(reset(folder.path(), "psi_neo_hookean").is_err_and(|error| error.to_string().contains("handout")));
        fs::create_dir_all(&handed_out).unwrap();
        fs::write(handed_out.join("psi_neo_hookean.rs"), "todo").unwrap();
        let old = |name: &str| folder.path().join(KEPT).join(name);
        for (text, kept) in
            [("first", "psi_neo_hookean.rs"), ("second", "psi_neo_hookean.2.rs"), ("first", "psi_neo_hookean.rs")]
        {
            fs::write(&file, text).unwrap();
            assert_eq!(reset(folder.path(), "psi_neo_hookean").unwrap(), Done::Kept(old(kept)));
            assert_eq!(
                (fs::read_to_string(old(kept)).unwrap(), fs::read_to_string(&file).unwrap()),
                (text.into(), "todo".into())
            );
        }
        assert_eq!(reset(folder.path(), "psi_neo_hookean").unwrap(), Done::Unchanged);
        fs::remove_file(&file).unwrap();
        assert_eq!(reset(folder.path(), "psi_neo_hookean").unwrap(), Done::New);
        assert_eq!((fs::read_dir(&src).unwrap().count(), fs::read_dir(old("")).unwrap().count()), (1, 2));
        assert!(matches!(reset(folder.path(), "psi"), Err(CheckError::Unknown(_))));
    }
}
