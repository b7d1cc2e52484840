//! Grades the submissions that have no grade yet, several at a time.

use std::collections::VecDeque;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::find::{Class, Submission};
use super::process::{Interrupt, Process, State};
use super::store::{self, Store};
use super::{ClassError, ClassOptions, Entry, Identity, Outcome, Summary, at};

/// How often processes are looked at.
const TICK: Duration = Duration::from_millis(20);
/// Tables of a large class are not written more often than that.
const REFRESH: Duration = Duration::from_secs(3);

/// State of the grading of a class.
struct Schedule<'a> {
    options: &'a ClassOptions,
    store: &'a Store,
    submissions: &'a [Submission],
    summary: Summary,
    /// Indices into submissions and entries, with their keys.
    waiting: VecDeque<(usize, String)>,
    running: Vec<Job>,
    bar: ProgressBar,
}

/// A submission that is being graded.
struct Job {
    index: usize,
    key: String,
    partial: PathBuf,
    process: Process,
}

/// Grades until nothing waits or the user stops it.
pub fn grade(options: &ClassOptions, class: Class, identity: Identity, store: &Store) -> Result<Summary, ClassError> {
    let mut interrupt = Interrupt::watch().map_err(at(&options.out))?;
    let mut schedule = Schedule::new(options, &class.submissions, class.remarks, identity, store);
    store.publish(&schedule.summary, options.report)?;
    let mut published = (schedule.summary.graded_now, Instant::now());
    while !(schedule.waiting.is_empty() && schedule.running.is_empty()) {
        if interrupt.has_come().map_err(at(&options.out))? {
            schedule.stop();
            break;
        }
        schedule.start();
        schedule.collect();
        if published.1.elapsed() >= REFRESH && published.0 != schedule.done() {
            store.publish(&schedule.summary, options.report)?;
            published = (schedule.done(), Instant::now());
        }
        sleep(TICK);
    }
    schedule.bar.finish_and_clear();
    store.publish(&schedule.summary, options.report)?;
    Ok(schedule.summary)
}

