//! Puts a function back as it was handed out.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::CheckError;
use crate::properties::FUNCTIONS;

/// Files as they were handed out, below the repository.
pub const HANDED_OUT: &str = "grader/handed_out";

/// Puts the file of a function back, and keeps the present one beside it, under the name that is returned.
///
/// # Errors
/// The reason if no function has this name, if the repository is not one of `handout`, or if a file cannot be written.
pub fn reset(folder: &Path, name: &str) -> Result<Option<PathBuf>, CheckError> {
    if !FUNCTIONS.iter().any(|(found, _)| *found == name) {
        return Err(CheckError::Unknown(name.to_owned()));
    }
    let (file, empty) = (folder.join(format!("src/{name}.rs")), folder.join(HANDED_OUT).join(format!("{name}.rs")));
    let text = fs::read(&empty).map_err(|error| CheckError::NotHandedOut { path: empty, error })?;
    let kept = if file.exists() { Some(keep(&file)?) } else { None };
    fs::write(&file, text)?;
    Ok(kept)
}

/// Renames a file to the first free one of NAME.rs.old, NAME.rs.old2, …
fn keep(file: &Path) -> io::Result<PathBuf> {
    let names = (1..).map(|n: usize| if n == 1 { "rs.old".to_owned() } else { format!("rs.old{n}") });
    let mut paths = names.map(|ending| file.with_extension(ending));
    let free = paths.find(|path| !path.exists()).unwrap_or_else(|| file.with_extension("rs.old"));
    fs::rename(file, &free)?;
    Ok(free)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reset_keeps_every_earlier_file_and_refuses_unknown_names() {
        let folder = tempfile::tempdir().unwrap();
        let (src, handed_out) = (folder.path().join("src"), folder.path().join(HANDED_OUT));
        fs::create_dir_all(&src).unwrap();
        let file = src.join("psi_neo_hookean.rs");
        fs::write(&file, "first").unwrap();
        assert!(reset(folder.path(), "psi_neo_hookean").is_err_and(|error| error.to_string().contains("handout")));
        fs::create_dir_all(&handed_out).unwrap();
        fs::write(handed_out.join("psi_neo_hookean.rs"), "todo").unwrap();
        assert_eq!(reset(folder.path(), "psi_neo_hookean").unwrap(), Some(src.join("psi_neo_hookean.rs.old")));
        fs::write(&file, "second").unwrap();
        reset(folder.path(), "psi_neo_hookean").unwrap();
        let read = |name: &str| fs::read_to_string(src.join(name)).unwrap();
        assert_eq!(read("psi_neo_hookean.rs"), "todo");
        assert_eq!(
            (read("psi_neo_hookean.rs.old"), read("psi_neo_hookean.rs.old2")),
            ("first".into(), "second".into())
        );
        assert!(matches!(reset(folder.path(), "psi"), Err(CheckError::Unknown(_))));
    }
}
