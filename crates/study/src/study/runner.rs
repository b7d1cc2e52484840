//! Runs the cases of a study: on several threads, a shard of them, or what a killed run has left; or joins the rows of shards.

use std::collections::BTreeMap;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use super::journal::{Heading, Journal, Line, Shard, found, joined};
use super::{Case, Finished, Found, Study, Trouble};
use crate::machine::Machine;

/// Where and how a study runs.
pub struct Run<'a> {
    /// Folder of the results.
    pub out: &'a Path,
    /// The part of the cases that runs here.
    pub shard: Shard,
    /// Folders of shards whose rows are joined, so that no case runs.
    pub merged: &'a [PathBuf],
    /// A folder of the checkout whose commit the results name.
    pub sources: &'a Path,
    /// Receives the numbers of finished and of all cases, and the name of the one that begins.
    pub tell: &'a (dyn Fn(usize, usize, &str) + Sync),
    /// Receives a line about a row that is not as expected.
    pub remark: &'a (dyn Fn(&str) + Sync),
}

/// Runs a study and writes its files. A shard writes its rows alone.
pub fn carry_out<S: Study>(study: &S, run: &Run) -> Result<Finished, Trouble> {
    let out = run.out;
    let unwritable = |error| Trouble::Unusable(format!("--out {}: cannot be written: {error}", out.display()));
    fs::create_dir_all(out).map_err(unwritable)?;
    let cases = study.cases();
    let heading = Heading::new(study.arguments(), &cases, Machine::this(run.sources), run.shard);
    if !run.merged.is_empty() {
        let found = joined(run.merged, &heading, &cases, out)?;
        return study.finish(found, out).map_err(unwritable);
    }
    let start = Instant::now();
    let (journal, lines) = Journal::open(out, &heading)?;
    let known = lines.into_iter().map(|line| (line.case, line)).collect();
    let lines = lines_of(study, cases, known, Some(&journal), run).map_err(unwritable)?;
    if run.shard != Shard::WHOLE {
        let told = format!("shard {}: {} cases; `merge` joins the folders of all shards", run.shard, lines.len());
        return Ok(Finished { lines: vec![told, journal.path().display().to_string()], failed: None });
    }
    let found = Found { seconds: start.elapsed().as_secs_f64(), ..found(lines, heading.machine) };
    let finished = study.finish(found, out).map_err(unwritable)?;
    journal.remove().map_err(unwritable)?;
    Ok(finished)
}

/// The rows of all cases, without files.
pub fn rows<S: Study>(study: &S) -> Found<S::Row> {
    let run = Run {
        out: Path::new(""),
        shard: Shard::WHOLE,
        merged: &[],
        sources: Path::new("."),
        tell: &|_, _, _| (),
        remark: &|_| (),
    };
    // Without a journal nothing is written.
    let lines = lines_of(study, study.cases(), BTreeMap::new(), None, &run).unwrap_or_default();
    found(lines, Machine::this(run.sources))
}

/// Runs the cases of a shard that have no row yet. Lines keep the order of the cases.
fn lines_of<S: Study>(
    study: &S,
    cases: Vec<Case<S::Row>>,
    known: BTreeMap<usize, Line<S::Row>>,
    journal: Option<&Journal>,
    run: &Run,
) -> std::io::Result<Vec<Line<S::Row>>> {
    let all = (0..cases.len()).filter(|&case| run.shard.has(case)).count();
    let missing = |(case, _): &(usize, Case<S::Row>)| run.shard.has(*case) && !known.contains_key(case);
    let waiting: Vec<_> = cases.into_iter().enumerate().filter(missing).collect();
    let waiting = Mutex::new(waiting.into_iter());
    let found = Mutex::new(known);
    let next = || waiting.lock().ok().and_then(|mut waiting| waiting.next());
    let done = || found.lock().map_or(0, |found| found.len());
    let work = || -> std::io::Result<()> {
        while let Some((case, Case { name, work })) = next() {
            (run.tell)(done(), all, &name);
            let start = Instant::now();
            let line = Line { case, row: work(), seconds: start.elapsed().as_secs_f64() };
            if let Some(remark) = study.remark(&line.row) {
                (run.remark)(&remark);
            }
            if let Some(journal) = journal {
                journal.add(&line)?;
            }
            if let Ok(mut found) = found.lock() {
                found.insert(case, line);
            }
        }
        Ok(())
    };
    match study.threads() {
        1 => work()?,
        threads => thread::scope(|scope| {
            let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
            workers.into_iter().try_for_each(|worker| match worker.join() {
                Ok(outcome) => outcome,
                Err(panic) => std::panic::resume_unwind(panic),
            })
        })?,
    }
    (run.tell)(all, all, "");
    Ok(found.into_inner().unwrap_or_default().into_values().collect())
}

/// The time at which a case must end.
#[derive(Clone, Copy, Debug)]
pub struct Deadline(pub Instant);

impl Deadline {
    /// Returns true after the deadline.
    pub fn is_over(&self) -> bool {
        Instant::now() >= self.0
    }
}

/// Time after the deadline at which a case counts as hanging.
const GRACE: Duration = Duration::from_secs(30);

/// The end of work that gave no result.
#[derive(Clone, Debug, PartialEq)]
pub enum Stopped {
    /// It panicked, with this message.
    Panicked(String),
    /// It did not end in time.
    Hangs,
}

/// Runs work on a thread of its own, so that a panic or a hang costs its result only. It should end itself at the deadline.
pub fn guarded<T: Send + 'static>(
    limit: Duration,
    work: impl FnOnce(Deadline) -> T + Send + 'static,
) -> Result<T, Stopped> {
    let deadline = Deadline(Instant::now() + limit);
    let (sender, receiver) = channel();
    thread::spawn(move || {
        let found = catch_unwind(AssertUnwindSafe(|| work(deadline))).map_err(|panic| {
            let message = panic.downcast_ref::<String>().map(String::as_str);
            let message = message.or(panic.downcast_ref::<&str>().copied()).unwrap_or("no message");
            Stopped::Panicked(message.to_owned())
        });
        // The receiver is gone if the work took too long.
        let _ = sender.send(found);
    });
    match receiver.recv_timeout(limit + GRACE) {
        Ok(found) => found,
        Err(RecvTimeoutError::Timeout) => Err(Stopped::Hangs),
        Err(RecvTimeoutError::Disconnected) => {
            Err(Stopped::Panicked("the thread of the case ended without a result".to_owned()))
        }
    }
}
