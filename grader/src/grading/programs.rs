//! Our own programs beside a submission's: the reference below each level, and the reference as a whole.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::Duration;
use std::{fs, io};

use grader::compile::prebuilt::Prebuilt;
use grader::compile::{Plan, build, names};
use grader::sandbox::{Confined, Limits, Profile, Running, Sandbox, library_folders};

use super::GradingError;
use crate::rubric::Rubric;

/// Where our own programs lie.
pub struct Programs {
    folder: PathBuf,
    lowest: u32,
    /// All functions of the reference; in a process of its own like a submission's, so that times can be compared.
    pub reference: PathBuf,
}

impl Programs {
    /// Builds them, or finds them already built.
    ///
    /// # Errors
    /// Where our own sources do not compile.
    pub fn new(root: &Path, rubric: &Rubric, prebuilt: &Prebuilt) -> Result<Self, GradingError> {
        let mut texts = BTreeMap::new();
        for name in names() {
            texts.insert(name, fs::read_to_string(root.join(format!("src/{name}.rs")))?);
        }
        let levels: Vec<u32> = names().map(|name| rubric.level(name)).collect();
        let mut hasher = DefaultHasher::new();
        (&texts, levels).hash(&mut hasher);
        let folder = prebuilt.folder.join(format!("reference-{:016x}", hasher.finish()));
        let lowest = rubric.levels().first().copied().unwrap_or(1);
        let programs = Self { reference: folder.join("whole/program"), folder, lowest };
        if !programs.folder.join("complete").exists() {
            programs.build(rubric, prebuilt, texts)?;
        }
        Ok(programs)
    }

    /// The library with the reference of all levels below this one.
    pub fn below(&self, level: u32) -> Option<PathBuf> {
        (level > self.lowest).then(|| self.folder.join(format!("below-{level}/libcourse_below.rlib")))
    }

    fn build(
        &self,
        rubric: &Rubric,
        prebuilt: &Prebuilt,
        texts: BTreeMap<&'static str, String>,
    ) -> Result<(), GradingError> {
        for level in rubric.levels() {
            let to = self.folder.join(format!("below-{level}"));
            let sources = self.folder.join(format!("sources-{level}"));
            fs::create_dir_all(&to)?;
            fs::create_dir_all(&sources)?;
            let mut library = String::from("pub extern crate course_given as given;\n");
            for (name, text) in texts.iter().filter(|(name, _)| rubric.level(name) < level) {
                library.push_str(&format!("pub mod {name};\npub use {name}::{name};\n"));
                fs::write(sources.join(format!("{name}.rs")), text)?;
            }
            let file = sources.join("lib.rs");
            fs::write(&file, library)?;
            prebuilt.library(&file, "course_below", &to, &[])?;
            fs::remove_dir_all(&sources)?;
        }
        let whole = self.folder.join("whole");
        fs::create_dir_all(&whole)?;
        let built = build(prebuilt, &Sandbox::none(), &Plan { own: texts, reference: None }, &whole)?;
        if built.program.is_none() || !built.faults.is_empty() {
            return Err(GradingError::Reference(format!("{:?}", built.faults)));
        }
        fs::remove_dir_all(whole.join("src"))?;
        Ok(fs::write(self.folder.join("complete"), "")?)
    }
}

/// How a program in `folder` is started: it sees the system's libraries and itself, and may write nothing.
pub fn start(sandbox: &Sandbox, program: Option<PathBuf>, folder: &Path) -> impl Fn() -> io::Result<Running> + 'static {
    let sandbox = sandbox.clone();
    let folder = folder.to_owned();
    move || {
        let Some(program) = program.clone() else { return Err(io::ErrorKind::NotFound.into()) };
        let readable = library_folders().into_iter().chain([folder.clone()]).collect();
        let limits = Limits {
            wall: Duration::from_secs(120),
            cpu: Duration::from_secs(60),
            memory: 2 << 30,
            processes: 16,
            file_size: 0,
            open_files: 32,
            output: 0,
        };
        sandbox.start(&Confined {
            program,
            arguments: Vec::new(),
            environment: Vec::new(),
            folder: folder.clone(),
            readable,
            writable: Vec::new(),
            profile: Profile::Submission,
            limits,
        })
    }
}
