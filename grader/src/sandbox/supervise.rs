//! The process between the grader and the program: makes the namespaces, starts the program, ends everything.

use std::fs::File;
use std::io::{self, Read, Write};
use std::os::fd::{AsFd, AsRawFd};
use std::os::unix::net::UnixStream;
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use nix::errno::Errno;
use nix::sched::{CloneFlags, unshare};
use nix::sys::prctl::set_child_subreaper;
use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::signal::{Signal, kill};
use nix::sys::wait::{Id, WaitPidFlag, WaitStatus, waitid, waitpid};
use nix::unistd::{Pid, pipe};

use super::Profile;
use super::cgroup;
use super::memory::Processes;
use super::owner;
use super::spec::{Control, News, Spec};

/// Runs the program of a spec and tells the grader about it, until the program ends, its time is over or the grader is gone.
pub fn supervise(spec: Spec) -> Result<(), String> {
    let control = control(spec.control).map_err(|error| format!("no way to the grader: {error}"))?;
    let processes = Arc::new(Processes::open().map_err(|error| format!("/proc: {error}"))?);
    let (spec, tree) = match in_cgroup(spec).and_then(|(spec, tree)| separate(&spec).map(|()| (spec, tree))) {
        Ok(ready) => ready,
        Err(why) => return tell(&control, &News::Refused(why)),
    };
    let watch = watch(&spec, &control, processes.clone()).map_err(|error| format!("no ear for the grader: {error}"))?;
    match begin(&spec, &watch) {
        Ok(program) => {
            tell(&control, &News::Started)?;
            let status = attend(program, &watch)?;
            sweep(&spec, &processes);
            let (timed_out, out_of_memory) = lock(&watch).why();
            let out_of_memory = out_of_memory || tree.as_ref().is_some_and(cgroup::Tree::is_out_of_memory);
            // The grader may exit as soon as it has read this.
            drop(tree);
            tell(&control, &ended(status, timed_out, out_of_memory)?)
        }
        Err(why) => tell(&control, &News::Refused(why)),
    }
}

fn control(place: Control) -> io::Result<UnixStream> {
    let descriptor = match place {
        Control::Stdin => io::stdin().as_fd().try_clone_to_owned()?,
        Control::Stdout => io::stdout().as_fd().try_clone_to_owned()?,
    };
    Ok(UnixStream::from(descriptor))
}

fn tell(mut control: &UnixStream, news: &News) -> Result<(), String> {
    let mut line = serde_json::to_string(news).map_err(|error| error.to_string())?;
    line.push('\n');
    // The grader may have closed the socket, which is no failure.
    match control.write_all(line.as_bytes()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error.to_string()),
        _ => Ok(()),
    }
}

/// Makes the cgroup of the tree, whose folder takes the place of the one that it is made in.
fn in_cgroup(spec: Spec) -> Result<(Spec, Option<cgroup::Tree>), String> {
    let Some(base) = spec.cgroup.as_ref().filter(|_| spec.layers.contains("memory_cgroup")) else {
        return Ok((spec, None));
    };
    let tree = cgroup::Tree::new(base, &spec.confined.limits).map_err(|error| format!("memory_cgroup: {error}"))?;
    Ok((Spec { cgroup: Some(tree.folder().to_owned()), ..spec }, Some(tree)))
}

/// Makes the namespaces but that of processes.
fn separate(spec: &Spec) -> Result<(), String> {
    let flags = namespaces(spec);
    let (user, group) = (nix::unistd::geteuid(), nix::unistd::getegid());
    unshare(flags).map_err(|error| format!("namespaces: {error}"))?;
    if flags.contains(CloneFlags::CLONE_NEWUSER) {
        // Root in the namespace, so that the next process may mount; it gives that up.
        let itself = File::open("/proc/self").map_err(|error| format!("/proc: {error}"))?;
        owner::map(&itself, (0, user.as_raw()), (0, group.as_raw()))
            .map_err(|error| format!("user_namespace: {error}"))?;
    }
    Ok(())
}

/// Starts the program; an error is what its launcher says.
fn begin(spec: &Spec, watch: &Mutex<Watch>) -> Result<Child, String> {
    if spec.layers.contains("pid_namespace") {
        // After this call no thread can be started.
        unshare(CloneFlags::CLONE_NEWPID).map_err(|error| format!("pid_namespace: {error}"))?;
    }
    set_child_subreaper(true).map_err(|error| format!("process_tree: {error}"))?;
    let (reports, told) = pipe().map_err(|error| error.to_string())?;
    let mut command = Command::new("/proc/self/exe");
    let text = serde_json::to_string(spec).map_err(|error| error.to_string())?;
    command.args(["confine", "enter", &told.as_raw_fd().to_string(), &text]).env_clear();
    match spec.control {
        Control::Stdin => command.stdin(Stdio::null()),
        Control::Stdout => command.stdout(Stdio::null()),
    };
    let child = command.spawn().map_err(|error| format!("the launcher: {error}"))?;
    drop(told);
    lock(watch).begun(Pid::from_raw(child.id().cast_signed()));
    // The other end closes when the program begins.
    let mut report = String::new();
    File::from(reports).read_to_string(&mut report).map_err(|error| error.to_string())?;
    if report.is_empty() {
        return Ok(child);
    }
    // The process reports no more.
    let _ = { child }.wait();
    Err(report)
}

