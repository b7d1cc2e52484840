//! The process that becomes the program. It drops its rights one by one before it executes the program.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::os::fd::{AsRawFd, RawFd};
use std::os::unix::process::CommandExt;
use std::process::Command;

use nix::errno::Errno;
use nix::sys::prctl::{set_no_new_privs, set_pdeathsig};
use nix::sys::resource::{Resource, setrlimit};
use nix::sys::signal::Signal;
use nix::unistd::setsid;

use super::spec::Spec;
use super::{calls, cgroup, files, owner, root};

/// Size of the main thread's stack, bytes. It is fixed so that results do not depend on `ulimit`.
const STACK: u64 = 8 << 20;

/// Becomes the program. Returns only on failure, which the keeper learns through its pipe.
pub fn enter(pipe: &str, spec: &str) -> Result<(), String> {
    // Opened anew, it closes by itself when the program begins.
    let mut report =
        OpenOptions::new().write(true).open(format!("/proc/self/fd/{pipe}")).map_err(|error| error.to_string())?;
    let why = match serde_json::from_str(spec) {
        Ok(spec) => restrict(&spec, report.as_raw_fd()).err().unwrap_or_else(|| begin(&spec)),
        Err(error) => error.to_string(),
    };
    report.write_all(why.as_bytes()).map_err(|error| error.to_string())
}

/// All layers, in the order in which each still has the rights that it needs.
fn restrict(spec: &Spec, report: RawFd) -> Result<(), String> {
    close_descriptors(report).map_err(|error| format!("descriptors: {error}"))?;
    let itself = File::open("/proc/self").map_err(|error| format!("/proc: {error}"))?;
    if let Some(tree) = spec.cgroup.as_ref().filter(|_| spec.layers.contains("memory_cgroup")) {
        cgroup::join(tree).map_err(|error| format!("memory_cgroup: {error}"))?;
    }
    if spec.layers.contains("own_user") {
        for path in &spec.confined.writable {
            owner::give(path, spec.owner).map_err(|error| format!("own_user: {}: {error}", path.display()))?;
        }
    }
    if spec.layers.contains("mount_namespace") {
        root::build(&spec.confined).map_err(|error| format!("mount_namespace: {error}"))?;
    }
    if spec.layers.contains("resource_limits") {
        limit(spec).map_err(|error| format!("resource_limits: {error}"))?;
    }
    owner::change(spec, &itself)?;
    if spec.layers.contains("process_tree") {
        detach().map_err(|error| format!("process_tree: {error}"))?;
    }
    if spec.layers.contains("landlock") {
        files::restrict(&spec.confined).map_err(|error| format!("landlock: {error}"))?;
    }
    if spec.layers.contains("seccomp") {
        calls::restrict(spec.confined.profile).map_err(|error| format!("seccomp: {error}"))?;
    }
    Ok(())
}

/// Closes what this process has inherited beside the three standard descriptors.
fn close_descriptors(report: RawFd) -> io::Result<()> {
    let mut open = Vec::new();
    for entry in fs::read_dir("/proc/self/fd")? {
        open.extend(entry?.file_name().to_str().and_then(|name| name.parse::<RawFd>().ok()));
    }
    for descriptor in open.into_iter().filter(|descriptor| *descriptor > 2 && *descriptor != report) {
        match nix::unistd::close(descriptor) {
            // The list holds the descriptor with which it was read.
            Ok(()) | Err(Errno::EBADF) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}

fn limit(spec: &Spec) -> nix::Result<()> {
    let limits = &spec.confined.limits;
    let cpu = limits.cpu.as_secs() + u64::from(limits.cpu.subsec_nanos() > 0);
    let mut values = vec![
        // With zero, a system that pipes core dumps to a program would still write one; with one byte it does not.
        (Resource::RLIMIT_CORE, 1),
        (Resource::RLIMIT_CPU, cpu),
        (Resource::RLIMIT_AS, limits.memory),
        (Resource::RLIMIT_FSIZE, limits.file_size),
        (Resource::RLIMIT_NOFILE, limits.open_files),
        (Resource::RLIMIT_STACK, STACK),
    ];
    // Processes are counted per user. Where the user is the grader's own, that would count everything else too.
    if spec.layers.contains("own_user") || spec.layers.contains("user_namespace") {
        values.push((Resource::RLIMIT_NPROC, limits.processes));
    }
    values.into_iter().try_for_each(|(resource, value)| setrlimit(resource, value, value))
}

/// A session of its own, no way to new rights, and death with the keeper.
fn detach() -> nix::Result<()> {
    set_pdeathsig(Signal::SIGKILL)?;
    setsid()?;
    set_no_new_privs()
}

/// Becomes the program, or returns the reason for the failure.
fn begin(spec: &Spec) -> String {
    let confined = &spec.confined;
    let mut command = Command::new(&confined.program);
    command.args(&confined.arguments).current_dir(&confined.folder);
    command.env_clear().envs(confined.environment.iter().map(|(name, value)| (name, value)));
    format!("{}: {}", confined.program.display(), command.exec())
}
