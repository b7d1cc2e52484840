//! Judges the functions of a repository, and tells a function's own mistakes from those of the functions that it needs.

use std::collections::{BTreeMap, BTreeSet};

use super::recorded::Recorded;
use super::report::{Cause, Checked, Report, names_of};
use super::roles::Role;
use super::run_checks::{CheckResult, run_checks, summary};
use super::{SEED, refused};
use crate::compile::Fault;
use crate::implementation::sandboxed::Sandboxed;
use crate::properties::{Check, FUNCTIONS};
use crate::status::Status;
use crate::submission::{Source, Submission, mentions};

type Names = BTreeSet<&'static str>;

/// A repository whose functions are compiled, and the processes that call them.
pub struct Judge<'a> {
    /// The files.
    pub submission: &'a Submission,
    /// The part of each function in the assignment.
    pub roles: &'a BTreeMap<&'static str, Role>,
    /// The functions that do not compile.
    pub faults: &'a BTreeMap<&'static str, Fault>,
    /// Answers for the function that is judged.
    pub subject: &'a Sandboxed,
    /// Answers for the functions that a check needs beside it.
    pub trusted: &'a Sandboxed,
}

/// What the compiler and the checks say of one function.
struct Found {
    status: Status,
    messages: Vec<String>,
    results: Vec<CheckResult>,
    /// The functions that its text names, itself not among them.
    names: Names,
    /// The functions without which nothing can be said of it: those that its text calls and that do not answer in time, or those of
    /// whose files it uses a part that is not in the program.
    stands_still_for: Names,
}

type All = BTreeMap<&'static str, Found>;

impl Judge<'_> {
    /// Reports of all functions of the assignment, or of one. `begins` is told each function whose checks begin.
    pub fn reports(&self, only: Option<&str>, mut begins: impl FnMut(&'static str)) -> Vec<Report> {
        let mut all = All::new();
        match FUNCTIONS.iter().find(|(name, _)| Some(*name) == only) {
            Some((name, _)) => self.judge_one(name, &mut all, &mut begins),
            None => FUNCTIONS.iter().for_each(|(name, _)| self.judge_after_those_it_names(name, &mut all, &mut begins)),
        }
        let waits = waits(&all);
        let is_told = |name: &&str| match only {
            Some(only) => *name == only,
            None => self.roles[name] != Role::Later || matches!(self.source(name), Some(Source::Written(_))),
        };
        let names: Vec<_> = FUNCTIONS.iter().map(|(name, _)| *name).filter(is_told).collect();
        names.into_iter().map(|name| self.report(name, &all, &waits)).collect()
    }

    /// Judges a function, and if it does not pass those that it needs.
    fn judge_one(&self, name: &'static str, all: &mut All, begins: &mut dyn FnMut(&'static str)) {
        all.insert(name, self.found(name, all, begins));
        if all[name].status != Status::Passed {
            let asked = all[name].results.iter().flat_map(|result| &result.asked);
            let needed: Names = all[name].names.iter().chain(asked).copied().collect();
            needed.into_iter().for_each(|other| self.judge_after_those_it_names(other, all, begins));
        }
    }

    fn judge_after_those_it_names(&self, name: &'static str, all: &mut All, begins: &mut dyn FnMut(&'static str)) {
        let mut open = vec![(name, false)];
        let mut visited = Names::new();
        while let Some((name, are_others_done)) = open.pop() {
            if all.contains_key(name) {
                continue;
            }
            if are_others_done {
                all.insert(name, self.found(name, all, begins));
            } else if visited.insert(name) {
                open.push((name, true));
                open.extend(self.names(name).into_iter().map(|other| (other, false)));
            }
        }
    }

    fn source(&self, name: &str) -> Option<&Source> {
        self.submission.functions.get(name)
    }

    fn names(&self, name: &str) -> Names {
        let Some(Source::Written(text)) = self.source(name) else { return Names::new() };
        mentions(text).into_iter().filter(|other| *other != name).collect()
    }

    fn found(&self, name: &'static str, all: &All, begins: &mut dyn FnMut(&'static str)) -> Found {
        let names = self.names(name);
        let without_checks = |status, messages, stands_still_for| Found {
            status,
            messages,
            results: Vec::new(),
            names: names.clone(),
            stands_still_for,
        };
        let text = match self.source(name) {
            Some(Source::Written(text)) => text,
            Some(Source::Refused { line, reason }) => {
                return without_checks(Status::Refused, vec![refused(*line, reason)], Names::new());
            }
            _ => return without_checks(Status::Missing, Vec::new(), Names::new()),
        };
        if let Some(fault) = self.faults.get(name) {
            let is_lacking = |other: &&&'static str| {
                let is_there =
                    matches!(self.source(other), Some(Source::Written(_))) && !self.faults.contains_key(**other);
                !is_there && text.contains(&format!("{other}::"))
            };
            let compiles_without = |_: &&&'static str| fault.status == Status::DidNotCompile;
            let lacking = names.iter().filter(compiles_without).filter(is_lacking).copied().collect();
            return without_checks(fault.status, vec![fault.message.clone()], lacking);
        }
        let slow: Names =
            all.iter().filter(|(_, found)| found.status == Status::TimedOut).map(|(name, _)| *name).collect();
        let called = reached(names.clone(), all);
        if !called.is_disjoint(&slow) {
            return without_checks(Status::Missing, Vec::new(), &called & &slow);
        }
        begins(name);
        self.subject.next_function();
        self.trusted.next_function();
        let results = run_checks(checks_of(name), self.subject, &Recorded::new(self.trusted, &slow), SEED);
        let (status, messages) = summary(name, &results);
        Found { status, messages, results, names, stands_still_for: Names::new() }
    }

    fn report(&self, name: &'static str, all: &All, waits: &BTreeMap<&'static str, Names>) -> Report {
        let cause = |name: &'static str| Cause { name, status: all[name].status, role: self.roles[name] };
        let causes = |names: &Names| -> Vec<Cause> {
            let roots = roots(names, waits);
            FUNCTIONS.iter().map(|(name, _)| *name).filter(|name| roots.contains(name)).map(cause).collect()
        };
        let found = &all[name];
        let checked = |result: &CheckResult| {
            let waits_for = causes(&causes_of(name, result, all));
            Checked { waits_for, ..result.checked.clone() }
        };
        let waits_for = causes(&waits[name]);
        let (status, messages) = match &waits_for[..] {
            [] => (found.status, found.messages.clone()),
            some => (Status::Missing, vec![format!("waits for {}", names_of(some))]),
        };
        Report {
            name,
            place: FUNCTIONS.iter().position(|(found, _)| *found == name).map_or(0, |index| index + 1),
            role: self.roles[name],
            status,
            checks: checks_of(name).len(),
            messages,
            checked: found.results.iter().map(checked).collect(),
            waits_for,
        }
    }
}

