//! Joins the shards of a class.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::store::{self, Index, IndexState, Store, read_grade};
use super::{ClassError, Entry, Identity, Outcome, Person, Report, Summary, at};

/// Implementation of [`super::merge`].
pub fn join(dirs: &[PathBuf], out: &Path, report: Report) -> Result<Summary, ClassError> {
    let indices = dirs.iter().map(|dir| Index::read(dir)).collect::<Result<Vec<_>, _>>()?;
    let first = indices.first().ok_or(ClassError::Nothing)?;
    for (dir, index) in dirs.iter().zip(&indices) {
        if let Some(what) = difference(first, index) {
            return Err(ClassError::Mismatch { first: dirs[0].clone(), second: dir.clone(), what });
        }
    }
    let store = Store::open(out)?;
    let mut remarks = missing_shards(&indices);
    let mut joined: BTreeMap<(String, String), Outcome> = BTreeMap::new();
    let identity = first.identity.clone();
    let (title, max_score, release) = (first.title.clone(), first.max_score, first.release.clone());
    let mut people = Vec::new();
    for (dir, index) in dirs.iter().zip(indices) {
        remarks.extend(index.remarks);
        people.extend(index.people);
        for row in index.submissions {
            let outcome = outcome(row.state, (&row.submission, &row.student), dir, &store);
            let name = row.submission.clone();
            let outcome = match joined.remove(&(row.student.clone(), name.clone())) {
                Some(before) => one_of(&name, before, outcome, &mut remarks),
                None => outcome,
            };
            joined.insert((row.student, name), outcome);
        }
    }
    let mut entries: Vec<Entry> =
        joined.into_iter().map(|((student, submission), outcome)| Entry { submission, student, outcome }).collect();
    forbid_two_that_count(&mut entries, &mut remarks);
    remarks.dedup();
    people.sort_by(|a: &Person, b| a.student.cmp(&b.student));
    people.dedup();
    let summary = Summary {
        identity,
        shard: None,
        kept: 0,
        graded_now: 0,
        entries,
        people,
        title,
        max_score,
        release,
        changes: Vec::new(),
        remarks,
        interrupted: false,
    };
    finish(&store, summary, report)
}

fn finish(store: &Store, mut summary: Summary, report: Report) -> Result<Summary, ClassError> {
    for entry in &summary.entries {
        if let Outcome::Graded(_, folder) = &entry.outcome {
            summary.kept += 1;
            let key = folder.file_name().unwrap_or_default().to_string_lossy();
            store.point(&entry.submission, &key).map_err(at(&store.out))?;
        }
    }
    store.publish(&summary, report)?;
    Ok(summary)
}

fn difference(a: &Index, b: &Index) -> Option<&'static str> {
    let Identity { grader, toolchain, seed, rubric, extra } = &b.identity;
    let pairs = [
        (a.identity.grader == *grader, "graders"),
        (a.identity.toolchain == *toolchain, "toolchains"),
        (a.identity.seed == *seed, "seeds"),
        (a.identity.rubric == *rubric, "rubrics"),
        (a.identity.extra == *extra, "arguments for the grader"),
        (a.shard.map(|shard| shard.n) == b.shard.map(|shard| shard.n), "numbers of shards"),
    ];
    pairs.into_iter().find_map(|(same, what)| (!same).then_some(what))
}

fn missing_shards(indices: &[Index]) -> Vec<String> {
    let n = indices.iter().find_map(|index| index.shard).map_or(0, |shard| shard.n);
    let is_there = |k| indices.iter().any(|index| index.shard.is_some_and(|shard| shard.k == k));
    (1..=n)
        .filter(|k| !is_there(*k))
        .map(|k| format!("shard {k}/{n} is missing: its students are not in this table"))
        .collect()
}

