//! Our own programs beside a submission's: the reference below each level, and the reference as a whole.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::Duration;
use std::{env, fs, io};

use grader::compile::prebuilt::{Prebuilt, once};
use grader::compile::{Plan, build};
use grader::sandbox::{Confined, Limits, Profile, Running, Sandbox, library_folders};
use grader::submission::{NAMES, mentions};

use super::GradingError;
use super::groups::{Calls, Names, closure};
use crate::rubric::{Role, Rubric};

/// The grader's own programs.
pub struct Programs {
    folder: PathBuf,
    lowest: u32,
    /// The functions that each function of the reference calls.
    pub calls: Calls,
    levels: BTreeMap<&'static str, u32>,
    texts: BTreeMap<&'static str, String>,
}

impl Programs {
    /// Builds them, or finds them already built.
    ///
    /// # Errors
    /// The reason if the reference does not compile.
    pub fn new(root: &Path, rubric: &Rubric, prebuilt: &Prebuilt) -> Result<Self, GradingError> {
        let mut texts = BTreeMap::new();
        for name in NAMES {
            texts.insert(name, fs::read_to_string(root.join(format!("src/{name}.rs")))?);
        }
        let calls: Calls = texts.iter().map(|(name, text)| (*name, mentions(text))).collect();
        let levels: BTreeMap<_, _> = NAMES.map(|name| (name, level(name, rubric, &calls))).into();
        let mut hasher = DefaultHasher::new();
        // Times are compared only between programs that were compiled alike.
        (&texts, &levels, rubric.levels(), prebuilt.arguments()).hash(&mut hasher);
        let folder = prebuilt.folder.join(format!("reference-{:016x}", hasher.finish()));
        let lowest = levels.values().copied().min().unwrap_or(1);
        let programs = Self { folder, lowest, calls, levels, texts };
        once(&programs.folder, || programs.build(rubric, prebuilt))?;
        Ok(programs)
    }

    /// The level of a function: the rubric's; for one that is given, the level from which on the reference answers all that it
    /// calls, 0 where it calls nothing that is asked for.
    pub fn level(&self, name: &str) -> u32 {
        self.levels.get(name).copied().unwrap_or(u32::MAX)
    }

    /// The functions whose reference the programs of a level are linked with.
    pub fn names_below(&self, level: u32) -> Names {
        NAMES.into_iter().filter(|name| self.level(name) < level).collect()
    }

    /// The reference's text of a function.
    pub fn text(&self, name: &str) -> Option<&String> {
        self.texts.get(name)
    }

    /// The library with the reference of all levels below this one.
    pub fn below(&self, level: u32) -> Option<PathBuf> {
        (level > self.lowest).then(|| self.folder.join(format!("below-{level}/libcourse_below.rlib")))
    }

    /// The folder with the reference's own program.
    pub fn whole(&self) -> PathBuf {
        self.folder.join("whole")
    }

    /// Returns a function that starts the reference in a process like that of a submission, so that times can be compared.
    pub fn start_reference(&self, sandbox: &Sandbox) -> impl Fn() -> io::Result<Running> + use<> {
        let folder = self.whole();
        start(sandbox, Some(folder.join(format!("program{}", env::consts::EXE_SUFFIX))), &folder)
    }

    /// Builds the library with the reference of these functions in a folder that holds nothing else.
    ///
    /// # Errors
    /// The reason if the reference does not compile, or if these functions call others.
    pub fn library(&self, prebuilt: &Prebuilt, of: &Names, to: &Path) -> Result<PathBuf, GradingError> {
        let sources = to.join("sources");
        fs::create_dir_all(&sources)?;
        let mut library = String::from("pub extern crate course_given as given;\n");
        for (name, text) in self.texts.iter().filter(|(name, _)| of.contains(*name)) {
            library.push_str(&format!("pub mod {name};\npub use {name}::{name};\n"));
            fs::write(sources.join(format!("{name}.rs")), text)?;
        }
        let file = sources.join("lib.rs");
        fs::write(&file, library)?;
        prebuilt.library(&file, "course_below", to, &[])?;
        fs::remove_dir_all(&sources)?;
        Ok(to.join("libcourse_below.rlib"))
    }

    fn build(&self, rubric: &Rubric, prebuilt: &Prebuilt) -> Result<(), GradingError> {
        for level in rubric.levels().into_iter().filter(|level| *level > self.lowest) {
            self.library(prebuilt, &self.names_below(level), &self.folder.join(format!("below-{level}")))?;
        }
        let whole = self.whole();
        fs::create_dir_all(&whole)?;
        let limit = Duration::from_secs(600);
        let plan = Plan { own: self.texts.clone(), reference: None, helpers: BTreeMap::new(), limit };
        let built = build(prebuilt, &prebuilt.tools, &plan, &whole)?;
        if built.program.is_none() || !built.faults.is_empty() {
            return Err(GradingError::Reference(format!("{:?}", built.faults)));
        }
        Ok(fs::remove_dir_all(whole.join("src"))?)
    }
}

/// The level of one function. A function of a later assignment comes after all levels, and so does what calls it.
fn level(name: &'static str, rubric: &Rubric, calls: &Calls) -> u32 {
    let of = |name: &&'static str| match rubric.role(name) {
        Role::Asked => rubric.level(name).unwrap_or(u32::MAX),
        Role::Given => 0,
        Role::Later => u32::MAX,
    };
    match rubric.role(name) {
        Role::Given => closure(name, calls).iter().map(of).max().unwrap_or(0),
        Role::Asked | Role::Later => of(&name),
    }
}

/// Returns a function that starts a program in `folder`. The program sees only the system's libraries and itself, and cannot write files.
pub fn start(sandbox: &Sandbox, program: Option<PathBuf>, folder: &Path) -> impl Fn() -> io::Result<Running> + use<> {
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
