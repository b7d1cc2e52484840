//! Ctrl-C and SIGTERM: the first ends a run after its step, the second ends the program at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use indicatif::ProgressBar;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::end::End;

/// Time between two looks at the signal. A step that goes on for longer is not silent.
const LOOK: Duration = Duration::from_millis(500);

/// The signal that has been received.
pub struct Signals(Arc<AtomicUsize>);

impl Signals {
    /// Catches both signals from now on.
    pub fn catch() -> Result<Self, End> {
        let (number, is_second) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicBool::new(false)));
        for signal in [SIGINT, SIGTERM] {
            // In this order: the first signal passes the shutdown and arms it for the second one.
            flag::register_conditional_shutdown(signal, exit_code(signal), Arc::clone(&is_second))
                .and_then(|_| flag::register(signal, Arc::clone(&is_second)))
                .and_then(|_| flag::register_usize(signal, Arc::clone(&number), signal.unsigned_abs() as usize))
                .map_err(|error| End::Stopped(format!("signals cannot be caught: {error}")))?;
        }
        Ok(Self(number))
    }

    /// The number of the signal that has been received, zero before.
    #[cfg(feature = "viewer")]
    pub fn number(&self) -> Arc<AtomicUsize> {
        Arc::clone(&self.0)
    }

    /// Says what a second signal does, where a step goes on after the first, until what it returns is dropped.
    pub fn watch(&self, bar: &ProgressBar) -> Arc<()> {
        let (running, number, bar) = (Arc::new(()), Arc::clone(&self.0), bar.clone());
        let run = Arc::downgrade(&running);
        // Where there can be no thread, the note alone is missing.
        let _ = thread::Builder::new().spawn(move || {
            let mut is_second_look = false;
            while run.strong_count() > 0 {
                thread::sleep(LOOK);
                let has_signal = number.load(Ordering::Relaxed) > 0 && run.strong_count() > 0;
                if has_signal && is_second_look {
                    return bar.suspend(|| {
                        eprintln!(
                            "the run ends after this step; the same signal again ends it at once, without its files"
                        )
                    });
                }
                is_second_look = has_signal;
            }
        });
        running
    }

    /// The exit code of the signal that has been received, if one has.
    pub fn received(&self) -> Option<u8> {
        let number = self.0.load(Ordering::Relaxed);
        (number > 0).then(|| 128 + number as u8)
    }
}

/// 128 and the number of the signal, as shells count.
fn exit_code(signal: i32) -> i32 {
    128 + signal
}
