//! Grades one level: its functions in as few programs as possible. Functions that do not compile because they need an item of the
//! student's other files are compiled again, each alone.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::rc::Rc;

use grader::compile::{BuildError, Fault, Plan, build_within};
use grader::implementation::budget::Budget;
use grader::implementation::places::Places;
use grader::implementation::sandboxed::Sandboxed;
use grader::status::Status;
use grader::submission::{NAMES, Source, Submission, mentions};

use super::groups::{Calls, Group, groups};
use super::programs::start;
use super::whole::Whole;
use super::{Grading, GradingError, finished};
use crate::grade::FunctionGrade;
use crate::rubric::Function;

impl Grading {
    /// Grades the functions of a level that are not yet `graded`; in the program of the `whole`, if there is one, those that call
    /// nothing.
    pub(super) fn grade_level(
        &self,
        level: u32,
        submission: &Submission,
        whole: Option<&Whole>,
        graded: &mut BTreeMap<String, FunctionGrade>,
        budget: &Rc<Budget>,
    ) -> Result<(), GradingError> {
        let is_due = |name: &&str| self.rubric.level(name) == Some(level) && !graded.contains_key(*name);
        let judged: Vec<&'static str> = NAMES.into_iter().filter(is_due).collect();
        let below = self.programs.names_below(level);
        let own = calls_of(submission);
        for group in groups(&judged, &below, &own, &self.programs.calls) {
            if let Some((program, folder)) = whole.filter(|_| group.reference.is_empty()).and_then(Whole::program) {
                let subject = self.subject(Some(program), folder, submission, budget);
                for (function, name) in self.judged(&group) {
                    graded.insert(name.to_owned(), self.judge(function, &subject)?);
                }
                continue;
            }
            // Two folders: the student's program may read its own folder, which must not contain the reference.
            let (folder, beside) = (self.workspace.folder()?, self.workspace.folder()?);
            let library = if group.reference == below {
                self.programs.below(level)
            } else {
                Some(self.programs.library(&self.prebuilt, &group.reference, beside.path())?)
            };
            let plan = Plan {
                own: with_what_they_call(&group, &own, submission),
                reference: library.map(|library| (library, group.reference.clone())),
                helpers: BTreeMap::new(),
                limit: self.compile_limit(),
            };
            self.grade_group(&group, &plan, submission, folder.path(), graded, budget)?;
        }
        Ok(())
    }

    fn grade_group(
        &self,
        group: &Group,
        plan: &Plan,
        submission: &Submission,
        folder: &Path,
        graded: &mut BTreeMap<String, FunctionGrade>,
        budget: &Rc<Budget>,
    ) -> Result<(), GradingError> {
        let built = match build_within(&self.prebuilt, &self.sandbox, plan, folder, budget) {
            Err(BuildError::GaveUp(why)) => return self.grade_apart(group, plan, submission, &why, graded, budget),
            built => built?,
        };
        let subject = self.subject(built.program.as_deref(), folder, submission, budget);
        for (function, name) in self.judged(group) {
            let grade = match built.faults.get(name) {
                None => self.judge(function, &subject)?,
                Some(fault) => self.judge_with_helpers(function, name, fault, plan, submission, budget)?,
            };
            graded.insert(name.to_owned(), grade);
        }
        Ok(())
    }

    /// Grades functions whose files the compiler takes one by one and not together, each in a program of its own.
    fn grade_apart(
        &self,
        group: &Group,
        plan: &Plan,
        submission: &Submission,
        why: &str,
        graded: &mut BTreeMap<String, FunctionGrade>,
        budget: &Rc<Budget>,
    ) -> Result<(), GradingError> {
        let own = calls_of(submission);
        for (function, name) in self.judged(group) {
            let folder = self.workspace.folder()?;
            let alone = Group { judged: vec![name], reference: group.reference.clone() };
            let alone = Plan { own: with_what_they_call(&alone, &own, submission), ..plan.clone() };
            let grade = match build_within(&self.prebuilt, &self.sandbox, &alone, folder.path(), budget) {
                Err(BuildError::GaveUp(_)) => {
                    let message = format!("the file compiles, but not with the others that it calls: {why}");
                    finished(function, Status::DidNotCompile, Some(message))
                }
                built => {
                    let built = built?;
                    match built.faults.get(name) {
                        None => self.judge(
                            function,
                            &self.subject(built.program.as_deref(), folder.path(), submission, budget),
                        )?,
                        Some(fault) => without_program(function, fault),
                    }
                }
            };
            graded.insert(name.to_owned(), grade);
        }
        Ok(())
    }

