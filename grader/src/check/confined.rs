//! Processes in which the functions of a check run: in the sandbox, if this machine has one.

use std::env;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::{CheckError, Options};
use crate::sandbox::{Confined, Limits, Profile, Running, Sandbox, library_folders};

/// The sandbox of this machine. One's own repository is checked without one too, another's folder only if that is asked for.
pub fn sandbox(options: &Options) -> Result<Sandbox, CheckError> {
    if options.without_sandbox {
        return Ok(Sandbox::none());
    }
    let sandbox = Sandbox::probe(&env::current_exe()?);
    let is_own = || options.folder.canonicalize().ok() == own_repository().canonicalize().ok();
    match &sandbox.missing()[..] {
        [] => Ok(sandbox),
        _ if is_own() => Ok(Sandbox::none()),
        [first, ..] => Err(CheckError::Unconfined(*first)),
    }
}

/// The repository that this program was built from. Its libraries are built without a sandbox, so never those of a folder that is checked.
pub fn own_repository() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own).to_owned()
}

/// Returns a function that starts the functions' program, which sees only the system's libraries and itself.
pub fn starter(
    sandbox: &Sandbox,
    program: Option<PathBuf>,
    folder: PathBuf,
) -> impl Fn() -> io::Result<Running> + use<> {
    let sandbox = sandbox.clone();
    move || {
        let Some(program) = program.clone() else { return Err(io::ErrorKind::NotFound.into()) };
        let limits = Limits {
            wall: Duration::from_secs(600),
            cpu: Duration::from_secs(600),
            memory: 4 << 30,
            processes: 64,
            file_size: 0,
            open_files: 64,
            output: 0,
        };
        sandbox.start(&Confined {
            program,
            arguments: Vec::new(),
            environment: Vec::new(),
            folder: folder.clone(),
            readable: library_folders().into_iter().chain([folder.clone()]).collect(),
            writable: Vec::new(),
            profile: Profile::Submission,
            limits,
        })
    }
}
