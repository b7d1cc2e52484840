//! The words that a scan looks for.

use super::Found;

/// Refused everywhere. No formula uses one of them as a name.
pub const ALWAYS: [&str; 23] = [
    "unsafe",
    "extern",
    "no_mangle",
    "export_name",
    "link_name",
    "link_section",
    "link_ordinal",
    "global_allocator",
    "alloc_error_handler",
    "panic_handler",
    "global_asm",
    "naked_asm",
    "llvm_asm",
    "include_str",
    "include_bytes",
    "option_env",
    "concat_idents",
    "proc_macro",
    "proc_macro_attribute",
    "proc_macro_derive",
    "rustc_builtin_macro",
    "no_core",
    "no_main",
];

/// Refused as macros: called, or imported under any name.
pub const AS_MACROS: [&str; 3] = ["asm", "env", "include"];

/// Refused in attributes.
pub const IN_ATTRIBUTES: [&str; 4] = ["feature", "link", "path", "used"];

/// The first refused word in a text that is not Rust. The compiler could read such a text differently from this tokeniser.
pub fn as_text(text: &str) -> Option<Found> {
    let has_attributes = text.contains('#');
    let is_refused = |word: &&str| {
        ALWAYS.contains(word) || AS_MACROS.contains(word) || has_attributes && IN_ATTRIBUTES.contains(word)
    };
    text.lines().enumerate().find_map(|(index, line)| {
        let word = line.split(|c: char| !c.is_alphanumeric() && c != '_').find(is_refused)?;
        Some(Found {
            line: index + 1,
            reason: format!("this is not valid Rust, and `{word}` is not allowed; correct the file"),
        })
    })
}
