//! The libraries that every program of a submission is linked with, built once for each toolchain: nalgebra, what the course gives, and the
//! loop that answers calls.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{self, Path, PathBuf};
use std::process::Command;
use std::{env, fs, io};

use thiserror::Error;

use super::locked::locked;
use super::tools::run;
use crate::sandbox::{Sandbox, system_folders};

/// Errors in the build of the libraries. They are errors of the machine or of the repository, never of a submission.
#[derive(Debug, Error)]
pub enum PrebuildError {
    /// A file cannot be read or written, a program cannot be started.
    #[error("{what}: {error}; it is needed to prepare the grader's libraries")]
    Io {
        /// Which file or program.
        what: String,
        /// The reason.
        error: io::Error,
    },
    /// A compiler reports errors.
    #[error("{what} failed while the grader's libraries were prepared:\n{output}")]
    Failed {
        /// Which step.
        what: String,
        /// Its output.
        output: String,
    },
}

/// Libraries to link with, and the compiler that made them.
#[derive(Clone)]
pub struct Prebuilt {
    /// The folder that holds them.
    pub folder: PathBuf,
    /// The compiler itself, not rustup's stand-in for it.
    pub rustc: PathBuf,
    /// Its standard library.
    pub sysroot: PathBuf,
    /// Output of `rustc --version`.
    pub toolchain: String,
    /// Sandbox for the grader's own compilers.
    pub tools: Sandbox,
}

/// Crates that a submission may name, apart from the course's own.
const CRATES: [&str; 3] = ["nalgebra", "nalgebra_sparse", "grader_child"];

impl Prebuilt {
    /// Builds the libraries of the repository at `root`, or finds them already built. `tools` is how compilers are run:
    /// [`Sandbox::own_tools`], or [`Sandbox::none`] in a program that is no launcher.
    ///
    /// # Errors
    /// The reason if a compiler or a file is missing or a library does not compile.
    pub fn new(root: &Path, tools: Sandbox) -> Result<Self, PrebuildError> {
        // Linkers on Windows do not accept canonical paths of that system.
        let whole = if cfg!(windows) { path::absolute(root) } else { fs::canonicalize(root) };
        let root = &whole.map_err(io_error(root))?;
        let sysroot = PathBuf::from(output(Command::new("rustc").current_dir(root).args(["--print", "sysroot"]))?);
        let rustc = sysroot.join("bin").join(format!("rustc{}", env::consts::EXE_SUFFIX));
        let toolchain = output(Command::new(&rustc).arg("--version"))?;
        let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
        let target = path::absolute(&target).map_err(io_error(&target))?;
        let folder = target.join("grader").join(format!("{:016x}", key(root, &toolchain)?));
        let prebuilt = Self { folder, rustc, sysroot, toolchain, tools };
        once(&prebuilt.folder, || prebuilt.build(root))?;
        Ok(prebuilt)
    }

    /// Arguments that every program is compiled with.
    pub fn arguments(&self) -> Vec<String> {
        let deps = self.folder.join("deps");
        let mut all = vec![
            "--edition=2024".to_owned(),
            "--error-format=json".to_owned(),
            format!("--sysroot={}", self.sysroot.display()),
            "-Copt-level=2".to_owned(),
            "-Ccodegen-units=1".to_owned(),
            // No program is optimised again after linking.
            "-Cembed-bitcode=no".to_owned(),
            // The linker of the Rust toolchain needs /proc. On other systems rustc uses the system's linker, and has no such option.
            #[cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]
            "-Clinker-features=-lld".to_owned(),
            format!("-Ldependency={}", deps.display()),
            format!("--extern=course_given={}", self.folder.join("given/libcourse_given.rlib").display()),
        ];
        all.extend(CRATES.map(|name| format!("--extern={name}={}", deps.join(format!("lib{name}.rlib")).display())));
        all
    }

    /// Folders that a compiler must be able to read: its own, the system's linker, the libraries.
    pub fn readable(&self) -> Vec<PathBuf> {
        let own = [self.sysroot.clone(), self.folder.join("deps"), self.folder.join("given")];
        system_folders().into_iter().chain(own).collect()
    }

