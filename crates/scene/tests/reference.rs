//! The reference of scene files is what the documentation of the structs says.

#[path = "../examples/reference/generator/mod.rs"]
mod generator;

use std::fs;

#[test]
fn the_reference_of_scene_files_is_up_to_date() {
    let (file, page) = (generator::file(), generator::page());
    let stored = fs::read_to_string(&file).unwrap_or_default();
    let number = stored.lines().zip(page.lines()).take_while(|(stored, page)| stored == page).count() + 1;
    assert!(
        stored == page,
        "{}, line {number}: not what the sources say; run `{}`",
        file.display(),
        generator::COMMAND
    );
}
