//! The folder that a grader works in. It is removed with the grader, or, if that was killed, by the next one.

use std::env;
use std::fs::{self, File};
use std::io;
use std::path::Path;

use tempfile::TempDir;

const PREFIX: &str = "grader-";

/// File in the folder that a grader locks for its lifetime.
const LOCK: &str = "lock";

/// Parent of the folders of the programs.
pub struct Workspace {
    folder: TempDir,
    /// Released by the system when this process ends, however it ends.
    _lock: File,
}

impl Workspace {
    /// Makes the folder, and removes those of graders that are gone.
    pub fn new() -> io::Result<Self> {
        let place = env::temp_dir();
        sweep(&place);
        Self::new_in(&place)
    }

    fn new_in(place: &Path) -> io::Result<Self> {
        let folder = passable(tempfile::Builder::new().prefix(PREFIX)).tempdir_in(place)?;
        // The file gets its name only after its owner has locked it.
        let early = folder.path().join("early");
        let lock = File::create(&early)?;
        // Some network file systems have no locks; there no grader removes the folder of another.
        let _ = lock.try_lock();
        fs::rename(early, folder.path().join(LOCK))?;
        Ok(Self { folder, _lock: lock })
    }

    /// A folder for one program, removed in the end.
    pub fn folder(&self) -> io::Result<TempDir> {
        tempfile::tempdir_in(self.folder.path())
    }
}

/// The program's user must pass through to its own folder, whose name it cannot list.
#[cfg(unix)]
fn passable<'a, 'b>(builder: &'a mut tempfile::Builder<'b, 'b>) -> &'a tempfile::Builder<'b, 'b> {
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o711))
}

#[cfg(not(unix))]
fn passable<'a, 'b>(builder: &'a mut tempfile::Builder<'b, 'b>) -> &'a tempfile::Builder<'b, 'b> {
    builder
}

/// Removes the folders of killed graders of this user in a place. The next grader tries again to remove those that remain.
fn sweep(place: &Path) {
    for entry in fs::read_dir(place).into_iter().flatten().flatten() {
        let path = entry.path();
        let is_ours = entry.file_name().to_string_lossy().starts_with(PREFIX) && is_own_folder(&path);
        if is_ours && is_abandoned(&path) {
            let _ = remove(&path);
        }
    }
}

fn is_abandoned(folder: &Path) -> bool {
    File::open(folder.join(LOCK)).is_ok_and(|lock| lock.try_lock().is_ok())
}

/// Removes the lock last, so that a folder which was removed in part is found again.
fn remove(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)?.flatten().filter(|entry| entry.file_name() != LOCK) {
        fs::remove_dir_all(entry.path())?;
    }
    fs::remove_dir_all(folder)
}

#[cfg(unix)]
fn is_own_folder(path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    // Only locks of this user are opened, and links are not followed.
    fs::symlink_metadata(path).is_ok_and(|found| found.is_dir() && found.uid() == nix::unistd::geteuid().as_raw())
}

#[cfg(not(unix))]
fn is_own_folder(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| found.is_dir())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_folder_of_a_killed_grader_is_removed_and_that_of_a_living_one_stays() {
        let place = tempfile::tempdir().unwrap();
        let living = Workspace::new_in(place.path()).unwrap();
        let program = living.folder().unwrap();
        let left = Workspace::new_in(place.path()).unwrap();
        fs::write(left.folder().unwrap().keep().join("program"), "").unwrap();
        let Workspace { folder, _lock: lock } = left;
        let left = folder.keep();
        drop(lock);
        for other in ["grader-notes", "mine"] {
            fs::create_dir(place.path().join(other)).unwrap();
        }
        fs::write(place.path().join("mine").join(LOCK), "").unwrap();
        sweep(place.path());
        assert!(!left.exists() && program.path().exists());
        assert!(place.path().join("grader-notes").exists() && place.path().join("mine").exists());
        drop((program, living));
        assert_eq!(fs::read_dir(place.path()).unwrap().count(), 2);
    }
}
