//! Finds out which layers the machine has, by trying them.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

use nix::unistd::geteuid;

use super::{Confined, Limits, Profile, Sandbox, cgroup, library_folders};

/// Layers in the order in which they are tried, beside `user_namespace`.
const LAYERS: [&str; 9] = [
    "mount_namespace",
    "network_namespace",
    "pid_namespace",
    "ipc_namespace",
    "resource_limits",
    "process_tree",
    "landlock",
    "seccomp",
    "own_user",
];

/// The layer that is tried last, where there is a cgroup for it.
const CGROUP: &str = "memory_cgroup";

/// The sandbox with each layer, and whether the layer works together with the previous ones.
pub fn probe(launcher: &Path) -> Sandbox {
    let mut sandbox =
        Sandbox { launcher: Some(launcher.to_path_buf()), cgroup: cgroup::prepare(), layers: BTreeMap::new() };
    let has_cgroup = sandbox.cgroup.is_ok();
    let confined = nothing(launcher);
    let mut holds = |name: &str| {
        sandbox.layers.insert(name.to_string(), true);
        let holds = sandbox.run(&confined).is_ok_and(|ended| ended.code == Some(0));
        sandbox.layers.insert(name.to_string(), holds);
        holds
    };
    let root = geteuid().is_root();
    let mut layers = LAYERS.iter();
    // Root that may mount needs no user namespace, and is safer without: programs then run as another user.
    if !(root && holds(LAYERS[0])) {
        let _ = holds("user_namespace");
    } else {
        layers.next();
    }
    for name in layers {
        holds(name);
    }
    if has_cgroup && !holds(CGROUP) {
        sandbox.cgroup = Err("a trial with a cgroup failed".to_owned());
    }
    sandbox.layers.entry(CGROUP.to_string()).or_insert(false);
    sandbox
}

/// The launcher as a program that does nothing.
fn nothing(launcher: &Path) -> Confined {
    let mut readable = library_folders();
    readable.push(launcher.to_path_buf());
    Confined {
        program: launcher.to_path_buf(),
        arguments: vec!["confine".into(), "nothing".into()],
        environment: Vec::new(),
        folder: "/".into(),
        readable,
        writable: Vec::new(),
        profile: Profile::Submission,
        limits: Limits {
            wall: Duration::from_secs(5),
            cpu: Duration::from_secs(5),
            memory: 1 << 30,
            processes: 16,
            file_size: 1 << 20,
            open_files: 32,
            output: 1000,
        },
    }
}
