//! The user that the program runs as.

use std::fs::{self, File};
use std::io::{self, Write};
use std::os::unix::fs::{MetadataExt, lchown};
use std::path::Path;

use nix::errno::Errno;
use nix::fcntl::{OFlag, openat};
use nix::sched::{CloneFlags, unshare};
use nix::sys::stat::Mode;
use nix::unistd::{Gid, Uid, setgroups, setresgid, setresuid};

use super::spec::Spec;

/// The user inside a namespace.
const NOBODY: u32 = 61_000;

/// Becomes the user of the spec; `itself` is the folder `/proc/self`.
pub fn change(spec: &Spec, itself: &File) -> Result<(), String> {
    if spec.layers.contains("own_user") {
        let gone = |error| format!("own_user: {error}");
        setgroups(&[]).map_err(gone)?;
        let group = Gid::from_raw(spec.owner);
        setresgid(group, group, group).map_err(gone)?;
        let user = Uid::from_raw(spec.owner);
        setresuid(user, user, user).map_err(gone)?;
    } else if spec.layers.contains("user_namespace") {
        // A second namespace, in which the program is not root, and after its start has no right over the first.
        let (user, group) = (nix::unistd::geteuid(), nix::unistd::getegid());
        unshare(CloneFlags::CLONE_NEWUSER).map_err(|error| format!("user_namespace: {error}"))?;
        map(itself, (NOBODY, user.as_raw()), (NOBODY, group.as_raw()))
            .map_err(|error| format!("user_namespace: {error}"))?;
    }
    Ok(())
}

/// Maps the one user and the one group of a new user namespace: (inside, outside).
pub fn map(itself: &File, user: (u32, u32), group: (u32, u32)) -> io::Result<()> {
    let lines = [
        ("setgroups", "deny".to_string()),
        ("uid_map", format!("{} {} 1", user.0, user.1)),
        ("gid_map", format!("{} {} 1", group.0, group.1)),
    ];
    for (name, line) in lines {
        let file = match openat(itself, name, OFlag::O_WRONLY | OFlag::O_CLOEXEC, Mode::empty()) {
            // Kernels before 3.19 do not ask for it.
            Err(Errno::ENOENT) if name == "setgroups" => continue,
            file => file?,
        };
        File::from(file).write_all(line.as_bytes())?;
    }
    Ok(())
}

/// Gives a folder and what is in it to the user of the program.
pub fn give(path: &Path, owner: u32) -> io::Result<()> {
    let metadata = fs::symlink_metadata(path)?;
    // A file with several hard links may also be outside this folder, where it does not belong to the program.
    if metadata.uid() != owner && (metadata.is_dir() || metadata.nlink() == 1) {
        lchown(path, Some(owner), Some(owner))?;
    }
    if metadata.is_dir() {
        for entry in fs::read_dir(path)? {
            give(&entry?.path(), owner)?;
        }
    }
    Ok(())
}