/// Reads what an index names, and copies it.
fn outcome(state: IndexState, (name, student): (&str, &str), dir: &Path, store: &Store) -> Outcome {
    match state {
        IndexState::Graded(folder) => match read_grade(&dir.join(store::student_folder(student))) {
            Err(reason) => Outcome::NotGraded(format!("{}: {reason}", dir.join(&folder).display())),
            Ok(grade) => match copy_all(dir, &store.out, &folder, student) {
                Err(error) => Outcome::NotGraded(format!("its reports could not be copied: {error}")),
                Ok(()) => Outcome::Graded(Box::new(grade), folder),
            },
        },
        IndexState::NotGraded(reason) => match copy_log(&store::log(dir, name), &store::log(&store.out, name)) {
            Ok(()) => Outcome::NotGraded(reason),
            Err(error) => Outcome::NotGraded(format!("{reason}; its log could not be copied: {error}")),
        },
        IndexState::Waiting => Outcome::Waiting,
        IndexState::Older(newer) => Outcome::Older { newer },
        IndexState::NoSubmission(score) => Outcome::NoSubmission(score),
    }
}

/// Copies a grade, and the student's reports, which may have changed since an earlier merge.
fn copy_all(from: &Path, to: &Path, grade: &Path, student: &str) -> io::Result<()> {
    copy(&from.join(grade), &to.join(grade))?;
    let own = store::student_folder(student);
    match fs::remove_dir_all(to.join(&own)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => copy(&from.join(&own), &to.join(&own)),
    }
}

/// Copies the log of a grader that failed. One that never started has none.
fn copy_log(from: &Path, to: &Path) -> io::Result<()> {
    match fs::copy(from, to) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Copies a folder as a whole, unless it is there.
fn copy(from: &Path, to: &Path) -> io::Result<()> {
    if to.exists() {
        return Ok(());
    }
    let place = to.parent().unwrap_or(Path::new("."));
    let partial = tempfile::Builder::new().prefix(".partial-").tempdir_in(place)?;
    copy_into(from, partial.path())?;
    fs::rename(partial.keep(), to)
}

fn copy_into(from: &Path, to: &Path) -> io::Result<()> {
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let target = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            fs::create_dir(&target)?;
            copy_into(&entry.path(), &target)?;
        } else if entry.file_type()?.is_file() {
            fs::copy(entry.path(), target)?;
        }
    }
    Ok(())
}

/// One outcome of two for the same submission.
fn one_of(name: &str, before: Outcome, after: Outcome, remarks: &mut Vec<String>) -> Outcome {
    match (before, after) {
        (Outcome::Graded(a, folder), Outcome::Graded(b, other)) => {
            if folder == other && a.score == b.score && a.max_score == b.max_score {
                remarks.push(format!("{name}: graded twice, with the same result"));
                return Outcome::Graded(a, folder);
            }
            let what = if folder == other { "results" } else { "contents" };
            let conflict = format!("conflict: two {what}, with scores {} and {}", a.score, b.score);
            remarks.push(format!("{name}: {conflict}"));
            Outcome::NotGraded(conflict)
        }
        // A conflict stays one with a third grade.
        (Outcome::NotGraded(reason), _) if reason.starts_with("conflict") => Outcome::NotGraded(reason),
        (graded @ Outcome::Graded(..), _) | (_, graded @ Outcome::Graded(..)) => graded,
        (Outcome::Waiting, other) | (other, _) => other,
    }
}

fn forbid_two_that_count(entries: &mut [Entry], remarks: &mut Vec<String>) {
    let mut counting: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (i, entry) in entries.iter().enumerate() {
        if !matches!(entry.outcome, Outcome::Older { .. } | Outcome::NoSubmission(_)) {
            counting.entry(entry.student.clone()).or_default().push(i);
        }
    }
    for (student, indices) in counting.into_iter().filter(|(_, indices)| indices.len() > 1) {
        let names: Vec<_> = indices.iter().map(|&i| entries[i].submission.clone()).collect();
        let conflict = format!("conflict: {} count for {student}", names.join(" and "));
        for i in indices {
            entries[i].outcome = Outcome::NotGraded(conflict.clone());
        }
        remarks.push(conflict);
    }
}
