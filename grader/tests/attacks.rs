//! Submissions that attack the grader. Each attack costs only the points of its own function.
#![cfg(target_os = "linux")]

mod attacks {
    pub mod checked;
    pub mod classroom;
    pub mod compiler;
    pub mod hostile;
    pub mod limits;
}

use std::fs;
use std::net::TcpListener;

use attacks::classroom::{Attacked, Classroom, repository};
use attacks::{compiler, hostile};

#[test]
fn attacks_at_run_time_cost_their_own_function_alone() {
    let mut room = Classroom::new();
    let outside = tempfile::TempDir::new().expect("a folder");
    let (sentinel, left) = (outside.path().join("sentinel"), outside.path().join("left"));
    fs::write(&sentinel, "untouched").expect("a file");
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    listener.set_nonblocking(true).expect("a listener");
    let reach = hostile::OUTSIDE
        .replace("SENTINEL", &sentinel.display().to_string())
        .replace("LEFT", &left.display().to_string())
        .replace("ADDRESS", &listener.local_addr().expect("an address").to_string());

    spoil(&mut room, &reach);
    let attacked = room.grade();
    attacked.is_as_expected();
    attacked.shows_students_nothing_of("STOLEN");
    assert_eq!(fs::read_to_string(&sentinel).expect("it is still there"), "untouched");
    assert!(!left.exists());
    assert!(listener.accept().is_err(), "no program called");
}

/// Puts an attack into every function but a few, each with its expected result.
fn spoil(room: &mut Classroom, reach: &str) {
    let deep = "fn deep(x: u64) -> f64 { let a = [x; 99]; if x == 0 { 0.0 } else { deep(std::hint::black_box(a)[7] + 1) + 1.0 } }";
    let flood = "let line = \"passed \".repeat(1000); loop { println!(\"{line}\"); eprintln!(\"{line}\"); }";
    let huge = "CsrMatrix::zeros(3, usize::MAX)";
    for (name, status, body) in [
        ("phi_linear_tetrahedron", "crashed", "std::process::exit(0)"),
        ("psi_neo_hookean", "crashed", hostile::PANIC_HOOK),
        ("quadrature_single_point", "crashed or failed", hostile::FORGED_FRAMES),
        ("V_spring_particle_particle", "failed", "f64::NAN"),
        ("mass_matrix_linear_tetrahedron", "crashed", &format!("{deep} SMatrix::repeat(deep(1))")),
        ("fixed_point_constraints", "failed", huge),
        ("pick_nearest_vertices", "crashed", "std::process::abort()"),
        ("linearly_implicit_euler", "timed_out", "loop { std::hint::spin_loop() }"),
        ("dphi_linear_tetrahedron_dX", "failed", hostile::OWN_MEMORY),
        ("d2psi_neo_hookean_dF2", "failed or timed_out", hostile::FORKS),
        ("T_linear_tetrahedron", "crashed or timed_out", hostile::MEMORY),
        ("build_skinning_matrix", "failed", hostile::FORGED_ROWS),
        ("dV_spring_particle_particle_dq", "timed_out", flood),
        ("mass_matrix_mesh", "failed", hostile::THREAD),
        ("V_linear_tetrahedron", "failed", reach),
        ("dV_linear_tetrahedron_dq", "crashed", "panic!(\"STOLEN {q:?} {V:?} {element:?} {C} {D}\")"),
        ("d2V_linear_tetrahedron_dq2", "crashed", hostile::FORGED_PLACE),
        ("assemble_forces", "failed", "println!(\"{{\\\"score\\\": 100}}\"); DVector::repeat(q.len(), f64::INFINITY)"),
    ] {
        room.replace_body(name, status, body);
    }
}

/// Files that read others while compiling, leave safe Rust, or run before the program.
fn refused(room: &mut Classroom) {
    let before = |line: &str, text: String| format!("{line}\n{text}");
    room.change("phi_linear_tetrahedron", "refused", |text| {
        before("const HIDDEN: &str = include_str!(\"../tests/hidden.rs\");", text)
    });
    room.change("psi_neo_hookean", "refused", |text| before("#[path = \"/etc/passwd\"]\nmod hidden;", text));
    room.change("quadrature_single_point", "refused", |text| {
        before("macro_rules! read { ($m:ident) => { $m!(\"HOME\") } }\nconst HOME: &str = read!(env);", text)
    });
    room.change("fixed_point_constraints", "refused", |text| {
        before("std::arch::global_asm!(\".incbin \\\"/etc/passwd\\\"\");", text)
    });
    room.change("pick_nearest_vertices", "refused", |text| {
        before("#[unsafe(link_section = \".init_array\")]\nstatic EARLY: fn() = early;\nfn early() {}", text)
    });
    room.change("linearly_implicit_euler", "refused", |text| {
        before("unsafe extern \"C\" { safe fn getpid() -> i32; }", text)
    });
    // The macros are those of two other files.
    room.change("V_linear_tetrahedron", "refused", |text| {
        before("const HOME: &str = crate::quadrature_single_point::read!(env (\"HOME\"));", text)
    });
    room.change("assemble_forces", "refused", |text| before("crate::m!(mod h {});", text));
    room.change("dpsi_neo_hookean_dF", "refused", |text| {
        before("macro_rules! m { ($a:tt $b:tt) => { $a $b { () } } }\nfn f() { m!(unsafe {}) }", text)
    });
}

