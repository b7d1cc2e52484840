//! A program that runs, as the grader sees it.

use std::io::{self, BufRead, BufReader};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use super::spec::{Control, News, Spec};
use super::{Confined, Sandbox};

/// How long a killed process tree may take to vanish, and a launcher to begin.
const PATIENCE: Duration = Duration::from_secs(10);

/// A program that runs. Dropping it kills the whole process tree.
pub struct Running {
    /// The other end of the program's standard input.
    pub socket: UnixStream,
    tree: Tree,
}

impl Running {
    /// Kills the program and all that it has started.
    pub fn kill(&mut self) {
        self.tree.kill();
    }

    /// Waits at most so long for the end of the program. Says how it ended: `exit code 0`, `signal 9 (killed)`, …
    pub fn ended(&mut self, wait: Duration) -> Option<String> {
        self.tree.ended(wait).map(|end| end.to_string())
    }
}

/// Starts a program with a socket as its standard input.
pub fn start(sandbox: &Sandbox, confined: &Confined) -> io::Result<Running> {
    let (ours, theirs) = UnixStream::pair()?;
    let input = Stdio::from(OwnedFd::from(theirs));
    let tree = match &sandbox.launcher {
        None => Tree::plain(confined, |command| command.stdin(input).stdout(Stdio::null()).stderr(Stdio::null()))?,
        Some(_) => {
            Tree::launch(sandbox, confined, Control::Stdout, |command| command.stdin(input).stderr(Stdio::null()))?
        }
    };
    Ok(Running { socket: ours, tree })
}

/// How a program ended.
#[derive(Clone, Debug)]
pub struct End {
    pub code: Option<i32>,
    pub signal: Option<i32>,
    pub timed_out: bool,
    pub seconds: f64,
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.timed_out, self.code, self.signal) {
            (true, ..) => f.write_str("its time was over"),
            (_, Some(code), _) => write!(f, "exit code {code}"),
            (_, _, Some(signal)) => write!(f, "signal {signal} ({})", meaning(signal)),
            _ => f.write_str("nobody knows how"),
        }
    }
}

/// What a signal says about the program. The numbers are the same on all systems that run it.
fn meaning(signal: i32) -> &'static str {
    match signal {
        4 => "abort or invalid instruction",
        6 => "abort or stack overflow",
        8 => "arithmetic",
        9 => "killed, or out of processor time",
        11 => "stack overflow, abort or invalid access",
        24 => "out of processor time",
        25 => "file too large",
        31 => "forbidden system call",
        _ => "unexpected",
    }
}

/// A process tree and the way to its end.
pub struct Tree {
    pub child: Child,
    /// The socket to the launcher: when it closes, the launcher kills everything. None for a plain program.
    control: Option<BufReader<UnixStream>>,
    /// When a plain program's time is over.
    deadline: Instant,
    end: Option<End>,
}

impl Tree {
    /// Starts a program without any layer; `wire` connects its standard descriptors.
    pub fn plain(confined: &Confined, wire: impl FnOnce(&mut Command) -> &mut Command) -> io::Result<Self> {
        let mut command = Command::new(&confined.program);
        command
            .args(&confined.arguments)
            .env_clear()
            .envs(confined.environment.iter().map(|(name, value)| (name, value)));
        command.current_dir(&confined.folder).process_group(0);
        let child = wire(&mut command).spawn()?;
        Ok(Self { child, control: None, deadline: Instant::now() + confined.limits.wall, end: None })
    }

    /// Starts a program through the launcher and waits until it has begun.
    pub fn launch(
        sandbox: &Sandbox,
        confined: &Confined,
        control: Control,
        wire: impl FnOnce(&mut Command) -> &mut Command,
    ) -> io::Result<Self> {
        let Some(launcher) = &sandbox.launcher else { return Err(io::Error::other("the sandbox has no launcher")) };
        let layers = sandbox.layers.iter().filter(|(_, there)| **there).map(|(name, _)| name.clone()).collect();
        let spec = Spec { confined: confined.clone(), layers, owner: unused_user(), control };
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

    /// What the launcher says next; `None` if it says nothing for so long.
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

    /// Waits at most so long for the end.
    pub fn ended(&mut self, wait: Duration) -> Option<End> {
        if self.end.is_none() {
            self.end = if self.control.is_some() { self.launched_end(wait) } else { self.plain_end(wait) };
        }
        self.end.clone()
    }

    fn launched_end(&mut self, wait: Duration) -> Option<End> {
        match self.news(wait) {
            Ok(Some(News::Ended { code, signal, timed_out, seconds })) => {
                Some(End { code, signal, timed_out, seconds })
            }
            Ok(None) => None,
            // The launcher is gone or talks nonsense, so what it kept is dead, or about to be.
            Ok(Some(_)) | Err(_) => {
                self.kill();
                Some(End { code: None, signal: None, timed_out: false, seconds: 0.0 })
            }
        }
    }

    fn plain_end(&mut self, wait: Duration) -> Option<End> {
        let until = Instant::now() + wait;
        loop {
            let timed_out = Instant::now() >= self.deadline;
            if timed_out {
                self.kill_plain();
            }
            if let Ok(Some(status)) = self.child.try_wait() {
                return Some(End { code: status.code(), signal: status.signal(), timed_out, seconds: 0.0 });
            }
            if Instant::now() >= until {
                return None;
            }
            thread::sleep(Duration::from_millis(1));
        }
    }

    /// Kills everything and waits until it is gone.
    pub fn kill(&mut self) {
        if self.control.take().is_none() {
            self.kill_plain();
        }
        let until = Instant::now() + PATIENCE;
        while matches!(self.child.try_wait(), Ok(None)) {
            if Instant::now() >= until {
                self.kill_plain();
            }
            thread::sleep(Duration::from_micros(200));
        }
    }

    /// Kills the group of processes that was started.
    fn kill_plain(&mut self) {
        // The process may be gone already, which is what is wanted.
        #[cfg(target_os = "linux")]
        if matches!(self.child.try_wait(), Ok(None)) {
            let group = nix::unistd::Pid::from_raw(self.child.id().cast_signed());
            let _ = nix::sys::signal::killpg(group, nix::sys::signal::Signal::SIGKILL);
        }
        let _ = self.child.kill();
    }
}

impl Drop for Tree {
    fn drop(&mut self) {
        self.kill();
    }
}

/// One of the user numbers that neither distributions nor systemd give to anyone, another one for each start.
fn unused_user() -> u32 {
    static NEXT: AtomicU32 = AtomicU32::new(0);
    61_000 + (std::process::id().wrapping_add(NEXT.fetch_add(1, Ordering::Relaxed))) % 184
}
