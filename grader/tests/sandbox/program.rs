//! Programs that are compiled inside of the sandbox.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use grader::sandbox::{Confined, Ended, Limits, Profile, Sandbox, library_folders, system_folders};
use tempfile::TempDir;

pub static SANDBOX: LazyLock<Sandbox> = LazyLock::new(|| Sandbox::probe(Path::new(env!("CARGO_BIN_EXE_grader"))));

pub fn limits() -> Limits {
    Limits {
        wall: Duration::from_secs(20),
        cpu: Duration::from_secs(20),
        memory: 4 << 30,
        processes: 64,
        file_size: 64 << 20,
        open_files: 256,
        output: 10_000,
    }
}

/// A program compiled inside of the sandbox from `source`, with a folder of its own.
pub struct Program {
    pub folder: TempDir,
    pub confined: Confined,
}

pub fn compile(source: &str) -> (TempDir, Ended) {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("x.rs"), source).expect("a file");
    let sysroot = Command::new("rustc").args(["--print", "sysroot"]).output().expect("rustc").stdout;
    let sysroot = PathBuf::from(String::from_utf8(sysroot).expect("a path").trim());
    let mut readable = system_folders();
    readable.push(sysroot.clone());
    let scratch = folder.path().display().to_string();
    let confined = Confined {
        program: sysroot.join("bin/rustc"),
        arguments: ["--edition=2024", "-Clinker-features=-lld", "--sysroot", &sysroot.display().to_string(), "x.rs"]
            .map(String::from)
            .to_vec(),
        environment: vec![
            ("PATH".into(), "/usr/bin:/bin".into()),
            ("TMPDIR".into(), scratch),
            ("LD_LIBRARY_PATH".into(), sysroot.join("lib").display().to_string()),
        ],
        folder: folder.path().into(),
        readable,
        writable: vec![folder.path().into()],
        profile: Profile::Compiler,
        limits: limits(),
    };
    let ended = SANDBOX.run(&confined).expect("the compiler runs");
    (folder, ended)
}

impl Program {
    pub fn new(main: &str) -> Self {
        let source = format!(
            "use std::{{io::*, fs, env, thread, process::Command, time::Duration}};\n#[allow(unused)] fn main() {{ {main} }}"
        );
        let (folder, ended) = compile(&format!("#![allow(unused)]\n{source}"));
        assert_eq!(ended.code, Some(0), "{}", String::from_utf8_lossy(&ended.stderr));
        let scratch = folder.path().join("scratch");
        fs::create_dir(&scratch).expect("a folder");
        let program = folder.path().join("x");
        let mut readable = library_folders();
        readable.push(program.clone());
        let confined = Confined {
            program,
            arguments: Vec::new(),
            environment: Vec::new(),
            folder: scratch.clone(),
            readable,
            writable: vec![scratch],
            profile: Profile::Submission,
            limits: Limits { wall: Duration::from_secs(30), memory: 1 << 30, processes: 16, ..limits() },
        };
        Self { folder, confined }
    }

    pub fn run(&self) -> Ended {
        let begun = Instant::now();
        let ended = SANDBOX.run(&self.confined).expect("the program runs");
        assert!(begun.elapsed() < self.confined.limits.wall + Duration::from_secs(30), "it ends");
        ended
    }

    /// Runs a program that must find everything forbidden.
    pub fn is_harmless(&self) {
        let ended = self.run();
        let said = String::from_utf8_lossy(&ended.stderr);
        assert_eq!((ended.code, ended.timed_out), (Some(0), false), "{said}");
    }
}
