//! The lock file of the students' repository: ours without the packages that are no longer needed, with all versions unchanged; and the
//! profiles of the remaining packages.

use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

use super::{HandoutError, manifest};

/// Lets cargo remove from `Cargo.lock` in `folder` the packages that the manifests there do not ask for. Cargo alone knows which
/// features are left, and so which optional dependencies; a lock file that it would change breaks `--locked` and needs the registry.
pub fn settle(folder: &Path) -> Result<(), HandoutError> {
    let failed = |problem: String| HandoutError::unusable("Cargo.lock", problem);
    let update = |more: &[&str]| {
        let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.args(["update", "--workspace", "--quiet"]).args(more).current_dir(folder);
        match cargo.output() {
            Ok(output) if output.status.success() => Ok(()),
            Ok(output) => Err(failed(format!(
                "cargo cannot settle it; try again where cargo reaches its registry\n{}",
                String::from_utf8_lossy(&output.stderr).trim_end()
            ))),
            Err(error) => Err(failed(format!("cargo does not start: {error}"))),
        }
    };
    // The packages that this program was built with are on this machine already, so the network is tried second.
    update(&["--offline"]).or_else(|_| update(&[]))?;
    let read = |name: &str| fs::read_to_string(folder.join(name)).map_err(HandoutError::io(&folder.join(name)));
    let root = manifest::with_locked_profiles(&read("Cargo.toml")?, &read("Cargo.lock")?).map_err(failed)?;
    fs::write(folder.join("Cargo.toml"), root).map_err(HandoutError::io(&folder.join("Cargo.toml")))
}
