//! Runs the compiler and programs with a submission's code in a sandbox.
//!
//! On Linux the grader starts itself a second time as a *launcher* (the hidden subcommand `confine`). The launcher makes the
//! namespaces and keeps the process tree; a third process gives up its rights one after the other and becomes the program.
//! Every layer is tried out beforehand ([`Sandbox::probe`]). If a layer that the machine has fails, the program is not started.
//! On other systems there are no layers, and a program runs plainly.

#[cfg(target_os = "linux")]
mod calls;
#[cfg(target_os = "linux")]
mod cgroup;
#[cfg(target_os = "linux")]
mod confine;
#[cfg(target_os = "linux")]
mod enter;
#[cfg(target_os = "linux")]
mod files;
#[cfg(target_os = "linux")]
mod memory;
mod output;
#[cfg(target_os = "linux")]
mod owner;
#[cfg(target_os = "linux")]
mod probe;
#[cfg(target_os = "linux")]
mod root;
mod running;
#[cfg(target_os = "linux")]
mod spec;
#[cfg(target_os = "linux")]
mod supervise;

use std::collections::BTreeMap;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use serde::{Deserialize, Serialize};

pub use running::Running;

/// Kind of program, which decides which system calls it may make.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Profile {
    /// rustc and what it calls: may start other programs that it can read.
    Compiler,
    /// A program with a submission's code: threads, but no other process.
    Submission,
}

/// Limits on a program's resources.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Limits {
    /// Time until the whole process tree is killed.
    pub wall: Duration,
    /// Processor time of one process, rounded up to seconds.
    pub cpu: Duration,
    /// Address space of one process, and what all processes together hold, bytes.
    pub memory: u64,
    /// Processes and threads.
    pub processes: u64,
    /// Size of one file, bytes.
    pub file_size: u64,
    /// Open files of one process.
    pub open_files: u64,
    /// Bytes of stdout and stderr together that are kept; what comes after is dropped.
    pub output: usize,
}

/// A program and what it may see.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Confined {
    /// The program.
    pub program: PathBuf,
    /// Its arguments.
    pub arguments: Vec<String>,
    /// Its whole environment. The grader's environment is not inherited.
    pub environment: Vec<(String, String)>,
    /// The folder in which it starts, one of `writable` or `readable` or below.
    pub folder: PathBuf,
    /// Files and folders that it may read. All paths are absolute.
    pub readable: Vec<PathBuf>,
    /// Files and folders that it may also change. Without another way their owner becomes the program's user.
    pub writable: Vec<PathBuf>,
    /// Kind of program.
    pub profile: Profile,
    /// Limits on its resources.
    pub limits: Limits,
}

/// The end of a program, with its output.
#[derive(Clone, Debug)]
pub struct Ended {
    /// Exit code; `None` if a signal ended it.
    pub code: Option<i32>,
    /// Signal that ended it.
    pub signal: Option<i32>,
    /// The program was killed because its time was over.
    pub timed_out: bool,
    /// The program was killed because its processes together had too much memory. The limit of a single process ends that process alone.
    pub out_of_memory: bool,
    /// Processor time of the whole process tree, s. Zero outside a sandbox, which measures it.
    pub seconds: f64,
    /// Start of what it printed.
    pub stdout: Vec<u8>,
    /// Start of its errors.
    pub stderr: Vec<u8>,
}

/// A resource that submissions must not reach, and the layers that isolate it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Isolation {
    /// The resources out of reach: the files of others, the network.
    pub from: &'static str,
    /// Names of layers; one is enough.
    pub layers: [&'static str; 2],
}

/// The isolations without which a submission could read the solutions or send out the inputs of checks.
const ISOLATIONS: [Isolation; 2] = [
    Isolation { from: "the files of others", layers: ["mount_namespace", "landlock"] },
    Isolation { from: "the network", layers: ["network_namespace", "seccomp"] },
];

impl fmt::Display for Isolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second] = self.layers;
        write!(f, "no layer isolates submissions from {} (neither {first} nor {second} holds)", self.from)
    }
}

/// The layers that this machine has.
#[derive(Clone, Debug)]
pub struct Sandbox {
    /// The program that confines, and the layers; none at all without it.
    #[cfg(target_os = "linux")]
    launcher: Option<PathBuf>,
    /// The cgroup in which each tree of processes gets one, or why there is none.
    #[cfg(target_os = "linux")]
    cgroup: Result<PathBuf, String>,
    layers: BTreeMap<String, bool>,
}

impl Sandbox {
    /// Tries each layer in a throw-away process. `launcher` is a program that calls [`confine`] for its subcommand `confine`.
    #[cfg(target_os = "linux")]
    pub fn probe(launcher: &Path) -> Self {
        let sandbox = probe::probe(launcher);
        if sandbox.is_some_layer() { sandbox } else { Self { launcher: None, ..sandbox } }
    }

    /// Other systems have no layer to try.
    #[cfg(not(target_os = "linux"))]
    pub fn probe(_launcher: &Path) -> Self {
        Self::none()
    }

