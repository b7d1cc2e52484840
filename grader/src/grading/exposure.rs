//! Refuses a repository that the compiler of a submission could read, because it holds the solutions.

use std::path::{Path, PathBuf};

/// The first of the `secrets` that lies in a folder which submissions can read, and that folder.
pub fn exposed<'a>(readable: &'a [PathBuf], secrets: &'a [PathBuf]) -> Option<(&'a Path, &'a Path)> {
    let real = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let pairs = secrets.iter().flat_map(|secret| readable.iter().map(move |folder| (secret, folder)));
    pairs.map(|(secret, folder)| (secret.as_path(), folder.as_path())).find(|(s, f)| real(s).starts_with(real(f)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repository_in_a_folder_of_the_system_is_exposed() {
        let paths = |paths: &[&str]| paths.iter().map(PathBuf::from).collect::<Vec<_>>();
        let readable = paths(&["/usr", "/work/target/grader/key/deps"]);
        assert_eq!(exposed(&readable, &paths(&["/work/src", "/work/target/grader/key/reference-1"])), None);
        let secrets = paths(&["/usr/src/course/src"]);
        assert_eq!(exposed(&readable, &secrets), Some((Path::new("/usr/src/course/src"), Path::new("/usr"))));
    }
}
