//! A small study: whole, in shards, killed and resumed.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use fem_chart::{Axis, Chart, Series};

use super::*;

/// Parts with a mark, a table and a chart each.
struct Squares {
    count: usize,
    computed: AtomicUsize,
}

impl Squares {
    fn new(count: usize) -> Self {
        Self { count, computed: AtomicUsize::new(0) }
    }
}

impl Study for Squares {
    type Row = Part;

    fn arguments(&self) -> Vec<String> {
        vec!["squares".to_owned(), self.count.to_string()]
    }

    fn cases(&self) -> Vec<Case<'_, Part>> {
        let part = |n: usize| {
            self.computed.fetch_add(1, Ordering::Relaxed);
            let square = n as f64 * n as f64;
            let mut chart = Chart::new("squares & roots", Axis::linear("n"), Axis::log("n²"));
            chart.series.push(Series::joined(format!("{n} < {square}"), (n, n), [(n as f64, square), (0.5, f64::NAN)]));
            let table =
                Table::of(format!("square-{n}"), &[n], &[("n", &|n| n.to_string()), (">n²", &|_| square.to_string())]);
            let mark = Mark::new(format!("{n} is not 3"), "", n != 3);
            Part::new("").titled(&n.to_string(), "Square").marks([mark]).tables([table]).chart(
                format!("{n}"),
                &chart,
                "",
            )
        };
        (0..self.count).map(|n| Case::new(format!("square of {n}"), move || part(n))).collect()
    }

    fn threads(&self) -> usize {
        3
    }

    fn finish(&self, found: Found<Part>, out: &Path) -> io::Result<Finished> {
        let machine = crate::machine::Machine { cpu: "this".to_owned(), load: String::new(), ..found.machine };
        let page = Page { name: "squares", title: "Squares", text: "", machine, quick: false, parts: found.rows };
        write(&page, out)?;
        Ok(page.finished())
    }
}

fn run(study: &Squares, out: &Path, shard: Shard, merged: &[PathBuf]) -> Result<Finished, Trouble> {
    let run = Run { out, shard, merged, sources: Path::new("."), tell: &|_, _, _| (), remark: &|_| () };
    carry_out(study, &run)
}

/// The files of a folder with their contents.
fn files(folder: &Path) -> Vec<(String, String)> {
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
    files.iter().map(|path| (name(path), fs::read_to_string(path).unwrap())).collect()
}

#[test]
fn shards_that_are_joined_have_the_files_of_the_whole_study() {
    let (folder, study) = (tempfile::tempdir().unwrap(), Squares::new(5));
    let at = |name: &str| folder.path().join(name);
    let whole = run(&study, &at("whole"), Shard::WHOLE, &[]).unwrap();
    assert_eq!(whole.failed.as_deref(), Some("1 marks do not hold"));
    assert_eq!(files(&at("whole")).len(), 11, "a page, and a table and a picture of each part");
    let shards = [1, 2].map(|number| {
        let out = at(&number.to_string());
        let told = run(&study, &out, Shard { number, of: 2 }, &[]).unwrap();
        assert_eq!(told.failed, None);
        out
    });
    assert_eq!(arguments(&shards[0]).unwrap(), ["squares", "5"]);
    let incomplete = run(&study, &at("half"), Shard::WHOLE, &shards[1..]);
    let message = "3 of 5 cases have no row, the first `square of 0`; run their shards to the end";
    assert_eq!(incomplete, Err(Trouble::Incomplete(message.to_owned())));
    assert_eq!(run(&study, &at("joined"), Shard::WHOLE, &shards).unwrap(), whole);
    // The page alone names the machine.
    let same = |folder: &Path| files(folder).into_iter().filter(|(name, _)| name != "squares.html").collect::<Vec<_>>();
    assert_eq!(same(&at("joined")), same(&at("whole")));
    assert!(run(&Squares::new(6), &at("other"), Shard::WHOLE, &shards).is_err(), "rows of another study");
}

#[test]
fn a_killed_shard_goes_on_after_its_last_whole_row() {
    let (folder, study) = (tempfile::tempdir().unwrap(), Squares::new(5));
    let shard = Shard { number: 1, of: 2 };
    run(&study, folder.path(), shard, &[]).unwrap();
    let path = folder.path().join("rows.jsonl");
    let text = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 4, "a heading and three rows");
    fs::write(&path, format!("{}\n{}\n{}", lines[0], lines[1], &lines[2][..20])).unwrap();
    study.computed.store(0, Ordering::Relaxed);
    run(&study, folder.path(), shard, &[]).unwrap();
    assert_eq!(study.computed.load(Ordering::Relaxed), 2);
    assert_eq!(fs::read_to_string(&path).unwrap().lines().count(), 4);
    let Err(Trouble::Unusable(message)) = run(&Squares::new(6), folder.path(), shard, &[]) else { panic!("was taken") };
    assert!(message.contains("rows of another study"), "{message}");
}

#[test]
fn shards_are_given_as_one_number_of_another() {
    assert_eq!("2/8".parse(), Ok(Shard { number: 2, of: 8 }));
    for wrong in ["0/8", "9/8", "2", "2/0", "a/b", "-1/2"] {
        assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
    }
}

#[test]
fn a_panic_and_work_without_end_are_told_apart() {
    let limit = Duration::from_secs(60);
    assert_eq!(guarded(limit, |deadline| deadline.is_over()), Ok(false));
    assert_eq!(guarded(limit, |_| -> () { panic!("no {}", "row") }), Err(Stopped::Panicked("no row".to_owned())));
}