    /// No layer: for a student's own code on their own machine.
    pub fn none() -> Self {
        Self {
            #[cfg(target_os = "linux")]
            launcher: None,
            #[cfg(target_os = "linux")]
            cgroup: Err("no cgroup was looked for".to_owned()),
            layers: BTreeMap::new(),
        }
    }

    /// Sandbox for the grader's own tools, such as cargo. They have the rights of the grader, and their whole process tree is killed
    /// when the grader ends. `launcher` is that of [`Sandbox::probe`].
    pub fn own_tools(launcher: &Path) -> Self {
        #[cfg(not(target_os = "linux"))]
        return Self::none();
        #[cfg(target_os = "linux")]
        Self {
            launcher: Some(launcher.to_path_buf()),
            layers: BTreeMap::from([("process_tree".to_string(), true)]),
            ..Self::none()
        }
    }

    /// The layers by name, and whether this machine has them.
    ///
    /// `user_namespace` is what an ordinary user needs for the other namespaces; where root does without it, it is not listed.
    /// `memory_cgroup` is true if a tree's memory is limited by a cgroup ([`Sandbox::without_cgroup`] gives the reason if not).
    /// `own_user` is true if the program runs as a user that owns no other files, which needs root.
    pub fn layers(&self) -> BTreeMap<String, bool> {
        self.layers.clone()
    }

    /// Reason why the memory of a process tree is not limited by a cgroup; `None` if it is. Without a cgroup the resident memory of the
    /// compiler's processes is summed ten times a second, which counts shared pages more than once.
    pub fn without_cgroup(&self) -> Option<&str> {
        #[cfg(target_os = "linux")]
        return self.cgroup.as_ref().err().map(String::as_str);
        #[cfg(not(target_os = "linux"))]
        Some("cgroups are Linux's")
    }

    /// The isolations that a submission must not run without and that this machine does not have.
    pub fn missing(&self) -> Vec<Isolation> {
        let holds = |layer: &&str| self.layers.get(*layer) == Some(&true);
        ISOLATIONS.into_iter().filter(|isolation| !isolation.layers.iter().any(holds)).collect()
    }

    /// Returns true if the sandbox has a layer.
    pub fn is_some_layer(&self) -> bool {
        self.layers.values().any(|there| *there)
    }

    /// Runs a program to its end, with nothing to read on its standard input.
    ///
    /// An error is the grader's, not the program's: the program was not started, or its end is not known.
    pub fn run(&self, confined: &Confined) -> io::Result<Ended> {
        #[cfg(target_os = "linux")]
        if self.launcher.is_some() {
            return output::launched(self, confined);
        }
        output::plain(confined)
    }

    /// Starts a program that finds a socket to its parent ([`grader_child::socket`]), and whose output goes nowhere.
    pub fn start(&self, confined: &Confined) -> io::Result<Running> {
        #[cfg(target_os = "linux")]
        if self.launcher.is_some() {
            return running::launched(self, confined);
        }
        running::plain(confined)
    }
}

/// Folders with a C linker and what rustc and its linker load. Beside them, the toolchain must be readable
/// (`rustc --print sysroot`), and `LD_LIBRARY_PATH` must name its `lib`, and on x86-64 rustc takes
/// `-Clinker-features=-lld`: without `/proc`, neither rustc nor its own linker finds its files.
pub fn system_folders() -> Vec<PathBuf> {
    present(&["/usr", "/bin", "/lib", "/lib64", "/etc/alternatives", "/etc/ld.so.cache"])
}

/// Folders with the libraries that a Rust program loads at its start.
pub fn library_folders() -> Vec<PathBuf> {
    present(&["/lib", "/lib64", "/usr/lib", "/usr/lib64", "/etc/ld.so.cache"])
}

fn present(paths: &[&str]) -> Vec<PathBuf> {
    paths.iter().map(PathBuf::from).filter(|path| path.exists()).collect()
}

/// The body of the launcher's subcommand `confine`; `arguments` are those after it.
pub fn confine(arguments: &[String]) -> ExitCode {
    #[cfg(target_os = "linux")]
    return confine::confine(arguments);
    #[cfg(not(target_os = "linux"))]
    {
        eprintln!("there is no sandbox on this system for {arguments:?}");
        ExitCode::FAILURE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(layers: &[(&str, bool)]) -> Vec<&'static str> {
        let layers = layers.iter().map(|(name, there)| (name.to_string(), *there)).collect();
        let sandbox = Sandbox { layers, ..Sandbox::none() };
        sandbox.missing().into_iter().map(|isolation| isolation.from).collect()
    }

    #[test]
    fn a_sandbox_isolates_from_files_and_from_the_network() {
        assert_eq!(with(&[]), ["the files of others", "the network"]);
        assert_eq!(with(&[("resource_limits", true), ("process_tree", true)]), ["the files of others", "the network"]);
        assert_eq!(with(&[("landlock", true), ("seccomp", false)]), ["the network"]);
        assert_eq!(with(&[("mount_namespace", false), ("network_namespace", true)]), ["the files of others"]);
        assert!(with(&[("mount_namespace", true), ("seccomp", true)]).is_empty());
        assert!(with(&[("landlock", true), ("network_namespace", true)]).is_empty());
    }
}