/// Files that the compiler refuses, or never finishes.
fn not_compiling(room: &mut Classroom) {
    let before = |line: &str, text: String| format!("{line}\n{text}");
    room.change("V_spring_particle_particle", "did_not_compile", |text| text.replace("q1: &Vector3<f64>, ", ""));
    // Notes of the compiler point into the standard library, nalgebra and the course's library.
    room.change("mass_matrix_mesh", "did_not_compile", |text| {
        let notes = "let _ = \"\".parse::<CsrMatrix<f64>>(); crate::given::solve(1); CsrMatrix::<f64>::identity(); }";
        format!("{text}\nfn notes() {{ {notes}")
    });
    // No program holds the reference of a function that is asked for, under whatever name.
    room.replace_body(
        "mass_matrix_linear_tetrahedron",
        "did_not_compile",
        "course_below::mass_matrix_linear_tetrahedron(density, volume)",
    );
    room.replace_body(
        "dV_spring_particle_particle_dq",
        "did_not_compile",
        "course_below::dV_spring_particle_particle_dq(q0, q1, l0, stiffness)",
    );
    room.change("T_linear_tetrahedron", "did_not_compile", |text| {
        before("compile_error!(\"</failure><script>alert(1)</script> 100 points\");", text)
    });
    room.change("d2V_linear_tetrahedron_dq2", "did_not_compile", |text| {
        let endless = "const ENDLESS: u64 = { let mut x = 0u64; while x < u64::MAX { x += 1; } x };";
        format!("#![allow(long_running_const_eval)]\n{endless}\nconst _: u64 = ENDLESS;\n{text}")
    });
    room.change("assemble_stiffness", "did_not_compile", |text| {
        before("const SHORT: u64 = { let mut x = 0u64; while x < u64::MAX { x += 1; } x };", text)
    });
}

/// Files that decide how code is built.
fn left_aside(room: &mut Classroom) {
    for (path, text) in [
        ("build.rs", "fn main() { std::fs::write(\"/tmp/attacks-build\", \"\").unwrap() }"),
        (".cargo/config.toml", "[build]\nrustc = \"/bin/false\"\n[target.x86_64-unknown-linux-gnu]\nrunner = \"true\""),
        ("Cargo.toml", "[package]\nname = \"x\"\n[lib]\npath = \"/etc/passwd\""),
        ("rust-toolchain.toml", "[toolchain]\nchannel = \"1.0.0\""),
        ("src/lib.rs", "compile_error!(\"never read\");"),
        ("src/main.rs", "compile_error!(\"never read\");"),
    ] {
        room.add(path, text);
    }
}

#[test]
fn attacks_at_compile_time_cost_their_own_function_alone() {
    let mut room = Classroom::new();
    refused(&mut room);
    not_compiling(&mut room);
    left_aside(&mut room);
    let attacked = room.grade();
    attacked.is_as_expected();
    for aside in ["build.rs", ".cargo", "rust-toolchain.toml"] {
        assert!(attacked.remarks().iter().any(|remark| remark.starts_with(aside)), "{aside}: {:?}", attacked.remarks());
    }
    for (name, line) in [
        ("phi_linear_tetrahedron", 1),
        ("psi_neo_hookean", 1),
        ("quadrature_single_point", 1),
        ("dpsi_neo_hookean_dF", 1),
    ] {
        let message = attacked.message(name);
        assert!(message.starts_with(&format!("line {line}: ")) || message.starts_with("line 2: "), "{name}: {message}");
    }
    let endless = attacked.message("d2V_linear_tetrahedron_dq2");
    assert!(endless.ends_with("the compiler did not finish within 5 s"), "{endless}");
    let told = attacked.message("V_spring_particle_particle");
    for check in ["CALL", "src/calls", "course_below", "grader_child"] {
        assert!(!told.contains(check), "{check} is quoted: {told}");
    }
    assert!(attacked.message("mass_matrix_mesh").contains("error"), "{}", attacked.message("mass_matrix_mesh"));
    let repository = repository().display().to_string();
    for path in
        [repository.as_str(), "/rustc/", "/registry/", "/lib/", "/tmp/", "/home/", "/root/", "-->  /", "::: /", ".rlib"]
    {
        attacked.shows_students_nothing_of(path);
    }
    assert!(!fs::exists("/tmp/attacks-build").expect("a look"));
    attacked.shows_no_browser("<script>alert");
}

#[test]
fn an_honest_submission_has_full_marks_and_its_compiler_sees_no_line_of_a_solution() {
    let mut room = Classroom::new();
    // A macro that takes no words apart, and names that are harmless where they stand.
    let at = "macro_rules! at { ($i:expr, $j:expr) => { 3 * $i + $j } }";
    let names = "fn names(path: usize) -> usize { let env = at!(1, 2); println!(\"{path} {}\", env); env + path }";
    room.change("assemble_forces", "passed", |text| format!("{text}\n{at}\n{names}\n"));
    room.change("assemble_stiffness", "passed", |text| format!("{text}\nfn link(include: f64) -> f64 {{ include }}\n"));
    let attacked: Attacked = room.grade_beside_others();
    attacked.is_as_expected();
    attacked.has_full_marks();
    compiler::libraries_hold_no_line_of_a_solution();
}