    fn build(&self, root: &Path) -> Result<(), PrebuildError> {
        let work = self.folder.join("work");
        let deps = self.folder.join("deps");
        for folder in [&work.join("src"), &deps, &self.folder.join("given")] {
            fs::create_dir_all(folder).map_err(io_error(folder))?;
        }
        write(&work.join("Cargo.toml"), &manifest(root)?)?;
        write(&work.join("src/lib.rs"), "")?;
        let lock = root.join("Cargo.lock");
        fs::copy(&lock, work.join("Cargo.lock")).map_err(io_error(&lock))?;
        let target = work.join("target");
        let cargo = || {
            let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
            cargo.args(["build", "--release", "--quiet", "--manifest-path"]).arg(work.join("Cargo.toml"));
            cargo.env("CARGO_TARGET_DIR", &target).env_remove("RUSTFLAGS").env("RUSTC", &self.rustc);
            cargo
        };
        // The crates that the grader itself was built with are on this machine already, so the network is tried second.
        let build = |cargo: &mut Command| succeeded(cargo, run(cargo, &self.tools));
        build(cargo().arg("--offline")).or_else(|_| build(&mut cargo()))?;
        self.collect(&target.join("release/deps"), &deps)?;
        self.library(&root.join("src/given/mod.rs"), "course_given", &self.folder.join("given"), &[])?;
        fs::remove_dir_all(&work).map_err(io_error(&work))
    }

    /// Copies what cargo built; the crates that are named on the command line lose the hash in their file name.
    fn collect(&self, from: &Path, to: &Path) -> Result<(), PrebuildError> {
        for entry in fs::read_dir(from).map_err(io_error(from))?.flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            let is_library = name.ends_with(".rlib") || name.ends_with(env::consts::DLL_SUFFIX);
            if !is_library || name.starts_with("libprebuilt") {
                continue;
            }
            let stem = name.trim_start_matches("lib").split('-').next().unwrap_or_default();
            let is_named = CRATES.contains(&stem) && name.ends_with(".rlib");
            let place = to.join(if is_named { format!("lib{stem}.rlib") } else { name.clone() });
            fs::copy(entry.path(), &place).map_err(io_error(&place))?;
        }
        Ok(())
    }

    /// Compiles one more library from its root file.
    ///
    /// # Errors
    /// The reason if it does not compile.
    pub fn library(&self, source: &Path, name: &str, to: &Path, more: &[String]) -> Result<(), PrebuildError> {
        let mut rustc = Command::new(&self.rustc);
        let given = self
            .arguments()
            .into_iter()
            .filter(|argument| name != "course_given" || !argument.contains("course_given="));
        rustc.args(given).args(["--crate-type=rlib", "--cap-lints=allow", "--crate-name", name, "--out-dir"]);
        rustc.arg(to).args(more).arg(source);
        succeeded(&rustc, run(&rustc, &self.tools))
    }
}

/// Has `build` fill a folder unless it is complete. Shards of a class start together and share the folder: one of them builds, and the
/// others wait.
///
/// # Errors
/// Those of `build`, and where the folder cannot be written.
pub fn once<E: From<PrebuildError>>(folder: &Path, build: impl FnOnce() -> Result<(), E>) -> Result<(), E> {
    let complete = folder.join("complete");
    if complete.exists() {
        return Ok(());
    }
    fs::create_dir_all(folder).map_err(io_error(folder))?;
    let path = folder.join(".lock");
    let lock = fs::File::create(&path).map_err(io_error(&path))?;
    // Some network file systems have no locks. There the build works, but must not be started twice at the same time.
    let _ = lock.lock();
    if !complete.exists() {
        build()?;
        write(&complete, "")?;
    }
    Ok(())
}

