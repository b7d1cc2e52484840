//! The files of a study: tables for programs, a page for readers.

use std::io;
use std::path::Path;

use super::page;
use super::results::Results;

/// Writes `stability.csv`, `stability.json` and `stability.html` into a folder, and a picture of each map.
pub fn write(results: &Results, folder: &Path) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("stability.csv"), results.csv()?)?;
    std::fs::write(folder.join("stability.json"), serde_json::to_string_pretty(results)? + "\n")?;
    for map in &results.maps {
        let picture = page::picture(map).standalone();
        std::fs::write(folder.join(format!("stability-{}.svg", map.integrator)), picture)?;
    }
    std::fs::write(folder.join("stability.html"), page::render(results))
}
