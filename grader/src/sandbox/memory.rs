//! The descendants of the launcher and their total memory. In addition each process has a limit of its own.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, Read};

use nix::dir::Dir;
use nix::fcntl::{OFlag, openat};
use nix::sys::stat::Mode;

/// Bytes of a page; larger pages only make the sum too small.
const PAGE: u64 = 4096;

/// The machine's processes. The folder stays open, because the launcher soon has another root without it.
pub struct Processes(File);

impl Processes {
    /// Opens the list.
    pub fn open() -> io::Result<Self> {
        File::open("/proc").map(Self)
    }

    /// Resident memory of all descendants of this process, bytes.
    pub fn memory_below(&self) -> u64 {
        let mut families: HashMap<u32, Vec<u32>> = HashMap::new();
        for (child, parent) in self.all() {
            families.entry(parent).or_default().push(child);
        }
        let (mut next, mut bytes) = (vec![std::process::id()], 0);
        while let Some(parent) = next.pop() {
            // Removed, so that a process number that is used again makes no cycle.
            for child in families.remove(&parent).unwrap_or_default() {
                bytes += self.resident(child);
                next.push(child);
            }
        }
        bytes
    }

    /// The processes whose parent is this one.
    pub fn children(&self) -> Vec<u32> {
        let own = std::process::id();
        self.all().into_iter().filter(|(_, parent)| *parent == own).map(|(pid, _)| pid).collect()
    }

    /// All processes, each with its parent.
    fn all(&self) -> Vec<(u32, u32)> {
        let listed = Dir::openat(&self.0, ".", OFlag::O_RDONLY | OFlag::O_CLOEXEC | OFlag::O_DIRECTORY, Mode::empty());
        let Ok(mut entries) = listed else { return Vec::new() };
        let numbers = entries.iter().flatten().filter_map(|entry| entry.file_name().to_str().ok()?.parse::<u32>().ok());
        numbers.filter_map(|pid| Some((pid, self.parent(pid)?))).collect()
    }

    fn parent(&self, pid: u32) -> Option<u32> {
        let stat = self.text(pid, "stat")?;
        // After the name, which may hold anything: `) state parent …`.
        stat.rsplit_once(')').and_then(|(_, rest)| rest.split_whitespace().nth(1))?.parse().ok()
    }

    fn resident(&self, pid: u32) -> u64 {
        let sizes = self.text(pid, "statm").unwrap_or_default();
        sizes.split_whitespace().nth(1).and_then(|pages| pages.parse::<u64>().ok()).map_or(0, |pages| pages * PAGE)
    }

    /// A file about a process; `None` if the process has ended.
    fn text(&self, pid: u32, name: &str) -> Option<String> {
        let path = format!("{pid}/{name}");
        let file = openat(&self.0, path.as_str(), OFlag::O_RDONLY | OFlag::O_CLOEXEC, Mode::empty()).ok()?;
        let mut bytes = Vec::new();
        File::from(file).read_to_end(&mut bytes).ok()?;
        Some(String::from_utf8_lossy(&bytes).into_owned())
    }
}
