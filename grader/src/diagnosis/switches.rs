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
    for (index, first) in switches.iter().enumerate() {
        for second in &switches[index + 1..] {
            let mut settings = right;
            (first.2)(&mut settings);
            (second.2)(&mut settings);
            let (name, sentence) = (format!("{} and {}", first.0, second.0), format!("{} {}", first.1, second.1));
            all.push(Candidate::new(name, sentence, move |trial, _| run(&settings, trial)));
        }
    }
    all
}
