//! Programs that the launcher confines, and its reports about them.

use std::io::{self, BufRead, BufReader};
use std::net::Shutdown;
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::os::unix::process::CommandExt;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use super::super::spec::{Control, News, Spec};
use super::super::{Confined, Sandbox};
use super::{End, PATIENCE, Running, Tree};

/// Starts a program in the sandbox with a socket as its standard input.
pub fn launched(sandbox: &Sandbox, confined: &Confined) -> io::Result<Running> {
    let (socket, theirs) = UnixStream::pair()?;
    let input = Stdio::from(OwnedFd::from(theirs));
    let tree = Tree::launch(sandbox, confined, Control::Stdout, |command| command.stdin(input).stderr(Stdio::null()))?;
    Ok(Running { socket, tree })
}

impl Tree {
    /// Starts a program through the launcher and waits until it has begun.
    pub fn launch(
        sandbox: &Sandbox,
        confined: &Confined,
        control: Control,
        wire: impl FnOnce(&mut Command) -> &mut Command,
    ) -> io::Result<Self> {
        let Some(launcher) = &sandbox.launcher else { return Err(io::Error::other("the sandbox has no launcher")) };
        let layers = sandbox.layers.iter().filter(|(_, there)| **there).map(|(name, _)| name.clone()).collect();
        let spec = Spec {
            confined: confined.clone(),
            layers,
            owner: unused_user(),
            cgroup: sandbox.cgroup.clone().ok(),
            control,
        };
        let (ours, theirs) = UnixStream::pair()?;
        let theirs = Stdio::from(OwnedFd::from(theirs));
        let mut command = Command::new(launcher);
        command.args(["confine", "keep", &serde_json::to_string(&spec)?]).env_clear().process_group(0);
        match control {
            Control::Stdin => wire(&mut command).stdin(theirs),
            Control::Stdout => wire(&mut command).stdout(theirs),
        };
        let child = command.spawn()?;
        drop(command); // it holds the launcher's end of the socket
        let deadline = Instant::now() + confined.limits.wall;
        let mut tree = Self { child, control: Some(BufReader::new(ours)), deadline, end: None };
        match tree.news(PATIENCE)? {
            Some(News::Started) => Ok(tree),
            Some(News::Refused(why)) => Err(io::Error::other(format!("the sandbox cannot run the program: {why}"))),
            Some(News::Ended { .. }) | None => Err(io::Error::other("the sandbox does not start")),
        }
    }

    /// The launcher's next line; `None` if none comes within this time.
    fn news(&mut self, wait: Duration) -> io::Result<Option<News>> {
        let Some(control) = &mut self.control else { return Ok(None) };
        control.get_ref().set_read_timeout(Some(wait.max(Duration::from_millis(1))))?;
        let mut line = String::new();
        match control.read_line(&mut line) {
            Ok(0) => Err(io::Error::new(io::ErrorKind::UnexpectedEof, "the sandbox's launcher ended without a word")),
            Ok(_) => Ok(Some(serde_json::from_str(&line)?)),
            Err(error) if matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// Tells the launcher to end the program, and waits for its last report, which contains the processor time.
    pub(super) fn launcher_ends_it(&mut self) -> bool {
        let Some(control) = &self.control else { return false };
        // If the launcher has ended, the next line fails.
        let _ = control.get_ref().shutdown(Shutdown::Write);
        if self.end.is_none() {
            self.end = match self.news(PATIENCE) {
                Ok(Some(News::Ended { code, signal, timed_out, out_of_memory, seconds })) => {
                    Some(End { code, signal, timed_out, out_of_memory, seconds })
                }
                _ => None,
            };
        }
        self.control = None;
        true
    }

    pub(super) fn launched_end(&mut self, wait: Duration) -> Option<End> {
        match self.news(wait) {
            Ok(Some(News::Ended { code, signal, timed_out, out_of_memory, seconds })) => {
                Some(End { code, signal, timed_out, out_of_memory, seconds })
            }
            Ok(None) => None,
            // The launcher has ended or sends invalid lines. Its processes have been killed, or will be.
            Ok(Some(_)) | Err(_) => {
                self.kill();
                Some(End { code: None, signal: None, timed_out: false, out_of_memory: false, seconds: 0.0 })
            }
        }
    }
}

/// One of the user numbers that neither distributions nor systemd give to anyone, a different one for each start.
fn unused_user() -> u32 {
    static NEXT: AtomicU32 = AtomicU32::new(0);
    61_000 + (std::process::id().wrapping_add(NEXT.fetch_add(1, Ordering::Relaxed))) % 184
}
