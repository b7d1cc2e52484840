//! Memory for factors.

/// Memory that the operating system can give without swapping, in bytes; `None` where it does not say.
pub(super) fn available_memory() -> Option<usize> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: usize = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kibibytes * 1024)
}

/// Returns true if the factor of a body of so many nodes is expected to fit into memory. In nested dissection of a compact body of n unknowns
/// it grows as n^(4/3); those of cubes of 9 261 and 29 791 nodes and their workspaces take 202 and 1 007 MB, 30 and 32 n^(4/3)
/// numbers of eight bytes; those of slender bodies take less. A few more are asked for.
pub fn factor_fits(nodes: usize) -> bool {
    let bytes = 8.0 * 36.0 * (3.0 * nodes as f64).powf(4.0 / 3.0);
    available_memory().is_none_or(|available| bytes < available as f64)
}