fn namespaces(spec: &Spec) -> CloneFlags {
    let flags = [
        ("user_namespace", CloneFlags::CLONE_NEWUSER),
        ("mount_namespace", CloneFlags::CLONE_NEWNS),
        ("network_namespace", CloneFlags::CLONE_NEWNET),
        ("ipc_namespace", CloneFlags::CLONE_NEWIPC | CloneFlags::CLONE_NEWUTS),
    ];
    flags.into_iter().filter(|(name, _)| spec.layers.contains(*name)).map(|(_, flag)| flag).collect()
}

/// The program that may be killed, and the reasons of the kill.
#[derive(Default)]
struct Watch {
    /// The program from its start until it is waited for; until then no other process has its number.
    program: Option<Pid>,
    /// The program's time is over, or the grader has ended.
    over: bool,
    timed_out: bool,
    out_of_memory: bool,
}

impl Watch {
    fn begun(&mut self, program: Pid) {
        self.program = Some(program);
        self.kill_if_over();
    }

    /// Returns the reasons of the kill: time over, memory used up.
    fn why(&self) -> (bool, bool) {
        (self.timed_out, self.out_of_memory)
    }

    fn kill_if_over(&self) {
        if let Some(program) = self.program.filter(|_| self.over) {
            // It may have ended by itself just now.
            let _ = kill(program, Signal::SIGKILL);
        }
    }
}

fn lock(watch: &Mutex<Watch>) -> MutexGuard<'_, Watch> {
    watch.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Shortest interval at which the memory of the process tree is polled.
const LOOK: Duration = Duration::from_millis(100);

/// Polling takes less than 1/RARELY of the time.
const RARELY: u32 = 20;

/// Ends the program when its time is over, its memory is used up or the grader is gone.
fn watch(spec: &Spec, control: &UnixStream, processes: Arc<Processes>) -> io::Result<Arc<Mutex<Watch>>> {
    let watch = Arc::new(Mutex::new(Watch::default()));
    let shared = watch.clone();
    let ear = control.try_clone()?;
    let until = Instant::now() + spec.confined.limits.wall;
    // A submission is one process, whose own limit is enough; where there is a cgroup, the kernel counts.
    let most = match spec.confined.profile {
        Profile::Compiler if !spec.layers.contains("memory_cgroup") => spec.confined.limits.memory,
        _ => u64::MAX,
    };
    let mut pause = if most == u64::MAX { Duration::MAX } else { LOOK };
    thread::Builder::new().spawn(move || {
        let (timed_out, out_of_memory) = loop {
            let left = until.saturating_duration_since(Instant::now());
            // The grader sends no data: a read returns when it closes the socket or ends, or when the next poll is due.
            let heard = ear.set_read_timeout(Some(left.min(pause).max(Duration::from_millis(1))));
            let heard = heard.and_then(|()| (&ear).read(&mut [0]));
            if left.is_zero() && heard.is_err() {
                break (true, false);
            }
            let is_quiet = |error: &io::Error| {
                matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut | io::ErrorKind::Interrupted)
            };
            if !heard.is_err_and(|error| is_quiet(&error)) {
                break (false, false);
            }
            let begin = Instant::now();
            if most < u64::MAX && processes.memory_below() > most {
                break (false, true);
            }
            pause = pause.max(begin.elapsed() * RARELY);
        };
        let mut watch = lock(&shared);
        watch.over = true;
        watch.timed_out = watch.program.is_some() && timed_out;
        watch.out_of_memory = watch.program.is_some() && out_of_memory;
        watch.kill_if_over();
    })?;
    Ok(watch)
}

/// Waits for the end of the program.
fn attend(mut program: Child, watch: &Mutex<Watch>) -> Result<WaitStatus, String> {
    let pid = Pid::from_raw(program.id().cast_signed());
    let status = retry(|| waitid(Id::Pid(pid), WaitPidFlag::WEXITED | WaitPidFlag::WNOWAIT));
    let mut watch = lock(watch);
    watch.program = None;
    let status = status.map_err(|error| error.to_string())?;
    program.wait().map_err(|error| error.to_string())?;
    Ok(status)
}

fn retry<T>(mut call: impl FnMut() -> nix::Result<T>) -> nix::Result<T> {
    loop {
        match call() {
            Err(Errno::EINTR) => {}
            done => return done,
        }
    }
}

/// Kills processes that the program has left running. In a namespace of its own, the kernel has done so.
fn sweep(spec: &Spec, processes: &Processes) {
    // Orphans become children of this process, generation by generation.
    loop {
        if !spec.layers.contains("pid_namespace") {
            processes.children().into_iter().for_each(|pid| {
                let _ = kill(Pid::from_raw(pid.cast_signed()), Signal::SIGKILL);
            });
        }
        if let Err(Errno::ECHILD) = waitpid(None, None) {
            return;
        }
    }
}

fn ended(status: WaitStatus, timed_out: bool, out_of_memory: bool) -> Result<News, String> {
    let usage = getrusage(UsageWho::RUSAGE_CHILDREN).map_err(|error| error.to_string())?;
    let seconds =
        [usage.user_time(), usage.system_time()].iter().map(|t| t.tv_sec() as f64 + t.tv_usec() as f64 * 1e-6).sum();
    let (code, signal) = match status {
        WaitStatus::Exited(_, code) => (Some(code), None),
        WaitStatus::Signaled(_, signal, _) => (None, Some(signal as i32)),
        other => return Err(format!("the program did not end: {other:?}")),
    };
    Ok(News::Ended { code, signal, timed_out, out_of_memory, seconds })
}
