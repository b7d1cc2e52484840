//! A line on the terminal while something without steps is made.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// Time before which no progress is shown.
const PATIENCE: Duration = Duration::from_secs(1);

/// Time between two states of the line.
const TICK: Duration = Duration::from_millis(120);

/// Does the work, and after a second shows on stderr what is done and for how long, if that is a terminal. The line is removed at the
/// end, also of work that panics.
pub fn during<T>(what: &'static str, work: impl FnOnce() -> T) -> T {
    shown(
        || {
            let style = ProgressStyle::with_template("{spinner} {msg}, {elapsed}").expect("a valid template");
            ProgressBar::new_spinner().with_style(style).with_message(what)
        },
        ProgressBar::tick,
        work,
    )
}

/// The same as a bar, for work that tells which share of it is done, from 0 to 1.
pub fn with_share<T>(what: &'static str, work: impl FnOnce(&dyn Fn(f64)) -> T) -> T {
    let done = AtomicU64::new(0);
    shown(
        || {
            let style =
                ProgressStyle::with_template("{bar:40} {percent:>3} %, {msg}, {elapsed}").expect("a valid template");
            ProgressBar::new(1000).with_style(style).with_message(what)
        },
        |bar| bar.set_position(done.load(Ordering::Relaxed)),
        || work(&|share| done.store((1000.0 * share) as u64, Ordering::Relaxed)),
    )
}

/// Does the work beside a thread that shows a line once it takes long, and updates it.
fn shown<T>(
    line: impl FnOnce() -> ProgressBar + Send,
    update: impl Fn(&ProgressBar) + Send,
    work: impl FnOnce() -> T,
) -> T {
    let (done, is_done) = channel::<()>();
    thread::scope(move |scope| {
        scope.spawn(move || {
            if is_done.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            let line = line();
            // The channel closes when the work has ended.
            while is_done.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                update(&line);
            }
            line.finish_and_clear();
        });
        let result = work();
        drop(done);
        result
    })
}
