use super::{Found, Macros};

/// Scans a file that is alone.
fn scan(text: &str) -> Option<Found> {
    super::scan(text, &Macros::of([text]))
}

fn refused_at(text: &str) -> Option<usize> {
    scan(text).map(|found| found.line)
}

#[test]
fn what_leaves_safe_rust_or_reads_files_is_refused_with_its_line() {
    let hostile = [
        "\nfn f() { unsafe { } }",
        "\nunsafe fn f() {}",
        "\nunsafe impl Send for X {}",
        "\nuse core::arch::asm as x;",
        "\nuse std::{arch::{asm as x}};",
        "\nstd::arch::global_asm!(\".incbin \\\"/etc/passwd\\\"\");",
        "\nfn f() { core::arch::asm!(\"nop\"); }",
        "\nextern \"C\" { fn abs(x: i32) -> i32; }",
        "\npub extern \"C\" fn f() {}",
        "\nextern crate libc;",
        "\n#[no_mangle] pub fn f() {}",
        "\n#[unsafe(no_mangle)] pub fn f() {}",
        "\n#[cfg_attr(all(), no_mangle)] pub fn f() {}",
        "\n#[r#no_mangle] pub fn f() {}",
        "\n#[export_name = \"malloc\"] pub fn f() {}",
        "\n#[link_section = \".init_array\"] static X: fn() = f;",
        "\n#[used] static X: fn() = f;",
        "\n#[link(name = \"c\")] fn f() {}",
        "\n#[global_allocator] static A: A = A;",
        "\n#[panic_handler] fn f() {}",
        "\n#[path = \"../tests/hidden.rs\"] mod h {}",
        "\n#[cfg_attr(all(), path = \"x.rs\")] mod h {}",
        "\nmod hidden;",
        "\nfn f() { mod hidden; }",
        "\nmacro_rules! m { ($x:ident) => { mod $x; } }",
        "\nfn f() { include!(\"x\") }",
        "\nconst X: &str = include_str!(\"x\");",
        "\nuse std::include_str as x;",
        "\nuse std::include as x;",
        "\nuse std::{env as x, fmt};",
        "\nconst X: &[u8] = core::include_bytes!(\"x\");",
        "\nconst X: &str = env!(\"HOME\");",
        "\nconst X: Option<&str> = option_env!(\"HOME\");",
        "\nmacro_rules! m { () => { env!(\"HOME\") } }",
        "\nmacro_rules! m { () => { unsafe { } } }",
        "\n#![feature(concat_idents)]",
        "\nfn f() { concat_idents!(a, b); }",
        "\n#[doc = include_str!(\"x\")] fn f() {}",
        "\n#[proc_macro] pub fn f() {}",
        "\nfn f() { r#unsafe { } }",
    ];
    for text in hostile {
        assert_eq!(refused_at(text), Some(2), "{text}");
    }
}

#[test]
fn words_that_a_macro_of_ones_own_puts_together_are_refused() {
    for text in [
        "macro_rules! call { ($m:ident) => { $m!(\"HOME\") } }\nconst X: &str = call!(env);",
        "macro_rules! call { ($a:tt $b:tt $c:tt) => { $a $b $c } }\nconst X: &str = call!(include ! (\"x\"));",
        "macro_rules! on { ($a:meta) => { #[$a] mod h {} } }\non!(path = \"x.rs\");",
        "macro_rules! on { ($a:tt) => { #[$a] fn f() {} } }\non!(no_mangle);",
    ] {
        assert_eq!(refused_at(text), Some(2), "{text}");
    }
    let unfinished = "macro_rules! m { ($x:ident $b:tt) => { mod $x $b } }";
    assert_eq!(refused_at(unfinished), Some(1), "{unfinished}");
}

