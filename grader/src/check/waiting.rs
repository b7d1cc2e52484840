//! Tells a function's own mistakes from those of the functions that it needs.

use std::collections::BTreeMap;

use super::found::{Found, Judged, Names, checks_of, reached};
use super::report::{Cause, Checked, Report, names_of};
use super::roles::{Role, Roles};
use super::run_checks::CheckResult;
use crate::implementation::Trouble;
use crate::properties::FUNCTIONS;
use crate::properties::outcome::Mistake;
use crate::status::Status;

type Waits = BTreeMap<&'static str, Names>;

/// Reports of the functions of an assignment, with the functions of later assignments that are written, or of one function.
pub fn reports(all: &Judged, roles: &Roles, only: Option<&str>) -> Vec<Report> {
    let waits = waits(all);
    let is_told = |name: &&str| match only {
        Some(only) => *name == only,
        None => roles[name] != Role::Later || all[name].status != Status::Missing,
    };
    let names = FUNCTIONS.iter().map(|(name, _)| *name).filter(is_told);
    names.map(|name| report(name, all, roles, &waits)).collect()
}

fn report(name: &'static str, all: &Judged, roles: &Roles, waits: &Waits) -> Report {
    let cause = |name: &'static str| Cause { name, status: all[name].status, role: roles[name] };
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
        role: roles[name],
        status,
        checks: checks_of(name).len(),
        messages,
        checked: found.results.iter().map(checked).collect(),
        waits_for,
    }
}

/// The functions that may be to blame for a failing check of the function `name`: those that it calls or that the check asks, and that
/// do not pass themselves. Empty for a check that passes.
fn causes_of(name: &str, result: &CheckResult, all: &Judged) -> Names {
    let Some(mistake) = &result.mistake else { return Names::new() };
    // A function that is not in the program stops whatever calls it, so an answer was made without it.
    let is_stopped = matches!(
        mistake,
        Mistake::Waits { .. } | Mistake::Trouble(Trouble::Missing) | Mistake::Trouble(Trouble::GivenUp)
    );
    let may_be_to_blame = |found: &Found| found.status != Status::Passed && (is_stopped || found.is_in_program);
    let needed = reached(&all[name].names | &result.asked, all);
    needed.into_iter().filter(|other| *other != name && all.get(other).is_some_and(may_be_to_blame)).collect()
}

/// The functions that each judged function waits for; none if it passes, is not written, or has a mistake of its own: a failing check
/// for which no other function may be to blame.
fn waits(all: &Judged) -> Waits {
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
    let in_circle = |waits: &Waits| {
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
fn roots(from: &Names, waits: &Waits) -> Names {
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