    /// A file that does not compile may only miss a private function or type in another file of its author, in whose place the
    /// reference stands. It is compiled once more with that file beside the reference.
    fn judge_with_helpers(
        &self,
        function: &Function,
        name: &'static str,
        fault: &Fault,
        plan: &Plan,
        submission: &Submission,
        budget: &Rc<Budget>,
    ) -> Result<FunctionGrade, GradingError> {
        let own: BTreeMap<_, _> =
            plan.own.get_key_value(name).map(|(name, text)| (*name, text.clone())).into_iter().collect();
        let helpers = helpers(name, plan, submission);
        if !helpers.is_empty() && fault.status == Status::DidNotCompile {
            let folder = self.workspace.folder()?;
            let alone = Plan { own, helpers, ..plan.clone() };
            let built = build_within(&self.prebuilt, &self.sandbox, &alone, folder.path(), budget)?;
            if built.faults.is_empty() {
                return self
                    .judge(function, &self.subject(built.program.as_deref(), folder.path(), submission, budget));
            }
        }
        Ok(without_program(function, fault))
    }

    /// The functions of a group, in the order of the rubric.
    fn judged(&self, group: &Group) -> impl Iterator<Item = (&Function, &'static str)> {
        self.rubric.functions.iter().filter_map(|function| {
            let name = group.judged.iter().find(|name| *name == function.name.get_ref())?;
            Some((function, *name))
        })
    }

    fn subject(
        &self,
        program: Option<&Path>,
        folder: &Path,
        submission: &Submission,
        budget: &Rc<Budget>,
    ) -> Sandboxed {
        let start = start(&self.sandbox, program.map(Path::to_owned), folder);
        Sandboxed::new(start, self.limit()).within(budget.clone(), Places::of(submission))
    }
}

fn without_program(function: &Function, fault: &Fault) -> FunctionGrade {
    let Fault { status, message } = fault;
    let message = match status {
        Status::DidNotCompile => format!("the file does not compile:\n{message}"),
        _ => message.clone(),
    };
    finished(function, *status, Some(message))
}

/// The text of a function, where the submission has one that may be compiled.
fn text<'a>(name: &str, submission: &'a Submission) -> Option<&'a String> {
    match submission.functions.get(name) {
        Some(Source::Written(text)) => Some(text),
        _ => None,
    }
}

fn calls_of(submission: &Submission) -> Calls {
    NAMES.into_iter().filter_map(|name| Some((name, mentions(text(name, submission)?)))).collect()
}

/// The texts of a group, and of the student's others that they call and that no reference answers.
fn with_what_they_call(group: &Group, calls: &Calls, submission: &Submission) -> BTreeMap<&'static str, String> {
    let mut own = BTreeMap::new();
    let mut wanted = group.judged.clone();
    while let Some(name) = wanted.pop() {
        let Some(text) = text(name, submission) else { continue };
        if own.insert(name, text.clone()).is_none() {
            let called = calls.get(name).into_iter().flatten();
            wanted.extend(called.filter(|other| !group.reference.contains(*other)));
        }
    }
    own
}

/// The student's files that a file reaches into beside the functions that the reference answers, and those that they reach into.
fn helpers(name: &'static str, plan: &Plan, submission: &Submission) -> BTreeMap<&'static str, String> {
    let Some((_, reference)) = &plan.reference else { return BTreeMap::new() };
    let reaches_into = |from: &str| -> BTreeSet<&'static str> {
        let Some(text) = text(from, submission) else { return BTreeSet::new() };
        let is_path = |other: &&'static str| text.contains(&format!("{other}::"));
        mentions(text).into_iter().filter(|other| *other != name && reference.contains(other)).filter(is_path).collect()
    };
    let (mut found, mut next) = (BTreeMap::new(), reaches_into(name));
    while let Some(other) = next.pop_first() {
        if let Some(text) = text(other, submission).filter(|_| !found.contains_key(other)) {
            found.insert(other, text.clone());
            next.extend(reaches_into(other));
        }
    }
    found
}
