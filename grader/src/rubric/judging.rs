//! The part of a rubric that decides the results of checks. The rest converts results into points, without a new grading.

use toml::Spanned;

use super::{Counts, Function, NoSubmission, OwnCheck, Rubric};

impl Rubric {
    /// A text that stays the same as long as no submission needs to be graded again.
    pub fn judging(&self) -> String {
        let function = |function: &Function| Function {
            name: Spanned::new(0..0, function.name.get_ref().clone()),
            points: Spanned::new(0..0, 0.0),
            level: Spanned::new(0..0, *function.level.get_ref()),
            hint: None,
            ..function.clone()
        };
        let later = |name: &Spanned<String>| Spanned::new(0..0, name.get_ref().clone());
        let check = |check: &OwnCheck| OwnCheck {
            function: Spanned::new(0..0, check.function.get_ref().clone()),
            // The path of the file does not matter; its content is part of the grader.
            file: Default::default(),
            points: None,
            ..check.clone()
        };
        let mut rubric = Self {
            title: String::new(),
            partial_credit: true,
            edge_cases: 0.0,
            counts: Counts::default(),
            no_submission: NoSubmission::default(),
            deadline: None,
            extensions: Vec::new(),
            functions: self.functions.iter().map(function).collect(),
            checks: self.checks.iter().map(check).collect(),
            later: self.later.iter().map(later).collect(),
            ..self.clone()
        };
        rubric.simulation.points = 0.0;
        (rubric.students.diagnosis, rubric.students.hints, rubric.students.release) = (true, true, None);
        format!("{rubric:?}")
    }
}
