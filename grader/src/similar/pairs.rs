//! Pairs of submissions, and the runs of tokens that they share.

use std::collections::{BTreeMap, HashMap};

use super::fingerprints::{Document, PIECE};

/// Largest number of places of a piece in one submission. A piece that repeats more often is an idiom of the language.
const MOST_PLACES: usize = 4;

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

/// All pairs with shared runs, the most alike first. Submissions with a student in common are not compared. What many submissions
/// share counts as much as what two share: a text may be common because the whole class has copied it.
pub fn pairs(class: &[Document]) -> Vec<Pair> {
    let mut owners: HashMap<u64, Vec<usize>> = HashMap::new();
    for (index, document) in class.iter().enumerate() {
        document.pieces.keys().for_each(|hash| owners.entry(*hash).or_default().push(index));
    }
    let is_apart = |a: usize, b: usize| !class[a].students.iter().any(|student| class[b].students.contains(student));
    let mut pairs: Vec<Pair> = Vec::new();
    for (a, document) in class.iter().enumerate() {
        let mut shared: BTreeMap<usize, Vec<u64>> = BTreeMap::new();
        for hash in document.pieces.keys() {
            let later = owners[hash].iter().filter(|b| **b > a);
            later.for_each(|b| shared.entry(*b).or_default().push(*hash));
        }
        let apart = shared.into_iter().filter(|(b, _)| is_apart(a, *b));
        pairs.extend(apart.map(|(b, hashes)| pair(class, [a, b], &hashes)));
    }
    pairs.sort_by(|a, b| b.share.total_cmp(&a.share).then(a.members.cmp(&b.members)));
    pairs
}

/// Submissions that are joined by pairs of at least this share, as their places in the class: the largest group first.
pub fn groups(class: &[Document], pairs: &[Pair], least: f64) -> Vec<Vec<usize>> {
    let mut group: Vec<usize> = (0..class.len()).collect();
    for pair in pairs.iter().filter(|pair| pair.share >= least) {
        let [kept, joined] = pair.members.map(|member| group[member]);
        group.iter_mut().filter(|group| **group == joined).for_each(|group| *group = kept);
    }
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    group.into_iter().enumerate().for_each(|(member, group)| groups.entry(group).or_default().push(member));
    let mut groups: Vec<_> = groups.into_values().filter(|group| group.len() > 1).collect();
    groups.sort_by_key(|group| std::cmp::Reverse(group.len()));
    groups
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
