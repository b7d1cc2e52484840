//! Runs a program to its end and keeps the start of its output.

use std::io::{self, Read};
use std::process::Stdio;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Duration;

use super::running::Tree;
use super::{Confined, Ended};
#[cfg(target_os = "linux")]
use super::{Sandbox, spec::Control};

/// Time that a program may take to end after its time is over.
const GRACE: Duration = Duration::from_secs(10);

/// Runs a program without any layer to its end.
pub fn plain(confined: &Confined) -> io::Result<Ended> {
    let tree =
        Tree::plain(confined, |command| command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()))?;
    followed(tree, confined)
}

/// Runs a program in the sandbox to its end.
#[cfg(target_os = "linux")]
pub fn launched(sandbox: &Sandbox, confined: &Confined) -> io::Result<Ended> {
    let tree = Tree::launch(sandbox, confined, Control::Stdin, |command| {
        command.stdout(Stdio::piped()).stderr(Stdio::piped())
    })?;
    followed(tree, confined)
}

fn followed(mut tree: Tree, confined: &Confined) -> io::Result<Ended> {
    let room = Arc::new(AtomicUsize::new(confined.limits.output));
    let stdout = tree.child.stdout.take().map(|pipe| keep(pipe, room.clone()));
    let stderr = tree.child.stderr.take().map(|pipe| keep(pipe, room));
    let end = tree.ended(confined.limits.wall.saturating_add(GRACE));
    tree.kill();
    let Some(end) = end else { return Err(io::Error::other("the sandbox does not end a program whose time is over")) };
    if end.code.is_none() && end.signal.is_none() {
        return Err(io::Error::other("the sandbox's launcher ended without a word"));
    }
    Ok(Ended {
        code: end.code,
        signal: end.signal,
        timed_out: end.timed_out,
        out_of_memory: end.out_of_memory,
        seconds: end.seconds,
        stdout: kept(stdout)?,
        stderr: kept(stderr)?,
    })
}

/// Reads a pipe to its end and keeps what there is room for. The rest is dropped, so that the program does not stop.
fn keep(mut pipe: impl Read + Send + 'static, room: Arc<AtomicUsize>) -> Receiver<io::Result<Vec<u8>>> {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        let mut kept = Vec::new();
        let mut chunk = vec![0; 1 << 16];
        let outcome = loop {
            match pipe.read(&mut chunk) {
                Ok(0) => break Ok(kept),
                Ok(n) => kept.extend_from_slice(&chunk[..take(&room, n)]),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => break Err(error),
            }
        };
        // The receiver is gone if the program was given up.
        let _ = sender.send(outcome);
    });
    receiver
}

/// Takes at most `n` bytes of the room that is left.
fn take(room: &AtomicUsize, n: usize) -> usize {
    let mut taken = 0;
    let _ = room.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| {
        taken = n.min(left);
        Some(left - taken)
    });
    taken
}

fn kept(pipe: Option<Receiver<io::Result<Vec<u8>>>>) -> io::Result<Vec<u8>> {
    let Some(pipe) = pipe else { return Ok(Vec::new()) };
    pipe.recv_timeout(GRACE).map_err(|_| io::Error::other("something outlived the program and holds its output"))?
}
