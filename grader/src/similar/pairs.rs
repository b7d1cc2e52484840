//! Pairs of submissions, and the runs of tokens that they share.

use std::collections::HashMap;

use super::fingerprints::{Document, PIECE};

/// Largest number of places of a piece in one submission. A piece that repeats more often is an idiom of the language.
const MOST_PLACES: usize = 4;

/// A piece in more than half of a class is left out, where the class has so many submissions at least.
const CLASS: usize = 8;

/// A run of tokens that two submissions share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Run {
    /// File and first token, in the first submission and in the second.
    pub places: [(usize, usize); 2],
    pub length: usize,
}

/// Two submissions with shared runs.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Their places in the class.
    pub members: [usize; 2],
    /// The longest first, none within another.
    pub runs: Vec<Run>,
    /// Number of the author's tokens in shared runs, of each.
    pub shared: [usize; 2],
    /// The same as a share of all that is the author's, of the one where it is larger.
    pub share: f64,
}

/// All pairs with shared runs, the most alike first. Submissions with a student in common are not compared.
pub fn pairs(class: &[Document]) -> Vec<Pair> {
    let mut owners: HashMap<u64, Vec<usize>> = HashMap::new();
    for (index, document) in class.iter().enumerate() {
        document.pieces.keys().for_each(|hash| owners.entry(*hash).or_default().push(index));
    }
    let is_common = |owners: &Vec<usize>| class.len() >= CLASS && 2 * owners.len() > class.len();
    owners.retain(|_, owners| owners.len() > 1 && !is_common(owners));
    let mut shared: HashMap<[usize; 2], Vec<u64>> = HashMap::new();
    for (hash, owners) in &owners {
        for (i, &a) in owners.iter().enumerate() {
            owners[i + 1..].iter().for_each(|&b| shared.entry([a.min(b), a.max(b)]).or_default().push(*hash));
        }
    }
    let is_apart = |[a, b]: [usize; 2]| !class[a].students.iter().any(|student| class[b].students.contains(student));
    let mut pairs: Vec<Pair> = shared
        .into_iter()
        .filter(|(members, _)| is_apart(*members))
        .map(|(members, hashes)| pair(class, members, &hashes))
        .collect();
    pairs.sort_by(|a, b| b.share.total_cmp(&a.share).then(a.members.cmp(&b.members)));
    pairs
}

fn pair(class: &[Document], members: [usize; 2], hashes: &[u64]) -> Pair {
    let documents = members.map(|index| &class[index]);
    let mut runs = found_runs(documents, hashes);
    runs.sort_by_key(|run| (std::cmp::Reverse(run.length), *run));
    let mut covered =
        documents.map(|document| document.files.iter().map(|file| vec![false; file.tokens.len()]).collect::<Vec<_>>());
    runs.retain(|run| {
        let news = [0, 1].map(|side| {
            let (file, start) = run.places[side];
            let place = &mut covered[side][file][start..start + run.length];
            let is_new = place.iter().any(|covered| !covered);
            (is_new, start, file)
        });
        // A run whose tokens are all in longer runs is redundant.
        if news.iter().all(|(is_new, ..)| *is_new) {
            for (side, (_, start, file)) in news.into_iter().enumerate() {
                covered[side][file][start..start + run.length].fill(true);
            }
            return true;
        }
        false
    });
    let shared = [0, 1].map(|side| {
        let files = documents[side].files.iter().zip(&covered[side]);
        files
            .map(|(file, covered)| file.is_own.iter().zip(covered).filter(|(own, covered)| **own && **covered).count())
            .sum()
    });
    let share = |side: usize| shared[side] as f64 / documents[side].size().max(1) as f64;
    Pair { members, runs, shared, share: share(0).max(share(1)) }
}

/// All runs around shared pieces. Pieces within a known run are skipped, so that the time is proportional to the length of the
/// texts.
fn found_runs(documents: [&Document; 2], hashes: &[u64]) -> Vec<Run> {
    let mut places: Vec<[(usize, usize); 2]> = Vec::new();
    for hash in hashes {
        let [first, second] = documents.map(|document| document.pieces.get(hash).map_or(&[][..], |places| places));
        if first.len() <= MOST_PLACES && second.len() <= MOST_PLACES {
            places.extend(first.iter().flat_map(|a| second.iter().map(move |b| [*a, *b])));
        }
    }
    places.sort_unstable();
    // Ends of runs by files and by how far the two texts are shifted.
    let mut ends: HashMap<(usize, usize, isize), usize> = HashMap::new();
    let mut runs = Vec::new();
    for [a, b] in places {
        let end = ends.entry((a.0, b.0, a.1 as isize - b.1 as isize)).or_default();
        if a.1 >= *end
            && let Some(run) = extended(documents, [a, b])
        {
            *end = run.places[0].1 + run.length;
            runs.push(run);
        }
    }
    runs
}

/// The whole run around a shared piece; `None` if two different pieces have the same hash.
fn extended(documents: [&Document; 2], places: [(usize, usize); 2]) -> Option<Run> {
    let kinds = [0, 1].map(|side| &documents[side].files[places[side].0].tokens);
    let [a, b] = places.map(|(_, start)| start);
    let is_same = |i: usize, j: usize| kinds[0].get(i).zip(kinds[1].get(j)).is_some_and(|(a, b)| a.kind == b.kind);
    let before = (1..=a.min(b)).take_while(|back| is_same(a - back, b - back)).count();
    let after = (0..).take_while(|ahead| is_same(a + ahead, b + ahead)).count();
    let places = [(places[0].0, a - before), (places[1].0, b - before)];
    (after >= PIECE).then_some(Run { places, length: before + after })
}
