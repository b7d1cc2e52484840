//! The parent's end of the socket to a submission: sends a call, answers the calls of its closures, and waits for a limited time. Frames
//! may be incomplete, late, or of a wrong type.

use std::io::{self, Read};
use std::panic::{self, AssertUnwindSafe};
use std::time::{Duration, Instant};

use grader_child::socket::Socket;
use grader_child::wire::{self, LONGEST_MESSAGE, kind, read};

use super::Trouble;
use crate::sandbox::Running;
use crate::submission::NAMES;

/// Time to wait for the end of a process after its socket has closed.
const END: Duration = Duration::from_millis(500);

/// Largest number of calls of closures in one call. Right functions make some hundreds in the checks.
const MOST_CLOSURES: usize = 100_000;

/// Answers calls of closures: from the closure's number and a body to a body; `None` if the call is malformed.
pub type Closures<'a> = &'a mut dyn FnMut(u8, &[u8]) -> Option<Vec<u8>>;

/// Sends a call to a submission and waits for the answer.
///
/// # Errors
/// The trouble in place of an answer. After any trouble but a panic the process cannot be used any more.
pub fn call(
    running: &mut Running,
    frames: &[(u8, Vec<u8>)],
    limit: Duration,
    closures: Closures,
) -> Result<Vec<u8>, Trouble> {
    let deadline = Instant::now() + limit;
    for (kind, body) in frames {
        let sent =
            running.socket.set_write_timeout(Some(limit)).and_then(|()| wire::send(&mut running.socket, *kind, body));
        sent.map_err(|error| lost(running, &error, limit))?;
    }
    for _ in 0..MOST_CLOSURES {
        let mut timed = Timed { socket: &running.socket, deadline };
        let (kind, body) = match wire::receive(&mut timed) {
            Ok(frame) => frame,
            Err(error) => return Err(lost(running, &error, limit)),
        };
        match kind {
            kind::RETURNED => return Ok(body),
            kind::PANICKED => {
                let (message, place) = read::<(String, String)>(&body).ok_or(Trouble::Malformed)?;
                return Err(panicked(message, place));
            }
            kind::CLOSURE.. => {
                // A submission may hand vectors of any length to a closure, which then panics.
                let asked = AssertUnwindSafe(|| closures(kind - kind::CLOSURE, &body));
                let answer = panic::catch_unwind(asked).ok().flatten().ok_or(Trouble::Malformed)?;
                wire::send(&mut running.socket, kind::ANSWER, &answer).map_err(|error| lost(running, &error, limit))?;
            }
            _ => return Err(Trouble::Malformed),
        }
    }
    Err(Trouble::Crashed("it calls its closures without end".to_owned()))
}

/// Waits until a process is ready.
///
/// # Errors
/// The trouble if it ends or sends something else.
pub fn greet(running: &mut Running, limit: Duration) -> Result<(), Trouble> {
    let mut timed = Timed { socket: &running.socket, deadline: Instant::now() + limit };
    match wire::receive(&mut timed) {
        Ok((kind::READY, _)) => Ok(()),
        Ok(_) => Err(Trouble::Malformed),
        Err(error) => Err(lost(running, &error, limit)),
    }
}

fn panicked(message: String, place: String) -> Trouble {
    // This is the message of the handout's bodies, which stand for functions that are not written.
    if message.starts_with("not yet implemented") {
        return Trouble::Missing;
    }
    // The child cuts its messages, and a submission can send others in its name.
    let message = wire::start(&message, LONGEST_MESSAGE).to_owned();
    // Students read the place, and a submission can forge it to reveal inputs.
    let place = if is_place(&place) { place } else { String::new() };
    Trouble::Panicked { message, place }
}

/// Returns true if the whole text is the place of a line in one of the course's files.
fn is_place(text: &str) -> bool {
    let mut parts = text.split(':');
    let file = parts.next().and_then(|file| file.strip_prefix("src/")?.strip_suffix(".rs"));
    let is_line = |part: &str| (1..=5).contains(&part.len()) && part.bytes().all(|byte| byte.is_ascii_digit());
    file.is_some_and(|name| NAMES.contains(&name)) && parts.clone().count() <= 2 && parts.all(is_line)
}

/// The reason why a process does not answer.
fn lost(running: &mut Running, error: &io::Error, limit: Duration) -> Trouble {
    let is_late = matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut);
    if is_late {
        running.kill();
        return Trouble::TimedOut(limit);
    }
    if error.kind() == io::ErrorKind::InvalidData {
        running.kill();
        return Trouble::Malformed;
    }
    Trouble::Crashed(running.ended(END).unwrap_or_else(|| "it closed the connection".to_owned()))
}

/// Reads until a point in time, even if the bytes arrive slowly.
struct Timed<'a> {
    socket: &'a Socket,
    deadline: Instant,
}

impl Read for Timed<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let left = self.deadline.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Err(io::ErrorKind::TimedOut.into());
        }
        self.socket.set_read_timeout(Some(left))?;
        (&mut &*self.socket).read(buffer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_of_a_panic_has_an_end() {
        let long = "ä".repeat(1 << 20);
        let Trouble::Panicked { message, place } = panicked(long.clone(), long) else { panic!("it panicked") };
        assert_eq!((message.len(), place.len()), (LONGEST_MESSAGE, 0));
        assert_eq!(wire::start("aä", 2), "a");
    }

    #[test]
    fn a_place_is_a_line_of_a_file_of_the_course() {
        assert!(is_place("src/psi_neo_hookean.rs:12"));
        assert!(is_place("src/psi_neo_hookean.rs:12:5"));
        for forged in
            ["src/q = [1, 2]", "src/psi_neo_hookean.rs:1234567", "src/psi_neo_hookean.rs:1:2:3", "src/x.rs:1", ""]
        {
            assert!(!is_place(forged), "{forged}");
        }
    }
}
