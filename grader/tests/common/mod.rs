//! The repository's folder and the start of a process, which several of the grader's tests share.

use std::path::{Path, PathBuf};
use std::time::Duration;

use grader::implementation::sandboxed::Sandboxed;
use grader::sandbox::{Confined, Limits, Profile, Sandbox};

/// The root of the repository.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the grader lies in the repository").to_owned()
}

/// A program of compiled functions in a process of its own, with this time for an answer.
pub fn process(program: PathBuf, folder: PathBuf, environment: Vec<(String, String)>, answer: Duration) -> Sandboxed {
    let second = Duration::from_secs(1);
    let start = move || {
        Sandbox::none().start(&Confined {
            program: program.clone(),
            arguments: Vec::new(),
            environment: environment.clone(),
            folder: folder.clone(),
            readable: Vec::new(),
            writable: Vec::new(),
            profile: Profile::Submission,
            limits: Limits {
                wall: 600 * second,
                cpu: 600 * second,
                memory: 4 << 30,
                processes: 64,
                file_size: 0,
                open_files: 64,
                output: 0,
            },
        })
    };
    Sandboxed::new(start, answer)
}
