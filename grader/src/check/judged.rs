//! Judges the functions of a repository: what the compiler and the checks say of each.

use std::collections::BTreeMap;

use super::found::{Found, Judged, Names, checks_of, reached};
use super::recorded::Recorded;
use super::run_checks::{run_checks, summary};
use super::{SEED, refused};
use crate::compile::Fault;
use crate::implementation::sandboxed::Sandboxed;
use crate::properties::FUNCTIONS;
use crate::status::Status;
use crate::submission::{Source, Submission, mentions};

/// A repository whose functions are compiled, and the processes that call them.
pub struct Judge<'a> {
    /// The files.
    pub submission: &'a Submission,
    /// The functions that do not compile.
    pub faults: &'a BTreeMap<&'static str, Fault>,
    /// Answers for the function that is judged.
    pub subject: &'a Sandboxed,
    /// Answers for the functions that a check needs beside it.
    pub trusted: &'a Sandboxed,
    /// Is told each function whose checks begin.
    pub begins: &'a dyn Fn(&'static str),
}

impl Judge<'_> {
    /// Judges all functions.
    pub fn all(&self) -> Judged {
        self.rest(Judged::new())
    }

    /// Judges all functions that may answer otherwise than before, when the file of one has changed: itself, and those that call it or
    /// whose checks ask it.
    pub fn after_a_change(&self, earlier: Judged, changed: &str) -> Judged {
        let is_affected = |found: &Found| reached(found.needs(), &earlier).contains(changed);
        let affected: Names = earlier
            .iter()
            .filter(|(name, found)| **name == changed || is_affected(found))
            .map(|(name, _)| *name)
            .collect();
        self.rest(earlier.into_iter().filter(|(name, _)| !affected.contains(name)).collect())
    }

    /// Judges a function, and all that it needs and that those need, as long as they do not pass.
    pub fn one(&self, name: &'static str) -> Judged {
        let (mut all, mut next) = (Judged::new(), Names::from([name]));
        while !next.is_empty() {
            next.iter().for_each(|name| self.judge(name, &mut all));
            let open = all.values().filter(|found| found.status != Status::Passed);
            next = open.flat_map(Found::needs).filter(|name| !all.contains_key(name)).collect();
        }
        all
    }

    fn rest(&self, mut all: Judged) -> Judged {
        FUNCTIONS.iter().for_each(|(name, _)| self.judge(name, &mut all));
        all
    }

    /// Judges a function after those that its text names.
    fn judge(&self, name: &'static str, all: &mut Judged) {
        let mut open = vec![(name, false)];
        let mut visited = Names::new();
        while let Some((name, are_others_done)) = open.pop() {
            if all.contains_key(name) {
                continue;
            }
            if are_others_done {
                all.insert(name, self.found(name, all));
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

    fn found(&self, name: &'static str, all: &Judged) -> Found {
        let names = self.names(name);
        let without_checks = |status, messages, stands_still_for| Found {
            status,
            messages,
            results: Vec::new(),
            is_in_program: status == Status::Missing && matches!(self.source(name), Some(Source::Written(_))),
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
        let is_slow = |found: &Found| {
            found.status == Status::TimedOut || (found.is_in_program && !found.stands_still_for.is_empty())
        };
        let slow: Names = all.iter().filter(|(_, found)| is_slow(found)).map(|(name, _)| *name).collect();
        let called = reached(names.clone(), all);
        if !called.is_disjoint(&slow) {
            return without_checks(Status::Missing, Vec::new(), &called & &slow);
        }
        (self.begins)(name);
        self.subject.next_function();
        self.trusted.next_function();
        let results = run_checks(checks_of(name), self.subject, &Recorded::new(self.trusted, &slow), SEED);
        let (status, messages) = summary(name, &results);
        Found { status, messages, results, is_in_program: true, names, stands_still_for: Names::new() }
    }
}
