//! The reference of scene files: the sources of the tables in, a page of Markdown out.

mod page;
mod source;
mod value;

use std::path::{Path, PathBuf};

pub use page::page;

/// The command that writes the page.
pub const COMMAND: &str = "cargo run -p fem-scene --example reference";

/// The page's file.
pub fn file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/book/scene-reference.md")
}
