//! Tries the cases, each on a thread of its own: a panic or a hang costs its own row.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use super::case::{Case, Clock, Finding, Outcome, Row};

/// A case ends itself between two steps after this time.
const PATIENCE: Duration = Duration::from_secs(60);

/// One that has not ended by then, too long after its deadline, is left behind.
const GRACE: Duration = Duration::from_secs(30);

/// Is told of every row as it is found, with the number of rows there will be.
pub type Progress<'a> = &'a (dyn Fn(&Row, usize) + Sync);

/// A row for each case, in their order. As many are tried at once as there are processors.
pub fn rows(cases: Vec<Case>, progress: Progress) -> Vec<Row> {
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

fn row(case: Case) -> Row {
    let Case { family, case, parameters, integrator, material, expected, margin_is, seed, work } = case;
    let start = Instant::now();
    let clock = Clock { deadline: start + PATIENCE };
    let Finding { outcome, margin, note } = guarded(move || work(clock));
    // A row is a line.
    let note = note.split_whitespace().collect::<Vec<_>>().join(" ");
    let margin = margin.filter(|margin| margin.is_finite());
    let (pass, seconds) = (outcome.satisfies(expected), start.elapsed().as_secs_f64());
    Row {
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

/// What the work finds, or how it fails to.
fn guarded(work: impl FnOnce() -> Finding + Send + 'static) -> Finding {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        let found = catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
            let message = panic.downcast_ref::<String>().map(String::as_str);
            let message = message.or(panic.downcast_ref::<&str>().copied()).unwrap_or("without a message");
            Finding::plain(Outcome::Panics, message)
        });
        // Nobody waits for it any more where it took too long.
        let _ = sender.send(found);
    });
    match receiver.recv_timeout(PATIENCE + GRACE) {
        Ok(found) => found,
        Err(RecvTimeoutError::Timeout) => Finding::plain(Outcome::Hangs, "a single step does not end"),
        Err(RecvTimeoutError::Disconnected) => Finding::plain(Outcome::Panics, "its thread is gone"),
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
    fn a_figure_that_is_not_a_number_is_not_within_its_bound() {
        assert_eq!(guarded(|| Finding::within(f64::NAN, "")).outcome, Outcome::Deviates);
    }
}
