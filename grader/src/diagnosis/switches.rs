//! Algorithms with switches: the right setting, one wrong switch, two wrong switches.

use super::Candidate;
use crate::reference::trial::{Observed, Trial};

/// A wrong switch: its name, a sentence for the student, and the change of the right settings.
pub type Switch<S> = (&'static str, &'static str, fn(&mut S));

/// The algorithm with these settings; `None` if it does not take such input.
pub type Run<S> = fn(&S, &Trial) -> Option<Observed>;

/// One wrong switch first, then any two of them.
pub fn candidates<'a, S: Copy + 'static>(right: S, switches: &'static [Switch<S>], run: Run<S>) -> Vec<Candidate<'a>> {
    let mut all: Vec<_> = switches
        .iter()
        .map(|&(name, sentence, change)| {
            let mut settings = right;
            change(&mut settings);
            Candidate::new(name, sentence, move |trial, _| run(&settings, trial))
        })
        .collect();
    let beside: Vec<String> = switches.iter().map(|(_, sentence, _)| beside_another(sentence)).collect();
    for (i, first) in switches.iter().enumerate() {
        for (j, second) in switches.iter().enumerate().skip(i + 1) {
            let mut settings = right;
            (first.2)(&mut settings);
            (second.2)(&mut settings);
            let name = format!("{} and {}", first.0, second.0);
            let sentence = format!("{} {}", beside[i], beside[j]);
            all.push(Candidate::new(name, sentence, move |trial, _| run(&settings, trial)));
        }
    }
    all
}

/// Words with which a sentence says that something is right.
const CLAIMS: [&str; 5] = [" is right", " are right", " is well", "The right ", "Right "];

/// A sentence about a mistake that is not the only one: what it says to be right is left out, as the other mistake may have spoilt it.
pub fn beside_another(sentence: &str) -> String {
    let end = sentence.find([':', '.']).filter(|&end| CLAIMS.iter().any(|claim| sentence[..end].contains(claim)));
    let rest = end.map_or(sentence, |end| sentence[end + 1..].trim_start());
    let mut letters = rest.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_beside_another_claims_nothing_to_be_right() {
        let one = "The velocity is right and the positions are not: how far does a body move in one step?";
        assert_eq!(beside_another(one), "How far does a body move in one step?");
        let other = "Inside all is well. Which element does a vertex outside follow?";
        assert_eq!(beside_another(other), "Which element does a vertex outside follow?");
        assert_eq!(beside_another("Every vertex is wrong: why?"), "Every vertex is wrong: why?");
    }
}
