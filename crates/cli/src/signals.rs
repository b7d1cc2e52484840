//! Ctrl-C and SIGTERM: the first ends a run after its step, the second ends the program at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::end::End;

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