impl<'a> Schedule<'a> {
    fn new(
        options: &'a ClassOptions,
        submissions: &'a [Submission],
        remarks: Vec<String>,
        identity: Identity,
        store: &'a Store,
    ) -> Self {
        let summary = Summary {
            identity,
            shard: options.shard,
            entries: Vec::with_capacity(submissions.len()),
            remarks,
            graded_now: 0,
            kept: 0,
            interrupted: false,
        };
        let bar = ProgressBar::hidden();
        let mut schedule =
            Self { options, store, submissions, summary, waiting: VecDeque::new(), running: Vec::new(), bar };
        for (index, submission) in submissions.iter().enumerate() {
            let outcome = schedule.first_look(index, submission);
            let entry = Entry { submission: submission.name.clone(), student: submission.student.clone(), outcome };
            schedule.summary.entries.push(entry);
        }
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len} graded, {eta} left");
        schedule.bar =
            ProgressBar::new(schedule.waiting.len() as u64).with_style(style.unwrap_or(ProgressStyle::default_bar()));
        schedule
    }

    /// Outcome of a submission before any process is started: kept, superseded, unreadable or waiting.
    fn first_look(&mut self, index: usize, submission: &Submission) -> Outcome {
        if let Some(newer) = &submission.newer {
            return Outcome::Older { newer: newer.clone() };
        }
        let key = match self.summary.identity.key(&submission.name, &submission.path) {
            Ok(key) => key,
            Err(error) => return Outcome::NotGraded(format!("it cannot be read: {error}")),
        };
        if let Some(grade) = self.store.find(&key) {
            self.summary.kept += 1;
            return Outcome::Graded(Box::new(grade), store::folder(&key));
        }
        self.waiting.push_back((index, key));
        Outcome::Waiting
    }

    /// Number of submissions that got their outcome since the start.
    fn done(&self) -> usize {
        self.bar.position() as usize
    }

    fn start(&mut self) {
        while self.running.len() < self.options.jobs.max(1) {
            let Some((index, key)) = self.waiting.pop_front() else { return };
            match self.launch(index, &key) {
                Ok((partial, process)) => self.running.push(Job { index, key, partial, process }),
                Err(error) => self.settle(index, Err(format!("the grader could not be started: {error}"))),
            }
        }
    }

    fn launch(&self, index: usize, key: &str) -> io::Result<(PathBuf, Process)> {
        let partial = self.store.begin(key)?;
        let mut command = Command::new(&self.options.grader);
        command.arg("grade").arg(&self.submissions[index].path).arg("--out").arg(&partial);
        command.arg("--seed").arg(self.options.seed.to_string());
        command.arg("--ends-with").arg(std::process::id().to_string()).args(&self.options.extra);
        if let Some(rubric) = &self.options.rubric {
            command.arg("--rubric").arg(rubric);
        }
        let process = Process::start(&mut command, &partial.join("log.txt"), self.options.time_limit)?;
        Ok((partial, process))
    }

    /// Collects the processes that have ended.
    fn collect(&mut self) {
        for mut job in std::mem::take(&mut self.running) {
            let ended = match job.process.state() {
                Ok(State::Running) => {
                    self.running.push(job);
                    continue;
                }
                Ok(State::TimedOut) => Err(format!("no end within {} s", self.options.time_limit.as_secs_f64())),
                Ok(State::Ended(status)) if status.success() => Ok(()),
                Ok(State::Ended(status)) => Err(format!("the grader failed ({status})")),
                Err(error) => Err(format!("the grader could not be watched: {error}")),
            };
            let Job { index, key, partial, process } = job;
            drop(process); // what it left behind must not write on
            let result = ended.and_then(|()| self.accept(index, &key, &partial));
            let result = result.map_err(|reason| self.reject(index, &partial, reason));
            self.settle(index, result);
        }
    }

    /// Keeps a grade if it is valid.
    fn accept(&self, index: usize, key: &str, partial: &Path) -> Result<Outcome, String> {
        let submission = &self.submissions[index];
        let grade = store::read_grade(partial)?;
        if grade.seed != self.options.seed {
            return Err(format!("the grader used the seed {}", grade.seed));
        }
        let now = self.summary.identity.key(&submission.name, &submission.path);
        if now.map_err(|error| format!("it cannot be read: {error}"))? != key {
            return Err("it was changed while it was graded; grade again".into());
        }
        let kept = self.store.finish(partial, &submission.name, key);
        kept.map_err(|error| format!("the grade could not be kept: {error}"))?;
        Ok(Outcome::Graded(Box::new(grade), store::folder(key)))
    }

    /// Adds to `reason` where the log is.
    fn reject(&self, index: usize, partial: &Path, reason: String) -> String {
        let name = &self.submissions[index].name;
        match self.store.fail(partial, name) {
            Ok(()) => format!("{reason}; see failed/{name}.log"),
            Err(error) => format!("{reason}; its log could not be kept: {error}"),
        }
    }

    fn settle(&mut self, index: usize, result: Result<Outcome, String>) {
        let outcome = result.unwrap_or_else(Outcome::NotGraded);
        let entry = &mut self.summary.entries[index];
        let line = match &outcome {
            Outcome::Graded(grade, _) => format!("{}: {} of {}", entry.submission, grade.score, grade.max_score),
            Outcome::NotGraded(reason) => format!("{}: not graded: {reason}", entry.submission),
            Outcome::Waiting | Outcome::Older { .. } => entry.submission.clone(),
        };
        self.summary.graded_now += usize::from(matches!(outcome, Outcome::Graded(..)));
        entry.outcome = outcome;
        self.bar.inc(1);
        self.bar.suspend(|| eprintln!("{line}"));
    }

    /// Kills the running processes and removes their files.
    fn stop(&mut self) {
        self.summary.interrupted = true;
        for job in std::mem::take(&mut self.running) {
            drop(job.process);
            if let Err(error) = std::fs::remove_dir_all(&job.partial) {
                self.summary.remarks.push(format!("{}: {error}", job.partial.display()));
            }
        }
    }
}
