//! Grades some functions of a submission again, and keeps the results of the others.

use std::collections::BTreeMap;
use std::rc::Rc;

use grader::submission::Submission;

use super::timer::CpuTimer;
use super::{Grading, GradingError, without_running};
use crate::grade::{FunctionGrade, Grade};

impl Grading {
    /// Returns the grade with these functions judged again. All functions are judged again if the submission or the assignment differs
    /// from that of the `earlier` grade.
    ///
    /// # Errors
    /// An error of the grader, never of the submission.
    pub fn grade_again(
        &self,
        submission: &Submission,
        earlier: &Grade,
        functions: &[String],
    ) -> Result<Grade, GradingError> {
        let asked = || self.rubric.functions.iter().map(|function| function.name.get_ref());
        let is_same = earlier.files == submission.hash()
            && earlier.seed == self.seed
            && asked().eq(earlier.functions.iter().map(|function| &function.name));
        if !is_same {
            return self.grade(submission);
        }
        let timer = CpuTimer::start();
        let submission = &self.as_assigned(submission);
        let kept = earlier.functions.iter().filter(|function| !functions.contains(&function.name));
        let mut graded: BTreeMap<String, FunctionGrade> =
            kept.map(|function| (function.name.clone(), function.clone())).collect();
        for function in self.rubric.functions.iter().filter(|function| functions.contains(function.name.get_ref())) {
            if let Some(grade) = without_running(function, submission) {
                graded.insert(function.name.get_ref().clone(), grade);
            }
        }
        let budget = Rc::new(self.budget());
        for level in self.rubric.levels() {
            self.grade_level(level, submission, None, &mut graded, &budget)?;
        }
        let functions: Vec<FunctionGrade> = asked().filter_map(|name| graded.remove(name)).collect();
        let parts = || functions.iter().chain([&earlier.simulation]);
        Ok(Grade {
            score: parts().map(|part| part.score).sum(),
            max_score: parts().map(|part| part.max_score).sum(),
            toolchain: self.prebuilt.toolchain.clone(),
            sandbox: self.sandbox.layers(),
            functions,
            seconds: timer.seconds(),
            ..earlier.clone()
        })
    }
}
