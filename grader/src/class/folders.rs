//! The folders of a class and of its results: neither may contain the other.

use std::io;
use std::path::{Path, PathBuf, absolute};

use super::{ClassError, at};

/// Folders that hold results, in the folder of the results.
pub const FOLDERS: [&str; 4] = ["grades", "failed", "submissions", "students"];

/// Refuses a folder of results inside that of the submissions, because the next run would take it for a submission, and a folder of
/// submissions inside that of the results, because results would overwrite it.
pub fn apart(folder: &Path, out: &Path) -> Result<(), ClassError> {
    let no_class = |source| ClassError::NoClass { path: folder.to_owned(), source };
    let submissions = folder.canonicalize().map_err(no_class)?;
    if !submissions.is_dir() {
        return Err(no_class(io::ErrorKind::NotADirectory.into()));
    }
    let results = resolved(out).map_err(at(out))?;
    let refused = |what| Err(ClassError::InTheWay { path: out.to_owned(), what });
    if results.starts_with(&submissions) {
        return refused("the submissions are");
    }
    if FOLDERS.iter().any(|name| submissions.starts_with(results.join(name))) {
        return refused("the submissions would be overwritten");
    }
    Ok(())
}

/// Refuses to join results into one of the folders that they come from.
pub fn distinct(folders: &[PathBuf], out: &Path) -> Result<(), ClassError> {
    let results = resolved(out).map_err(at(out))?;
    if folders.iter().any(|folder| resolved(folder).is_ok_and(|folder| folder == results)) {
        return Err(ClassError::InTheWay { path: out.to_owned(), what: "one of the parts is" });
    }
    Ok(())
}

/// A path without links, whether its last parts exist or not.
fn resolved(path: &Path) -> io::Result<PathBuf> {
    let path = absolute(path)?;
    let there = path.ancestors().find_map(|folder| Some((folder, folder.canonicalize().ok()?)));
    let Some((folder, real)) = there else { return Ok(path) };
    Ok(path.strip_prefix(folder).map_or_else(|_| path.clone(), |rest| real.join(rest)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn results_and_submissions_may_not_lie_in_each_others_way() {
        let base = tempfile::tempdir().unwrap();
        let path = |name: &str| base.path().join(name);
        fs::create_dir(path("submissions")).unwrap();
        fs::write(path("file"), "").unwrap();
        let verdict = |folder: &str, out: &str| apart(&path(folder), &path(out)).map_err(|error| error.to_string());
        assert_eq!(verdict("submissions", "results"), Ok(()));
        assert_eq!(verdict("submissions", "submissions2/new"), Ok(()));
        for (folder, out, word) in [
            ("submissions", "submissions", "lies where the submissions are"),
            ("submissions", "submissions/new/results", "lies where the submissions are"),
            ("submissions", ".", "would be overwritten"),
            ("nowhere", "results", "name a folder with submissions"),
            ("file", "results", "name a folder with submissions"),
        ] {
            let problem = verdict(folder, out).unwrap_err();
            assert!(problem.contains(word), "{folder}, {out}: {problem}");
        }
    }

    #[test]
    fn parts_are_not_joined_into_one_of_them() {
        let base = tempfile::tempdir().unwrap();
        let path = |name: &str| base.path().join(name);
        fs::create_dir(path("part1")).unwrap();
        let parts = [path("part1"), path("part2")];
        assert!(distinct(&parts, &path("joined")).is_ok());
        assert!(distinct(&parts, &path("./part1")).is_err());
        assert!(distinct(&parts, &path("part2")).is_err());
    }
}
