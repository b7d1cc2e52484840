//! Remarks on a file that was read: what was left out of it, and what was changed.

/// Names of parts that were not read, beyond which only their number is told.
const MOST_NAMES: usize = 12;

/// Remarks, each in one line, told once.
#[derive(Debug, Default)]
pub(super) struct Notes {
    lines: Vec<String>,
    unread: Vec<String>,
    has_more: bool,
}

impl Notes {
    /// Adds a line.
    pub(super) fn tell(&mut self, line: String) {
        self.lines.push(line);
    }

    /// Names a part of the file that is not read, such as `the section $Periodic`.
    pub(super) fn unread(&mut self, part: impl Into<String>) {
        let part = part.into();
        if self.unread.len() == MOST_NAMES {
            self.has_more |= !self.unread.contains(&part);
        } else if !self.unread.contains(&part) {
            let part = part.chars().take(60).map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
            self.unread.push(part);
        }
    }

    /// The lines, in the order in which they came; the parts that were not read are the last.
    pub(super) fn into_lines(mut self) -> Vec<String> {
        if !self.unread.is_empty() {
            let more = if self.has_more { " and more" } else { "" };
            self.lines.push(format!("not read: {}{more}", self.unread.join(", ")));
        }
        self.lines
    }
}
