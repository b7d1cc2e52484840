//! New folders that are created atomically.

use std::fs;
use std::io;
use std::path::{Path, PathBuf, absolute};

use thiserror::Error;

/// Reason why a folder cannot be written.
#[derive(Debug, Error)]
pub enum FolderError {
    #[error("{}: the folder is not empty; name a new one", .0.display())]
    NotEmpty(PathBuf),
    #[error("{}: is a file; name a new folder", .0.display())]
    NotAFolder(PathBuf),
    #[error("{}: {error}; name a new folder where you may write", .path.display())]
    Io { path: PathBuf, error: io::Error },
}

fn at(path: &Path) -> impl FnOnce(io::Error) -> FolderError {
    move |error| FolderError::Io { path: path.to_owned(), error }
}

/// Refuses a path at which a file or a folder with content exists.
pub fn check(to: &Path) -> Result<(), FolderError> {
    match fs::read_dir(to).map(|mut entries| entries.next().is_none()) {
        Ok(true) => Ok(()),
        Ok(false) => Err(FolderError::NotEmpty(to.to_owned())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(error) if error.kind() == io::ErrorKind::NotADirectory => Err(FolderError::NotAFolder(to.to_owned())),
        Err(error) => Err(at(to)(error)),
    }
}

/// Has `fill` write into a folder beside `to`, which is renamed to `to` when it is complete. A failure leaves no folder.
///
/// # Errors
/// Those of `fill`, and the reason if `to` exists with content or is not writable.
pub fn create<E: From<FolderError>>(to: &Path, fill: impl FnOnce(&Path) -> Result<(), E>) -> Result<(), E> {
    check(to)?;
    let to = &absolute(to).map_err(at(to))?;
    let beside = to.parent().unwrap_or(to);
    fs::create_dir_all(beside).map_err(at(to))?;
    // Only the owner may read the temporary folder; the folder inside has the usual rights.
    let partial = tempfile::Builder::new().prefix(".grader-").tempdir_in(beside).map_err(at(to))?;
    let folder = partial.path().join("new");
    fs::create_dir(&folder).map_err(at(to))?;
    fill(&folder)?;
    match fs::remove_dir(to) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(at(to)(error).into()),
        _ => fs::rename(&folder, to).map_err(at(to))?,
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn a_folder_appears_complete_or_not_at_all() {
        let base = tempfile::tempdir().unwrap();
        fs::create_dir(base.path().join("empty")).unwrap();
        for name in ["new", "empty", "deep/er"] {
            let to = base.path().join(name);
            let fill = |folder: &Path| {
                assert_ne!(folder, to);
                fs::write(folder.join("file"), "").map_err(at(folder))
            };
            create(&to, fill).unwrap();
            assert_eq!(names(&to), ["file"]);
        }
        let lost = base.path().join("lost");
        assert!(create(&lost, |folder| Err(FolderError::NotEmpty(folder.to_owned()))).is_err());
        let mut left = names(base.path());
        left.sort();
        assert_eq!(left, ["deep", "empty", "new"]);
    }

    #[test]
    fn a_file_and_a_folder_with_something_in_it_are_left_as_they_are() {
        let base = tempfile::tempdir().unwrap();
        let file = base.path().join("file");
        fs::write(&file, "mine").unwrap();
        for (to, word) in [(file.as_path(), "is a file"), (base.path(), "not empty")] {
            let problem = create(to, |_| -> Result<(), FolderError> { panic!("nothing is written") }).unwrap_err();
            assert!(problem.to_string().contains(word) && problem.to_string().contains("name a new"), "{problem}");
        }
        assert_eq!((names(base.path()), fs::read_to_string(&file).unwrap()), (vec!["file".to_owned()], "mine".into()));
    }
}
