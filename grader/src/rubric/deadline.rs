//! `[deadline]` and `[[extension]]` of a rubric: when a submission is late, and what that costs.

use jiff::{SignedDuration, Timestamp};
use serde::{Deserialize, Serialize};
use toml::Spanned;

/// A day in seconds.
const DAY: f64 = 86_400.0;

/// A moment, written as RFC 3339 asks for: `2026-05-04T23:59:00+02:00`, with or without quotation marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "toml::Value")]
pub struct Time(pub Timestamp);

impl TryFrom<toml::Value> for Time {
    type Error = String;

    fn try_from(value: toml::Value) -> Result<Self, String> {
        let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let problem =
            |error| format!("`{text}` is no time ({error}); write it as 2026-05-04T23:59:00+02:00, offset included");
        text.parse().map(Self).map_err(problem)
    }
}

/// The deadline of an assignment.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Deadline {
    pub at: Time,
    /// Minutes after the deadline within which a submission is not late.
    #[serde(default)]
    pub grace_minutes: f64,
    /// Days, begun ones included, that cost nothing.
    #[serde(default)]
    pub late_days: u32,
    /// Share of the points that each further day costs.
    #[serde(default)]
    pub penalty_per_day: f64,
    /// Largest share of the points that lateness costs.
    #[serde(default = "everything")]
    pub largest_penalty: f64,
    /// A submission that is late by more days counts 0.
    pub closes_after_days: Option<u32>,
}

fn everything() -> f64 {
    1.0
}

/// A later deadline of one student.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Extension {
    /// As `students.csv` or the name of the submission spells it.
    pub student: Spanned<String>,
    /// The deadline in place of the assignment's.
    pub until: Option<Time>,
    /// Days after the assignment's.
    pub days: Option<u32>,
    /// Note for the instructor's records.
    #[allow(dead_code)] // read by people
    pub reason: Option<String>,
}

/// Lateness of a submission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lateness {
    /// Time of submission, in UTC.
    pub submitted: String,
    /// The student's deadline, extension included, in UTC.
    pub deadline: String,
    /// Days after the deadline, begun ones included; 0 within the grace.
    pub days: u32,
    /// Share of the points that this costs.
    pub penalty: f64,
}

impl Deadline {
    pub(super) fn check(&self) -> Result<(), String> {
        for (what, share) in [("penalty_per_day", self.penalty_per_day), ("largest_penalty", self.largest_penalty)] {
            if !(0.0..=1.0).contains(&share) {
                return Err(format!("{what} = {share} of [deadline]; give a share from 0 to 1, such as 0.1 for 10 %"));
            }
        }
        if !(0.0..=10_080.0).contains(&self.grace_minutes) {
            let minutes = self.grace_minutes;
            return Err(format!("grace_minutes = {minutes} of [deadline]; give a number from 0 to 10080, a week"));
        }
        Ok(())
    }

    /// The lateness of a submission; students with several extensions among `extensions` have been refused.
    pub fn lateness(&self, extensions: &[Extension], students: &[&str], submitted: Timestamp) -> Lateness {
        let own = extensions.iter().find(|extension| students.contains(&extension.student.get_ref().as_str()));
        let until = own.map_or(self.at.0, |extension| extension.deadline(self.at.0));
        let seconds = submitted.duration_since(until).as_secs_f64();
        let days = if seconds <= 60.0 * self.grace_minutes { 0 } else { (seconds / DAY).ceil() as u32 };
        let is_closed = self.closes_after_days.is_some_and(|last| days > last);
        let paid = f64::from(days.saturating_sub(self.late_days));
        let penalty = if is_closed { 1.0 } else { (paid * self.penalty_per_day).min(self.largest_penalty) };
        Lateness { submitted: submitted.to_string(), deadline: until.to_string(), days, penalty }
    }
}

impl Extension {
    pub(super) fn check(&self, deadline: Option<&Deadline>, earlier: &[Self]) -> Result<(), String> {
        let student = self.student.get_ref();
        if deadline.is_none() {
            return Err(format!("an extension for `{student}` without a table [deadline]; add one"));
        }
        if self.until.is_some() == self.days.is_some() {
            return Err(format!("the extension for `{student}` needs `until` or `days`, one of them"));
        }
        if earlier.iter().any(|other| other.student.get_ref() == student) {
            return Err(format!("`{student}` has a second extension; remove one"));
        }
        Ok(())
    }

    fn deadline(&self, regular: Timestamp) -> Timestamp {
        let days = SignedDuration::from_hours(24 * i64::from(self.days.unwrap_or(0)));
        self.until.map_or_else(|| regular.saturating_add(days).unwrap_or(regular), |until| until.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn deadline(more: &str) -> Deadline {
        let text = format!("at = 2026-05-04T23:59:00+02:00\ngrace_minutes = 15\npenalty_per_day = 0.1\n{more}");
        toml::from_str(&text).unwrap()
    }

    fn late(deadline: &Deadline, extensions: &[Extension], time: &str) -> (u32, f64) {
        let found = deadline.lateness(extensions, &["anna", "anna@x.org"], time.parse().unwrap());
        (found.days, (found.penalty * 1e9).round() / 1e9)
    }

    #[test]
    fn begun_days_count_from_the_deadline_once_the_grace_is_over() {
        let plain = deadline("");
        for (time, expected) in [
            ("2026-05-04T21:59:00Z", (0, 0.0)),
            ("2026-05-05T00:14:00+02:00", (0, 0.0)),
            ("2026-05-05T00:14:01+02:00", (1, 0.1)),
            ("2026-05-05T21:59:00Z", (1, 0.1)),
            ("2026-05-05T21:59:01Z", (2, 0.2)),
            ("2027-05-05T21:59:01Z", (367, 1.0)),
        ] {
            assert_eq!(late(&plain, &[], time), expected, "{time}");
        }
    }

    #[test]
    fn late_days_cost_nothing_the_penalty_has_a_cap_and_in_the_end_nothing_counts() {
        let capped = deadline("late_days = 2\nlargest_penalty = 0.25\ncloses_after_days = 7");
        for (time, expected) in [
            ("2026-05-06T12:00:00Z", (2, 0.0)),
            ("2026-05-07T12:00:00Z", (3, 0.1)),
            ("2026-05-11T12:00:00Z", (7, 0.25)),
            ("2026-05-12T12:00:00Z", (8, 1.0)),
        ] {
            assert_eq!(late(&capped, &[], time), expected, "{time}");
        }
    }

    #[test]
    fn an_extension_moves_the_deadline_of_its_student_alone() {
        let read = |text: &str| -> Extension { toml::from_str(text).unwrap() };
        let plain = deadline("");
        let time = "2026-05-06T12:00:00Z";
        assert_eq!(late(&plain, &[read("student = \"anna\"\ndays = 2\nreason = \"ill\"")], time), (0, 0.0));
        assert_eq!(late(&plain, &[read("student = \"anna@x.org\"\nuntil = \"2026-05-05T12:00:00Z\"")], time), (1, 0.1));
        assert_eq!(late(&plain, &[read("student = \"bob\"\ndays = 2")], time), (2, 0.2));
    }
}
