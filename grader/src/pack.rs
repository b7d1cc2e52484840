//! Packs the files that the platforms of instructors need: Gradescope, Classroom 50, Slurm.

mod sources;
#[cfg(test)]
mod tests;

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};
use std::process::Command;

use clap::ValueEnum;

use crate::new_folder::{self, FolderError};

/// A platform that grades classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Platform {
    Gradescope,
    Classroom50,
    Slurm,
}

/// Options of `pack`.
#[derive(Clone, Debug)]
pub struct PackOptions {
    pub platform: Platform,
    /// New or empty.
    pub out: PathBuf,
    /// The solved repository.
    pub repository: PathBuf,
    pub seed: u64,
    /// The assignment, in place of the grader's own rubric.
    pub rubric: Option<PathBuf>,
    /// Number of functions that the assignment asks for.
    pub functions: usize,
    /// The files of the rubric's own checks, in its folder or below.
    pub checks: Vec<PathBuf>,
    /// Pack the sources of all dependencies too, so that the setup needs no crates from the network.
    pub vendor: bool,
}

/// Reasons for which no package was written.
#[derive(Debug, thiserror::Error)]
pub enum PackError {
    #[error("{path}: {source}", path = .path.display())]
    File { path: PathBuf, source: io::Error },
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error("{path}: is not the repository; Cargo.toml, Cargo.lock, src and grader belong there", path = .0.display())]
    NotTheRepository(PathBuf),
    #[error("{path}: {message}", path = .path.display())]
    Manifest { path: PathBuf, message: String },
    #[error("autograder.zip: {0}")]
    Zip(#[from] zip::result::ZipError),
    #[error("{path}: a package holds checks in the folder of the rubric or below, and none in its place `grader/{place}`; move it", path = .0.display(), place = .1)]
    Misplaced(PathBuf, String),
    #[error("{command}: {message}")]
    Command { command: &'static str, message: String },
}

/// A file to write: its name, its text and whether it is a program.
type Template = (&'static str, &'static str, bool);

const GRADESCOPE: [Template; 3] = [
    ("setup.sh", include_str!("pack/templates/setup.sh"), true),
    ("run_autograder", include_str!("pack/templates/run_autograder"), true),
    ("AUTOGRADER.md", include_str!("pack/templates/gradescope.md"), false),
];
const CLASSROOM50: [Template; 3] = [
    ("autograder.py", include_str!("pack/templates/autograder.py"), false),
    ("runtime.json", include_str!("pack/templates/runtime.json"), false),
    ("README.md", include_str!("pack/templates/classroom50.md"), false),
];
const SLURM: [Template; 4] = [
    ("submit.sh", include_str!("pack/templates/submit.sh"), true),
    ("array.sbatch", include_str!("pack/templates/array.sbatch"), true),
    ("merge.sbatch", include_str!("pack/templates/merge.sbatch"), true),
    ("README.md", include_str!("pack/templates/slurm.md"), false),
];

/// Adds the path that an error of the file system is about.
fn at(path: &Path) -> impl FnOnce(io::Error) -> PackError {
    let path = path.to_path_buf();
    move |source| PackError::File { path, source }
}

/// Writes the package into `options.out`.
pub fn pack(options: &PackOptions) -> Result<(), PackError> {
    new_folder::create(&options.out, |out| match options.platform {
        Platform::Gradescope => gradescope(options, out),
        Platform::Classroom50 => write(out, &CLASSROOM50, &fields(options)?),
        Platform::Slurm => write(out, &SLURM, &fields(options)?),
    })
}

/// Values for the placeholders of the templates.
fn fields(options: &PackOptions) -> Result<[(&'static str, String); 8], PackError> {
    Ok([
        ("@TOOLCHAIN@", toolchain()?),
        ("@SEED@", options.seed.to_string()),
        ("@FUNCTIONS@", options.functions.to_string()),
        // Checks of its own are found beside a rubric; without them, it is part of the grader.
        ("@RUBRIC@", if options.checks.is_empty() { "" } else { " --rubric grader/rubric.toml" }.into()),
        ("@SHARDS@", "8".into()),
        ("@CPUS@", "4".into()),
        ("@MEMORY@", "2G".into()),
        ("@TIME@", "08:00:00".into()),
    ])
}

/// The version of the toolchain at work: grades are made with the one that the instructor tried.
fn toolchain() -> Result<String, PackError> {
    let text = output(Command::new("rustc").arg("--version"), "rustc --version")?;
    let version = text.split_whitespace().nth(1).unwrap_or("stable");
    Ok(version.to_string())
}

fn output(command: &mut Command, name: &'static str) -> Result<String, PackError> {
    let fail = |message: String| PackError::Command { command: name, message };
    let output = command.output().map_err(|error| fail(error.to_string()))?;
    if !output.status.success() {
        return Err(fail(String::from_utf8_lossy(&output.stderr).trim().to_string()));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

fn write(out: &Path, templates: &[Template], fields: &[(&str, String)]) -> Result<(), PackError> {
    for (name, text, is_program) in templates {
        let text = fields.iter().fold((*text).to_string(), |text, (mark, value)| text.replace(mark, value));
        let path = out.join(name);
        fs::write(&path, text).map_err(at(&path))?;
        if *is_program {
            make_program(&path).map_err(at(&path))?;
        }
    }
    Ok(())
}

#[cfg(unix)]
fn make_program(path: &Path) -> io::Result<()> {
    fs::set_permissions(path, std::os::unix::fs::PermissionsExt::from_mode(0o755))
}

#[cfg(not(unix))]
fn make_program(_path: &Path) -> io::Result<()> {
    Ok(())
}

fn gradescope(options: &PackOptions, out: &Path) -> Result<(), PackError> {
    let root = &options.repository;
    if !["Cargo.toml", "Cargo.lock", "src", "grader"].iter().all(|name| root.join(name).exists()) {
        return Err(PackError::NotTheRepository(root.clone()));
    }
    let files = out.join("autograder");
    fs::create_dir(&files).map_err(at(&files))?;
    sources::copy(root, &files)?;
    if let Some(rubric) = &options.rubric {
        fs::copy(rubric, files.join("grader/rubric.toml")).map_err(at(rubric))?;
    }
    for check in &options.checks {
        copy_check(options, check, &files.join("grader"))?;
    }
    if options.vendor {
        sources::vendor(&files)?;
    }
    write(&files, &GRADESCOPE, &fields(options)?)?;
    archive(&files, &out.join("autograder.zip"))
}

/// Copies a check to the place beside the packed rubric that it has beside the rubric.
fn copy_check(options: &PackOptions, check: &Path, to: &Path) -> Result<(), PackError> {
    let rubric = options.rubric.as_deref().unwrap_or(Path::new("rubric.toml"));
    let folder = std::path::absolute(rubric).map_err(at(rubric))?.parent().map(Path::to_owned).unwrap_or_default();
    let name = check.strip_prefix(&folder).unwrap_or(check);
    let is_below = name.is_relative() && name.components().all(|part| matches!(part, Component::Normal(_)));
    let place = to.join(name);
    if !is_below || place.exists() {
        return Err(PackError::Misplaced(check.to_owned(), name.display().to_string()));
    }
    fs::create_dir_all(place.parent().unwrap_or(to)).map_err(at(&place))?;
    fs::copy(check, &place).map(drop).map_err(at(check))
}

/// Packs the content of a folder, not the folder: Gradescope looks for its scripts at the top.
fn archive(files: &Path, path: &Path) -> Result<(), PackError> {
    let mut zip = zip::ZipWriter::new(File::create(path).map_err(at(path))?);
    add(&mut zip, files, "")?;
    let mut file = zip.finish()?;
    file.flush().map_err(at(path))
}

fn add(zip: &mut zip::ZipWriter<File>, folder: &Path, prefix: &str) -> Result<(), PackError> {
    let entries = fs::read_dir(folder).and_then(Iterator::collect::<io::Result<Vec<_>>>).map_err(at(folder))?;
    let mut paths: Vec<PathBuf> = entries.into_iter().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        let name = format!("{prefix}{}", path.file_name().unwrap_or_default().to_string_lossy());
        if path.is_dir() {
            add(zip, &path, &format!("{name}/"))?;
            continue;
        }
        let settings = zip::write::SimpleFileOptions::default().unix_permissions(mode(&path).map_err(at(&path))?);
        zip.start_file(name, settings)?;
        let mut file = File::open(&path).map_err(at(&path))?;
        io::copy(&mut file, zip).map_err(at(&path))?;
    }
    Ok(())
}

#[cfg(unix)]
fn mode(path: &Path) -> io::Result<u32> {
    Ok(std::os::unix::fs::PermissionsExt::mode(&fs::metadata(path)?.permissions()) & 0o777)
}

#[cfg(not(unix))]
fn mode(path: &Path) -> io::Result<u32> {
    // Windows has no executable flag, so all files at the top are marked as executable.
    Ok(if path.extension().is_none_or(|ending| ending == "sh") { 0o755 } else { 0o644 })
}
