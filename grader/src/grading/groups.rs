//! Divides the functions of a level among programs. A function that calls another one of its level must not lose marks for the
//! mistakes in that one. It is judged in a second program, in which the reference answers that call.

use std::collections::{BTreeMap, BTreeSet};

/// Names of functions.
pub type Names = BTreeSet<&'static str>;

/// The functions that the text of each function calls.
pub type Calls = BTreeMap<&'static str, Names>;

/// Functions that share a program.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Group {
    /// Those that are judged, in the student's words.
    pub judged: Vec<&'static str>,
    /// Those that the reference answers when they are called. No function is judged in a program with its own reference.
    pub reference: Names,
}

/// Divides the `judged` functions of a level among a small number of programs, by a greedy search: one program if no function calls
/// another. `below` are the functions of lower levels; `own` and `reference` give the calls of each function.
pub fn groups(judged: &[&'static str], below: &Names, own: &Calls, reference: &Calls) -> Vec<Group> {
    let mut wanted: Vec<_> = judged.iter().map(|name| (*name, needs(name, below, own, reference))).collect();
    // First the functions that call no other: they may all stay together.
    wanted.sort_by_key(|(_, needs)| !needs.is_empty());
    let mut groups: Vec<Group> = Vec::new();
    for (name, needs) in wanted {
        let is_free = |group: &&mut Group| {
            !group.reference.contains(name) && group.judged.iter().all(|other| !needs.contains(other))
        };
        let place = match groups.iter_mut().find(is_free) {
            Some(group) => group,
            None => {
                groups.push(Group { judged: Vec::new(), reference: below.clone() });
                // There is one since the line above.
                let Some(group) = groups.last_mut() else { continue };
                group
            }
        };
        place.judged.push(name);
        place.reference.extend(needs);
    }
    groups
}

/// The functions that a function calls and that are not below its level, and those that their reference calls. One whose reference
/// leads back to the one that is judged is left out: there, the student's own one answers.
fn needs(name: &str, below: &Names, own: &Calls, reference: &Calls) -> Names {
    let called = own.get(name).into_iter().flatten().filter(|other| **other != name && !below.contains(*other));
    let with_theirs = called.map(|other| closure(other, reference)).filter(|names| !names.contains(name));
    with_theirs.flatten().collect()
}

/// A function, and all functions that it calls directly or indirectly.
pub fn closure(name: &'static str, calls: &Calls) -> Names {
    let (mut found, mut next) = (Names::new(), vec![name]);
    while let Some(name) = next.pop() {
        if found.insert(name) {
            next.extend(calls.get(name).into_iter().flatten());
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn calls(pairs: &[(&'static str, &[&'static str])]) -> Calls {
        pairs.iter().map(|(name, called)| (*name, called.iter().copied().collect())).collect()
    }

    fn judged(groups: &[Group]) -> Vec<&[&'static str]> {
        groups.iter().map(|group| &group.judged[..]).collect()
    }

    #[test]
    fn functions_that_call_only_what_is_below_share_one_program() {
        let own = calls(&[("b", &["a"]), ("c", &["a", "c"])]);
        let below = Names::from(["a"]);
        let found = groups(&["b", "c"], &below, &own, &Calls::new());
        assert_eq!(found, [Group { judged: vec!["b", "c"], reference: below }]);
    }

    #[test]
    fn one_that_calls_another_of_its_level_has_a_program_with_the_reference_of_that_one() {
        let own = calls(&[("b", &["c"])]);
        let reference = calls(&[("c", &["a"])]);
        let below = Names::from(["a"]);
        let found = groups(&["b", "c", "d"], &below, &own, &reference);
        assert_eq!(judged(&found), [&["c", "d"][..], &["b"]]);
        assert_eq!(found[0].reference, below);
        assert_eq!(found[1].reference, Names::from(["a", "c"]));
    }

    #[test]
    fn a_chain_of_calls_within_a_level_never_meets_the_reference_of_one_that_is_judged() {
        let chain = calls(&[("b", &["a"]), ("c", &["b"]), ("d", &["c"])]);
        let found = groups(&["d", "c", "b", "a"], &Names::new(), &chain, &chain);
        assert_eq!(found.iter().map(|group| group.judged.len()).sum::<usize>(), 4);
        for group in &found {
            assert!(group.judged.iter().all(|name| !group.reference.contains(name)), "{group:?}");
        }
    }

    #[test]
    fn a_reference_that_leads_back_to_the_judged_function_does_not_answer_for_it() {
        let found = groups(&["a"], &Names::new(), &calls(&[("a", &["b"])]), &calls(&[("b", &["a"])]));
        assert_eq!(found, [Group { judged: vec!["a"], reference: Names::new() }]);
    }
}
