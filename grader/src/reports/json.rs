//! `grade.json`: all results of a submission, for the instructor and for later commands.

use std::fs;
use std::io;
use std::path::Path;

use crate::grade::{FORMAT_VERSION, Grade, MOST_BYTES};

/// The text of `grade.json`. Errors and times that are no finite numbers become null; scores must be numbers.
pub fn render(grade: &Grade) -> io::Result<String> {
    let figures = super::view::parts(grade).flat_map(|part| [part.score, part.max_score]);
    if let Some(figure) = figures.chain([grade.score, grade.max_score]).find(|figure| !figure.is_finite()) {
        return Err(io::Error::new(io::ErrorKind::InvalidData, format!("a score is {figure}, which is no grade")));
    }
    let mut text = serde_json::to_string_pretty(grade)?;
    text.push('\n');
    Ok(text)
}

/// Reads a `grade.json` back.
pub fn read(path: &Path) -> io::Result<Grade> {
    let explain = |kind, reason: String| io::Error::new(kind, format!("cannot read {}: {reason}", path.display()));
    let length = fs::metadata(path).map_err(|error| explain(error.kind(), error.to_string()))?.len();
    if length > MOST_BYTES {
        return Err(explain(
            io::ErrorKind::InvalidData,
            format!("it is larger than {MOST_BYTES} bytes, which no grade is"),
        ));
    }
    let text = fs::read_to_string(path).map_err(|error| explain(error.kind(), error.to_string()))?;
    let grade: Grade =
        serde_json::from_str(&text).map_err(|error| explain(io::ErrorKind::InvalidData, error.to_string()))?;
    if grade.format_version != FORMAT_VERSION {
        let reason = format!("its format is version {}, this program's is {FORMAT_VERSION}", grade.format_version);
        return Err(explain(io::ErrorKind::InvalidData, reason));
    }
    Ok(grade)
}
