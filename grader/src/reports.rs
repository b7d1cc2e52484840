//! Every report of a graded submission and of a class, each format in its own file.
//!
//! `grade.json` and all tables and pages of a class are the instructor's. All other files may be read by students: they hold
//! names, statuses, messages and hints, never an input, an expected value or a path.

mod class_html;
pub mod classroom50;
mod csv;
mod escape;
mod gradebooks;
mod gradescope;
mod html;
pub mod json;
mod junit;
mod markdown;
mod page;
pub mod regrade;
mod rows;
pub mod similar;
mod study;
pub mod terminal;
mod view;

#[cfg(test)]
mod sample;
#[cfg(test)]
mod tests;

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use crate::class::Summary;
use crate::grade::Grade;

/// Contents of the reports of one submission.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Students read the name of the mistake and the sentence that explains it.
    pub show_diagnosis: bool,
    /// Origin of the submission in a classroom of Classroom 50; `result.json` is written with it alone.
    pub origin: Option<classroom50::Origin>,
}

/// Writes `grade.json`, `results.json`, `junit.xml`, `report.md` and `report.html` into `folder`, and with an origin
/// `result.json`. `grade.json` is written last: if it exists, all files do.
pub fn write_all(grade: &Grade, folder: &Path, options: &Options) -> io::Result<()> {
    let record = json::render(grade)?;
    fs::create_dir_all(folder)?;
    write_file(folder, "results.json", &gradescope::render(grade, options.show_diagnosis)?)?;
    if let Some(origin) = &options.origin {
        write_file(folder, "result.json", &classroom50::render(grade, origin, options.show_diagnosis)?)?;
    }
    write_file(folder, "junit.xml", &junit::render(grade, options.show_diagnosis)?)?;
    write_file(folder, "report.md", &markdown::render(grade, options.show_diagnosis))?;
    write_file(folder, "report.html", &html::render(grade, options.show_diagnosis))?;
    write_file(folder, "grade.json", &record)
}

/// Writes all reports of a student into a folder, which is made where needed.
pub fn write_final(grade: &Grade, folder: &Path, show_diagnosis: bool) -> io::Result<()> {
    write_all(grade, folder, &Options { show_diagnosis, origin: None })
}

/// Writes `grades.csv`, `errors.csv`, `class.html` and the gradebooks into `folder`, as far as the class is graded; after a change of
/// points `regrade.csv` and `regrade.html` too.
pub fn write_class(summary: &Summary, folder: &Path) -> io::Result<()> {
    let rows = rows::rows(&summary.entries);
    fs::create_dir_all(folder)?;
    write_file(folder, "grades.csv", &csv::grades(&rows)?)?;
    write_file(folder, "errors.csv", &csv::errors(&rows)?)?;
    write_file(folder, "canvas.csv", &gradebooks::canvas(&rows, summary)?)?;
    write_file(folder, "moodle.csv", &gradebooks::moodle(&rows, summary)?)?;
    if !summary.changes.is_empty() {
        write_file(folder, "regrade.csv", &regrade::csv(&summary.changes)?)?;
        write_file(folder, "regrade.html", &regrade::html(&summary.changes))?;
    }
    write_file(folder, "class.html", &class_html::render(&rows, summary))
}

/// Replaces a file atomically, so that a reader sees either the whole new file or the old one.
fn write_file(folder: &Path, name: &str, text: &str) -> io::Result<()> {
    let explain = |error: io::Error| {
        io::Error::new(error.kind(), format!("cannot write {}: {error}", folder.join(name).display()))
    };
    let mut file = tempfile::Builder::new().prefix(name).tempfile_in(folder).map_err(explain)?;
    file.write_all(text.as_bytes()).map_err(explain)?;
    make_readable(file.as_file()).map_err(explain)?;
    file.persist(folder.join(name)).map_err(|error| explain(error.error))?;
    Ok(())
}

/// Temporary files are readable by their owner alone; reports are read by web servers and harnesses too.
#[cfg(unix)]
fn make_readable(file: &fs::File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn make_readable(_: &fs::File) -> io::Result<()> {
    Ok(())
}
