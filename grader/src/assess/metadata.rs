//! `submission_metadata.json`, which Gradescope puts beside a submission
//! (<https://gradescope-autograders.readthedocs.io/en/latest/submission_metadata/>).

use std::fs;
use std::path::{Path, PathBuf};

use jiff::Timestamp;
use serde::Deserialize;
use thiserror::Error;

/// Students and time of a submission.
pub struct Metadata {
    pub submitted: Timestamp,
    /// Addresses, numbers and names of the student, or of the students of a group.
    pub students: Vec<String>,
}

/// An error in the file.
#[derive(Debug, Error)]
#[error("{path}: {problem}; name Gradescope's submission_metadata.json", path = path.display())]
pub struct MetadataError {
    path: PathBuf,
    problem: String,
}

#[derive(Deserialize)]
struct File {
    created_at: String,
    #[serde(default)]
    users: Vec<User>,
}

#[derive(Deserialize)]
struct User {
    email: Option<String>,
    name: Option<String>,
    sid: Option<String>,
}

impl Metadata {
    /// Reads the file.
    ///
    /// # Errors
    /// The problem with it.
    pub fn read(path: &Path) -> Result<Self, MetadataError> {
        let unusable = |problem: String| MetadataError { path: path.to_owned(), problem };
        let text = fs::read_to_string(path).map_err(|error| unusable(error.to_string()))?;
        let file: File = serde_json::from_str(&text).map_err(|error| unusable(error.to_string()))?;
        let submitted = file.created_at.parse().map_err(|error| unusable(format!("created_at: {error}")))?;
        let students = file.users.into_iter().flat_map(|user| [user.email, user.sid, user.name]).flatten().collect();
        Ok(Self { submitted, students })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradescope_tells_who_and_when() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("submission_metadata.json");
        let text = r#"{"id": 123456, "created_at": "2018-07-01T14:22:32.365935-07:00", "assignment": {"title": "x"},
            "users": [{"email": "anna@x.org", "id": 1234, "name": "Anna"}, {"email": "bob@x.org", "name": "Bob"}]}"#;
        fs::write(&path, text).unwrap();
        let metadata = Metadata::read(&path).unwrap();
        assert_eq!(metadata.submitted.to_string(), "2018-07-01T21:22:32.365935Z");
        assert_eq!(metadata.students, ["anna@x.org", "Anna", "bob@x.org", "Bob"]);
        fs::write(&path, "{}").unwrap();
        assert!(Metadata::read(&path).err().unwrap().to_string().contains("missing field `created_at`"));
    }
}
