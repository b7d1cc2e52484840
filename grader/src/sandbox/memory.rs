//! The memory of a process tree. Each process has a limit of its own; the launcher adds up what all of them hold.

use std::collections::HashMap;
use std::fs;

/// Bytes of a page; larger pages only make the sum too small, and each process has its own limit besides.
const PAGE: u64 = 4096;

/// Memory that the processes below this one hold, bytes.
pub fn of_descendants() -> u64 {
    let mut families: HashMap<u32, Vec<u32>> = HashMap::new();
    for (child, parent) in processes() {
        families.entry(parent).or_default().push(child);
    }
    let (mut next, mut held) = (vec![std::process::id()], 0);
    while let Some(parent) = next.pop() {
        // Taken out, so that a number which is used again meanwhile makes no circle.
        for child in families.remove(&parent).unwrap_or_default() {
            held += resident(child);
            next.push(child);
        }
    }
    held
}

/// All processes, each with its parent.
pub fn processes() -> impl Iterator<Item = (u32, u32)> {
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    let numbers = entries.filter_map(|entry| entry.file_name().to_str()?.parse::<u32>().ok());
    numbers.filter_map(|pid| Some((pid, parent(pid)?)))
}

/// The parent of a process.
fn parent(pid: u32) -> Option<u32> {
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    // After the name, which may hold anything: `) state parent …`.
    stat.rsplit_once(')').and_then(|(_, rest)| rest.split_whitespace().nth(1))?.parse().ok()
}

fn resident(pid: u32) -> u64 {
    let sizes = fs::read_to_string(format!("/proc/{pid}/statm")).unwrap_or_default();
    sizes.split_whitespace().nth(1).and_then(|pages| pages.parse::<u64>().ok()).map_or(0, |pages| pages * PAGE)
}
