//! Cgroups on a folder of ordinary files with the kernel's names and contents.

use super::*;
use tempfile::TempDir;

const PID: u32 = 4711;

/// A hierarchy with one delegated cgroup, `user/scope`, which holds these processes and has these controllers.
fn delegated(controllers: &str, given: &str, processes: &str) -> (TempDir, PathBuf) {
    let mount = TempDir::new().unwrap();
    let scope = mount.path().join("user/scope");
    fs::create_dir_all(&scope).unwrap();
    let files = [
        ("cgroup.controllers", controllers),
        ("cgroup.subtree_control", given),
        ("cgroup.procs", processes),
        ("cgroup.type", "domain\n"),
    ];
    files.iter().for_each(|(name, text)| fs::write(scope.join(name), text).unwrap());
    (mount, scope)
}

fn limits() -> Limits {
    let time = Duration::from_secs(1);
    Limits { wall: time, cpu: time, memory: 1 << 30, processes: 64, file_size: 1, open_files: 1, output: 1 }
}

#[test]
fn a_grader_alone_in_its_cgroup_moves_into_a_child_before_it_gives_controllers_on() {
    let (mount, scope) = delegated("cpu memory pids\n", "", "4711\n");
    let base = prepare_in(mount.path(), "4:memory:/old\n0::/user/scope\n", PID).unwrap();
    assert_eq!(base, scope);
    assert_eq!(fs::read_to_string(scope.join("grader/cgroup.procs")).unwrap(), "4711");
    assert_eq!(fs::read_to_string(scope.join("cgroup.subtree_control")).unwrap(), "+memory +pids");
}

#[test]
fn a_grader_that_another_has_started_uses_the_same_cgroup() {
    let (mount, scope) = delegated("memory", "memory\n", "");
    fs::create_dir(scope.join("grader")).unwrap();
    assert_eq!(prepare_in(mount.path(), "0::/user/scope/grader\n", PID), Ok(scope.clone()));
    assert!(!scope.join("grader/cgroup.procs").exists(), "it was moved by the first one");
}

#[test]
fn the_cgroup_above_all_others_may_hold_processes() {
    let (mount, scope) = delegated("memory", "", "1\n2\n4711\n");
    fs::remove_file(scope.join("cgroup.type")).unwrap();
    assert_eq!(prepare_in(&scope, "0::/\n", PID), Ok(scope.join("")));
    assert!(!scope.join("grader").exists());
    drop(mount);
}

#[test]
fn a_reason_is_told_where_there_is_no_such_cgroup_and_no_process_is_moved() {
    let told = |controllers, processes, membership| {
        let (mount, scope) = delegated(controllers, "", processes);
        let why = prepare_in(mount.path(), membership, PID).unwrap_err();
        assert!(!scope.join("grader").exists() && fs::read(scope.join("cgroup.subtree_control")).unwrap().is_empty());
        why
    };
    assert!(told("cpu pids", "4711", "0::/user/scope").contains("no controller `memory`"));
    assert!(told("memory", "4711\n12\n", "0::/user/scope").contains("other processes (1)"));
    assert!(told("memory", "4711", "4:memory:/user/scope").contains("in no cgroup of version 2"));
    assert!(told("memory", "4711", "0::/elsewhere").contains("systemd-run"));
}

#[test]
fn a_tree_has_its_limits_tells_of_a_want_of_memory_and_goes_with_its_owner() {
    let (_mount, scope) = delegated("memory", "memory", "");
    let tree = Tree::new(&scope, &limits()).unwrap();
    let text = |name: &str| fs::read_to_string(tree.folder().join(name)).unwrap();
    assert_eq!(text("memory.max"), (1_u64 << 30).to_string());
    assert_eq!(
        (text("memory.swap.max"), text("pids.max"), text("memory.oom.group")),
        ("0".into(), "64".into(), "1".into())
    );
    join(tree.folder()).unwrap();
    assert_eq!(text("cgroup.procs"), "0");
    assert!(!tree.is_out_of_memory());
    fs::write(tree.folder().join("memory.events"), "low 0\nhigh 0\nmax 9\noom 1\noom_kill 2\n").unwrap();
    assert!(tree.is_out_of_memory());
    fs::write(tree.folder().join("memory.events"), "oom 1\noom_kill 0\noom_group_kill 0\n").unwrap();
    assert!(!tree.is_out_of_memory());
    // The kernel removes its files with the folder; these must be removed first.
    let folder = tree.folder().to_owned();
    fs::read_dir(&folder).unwrap().flatten().for_each(|file| fs::remove_file(file.path()).unwrap());
    drop(tree);
    assert!(!folder.exists());
}

#[test]
fn what_a_killed_grader_has_left_behind_is_removed_by_the_next() {
    let (mount, scope) = delegated("memory", "memory", "");
    fs::create_dir(scope.join("grade-12")).unwrap();
    fs::create_dir(scope.join("another")).unwrap();
    prepare_in(mount.path(), "0::/user/scope", PID).unwrap();
    assert!(!scope.join("grade-12").exists() && scope.join("another").exists());
}
