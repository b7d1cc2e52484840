//! A root folder with only the files that the program may see.

use std::collections::BTreeMap;
use std::fs::{self, DirBuilder};
use std::io;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{DirBuilderExt, symlink};
use std::path::{Path, PathBuf};

use nix::mount::{MntFlags, MsFlags, mount, umount2};
use nix::sys::statvfs::{FsFlags, statvfs};
use nix::unistd::{chdir, pivot_root};

use super::{Confined, Profile};

/// Mount point of the old root until the new one is complete.
const OLD: &str = "/.old";

const DEVICES: [&str; 3] = ["/dev/null", "/dev/zero", "/dev/urandom"];

/// Moves this process, which has a mount namespace of its own, into a new root.
pub fn build(confined: &Confined) -> io::Result<()> {
    const NONE: Option<&str> = None;
    mount(NONE, "/", NONE, MsFlags::MS_REC | MsFlags::MS_PRIVATE, NONE)?;
    // Any folder is suitable, because the new root is moved at once.
    let place = "/proc";
    mount(Some("tmpfs"), place, Some("tmpfs"), MsFlags::MS_NOSUID | MsFlags::MS_NODEV, Some("size=1m,mode=755"))?;
    chdir(place)?;
    fs::create_dir(OLD.trim_start_matches('/'))?;
    pivot_root(".", OLD.trim_start_matches('/'))?;
    chdir("/")?;
    for (path, writable) in in_order(confined) {
        show(&path, writable).map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", path.display())))?;
    }
    for device in DEVICES {
        bind(Path::new(device))?;
    }
    // A program that panics looks here for its own file, to name the lines of its calls. Of /proc there is nothing else, and no list.
    if confined.profile == Profile::Submission {
        DirBuilder::new().mode(0o711).recursive(true).create("/proc/self")?;
        symlink(&confined.program, "/proc/self/exe")?;
    }
    umount2(OLD, MntFlags::MNT_DETACH)?;
    fs::remove_dir(OLD)?;
    let fixed = MsFlags::MS_REMOUNT | MsFlags::MS_BIND | MsFlags::MS_RDONLY | MsFlags::MS_NOSUID | MsFlags::MS_NODEV;
    Ok(mount(NONE, "/", NONE, fixed, NONE)?)
}

/// Outer folders before inner ones; what is in both lists is writable.
fn in_order(confined: &Confined) -> BTreeMap<PathBuf, bool> {
    let readable = confined.readable.iter().map(|path| (path.clone(), false));
    readable.chain(confined.writable.iter().map(|path| (path.clone(), true))).collect()
}

/// Makes one path of the old root appear in the new one.
fn show(path: &Path, writable: bool) -> io::Result<()> {
    let before = old(path);
    if fs::symlink_metadata(&before)?.is_symlink() {
        // A folder such as /bin; the target of the link must be listed too.
        return if fs::symlink_metadata(path).is_ok() { Ok(()) } else { link(&fs::read_link(&before)?, path) };
    }
    bind(path)?;
    let mut inside = vec![path.to_path_buf()];
    inside.extend(mounts_below(path)?);
    inside.iter().try_for_each(|mounted| seal(mounted, writable))
}

fn old(path: &Path) -> PathBuf {
    Path::new(OLD).join(path.strip_prefix("/").unwrap_or(path))
}

fn link(target: &Path, path: &Path) -> io::Result<()> {
    if let Some(parent) = path.parent() {
        fs::create_dir_all(parent)?;
    }
    symlink(target, path)
}

fn bind(path: &Path) -> io::Result<()> {
    let before = old(path);
    if fs::metadata(&before)?.is_dir() {
        fs::create_dir_all(path)?;
    } else if fs::symlink_metadata(path).is_err() {
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent)?;
        }
        fs::write(path, "")?;
    }
    Ok(mount(Some(&before), path, None::<&str>, MsFlags::MS_BIND | MsFlags::MS_REC, None::<&str>)?)
}

/// Makes a mount read-only or not, without devices and programs of other users' rights.
fn seal(path: &Path, writable: bool) -> io::Result<()> {
    let mut flags = MsFlags::MS_REMOUNT | MsFlags::MS_BIND | MsFlags::MS_NOSUID | MsFlags::MS_NODEV;
    // In a user namespace, restrictions of a mount cannot be removed.
    let kept = [
        (FsFlags::ST_RDONLY, MsFlags::MS_RDONLY),
        (FsFlags::ST_NOEXEC, MsFlags::MS_NOEXEC),
        (FsFlags::ST_NOATIME, MsFlags::MS_NOATIME),
        (FsFlags::ST_NODIRATIME, MsFlags::MS_NODIRATIME),
        (FsFlags::ST_RELATIME, MsFlags::MS_RELATIME),
    ];
    let before = statvfs(path)?.flags();
    flags.extend(kept.into_iter().filter(|(had, _)| before.contains(*had)).map(|(_, keeps)| keeps));
    if !writable {
        flags |= MsFlags::MS_RDONLY;
    }
    Ok(mount(None::<&str>, path, None::<&str>, flags, None::<&str>)?)
}

/// Mounts inside of a folder that came along with it.
fn mounts_below(path: &Path) -> io::Result<Vec<PathBuf>> {
    let table = fs::read_to_string(old(Path::new("/proc/self/mountinfo")))?;
    let points = table.lines().filter_map(|line| line.split(' ').nth(4)).map(unescape);
    Ok(points.filter(|point| point != path && point.starts_with(path)).collect())
}

/// The table writes blanks, tabs, line ends and backslashes as `\040`, …
fn unescape(point: &str) -> PathBuf {
    let mut bytes = Vec::new();
    let mut rest = point.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let octal = after.get(..3).filter(|_| first == b'\\').and_then(|digits| std::str::from_utf8(digits).ok());
        match octal.and_then(|digits| u8::from_str_radix(digits, 8).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[3..];
            }
            None => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    PathBuf::from(std::ffi::OsStr::from_bytes(&bytes))
}
