//! `list`: the scenes.

use crate::course::Course;
use crate::end::End;
use crate::explain;

/// Prints a line for each scene: its name, its line `about`, and the parts that it builds.
pub fn print_scenes(course: &Course) -> Result<(), End> {
    let data = course.data();
    let names = fem_scene::names(&data);
    if names.is_empty() {
        return Err(End::unusable(format!("there are no scenes in {}; run from the repository", data.display())));
    }
    let width = names.iter().map(String::len).max().unwrap_or_default();
    for name in names {
        let scene = fem_scene::load(&name, &data).map_err(End::unusable)?;
        // One scene that cannot be built does not hide the others.
        match explain::parts(course, &scene) {
            Ok(parts) => say!("{name:<width$} {} [{}]", scene.about, explain::built(&parts)),
            Err(end) => say!("{name:<width$} {} [cannot be built: {}]", scene.about, end.message()),
        }
    }
    Ok(())
}
