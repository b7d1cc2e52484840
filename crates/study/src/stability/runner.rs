//! Runs the cases, each on a thread of its own: a panic or a hang costs one row only.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use super::case::{Case, CaseRow, Deadline, Finding, Outcome};

/// Time after which a case ends itself between two steps.
const TIME_LIMIT: Duration = Duration::from_secs(60);

/// Time after the deadline at which a case counts as hanging.
const GRACE: Duration = Duration::from_secs(30);

/// Receives every finished row and the number of all rows.
pub type Progress<'a> = &'a (dyn Fn(&CaseRow, usize) + Sync);

/// Runs the cases on all processors. Rows keep the order of the cases.
pub fn rows(cases: Vec<Case>, progress: Progress) -> Vec<CaseRow> {
    let count = cases.len();
    let waiting = Mutex::new(cases.into_iter().enumerate());
    let found = Mutex::new(Vec::with_capacity(count));
    let next = || waiting.lock().ok().and_then(|mut waiting| waiting.next());
    let work = || {
        while let Some((number, case)) = next() {
            let row = row(case);
            progress(&row, count);
            if let Ok(mut found) = found.lock() {
                found.push((number, row));
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
    let mut found = found.into_inner().unwrap_or_default();
    found.sort_by_key(|(number, _)| *number);
    found.into_iter().map(|(_, row)| row).collect()
}

fn row(case: Case) -> CaseRow {
    let Case { family, case, parameters, integrator, material, expected, margin_is, seed, work } = case;
    let start = Instant::now();
    let deadline = Deadline(start + TIME_LIMIT);
    let Finding { outcome, margin, note } = guarded(move || work(deadline));
    // A row is one line.
    let note = note.split_whitespace().collect::<Vec<_>>().join(" ");
    let margin = margin.filter(|margin| margin.is_finite());
    let (pass, seconds) = (outcome.satisfies(expected), start.elapsed().as_secs_f64());
    CaseRow {
        family,
        case,
        parameters,
        integrator,
        material,
        expected,
        outcome,
        margin,
        margin_is,
        seed,
        pass,
        note,
        seconds,
    }
}

/// The finding of a case, or its panic or hang.
fn guarded(work: impl FnOnce() -> Finding + Send + 'static) -> Finding {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        let found = catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
            let message = panic.downcast_ref::<String>().map(String::as_str);
            let message = message.or(panic.downcast_ref::<&str>().copied()).unwrap_or("no message");
            Finding::plain(Outcome::Panics, message)
        });
        // The receiver is gone if the case took too long.
        let _ = sender.send(found);
    });
    match receiver.recv_timeout(TIME_LIMIT + GRACE) {
        Ok(found) => found,
        Err(RecvTimeoutError::Timeout) => Finding::plain(Outcome::Hangs, "a step does not end"),
        Err(RecvTimeoutError::Disconnected) => {
            Finding::plain(Outcome::Panics, "the thread of the case ended without a result")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::guarded;
    use crate::stability::case::{Finding, Outcome};

    #[test]
    fn a_panic_becomes_a_finding_with_its_message() {
        let found = guarded(|| panic!("element {} is gone", 7));
        assert_eq!((found.outcome, found.note.as_str()), (Outcome::Panics, "element 7 is gone"));
    }

    #[test]
    fn nan_is_not_within_a_bound() {
        assert_eq!(guarded(|| Finding::within(f64::NAN, "")).outcome, Outcome::Deviates);
    }
}
