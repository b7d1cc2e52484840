//! Shards of a class, and their joined results.

use super::*;

#[test]
fn shards_join_to_the_whole_class() {
    let names: Vec<String> = (0..12).map(|i| format!("student{i}")).collect();
    let room = Room::new(&names.iter().map(|name| (name.as_str(), GOOD)).collect::<Vec<_>>());
    let dirs: Vec<PathBuf> = (1..=3).map(|k| room.path(&format!("shard{k}"))).collect();
    let mut seen = BTreeSet::new();
    for (k, out) in dirs.iter().enumerate() {
        let options = ClassOptions { shard: Some((k + 1, 3)), out: out.clone(), jobs: 2, ..options(room.0.path()) };
        seen.extend(run(&options).unwrap().entries.into_iter().map(|entry| entry.submission));
    }
    assert_eq!((seen.len(), room.calls().len()), (12, 12));
    let merged = merge(&dirs, &room.path("merged"), reports::write_class).unwrap();
    assert_eq!((merged.kept, merged.remarks.len()), (12, 0), "{:?}", merged.remarks);
    room.run();
    let read = |folder: &str| fs::read_to_string(room.path(folder).join("grades.csv")).unwrap();
    assert_eq!(read("merged"), read("out"));
    assert!(room.path("merged/submissions/student3/grade.json").exists());

    let part = merge(&dirs[..2], &room.path("part"), reports::write_class).unwrap();
    assert!(part.remarks.iter().any(|remark| remark.starts_with("shard 3/3 is missing")));
}

#[test]
fn a_merge_refuses_strangers_and_tells_doubles_and_conflicts() {
    let room = Room::new(&[("a", GOOD), ("b", GOOD)]);
    let dir = |name: &str| ClassOptions { out: room.path(name), ..options(room.0.path()) };
    run(&dir("one")).unwrap();
    fs::write(room.path("hw/b/do.sh"), format!("{GOOD}\n")).unwrap();
    run(&dir("two")).unwrap();
    run(&ClassOptions { seed: 8, ..dir("three") }).unwrap();
    let join = |names: [&str; 2]| merge(&names.map(|name| room.path(name)), &room.path("merged"), reports::write_class);
    let joined = join(["one", "two"]).unwrap();
    assert_eq!((outcomes(&joined).as_str(), joined.remarks.len()), ("+-", 2), "{:?}", joined.remarks);
    assert!(matches!(join(["one", "three"]), Err(ClassError::Mismatch { what: "seeds", .. })));
}
