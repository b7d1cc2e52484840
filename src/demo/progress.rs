//! A line on the terminal while something without steps is made.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// Work that is done before this time shows nothing.
const PATIENCE: Duration = Duration::from_secs(1);

/// Time between two states of the line.
const TICK: Duration = Duration::from_millis(120);

/// Does the work, and after a second shows on stderr what is done and for how long, if that is a terminal. The line is removed at the
/// end, also of work that panics.
pub fn during<T>(what: &'static str, work: impl FnOnce() -> T) -> T {
    let (done, is_done) = channel::<()>();
    thread::scope(move |scope| {
        scope.spawn(move || {
            if is_done.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            let style = ProgressStyle::with_template("{spinner} {msg}, {elapsed}").expect("a valid template");
            let line = ProgressBar::new_spinner().with_style(style).with_message(what);
            line.enable_steady_tick(TICK);
            // The channel closes when the work has ended.
            let _ = is_done.recv();
            line.finish_and_clear();
        });
        let result = work();
        drop(done);
        result
    })
}
