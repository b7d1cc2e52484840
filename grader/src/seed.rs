//! The seed of the random inputs: drawn once for a class, and written down with its results.

use std::hash::{BuildHasher, Hasher, RandomState};
use std::path::Path;

use crate::class;

/// An unpredictable seed, short enough for people and for every reader of JSON.
pub fn drawn() -> u64 {
    // The keys of a hash map's hasher come from the system's random numbers.
    RandomState::new().build_hasher().finish() % 1_000_000_000 + 1
}

/// The seed of a class: the one that is given, that of earlier results in the folder, or a new one.
///
/// # Errors
/// The problem and the remedy where a shard has none, because all shards need the same.
pub fn of_class(out: &Path, given: Option<u64>, is_shard: bool) -> Result<u64, String> {
    let before = || class::Index::read(out).ok().map(|index| index.identity.seed);
    match given.or_else(before) {
        Some(seed) => Ok(seed),
        None if is_shard => Err(format!(
            "all shards need one seed, or they cannot be joined; give each of them the same, such as --seed {}",
            drawn()
        )),
        None => Ok(drawn()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_class_keeps_the_seed_that_was_drawn_for_it_and_shards_are_given_one() {
        let folder = tempfile::tempdir().unwrap();
        let seeds: Vec<_> = (0..8).map(|_| of_class(folder.path(), None, false).unwrap()).collect();
        assert!(seeds.iter().any(|seed| *seed != seeds[0]) && seeds.iter().all(|seed| *seed <= 1_000_000_000));
        assert!(of_class(folder.path(), None, true).unwrap_err().contains("give each of them the same"));
        let identity = r#"{"grader": "", "toolchain": "", "seed": 4711, "rubric": null, "extra": []}"#;
        let index = format!(
            r#"{{"format_version": 1, "identity": {identity}, "shard": null, "remarks": [], "submissions": []}}"#
        );
        fs::write(folder.path().join("class.json"), index).unwrap();
        assert_eq!(of_class(folder.path(), None, true), Ok(4711));
        assert_eq!(of_class(folder.path(), Some(7), false), Ok(7));
    }
}
