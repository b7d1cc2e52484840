//! Hostile programs in the sandbox, and their ends.
#![cfg(target_os = "linux")]

mod program;

use std::fs;
use std::io::{Read, Write};
use std::net::TcpListener;
use std::time::{Duration, Instant};

use grader::sandbox::{Profile, Sandbox, system_folders};
use tempfile::TempDir;

use program::{Program, SANDBOX, compile};

#[test]
fn this_machine_has_layers_that_hold_together() {
    println!("{:?}", SANDBOX.layers());
    assert!(SANDBOX.is_some_layer());
    assert!(!Sandbox::none().is_some_layer());
}

#[test]
#[ignore = "measures times"]
fn a_start_costs_little() {
    let program = Program::new("");
    let begun = Instant::now();
    (0..20).for_each(|_| program.is_harmless());
    let each = begun.elapsed() / 20;
    println!("{each:?} for each start");
    assert!(each < Duration::from_millis(500));
}

#[test]
fn the_compiler_reads_no_file_of_another() {
    let (_folder, ended) = compile("const X: &str = include_str!(\"/etc/passwd\"); fn main() { print!(\"{X}\") }");
    assert_ne!(ended.code, Some(0));
}

#[test]
fn files_of_others_cannot_be_read() {
    let other = TempDir::new().expect("a folder");
    let secret = other.path().join("secret");
    fs::write(&secret, "42").expect("a file");
    Program::new(&format!(
        "for path in [{secret:?}, \"/etc/passwd\", \"/etc/shadow\", \"/proc/1/environ\", \"/proc/self/mem\", \"/proc/self/cmdline\", \"/root/.bashrc\"] {{
            assert!(fs::read(path).is_err(), \"{{path}}\"); assert!(fs::File::open(path).is_err(), \"{{path}}\");
        }}
        for path in [\"/proc\", \"/home\", \"/root\", {:?}] {{ assert!(fs::read_dir(path).is_err(), \"{{path}}\"); }}
        std::os::unix::fs::symlink({secret:?}, \"link\").ok(); assert!(fs::read(\"link\").is_err());
        assert!(fs::hard_link({secret:?}, \"hard\").is_err());",
        other.path()
    ))
    .is_harmless();
}

#[test]
fn only_the_scratch_folder_can_be_written() {
    let program = Program::new(
        "fs::write(\"mine\", \"x\").unwrap(); assert_eq!(fs::read(\"mine\").unwrap(), b\"x\");
        for path in [\"/x\", \"/tmp/x\", \"/usr/x\", \"/usr/lib/x\", \"/dev/shm/x\", \"../x\", \"../y\"] {
            assert!(fs::write(path, \"x\").is_err(), \"{path}\"); assert!(fs::remove_file(path).is_err(), \"{path}\");
        }",
    );
    program.is_harmless();
    assert!(program.folder.path().join("scratch/mine").exists());
    assert!(!program.folder.path().join("y").exists());
}

#[test]
fn there_is_no_network() {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = listener.local_addr().expect("an address");
    Program::new(&format!(
        "assert!(std::net::TcpStream::connect(\"{address}\").is_err()); assert!(std::net::TcpListener::bind(\"127.0.0.1:0\").is_err());
        assert!(std::net::UdpSocket::bind(\"127.0.0.1:0\").is_err());
        assert!(std::os::unix::net::UnixListener::bind(\"socket\").is_err());"
    ))
    .is_harmless();
}

#[test]
fn no_other_process_starts_or_is_killed() {
    Program::new(
        "for program in [\"/bin/sh\", \"/bin/kill\", \"/usr/bin/env\"] { for _ in 0..200 {
            assert!(Command::new(program).arg(\"-9\").arg(\"1\").spawn().is_err());
        } }
        assert!(Command::new(env::current_exe().unwrap_or(\"../x\".into())).spawn().is_err());",
    )
    .is_harmless();
}

#[test]
fn threads_are_allowed() {
    Program::new("assert_eq!(thread::spawn(|| 7).join().unwrap(), 7);").is_harmless();
}

#[test]
fn the_environment_of_the_grader_is_not_seen() {
    Program::new("assert_eq!(env::vars_os().count(), 0);").is_harmless();
}

#[test]
fn no_descriptor_is_inherited() {
    // The next descriptors that a program opens are 3 and 4.
    Program::new(
        "use std::os::fd::AsRawFd; let a = fs::File::open(\"/dev/null\").unwrap(); assert_eq!(a.as_raw_fd(), 3);",
    )
    .is_harmless();
}

#[test]
fn memory_is_limited() {
    let mut program = Program::new("let mut all = Vec::new(); loop { all.push(vec![1u8; 1 << 24]); }");
    program.confined.limits.memory = 256 << 20;
    let ended = program.run();
    assert!(ended.signal.is_some() && !ended.timed_out, "{ended:?}");
}

#[test]
fn the_memory_of_a_tree_of_processes_is_limited() {
    let mut program = Program::new("");
    program.confined.program = "/bin/sh".into();
    program.confined.readable = system_folders();
    program.confined.profile = Profile::Compiler;
    program.confined.environment = vec![("PATH".into(), "/usr/bin:/bin".into())];
    program.confined.limits.memory = 512 << 20;
    program.confined.limits.processes = 64;
    program.confined.limits.wall = Duration::from_secs(60);
    // Six processes, each within its own limit.
    let script = "for i in 1 2 3 4 5 6; do head -c 120000000 /dev/zero | tail -c 110000000 | sleep 20 & done; wait";
    program.confined.arguments = vec!["-c".into(), script.into()];
    let ended = program.run();
    assert!(ended.signal == Some(9) && ended.out_of_memory && !ended.timed_out, "{ended:?}");
    program.confined.arguments[1] = script.replace("1 2 3 4 5 6", "1").replace("20", "1");
    assert_eq!(program.run().code, Some(0), "one of them is not too much");
}

#[test]
fn the_processor_time_of_threads_that_compute_behind_an_answer_is_told() {
    let program =
        Program::new("for _ in 0..4 { thread::spawn(|| loop { std::hint::spin_loop() }); } loop { thread::park() }");
    let mut running = SANDBOX.start(&program.confined).expect("it starts");
    assert_eq!(running.ended(Duration::from_millis(1500)), None);
    assert!(running.kill() > Duration::from_millis(100));
}

#[test]
fn no_core_is_written() {
    use nix::sys::resource::{Resource, getrlimit, setrlimit};
    let (_, most) = getrlimit(Resource::RLIMIT_CORE).expect("a limit");
    setrlimit(Resource::RLIMIT_CORE, most, most).expect("a limit");
    let program = Program::new("std::process::abort()");
    assert!(program.run().signal.is_some());
    let left: Vec<_> = fs::read_dir(program.folder.path().join("scratch")).expect("a folder").flatten().collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn files_are_limited_in_size() {
    let program = Program::new(
        "let mut f = fs::File::create(\"big\").unwrap(); let chunk = vec![0; 1 << 20];
        for _ in 0..10_000 { if f.write_all(&chunk).is_err() { break; } }",
    );
    program.run();
    assert!(fs::metadata(program.folder.path().join("scratch/big")).expect("a file").len() <= 64 << 20);
}

#[test]
fn a_loop_without_end_and_a_sleep_are_ended() {
    for main in ["loop { std::hint::spin_loop() }", "thread::sleep(Duration::from_secs(1000))"] {
        let mut program = Program::new(main);
        program.confined.limits.wall = Duration::from_millis(500);
        assert!(program.run().timed_out);
    }
}

#[test]
fn processor_time_is_limited() {
    let mut program = Program::new("loop { std::hint::spin_loop() }");
    program.confined.limits.cpu = Duration::from_secs(1);
    // Enough on a busy machine. There, time is counted coarsely.
    program.confined.limits.wall = Duration::from_secs(60);
    let ended = program.run();
    assert!(ended.signal.is_some() && !ended.timed_out && ended.seconds > 0.5, "{ended:?}");
}

#[test]
fn a_flood_of_output_is_cut() {
    let ended = Program::new("for _ in 0..200_000 { println!(\"{}\", \"x\".repeat(100)); eprintln!(\"y\"); }").run();
    assert_eq!((ended.code, ended.stdout.len() + ended.stderr.len()), (Some(0), 10_000));
}

#[test]
fn a_daemon_of_a_compiler_dies_with_it() {
    let mut program = Program::new("");
    program.confined.program = "/bin/sh".into();
    program.confined.readable = system_folders();
    program.confined.profile = Profile::Compiler;
    program.confined.environment = vec![("PATH".into(), "/usr/bin:/bin".into())];
    let script = "(setsid sh -c 'while :; do echo x >> beat; sleep 0.02; done' > /dev/null 2>&1 &) ; sleep 0.2";
    program.confined.arguments = vec!["-c".into(), script.into()];
    assert_eq!(program.run().code, Some(0));
    let size = || fs::metadata(program.folder.path().join("scratch/beat")).expect("the daemon lived").len();
    let before = size();
    std::thread::sleep(Duration::from_millis(100));
    assert_eq!(before, size(), "and lives no more");
}

#[test]
fn a_program_answers_through_its_socket_and_dies_when_dropped() {
    let program = Program::new(
        "use std::os::fd::AsFd; let mut s = std::os::unix::net::UnixStream::from(stdin().as_fd().try_clone_to_owned().unwrap());
        let mut b = [0]; s.read_exact(&mut b).unwrap(); s.write_all(&[b[0] + 1]).unwrap();
        loop { fs::write(\"beat\", format!(\"{:?}\", std::time::Instant::now())); }",
    );
    let mut running = SANDBOX.start(&program.confined).expect("it starts");
    running.socket.write_all(&[41]).expect("it listens");
    let mut answer = [0];
    running.socket.read_exact(&mut answer).expect("it answers");
    assert_eq!(answer, [42]);
    assert_eq!(running.ended(Duration::from_millis(10)), None);
    drop(running);
    let beat = || fs::read(program.folder.path().join("scratch/beat")).unwrap_or_default();
    let before = beat();
    std::thread::sleep(Duration::from_millis(50));
    assert_eq!(before, beat());
}

#[test]
fn the_end_of_a_program_is_told_in_words() {
    for (main, words) in [
        ("std::process::exit(7)", "exit code 7"),
        (
            "fn f(x: u64) -> u64 { let a = [x; 100]; if x == 0 { 0 } else { f(x + 1) + std::hint::black_box(a)[3] } } f(1);",
            "signal",
        ),
        ("std::process::abort()", "signal"),
    ] {
        let program = Program::new(main);
        let mut running = SANDBOX.start(&program.confined).expect("it starts");
        let how = running.ended(Duration::from_secs(3)).expect("it ends");
        assert!(how.starts_with(words), "{how}");
        println!("{how}");
    }
}

#[test]
fn what_cannot_be_started_is_an_error_of_the_grader() {
    let mut program = Program::new("");
    program.confined.program = program.folder.path().join("scratch/nothing");
    assert!(SANDBOX.run(&program.confined).is_err());
    assert!(Sandbox::none().run(&program.confined).is_err());
}

#[test]
fn without_a_sandbox_programs_run_as_well_and_end_in_time() {
    let mut program = Program::new("println!(\"hello\"); thread::sleep(Duration::from_secs(100))");
    program.confined.limits.wall = Duration::from_millis(300);
    let ended = Sandbox::none().run(&program.confined).expect("it runs");
    assert!(ended.timed_out);
    assert_eq!(ended.stdout, b"hello\n");
}