#[test]
fn a_macro_of_another_file_gets_no_word_that_it_could_make_dangerous() {
    let other = "macro_rules! call { ($m:ident $a:tt) => { $m!$a } }\nmacro_rules! vec { ($($t:tt)*) => { $($t)* } }\n\
        use call as println;";
    for text in [
        "\nconst X: &str = crate::call!(env (\"HOME\"));",
        "\ncrate::psi_neo_hookean::call!(mod h {});",
        "\ncrate::m!(mod h {});",
        "\ncrate::call! { path = \"x\" }",
        "\nfn f() { vec![env]; }",
        "\nfn f() { println!(include) }",
        "\nfn f() { grader_child::course_functions!(env => \"HOME\") }",
        "\nfn f() { assert!(crate::call!(env (\"HOME\")) == \"\") }",
    ] {
        let found = super::scan(text, &Macros::of([other, text]));
        assert_eq!(found.map(|found| found.line), Some(2), "{text}");
    }
    // A name that a macro makes, or a file that cannot be read, can be that of any macro.
    for other in ["macro_rules! name { ($n:ident) => { macro_rules! $n { () => {} } } }", "fn f( {"] {
        let text = "fn f() { println!(\"{}\", env); }";
        assert!(super::scan(text, &Macros::of([other, text])).is_some(), "{other}");
    }
}

#[test]
fn harmless_macros_are_not_refused() {
    let at = "macro_rules! at { ($i:expr, $j:expr) => { 3 * $i + $j } }";
    for text in [
        format!("{at}\nfn f(path: usize) -> usize {{ let env = at!(1, path2); env + path }}").replace("path2", "2"),
        format!(
            "{at}\nfn f() {{ if !(link && used) {{}} println!(\"{{path}} {{env}}\"); assert!(path > 0, \"{{}}\", env); }}"
        ),
        format!("{at}\nmod parts {{ pub fn f() {{}} }}"),
        "fn f() { let v = vec![path.x, env.y]; let m = nalgebra::matrix![include, 1.0; link, 2.0]; }".to_owned(),
    ] {
        assert_eq!(scan(&text), None, "{text}");
    }
}

#[test]
fn honest_code_is_not_refused() {
    for text in [
        "// unsafe, extern and include!(\"x\") are words of a comment\nfn f() {}",
        "/// asm!, env!, #[path = \"x\"]\nfn f() { /* unsafe { } */ }",
        "fn f() { let environment = 1; let env = 2; let path = env + environment; if env != path {} }",
        "fn f(link: usize, used: usize, feature: usize, include: usize) -> usize { link + used + feature + include }",
        "fn f() { assert!(true, \"unsafe #[no_mangle] extern \\\" include_str!\"); }",
        "fn f() -> &'static str { r#\"unsafe { asm!() }\"# }",
        "#![allow(unsafe_code)] fn f() {}",
        "#[forbid(unsafe_code)] fn f() {}",
        "#[allow(clippy::too_many_arguments)] fn f() {}",
        "use std::path::Path; fn f(_: &Path) {}",
        "use std::ops::Mul;\nfn f() { let include = 3; let env = include; println!(\"{env}\"); }",
        "mod parts { pub fn f() {} }\n#[cfg(test)]\nmod tests { #[test] fn t() {} }",
        "macro_rules! square { ($x:expr) => { $x * $x } } fn f() -> f64 { square!(2.0) }",
        "#[derive(Clone)] struct S; #[inline] fn f<'a>(x: &'a S) -> S { x.clone() }",
        "fn größe(J: f64) -> f64 { let Δ = J; Δ }",
    ] {
        assert_eq!(scan(text), None, "{text}");
    }
}

#[test]
fn the_first_line_for_a_shell_cannot_hide_what_follows() {
    assert_eq!(refused_at("#!/*\nunsafe fn f() {}\n// */"), Some(1));
    assert_eq!(refused_at("#! \"\nfn f() {}"), Some(1));
    assert_eq!(scan("#![allow(dead_code)]\nfn f() {}"), None);
}

#[test]
fn what_does_not_tokenise_is_left_for_the_compiler_unless_it_holds_a_refused_word() {
    assert_eq!(scan("fn f( {"), None);
    assert_eq!(scan("fn f() { \"no end"), None);
    assert_eq!(scan("let path = (;"), None);
    assert_eq!(refused_at("fn f( {\n unsafe"), Some(2));
}

#[test]
fn brackets_without_end_are_refused_and_overflow_no_stack() {
    for open in ["(", "[", "{", "!(", "&["] {
        let text = format!("fn f() {{\n{}", open.repeat(300_000));
        assert_eq!(refused_at(&text), Some(2));
    }
    let closed = format!("fn f() {{ {}{} }}", "(".repeat(250), ")".repeat(250));
    assert_eq!(scan(&closed), None);
    let long = format!("fn f() -> bool {{ {} true }}", "!".repeat(900_000));
    assert_eq!(scan(&long), None);
    assert!(!crate::submission::is_stub("f", &long));
}
