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
use super::{ClassError, ClassOptions, Entry, Identity, Outcome, Summary, at, empty, regrade, roster};
use crate::grade::Grade;
use crate::rubric::{Counts, NoSubmission};

/// Interval at which processes are polled.
const TICK: Duration = Duration::from_millis(20);
/// Shortest interval at which the tables of a large class are written.
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

/// Grades until no submission waits or the user stops the run.
pub fn grade(options: &ClassOptions, class: Class, identity: Identity, store: &Store) -> Result<Summary, ClassError> {
    let mut interrupt = Interrupt::watch().map_err(at(&options.out))?;
    let before = regrade::read(&options.out);
    let mut schedule = Schedule::new(options, &class, identity, store)?;
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
    let empty = empty::remarks(&schedule.summary.entries);
    schedule.summary.remarks.extend(empty);
    let after = regrade::table(&schedule.summary.entries);
    schedule.summary.changes = regrade::changes(&before, &after);
    store.publish(&schedule.summary, options.report)?;
    if !schedule.summary.interrupted {
        regrade::write(&options.out, &after).map_err(at(&options.out))?;
    }
    Ok(schedule.summary)
}

impl<'a> Schedule<'a> {
    fn new(
        options: &'a ClassOptions,
        class: &'a Class,
        identity: Identity,
        store: &'a Store,
    ) -> Result<Self, ClassError> {
        let submissions = &class.submissions[..];
        let rubric = options.accounts.rubric();
        let summary = Summary {
            identity,
            shard: options.shard,
            entries: Vec::with_capacity(submissions.len()),
            people: class.people.clone(),
            title: rubric.title.clone(),
            max_score: rubric.max_score(),
            release: rubric.students.release.map(|time| time.0.to_string()),
            changes: Vec::new(),
            remarks: class.remarks.clone(),
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
        for index in 0..submissions.len() {
            schedule.hand_back(index).map_err(at(&options.out))?;
        }
        let zero = rubric.no_submission == NoSubmission::Zero;
        schedule.summary.entries.extend(roster::without_a_submission(class, zero.then_some(0.0)));
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len} graded, {eta} left");
        schedule.bar =
            ProgressBar::new(schedule.waiting.len() as u64).with_style(style.unwrap_or(ProgressStyle::default_bar()));
        Ok(schedule)
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
        // A group's submission is graded once.
        let is_repeated = self.submissions[..index].iter().any(|other| other.path == submission.path);
        let regrades = !(self.options.only.is_empty() && self.options.functions.is_empty());
        if regrades && self.is_named(submission) {
            if !is_repeated {
                self.waiting.push_back((index, key));
            }
            return Outcome::Waiting;
        }
        let found = match regrades {
            true => self
                .store
                .find(&key)
                .map(|grade| (grade, key.clone()))
                .or_else(|| self.store.find_any(&submission.name)),
            false => self.store.find(&key).map(|grade| (grade, key.clone())),
        };
        if let Some((grade, key)) = found {
            self.summary.kept += usize::from(!is_repeated);
            return Outcome::Graded(Box::new(self.assessed(submission, grade)), store::folder(&key));
        }
        if !is_repeated && !regrades {
            self.waiting.push_back((index, key));
        }
        Outcome::Waiting
    }

    /// Returns true if a submission is to be graded again.
    fn is_named(&self, submission: &Submission) -> bool {
        let only = &self.options.only;
        only.is_empty() || only.contains(&submission.student) || only.contains(&submission.name)
    }

    /// The grade that counts for the student.
    fn assessed(&self, submission: &Submission, grade: Grade) -> Grade {
        self.options.accounts.assess(grade, &[&submission.student], submission.submitted())
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
        let earlier = self.options.out.join("submissions").join(&self.submissions[index].name).join("grade.json");
        if !self.options.functions.is_empty() && earlier.exists() {
            command.arg("--earlier").arg(earlier);
            command.args(self.options.functions.iter().map(|name| format!("--function={name}")));
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
            drop(process); // processes that it left running must not write any more
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

    /// Writes the reports of the submission that counts for a student.
    fn hand_back(&mut self, index: usize) -> io::Result<()> {
        let student = self.submissions[index].student.clone();
        if self.options.accounts.rubric().counts == Counts::Best {
            roster::keep_the_best(&mut self.summary.entries, &student);
        }
        let of_student = |entry: &&Entry| entry.student == student;
        for entry in self.summary.entries.iter().filter(of_student) {
            if let Outcome::Graded(grade, _) = &entry.outcome {
                let folder = self.options.out.join(store::student_folder(&student));
                (self.options.write)(grade, &folder, self.options.accounts.rubric().students.diagnosis)?;
            }
        }
        Ok(())
    }

    /// Adds to `reason` where the log is.
    fn reject(&self, index: usize, partial: &Path, reason: String) -> String {
        let name = &self.submissions[index].name;
        match self.store.fail(partial, name) {
            Ok(()) => format!("{reason}; see failed/{name}.log"),
            Err(error) => format!("{reason}; its log could not be kept: {error}"),
        }
    }

    /// Gives a submission's outcome to its student, or to all students of a group.
    fn settle(&mut self, index: usize, result: Result<Outcome, String>) {
        let outcome = result.unwrap_or_else(Outcome::NotGraded);
        let name = &self.submissions[index].name;
        let line = match &outcome {
            Outcome::Graded(grade, _) => format!("{name}: {}", empty::score(grade)),
            Outcome::NotGraded(reason) => format!("{name}: not graded: {reason}"),
            _ => name.clone(),
        };
        self.summary.graded_now += usize::from(matches!(outcome, Outcome::Graded(..)));
        for of_group in 0..self.submissions.len() {
            let submission = &self.submissions[of_group];
            if submission.path != self.submissions[index].path || submission.newer.is_some() {
                continue;
            }
            let own = match outcome.clone() {
                Outcome::Graded(grade, folder) => Outcome::Graded(Box::new(self.assessed(submission, *grade)), folder),
                other => other,
            };
            self.summary.entries[of_group].outcome = own;
            if let Err(error) = self.hand_back(of_group) {
                self.summary.entries[of_group].outcome =
                    Outcome::NotGraded(format!("its reports cannot be written: {error}"));
            }
        }
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
