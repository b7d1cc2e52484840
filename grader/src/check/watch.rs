//! Checks again whenever a file is saved.

use std::path::Path;
use std::sync::mpsc::channel;
use std::time::Duration;

use notify::{RecursiveMode, Watcher, recommended_watcher};

use super::{CheckError, check_in, print, usable};
use crate::sandbox::Sandbox;

/// Editors save in several strokes; this long without another one counts as saved.
const QUIET: Duration = Duration::from_millis(200);

/// Checks whenever a file in `src` changes, until the program is stopped.
///
/// # Errors
/// The reason if the folder or the name is not usable or cannot be watched. Problems that a later check finds are printed, and
/// watching goes on.
pub fn watch(sandbox: &Sandbox, folder: &Path, only: Option<&str>) -> Result<(), CheckError> {
    usable(folder, only)?;
    let (sender, changes) = channel();
    let mut watcher = recommended_watcher(move |event: notify::Result<notify::Event>| {
        // Reading a file is an event too, and the checks read them all.
        if event.is_ok_and(|event| !event.kind.is_access()) {
            // The receiver is gone when watching ends.
            let _ = sender.send(());
        }
    })?;
    watcher.watch(&folder.join("src"), RecursiveMode::NonRecursive)?;
    loop {
        match check_in(sandbox, folder, only) {
            Ok(reports) => print(&reports),
            Err(error) => eprintln!("{error}"),
        }
        println!("waiting for a file to be saved in {}; stop with Ctrl-C", folder.join("src").display());
        if changes.recv().is_err() {
            return Ok(());
        }
        while changes.recv_timeout(QUIET).is_ok() {}
    }
}
