//! Checks again whenever a file is saved.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use notify::{RecursiveMode, Watcher, recommended_watcher};

use super::{CheckError, Options, What, judged_in, reports, show, usable};
use crate::properties::FUNCTIONS;
use crate::sandbox::Sandbox;

/// Editors save a file in several events. A file counts as saved after this time without another event.
const QUIET: Duration = Duration::from_millis(200);

/// Checks all functions, then those that a change of a file in `src` may concern, until the program is stopped.
///
/// # Errors
/// The reason if the folder or the name is not usable or cannot be watched. Problems that a later check finds are printed, and
/// watching goes on.
pub fn watch(sandbox: &Sandbox, options: &Options) -> Result<(), CheckError> {
    let folder = &options.folder;
    let only = usable(folder, options.only.as_deref())?.1;
    let (sender, changes) = channel();
    let mut watcher = recommended_watcher(move |event: notify::Result<notify::Event>| {
        // Reading a file is an event too, and the checks read them all.
        if let Some(event) = event.ok().filter(|event| !event.kind.is_access()) {
            // The receiver is gone when watching ends.
            let _ = sender.send(event.paths);
        }
    })?;
    watcher.watch(&folder.join("src"), RecursiveMode::NonRecursive)?;
    let (mut changed, mut earlier) = (None, None);
    loop {
        let what = match (only, changed, earlier.take()) {
            (Some(name), ..) => What::One(name),
            (None, Some(name), Some(earlier)) => What::Changed(name, earlier),
            (None, ..) => What::All,
        };
        match judged_in(sandbox, folder, what) {
            Ok((judged, roles)) => {
                show(options, &reports(&judged, &roles, only), changed);
                earlier = Some(judged);
            }
            Err(error) => eprintln!("{error}"),
        }
        println!("waiting for a file to be saved in {}; stop with Ctrl-C", folder.join("src").display());
        let Some(paths) = saved(&changes) else { return Ok(()) };
        changed = function_of(&paths);
    }
}

/// The files that are saved next, of which one is Rust's; `None` when watching ends.
fn saved(changes: &Receiver<Vec<PathBuf>>) -> Option<BTreeSet<PathBuf>> {
    loop {
        let mut paths = BTreeSet::from_iter(changes.recv().ok()?);
        while let Ok(more) = changes.recv_timeout(QUIET) {
            paths.extend(more);
        }
        // Editors write copies and locks, too.
        if paths.iter().any(|path| path.extension().is_some_and(|end| end == "rs")) {
            return Some(paths);
        }
    }
}

/// The function that these files are about, if it is one: editors also write copies and locks beside it.
fn function_of(paths: &BTreeSet<PathBuf>) -> Option<&'static str> {
    let file = |name: &str| format!("{name}.rs");
    let is_saved =
        |name: &&str| paths.iter().any(|path| path.file_name().is_some_and(|found| found == file(name).as_str()));
    let mut names = FUNCTIONS.iter().map(|(name, _)| *name).filter(is_saved);
    names.next().filter(|_| names.next().is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_saved_function_is_known_among_an_editors_copies_and_two_at_once_are_not() {
        let found =
            |names: &[&str]| function_of(&names.iter().map(|name| PathBuf::from("/a/src").join(name)).collect());
        assert_eq!(found(&["psi_neo_hookean.rs", ".psi_neo_hookean.rs.swp", "4913"]), Some("psi_neo_hookean"));
        assert_eq!(found(&["psi_neo_hookean.rs", "dpsi_neo_hookean_dF.rs"]), None);
        assert_eq!(found(&["lib.rs"]), None);
    }
}