fn checks_of(name: &str) -> &'static [Check] {
    FUNCTIONS.iter().find(|(found, _)| *found == name).map_or(&[], |(_, checks)| checks)
}

/// Functions and all that they call, as far as these are judged.
fn reached(from: Names, all: &All) -> Names {
    let (mut found, mut next) = (Names::new(), Vec::from_iter(from));
    while let Some(name) = next.pop() {
        if found.insert(name) {
            next.extend(all.get(name).into_iter().flat_map(|found| &found.names));
        }
    }
    found
}

/// The functions that may be to blame for a failing check of the function `name`: those that it calls or that the check asks, and that
/// do not pass themselves. Empty for a check that passes.
fn causes_of(name: &str, result: &CheckResult, all: &All) -> Names {
    if result.mistake.is_none() {
        return Names::new();
    }
    let needed = reached(&all[name].names | &result.asked, all);
    let is_open = |other: &&str| *other != name && all.get(other).is_some_and(|found| found.status != Status::Passed);
    needed.into_iter().filter(is_open).collect()
}

/// The functions that each judged function waits for; none if it passes, is not written, or has a mistake of its own: a failing check
/// for which no other function may be to blame.
fn waits(all: &All) -> BTreeMap<&'static str, Names> {
    let of_one = |name: &str, found: &Found| {
        let failing = found.results.iter().filter(|result| result.mistake.is_some());
        let causes: Vec<_> = failing.map(|result| causes_of(name, result, all)).collect();
        if causes.iter().any(Names::is_empty) {
            return Names::new();
        }
        causes.into_iter().flatten().chain(found.stands_still_for.iter().copied()).collect()
    };
    let mut waits: BTreeMap<_, _> = all.iter().map(|(name, found)| (*name, of_one(name, found))).collect();
    // Functions that wait for each other and for no other have a mistake among them; the first of the course is looked at first.
    let in_circle = |waits: &BTreeMap<&'static str, Names>| {
        let is_stuck = |name: &&str| {
            waits.get(name).is_some_and(|for_them| !for_them.is_empty() && roots(for_them, waits).is_empty())
        };
        FUNCTIONS.iter().map(|(name, _)| *name).find(is_stuck)
    };
    while let Some(name) = in_circle(&waits) {
        waits.insert(name, Names::new());
    }
    waits
}

/// The functions at the ends of all chains of waiting functions, which wait for none.
fn roots(from: &Names, waits: &BTreeMap<&'static str, Names>) -> Names {
    let (mut seen, mut next, mut found) = (Names::new(), Vec::from_iter(from.iter().copied()), Names::new());
    while let Some(name) = next.pop() {
        let for_them = waits.get(name).filter(|for_them| !for_them.is_empty());
        match for_them {
            _ if !seen.insert(name) => {}
            Some(for_them) => next.extend(for_them),
            None => drop(found.insert(name)),
        }
    }
    found
}
