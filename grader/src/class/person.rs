//! One student of the roster.

use serde::{Deserialize, Serialize};

/// A student of the roster. Identifiers in gradebooks are empty if `students.csv` does not give them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Person {
    pub student: String,
    pub name: String,
    pub id: String,
    pub login: String,
    pub email: String,
    pub section: String,
    /// Canvas' own number of the student.
    #[serde(default)]
    pub canvas: String,
}

impl Person {
    /// Fills in the identifiers of another row.
    pub fn complete(&mut self, other: Self) {
        let Self { name, id, login, email, section, canvas, student: _ } = other;
        let own = [&mut self.name, &mut self.id, &mut self.login, &mut self.email, &mut self.section, &mut self.canvas];
        for (own, told) in own.into_iter().zip([name, id, login, email, section, canvas]) {
            if own.is_empty() {
                *own = told;
            }
        }
    }
}
