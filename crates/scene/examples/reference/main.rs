//! Writes the reference of scene files, `docs/book/scene-reference.md`, from the documentation of the structs that they are read into:
//! `cargo run -p fem-scene --example reference`.

mod generator;

fn main() -> std::io::Result<()> {
    std::fs::write(generator::file(), generator::page())
}
