//! A grader's process tree, and the signals by which a user stops a run.

use std::fs::File;
use std::io;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// The leader of a process group. Dropping it kills the group.
pub struct Process {
    child: Child,
    deadline: Instant,
    reaped: bool,
}

/// State of a process.
pub enum State {
    Running,
    TimedOut,
    Ended(ExitStatus),
}

impl Process {
    /// Starts `command` with its output in the file `log`.
    pub fn start(command: &mut Command, log: &Path, limit: Duration) -> io::Result<Self> {
        let log = File::create(log)?;
        command.stdin(Stdio::null()).stdout(log.try_clone()?).stderr(log);
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(command, 0);
        let child = command.spawn()?;
        let now = Instant::now();
        let deadline = now.checked_add(limit).unwrap_or(now + Duration::from_secs(u32::MAX.into()));
        Ok(Self { child, deadline, reaped: false })
    }

    /// Returns the state without waiting.
    pub fn state(&mut self) -> io::Result<State> {
        if let Some(status) = self.child.try_wait()? {
            self.reaped = true;
            return Ok(State::Ended(status));
        }
        Ok(if Instant::now() >= self.deadline { State::TimedOut } else { State::Running })
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // Also after a regular end: processes that the grader left running must not slow down others. Errors mean that the group or
        // the child has ended already.
        kill_group(self.child.id());
        if !self.reaped {
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}

#[cfg(target_os = "linux")]
fn kill_group(leader: u32) {
    use nix::sys::signal::{Signal, killpg};
    if let Ok(leader) = i32::try_from(leader) {
        let _ = killpg(nix::unistd::Pid::from_raw(leader), Signal::SIGKILL);
    }
}

#[cfg(not(target_os = "linux"))]
fn kill_group(_leader: u32) {}

/// Has the kernel kill this process when its parent process `parent` ends, so that no grader continues to run after the run of a class
/// is killed.
#[cfg(target_os = "linux")]
pub fn end_with(parent: u32) -> io::Result<()> {
    nix::sys::prctl::set_pdeathsig(nix::sys::signal::Signal::SIGKILL)?;
    // It may have ended before the kernel was asked.
    if std::os::unix::process::parent_id() == parent {
        return Ok(());
    }
    Err(io::Error::other("the process that this one was to end with has ended already"))
}

/// On other systems a grader that outlives the run of its class ends with an error, because its folder has been removed.
#[cfg(not(target_os = "linux"))]
pub fn end_with(_parent: u32) -> io::Result<()> {
    Ok(())
}

/// Blocks SIGINT (Ctrl-C) and SIGTERM while it lives, and tells on request if one has arrived.
#[cfg(target_os = "linux")]
pub struct Interrupt {
    signals: nix::sys::signalfd::SignalFd,
    before: nix::sys::signal::SigSet,
}

#[cfg(target_os = "linux")]
impl Interrupt {
    /// Blocks both signals in this thread. Child processes start with the earlier signal mask.
    pub fn watch() -> io::Result<Self> {
        use nix::sys::signal::{SigSet, SigmaskHow, Signal};
        use nix::sys::signalfd::{SfdFlags, SignalFd};
        let mut set = SigSet::empty();
        set.add(Signal::SIGINT);
        set.add(Signal::SIGTERM);
        let before = set.thread_swap_mask(SigmaskHow::SIG_BLOCK)?;
        let signals = SignalFd::with_flags(&set, SfdFlags::SFD_NONBLOCK | SfdFlags::SFD_CLOEXEC)?;
        Ok(Self { signals, before })
    }

    /// Returns true if a signal has arrived since the last call.
    pub fn has_come(&mut self) -> io::Result<bool> {
        Ok(self.signals.read_signal()?.is_some())
    }
}

#[cfg(target_os = "linux")]
impl Drop for Interrupt {
    fn drop(&mut self) {
        // Setting a mask that was read a moment ago cannot fail.
        let _ = self.before.thread_set_mask();
    }
}

/// On other systems the signals end the program. Finished grades are kept.
#[cfg(not(target_os = "linux"))]
pub struct Interrupt;

#[cfg(not(target_os = "linux"))]
impl Interrupt {
    /// Does nothing.
    pub fn watch() -> io::Result<Self> {
        Ok(Self)
    }

    /// Never.
    pub fn has_come(&mut self) -> io::Result<bool> {
        Ok(false)
    }
}
