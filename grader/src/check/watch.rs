//! Checks again whenever a file is saved.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use notify::{RecursiveMode, Watcher, recommended_watcher};

use super::report::{Report, names_of};
use super::{CheckError, Options, check_in, show, usable};
use crate::properties::FUNCTIONS;
use crate::sandbox::Sandbox;

/// Editors save a file in several events. A file counts as saved after this time without another event.
const QUIET: Duration = Duration::from_millis(200);

/// Checks all functions, then those whose file in `src` changes, until the program is stopped.
///
/// # Errors
/// The reason if the folder or the name is not usable or cannot be watched. Problems that a later check finds are printed, and
/// watching goes on.
pub fn watch(sandbox: &Sandbox, options: &Options) -> Result<(), CheckError> {
    let (folder, only) = (&options.folder, options.only.as_deref());
    usable(folder, only)?;
    let (sender, changes) = channel();
    let mut watcher = recommended_watcher(move |event: notify::Result<notify::Event>| {
        // Reading a file is an event too, and the checks read them all.
        if let Some(event) = event.ok().filter(|event| !event.kind.is_access()) {
            // The receiver is gone when watching ends.
            let _ = sender.send(event.paths);
        }
    })?;
    watcher.watch(&folder.join("src"), RecursiveMode::NonRecursive)?;
    let mut reports = Vec::new();
    let mut changed = None;
    loop {
        let check = |only: Option<&str>| check_in(sandbox, folder, only);
        match checked_again(check, only, changed, &mut reports) {
            Ok(()) => show(options, &reports, changed),
            Err(error) => eprintln!("{error}"),
        }
        println!("waiting for a file to be saved in {}; stop with Ctrl-C", folder.join("src").display());
        let Some(paths) = saved(&changes) else { return Ok(()) };
        changed = function_of(&paths);
    }
}

/// Checks the function that has changed; all functions if several files have changed, or if others may have waited for this function.
fn checked_again(
    check: impl Fn(Option<&str>) -> Result<Vec<Report>, CheckError>,
    only: Option<&str>,
    changed: Option<&'static str>,
    reports: &mut Vec<Report>,
) -> Result<(), CheckError> {
    let before = reports.iter_mut().find(|report| Some(report.name) == changed).filter(|_| only.is_none());
    if let Some(before) = before {
        let outcome = |report: &Report| (report.status, names_of(&report.waits_for));
        let earlier = outcome(before);
        if let Some(now) = check(Some(before.name))?.into_iter().next() {
            *before = now;
        }
        if outcome(before) == earlier {
            return Ok(());
        }
    }
    *reports = check(only)?;
    Ok(())
}

/// The files that are saved next; `None` when watching ends.
fn saved(changes: &Receiver<Vec<PathBuf>>) -> Option<BTreeSet<PathBuf>> {
    let mut paths = BTreeSet::from_iter(changes.recv().ok()?);
    while let Ok(more) = changes.recv_timeout(QUIET) {
        paths.extend(more);
    }
    Some(paths)
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