/// The package that has the libraries as its dependencies, with the versions of the repository.
fn manifest(root: &Path) -> Result<String, PrebuildError> {
    let path = root.join("Cargo.toml");
    let text = fs::read_to_string(&path).map_err(io_error(&path))?;
    let version = |name: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix(&format!("{name} = \"")));
        line.and_then(|rest| rest.strip_suffix('"')).map(str::to_owned)
    };
    let missing = |name: &str| PrebuildError::Failed {
        what: path.display().to_string(),
        output: format!("no line `{name} = \"…\"` among the workspace's dependencies"),
    };
    let nalgebra = version("nalgebra").ok_or_else(|| missing("nalgebra"))?;
    let sparse = version("nalgebra-sparse").ok_or_else(|| missing("nalgebra-sparse"))?;
    let child = root.join("grader/child");
    Ok(format!(
        "[package]\nname = \"prebuilt\"\nversion = \"0.0.0\"\nedition = \"2024\"\n[workspace]\n[workspace.package]\n\
         [dependencies]\nnalgebra = \"{nalgebra}\"\nnalgebra-sparse = \"{sparse}\"\n\
         grader-child = {{ path = {:?} }}\n[profile.release]\nopt-level = 2\ndebug = false\nlto = \"off\"\n",
        child.display().to_string()
    ))
}

/// A hash of everything that the libraries are made of. A repository and its handout have the same.
fn key(root: &Path, toolchain: &str) -> Result<u64, PrebuildError> {
    let mut hasher = DefaultHasher::new();
    (toolchain, env!("CARGO_PKG_VERSION")).hash(&mut hasher);
    let lock = root.join("Cargo.lock");
    let lock = fs::read_to_string(&lock).map_err(io_error(&lock))?;
    locked(&lock, "grader-child").hash(&mut hasher);
    let mut files = vec![root.join("grader/child/Cargo.toml")];
    for folder in ["grader/child/src", "src/given"] {
        let folder = root.join(folder);
        let entries = fs::read_dir(&folder).map_err(io_error(&folder))?;
        files.extend(entries.flatten().map(|entry| entry.path()));
    }
    files.sort();
    for file in files {
        fs::read(&file).map_err(io_error(&file))?.hash(&mut hasher);
    }
    Ok(hasher.finish())
}

fn write(path: &Path, text: &str) -> Result<(), PrebuildError> {
    fs::write(path, text).map_err(io_error(path))
}

fn io_error(path: &Path) -> impl FnOnce(io::Error) -> PrebuildError {
    let what = path.display().to_string();
    move |error| PrebuildError::Io { what, error }
}

fn succeeded(command: &Command, ended: io::Result<(Option<i32>, String)>) -> Result<(), PrebuildError> {
    let what = format!("{:?}", command.get_program());
    match ended {
        Ok((Some(0), _)) => Ok(()),
        Ok((_, output)) => Err(PrebuildError::Failed { what, output }),
        Err(error) => Err(PrebuildError::Io { what, error }),
    }
}

/// Output of a program, without the space around it.
fn output(command: &mut Command) -> Result<String, PrebuildError> {
    let what = format!("{:?}", command.get_program());
    let output = command.output().map_err(|error| PrebuildError::Io { what: what.clone(), error })?;
    if !output.status.success() {
        return Err(PrebuildError::Failed { what, output: String::from_utf8_lossy(&output.stderr).into_owned() });
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::thread;
    use std::time::Duration;

    #[test]
    fn of_several_that_start_together_one_builds_and_a_failure_leaves_nothing_complete() {
        let folder = tempfile::tempdir().unwrap();
        let failure = || Err(PrebuildError::Failed { what: "it".into(), output: String::new() });
        assert!(once(folder.path(), failure).is_err());
        let built = AtomicUsize::new(0);
        thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    let build = || -> Result<(), PrebuildError> {
                        thread::sleep(Duration::from_millis(20));
                        built.fetch_add(1, Ordering::Relaxed);
                        Ok(())
                    };
                    once(folder.path(), build).unwrap();
                    assert_eq!(built.load(Ordering::Relaxed), 1);
                });
            }
        });
    }
}
