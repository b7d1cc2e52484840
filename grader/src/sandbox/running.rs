//! A running program, as the grader sees it.

#[cfg(target_os = "linux")]
mod launch;

use std::io;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use grader_child::socket::Socket;

use super::Confined;
#[cfg(target_os = "linux")]
pub use launch::launched;

/// Time that a killed process tree may take to end, and a launcher to start.
const PATIENCE: Duration = Duration::from_secs(10);

/// A running program. Dropping it kills the whole process tree.
pub struct Running {
    /// Connection to the program.
    pub socket: Socket,
    tree: Tree,
}

impl Running {
    /// Kills the program and all that it has started. Returns its processor time, zero outside a sandbox.
    pub fn kill(&mut self) -> Duration {
        self.tree.kill();
        let seconds = self.tree.end.as_ref().map_or(0.0, |end| end.seconds);
        Duration::try_from_secs_f64(seconds).unwrap_or_default()
    }

    /// Waits at most so long for the end of the program. Says how it ended: `exit code 0`, `signal 9 (killed)`, …
    pub fn ended(&mut self, wait: Duration) -> Option<String> {
        self.tree.ended(wait).map(|end| end.to_string())
    }
}

/// Starts a program without any layer, with a socket as its standard input.
#[cfg(unix)]
pub fn plain(confined: &Confined) -> io::Result<Running> {
    let (socket, theirs) = Socket::pair()?;
    let input = Stdio::from(std::os::fd::OwnedFd::from(theirs));
    let tree = Tree::plain(confined, |command| command.stdin(input).stdout(Stdio::null()).stderr(Stdio::null()))?;
    Ok(Running { socket, tree })
}

/// Starts a program without any layer, and waits until it has called back.
#[cfg(not(unix))]
pub fn plain(confined: &Confined) -> io::Result<Running> {
    let listener = std::net::TcpListener::bind((std::net::Ipv4Addr::LOCALHOST, 0))?;
    listener.set_nonblocking(true)?;
    let mut confined = confined.clone();
    confined.arguments.push(listener.local_addr()?.port().to_string());
    let mut tree =
        Tree::plain(&confined, |command| command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()))?;
    let until = Instant::now() + PATIENCE;
    loop {
        match listener.accept() {
            Ok((socket, _)) => {
                socket.set_nonblocking(false)?;
                socket.set_nodelay(true)?;
                return Ok(Running { socket, tree });
            }
            Err(error) if error.kind() != io::ErrorKind::WouldBlock || Instant::now() >= until => return Err(error),
            Err(_) => {}
        }
        if let Some(end) = tree.ended(Duration::from_millis(1)) {
            return Err(io::Error::other(format!("it ends at once: {end}")));
        }
    }
}

/// End of a program.
#[derive(Clone, Debug)]
pub struct End {
    pub code: Option<i32>,
    pub signal: Option<i32>,
    pub timed_out: bool,
    /// The memory of its processes together was used up, if the system reports that.
    pub out_of_memory: bool,
    pub seconds: f64,
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.timed_out, self.code, self.signal) {
            (true, ..) => f.write_str("its time was over"),
            _ if self.out_of_memory => f.write_str("killed: out of memory"),
            (_, Some(code), _) => match code.cast_unsigned() {
                // Exit codes of Windows.
                0xC000_00FD => f.write_str("stack overflow"),
                0xC000_0409 => f.write_str("abort"),
                _ => write!(f, "exit code {code}"),
            },
            (_, _, Some(signal)) => write!(f, "signal {signal} ({})", meaning(signal)),
            _ => f.write_str("for an unknown reason"),
        }
    }
}

/// The cause that a signal stands for. The numbers are the same on all systems that run it.
fn meaning(signal: i32) -> &'static str {
    match signal {
        4 => "abort or invalid instruction",
        6 => "abort or stack overflow",
        8 => "arithmetic",
        9 => "killed: out of memory or of processor time",
        11 => "stack overflow, abort or invalid access",
        24 => "out of processor time",
        25 => "file too large",
        31 => "forbidden system call",
        _ => "unexpected",
    }
}

/// A process tree, and the means to kill it.
pub struct Tree {
    pub child: Child,
    /// The socket to the launcher: when it closes, the launcher kills everything. None for a plain program.
    #[cfg(target_os = "linux")]
    control: Option<io::BufReader<Socket>>,
    /// Time limit of a plain program.
    deadline: Instant,
    end: Option<End>,
}

impl Tree {
    /// Starts a program without any layer; `wire` connects its standard descriptors.
    pub fn plain(confined: &Confined, wire: impl FnOnce(&mut Command) -> &mut Command) -> io::Result<Self> {
        let mut command = Command::new(&confined.program);
        command.args(&confined.arguments).current_dir(&confined.folder);
        // On other systems only the user's own environment tells where linker and system libraries are.
        if cfg!(target_os = "linux") {
            command.env_clear().envs(confined.environment.iter().map(|(name, value)| (name, value)));
        }
        // In the grader's own process group, so that Ctrl-C at a terminal also ends an endless loop.
        let child = wire(&mut command).spawn()?;
        Ok(Self {
            child,
            #[cfg(target_os = "linux")]
            control: None,
            deadline: Instant::now() + confined.limits.wall,
            end: None,
        })
    }

    /// Waits at most so long for the end.
    pub fn ended(&mut self, wait: Duration) -> Option<End> {
        if self.end.is_none() {
            self.end = self.end_within(wait);
        }
        self.end.clone()
    }

    fn end_within(&mut self, wait: Duration) -> Option<End> {
        #[cfg(target_os = "linux")]
        if self.control.is_some() {
            return self.launched_end(wait);
        }
        self.plain_end(wait)
    }

    fn plain_end(&mut self, wait: Duration) -> Option<End> {
        let until = Instant::now() + wait;
        loop {
            let timed_out = Instant::now() >= self.deadline;
            if timed_out {
                self.kill_plain();
            }
            if let Ok(Some(status)) = self.child.try_wait() {
                let (code, signal) = (status.code(), signal(status));
                return Some(End { code, signal, timed_out, out_of_memory: false, seconds: 0.0 });
            }
            if Instant::now() >= until {
                return None;
            }
            thread::sleep(Duration::from_millis(1));
        }
    }

    /// Kills everything and waits until it is gone.
    pub fn kill(&mut self) {
        let until = Instant::now() + PATIENCE;
        if !self.closes_control() {
            self.kill_plain();
        }
        while matches!(self.child.try_wait(), Ok(None)) {
            if Instant::now() >= until {
                self.kill_plain();
            }
            thread::sleep(Duration::from_micros(200));
        }
    }

    /// Tells the launcher to kill everything, if there is one.
    fn closes_control(&mut self) -> bool {
        #[cfg(target_os = "linux")]
        return self.launcher_ends_it();
        #[cfg(not(target_os = "linux"))]
        false
    }

    /// Kills what was started: a launcher with its group; a plain program has none of its own.
    fn kill_plain(&mut self) {
        // An error means that the process has ended already.
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

#[cfg(unix)]
fn signal(status: ExitStatus) -> Option<i32> {
    std::os::unix::process::ExitStatusExt::signal(&status)
}

#[cfg(not(unix))]
fn signal(_: ExitStatus) -> Option<i32> {
    None
}
