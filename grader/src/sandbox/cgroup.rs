//! Memory of a tree of processes by a cgroup (version 2) of its own: the kernel counts it, ends the tree that has too much, and says so.
//!
//! A cgroup that gives controllers to its children may hold no process itself (Linux, *Control Group v2*, section "No Internal Process
//! Constraint"). So the grader first moves into a child, if it is alone in its cgroup; the trees get children beside that one.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process;
use std::thread;
use std::time::Duration;

use super::Limits;

/// Places at which version 2 is mounted: alone, or beside version 1.
const MOUNTS: [&str; 2] = ["/sys/fs/cgroup", "/sys/fs/cgroup/unified"];

/// The child that holds the grader itself.
const GRADER: &str = "grader";

/// Begin of the names of the children that hold a tree.
const TREE: &str = "grade-";

/// The remedy where the cgroup is not the grader's own.
const REMEDY: &str =
    "start the grader in a cgroup of its own, such as `systemd-run --user --scope -p Delegate=yes grader …`";

/// The cgroup in which this process may make children with a limit on memory; it moves into one of them if that is necessary.
///
/// # Errors
/// The reason why there is no such cgroup.
pub fn prepare() -> Result<PathBuf, String> {
    let membership = fs::read_to_string("/proc/self/cgroup").map_err(|error| format!("/proc/self/cgroup: {error}"))?;
    let is_mounted = |mount: &&&str| Path::new(mount).join("cgroup.controllers").exists();
    let mount = MOUNTS.iter().find(is_mounted).ok_or("no cgroups of version 2 are mounted")?;
    prepare_in(Path::new(mount), &membership, process::id())
}

/// The same for a hierarchy mounted at `mount`, and a process with the text of its `/proc/self/cgroup`.
fn prepare_in(mount: &Path, membership: &str, pid: u32) -> Result<PathBuf, String> {
    let path = membership.lines().find_map(|line| line.strip_prefix("0::/"));
    let own = mount.join(path.ok_or("this process is in no cgroup of version 2")?);
    // A grader that another one has started is in its child.
    let is_moved = own.file_name().is_some_and(|name| name == GRADER);
    let base = if is_moved { own.parent().unwrap_or(mount).to_owned() } else { own };
    let read = |name: &str| fs::read_to_string(base.join(name)).map_err(|error| at(&base.join(name), &error));
    let controllers = read("cgroup.controllers")?;
    if !lists(&controllers, "memory") {
        return Err(format!("{} has no controller `memory`; {REMEDY}", base.display()));
    }
    if !lists(&read("cgroup.subtree_control")?, "memory") {
        // The cgroup above all others may hold processes.
        if base.join("cgroup.type").exists() {
            move_down(&base, &read("cgroup.procs")?, pid)?;
        }
        let wanted: Vec<_> = ["memory", "pids"].into_iter().filter(|name| lists(&controllers, name)).collect();
        let wanted: Vec<_> = wanted.iter().map(|name| format!("+{name}")).collect();
        write(&base.join("cgroup.subtree_control"), &wanted.join(" ")).inspect_err(|_| move_up(&base, pid))?;
    }
    remove_empty(&base);
    Ok(base)
}

/// Moves the process into a child of the cgroup, in which no other process may be.
fn move_down(base: &Path, processes: &str, pid: u32) -> Result<(), String> {
    let others = processes.lines().filter(|line| line.trim() != pid.to_string()).count();
    if others > 0 {
        return Err(format!("{} holds other processes ({others}); {REMEDY}", base.display()));
    }
    let child = base.join(GRADER);
    make(&child)?;
    write(&child.join("cgroup.procs"), &pid.to_string()).inspect_err(|_| move_up(base, pid))
}

/// Undoes [`move_down`].
fn move_up(base: &Path, pid: u32) {
    // If this fails, the process stays in the child, which has no disadvantage.
    let _ = write(&base.join("cgroup.procs"), &pid.to_string());
    let _ = fs::remove_dir(base.join(GRADER));
}

/// Removes the cgroups of a killed grader. A cgroup with processes cannot be removed.
fn remove_empty(base: &Path) {
    let entries = fs::read_dir(base).into_iter().flatten().flatten();
    for entry in entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(TREE)) {
        let _ = fs::remove_dir(entry.path());
    }
}

fn lists(names: &str, name: &str) -> bool {
    names.split_whitespace().any(|listed| listed == name)
}

fn at(path: &Path, error: &io::Error) -> String {
    format!("{}: {error}; {REMEDY}", path.display())
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|error| at(path, &error))
}

fn make(folder: &Path) -> Result<(), String> {
    match fs::create_dir(folder) {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => Err(at(folder, &error)),
        _ => Ok(()),
    }
}

/// The cgroup of one tree of processes. Dropping it ends them and removes it.
pub struct Tree(PathBuf);

impl Tree {
    /// Makes the cgroup with its limits in one that [`prepare`] has found.
    ///
    /// # Errors
    /// The file that cannot be written.
    pub fn new(base: &Path, limits: &Limits) -> Result<Self, String> {
        let tree = Self(base.join(format!("{TREE}{}", process::id())));
        make(&tree.0)?;
        write(&tree.0.join("memory.max"), &limits.memory.to_string())?;
        // A kernel may have been built without swap, and the controller of processes may be another's.
        let _ = write(&tree.0.join("memory.swap.max"), "0");
        let _ = write(&tree.0.join("pids.max"), &limits.processes.to_string());
        // If memory runs out, the kernel kills all processes of the group, and not one of its choice.
        let _ = write(&tree.0.join("memory.oom.group"), "1");
        Ok(tree)
    }

    /// The folder of the cgroup.
    pub fn folder(&self) -> &Path {
        &self.0
    }

    /// Returns true if the kernel has killed a process because memory ran out.
    pub fn is_out_of_memory(&self) -> bool {
        let events = fs::read_to_string(self.0.join("memory.events")).unwrap_or_default();
        let killed = events.lines().find_map(|line| line.strip_prefix("oom_kill "));
        killed.and_then(|count| count.trim().parse::<u64>().ok()).is_some_and(|count| count > 0)
    }
}

impl Drop for Tree {
    fn drop(&mut self) {
        // Before Linux 5.14 this file does not exist; the processes have been waited for already.
        if self.0.join("cgroup.kill").exists() {
            let _ = write(&self.0.join("cgroup.kill"), "1");
        }
        for _ in 0..100 {
            match fs::remove_dir(&self.0) {
                // A process is still counted for a moment after its end.
                Err(error) if error.kind() == io::ErrorKind::ResourceBusy => thread::sleep(Duration::from_millis(5)),
                // If it cannot be removed, the next grader removes it.
                _ => return,
            }
        }
    }
}

/// Moves this process into the cgroup of a tree.
///
/// # Errors
/// The file that cannot be written.
pub fn join(tree: &Path) -> Result<(), String> {
    // Zero stands for the writing process.
    write(&tree.join("cgroup.procs"), "0")
}

#[cfg(test)]
mod tests;
