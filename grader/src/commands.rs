//! The work of each command and its exit code: 0 done, 1 the grader itself failed, 2 unusable arguments.

use std::collections::BTreeMap;
use std::env;
use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use grader::sandbox::Sandbox;
use grader::submission::{NAMES, Source, Submission};
use jiff::Timestamp;

use crate::assess::{Accounts, Adjustments, Metadata};
use crate::class::Outcome;
use crate::cli::{Again, GradeOptions};
use crate::grading::{Grading, repository};
use crate::new_folder::{self, FolderError};
use crate::pack::{self, PackOptions, Platform};
use crate::reports::{self, Options};
use crate::rubric::{Role, Rubric};
use crate::similar::fingerprints::Document;
use crate::{archive, class, feedback, handout, own_checks, seed, similar, weights};

/// The grader or its machine failed; there is no grade.
pub const GRADER_FAILED: u8 = 1;
/// An argument, the rubric or a path cannot be used.
pub const UNUSABLE: u8 = 2;

/// Limit of wall-clock time for one submission of a class, in budgets of the rubric. The grader ends every submission
/// within its budget, so this limit is reached only if the grader hangs or the machine stalls.
const LONGEST: f64 = 10.0;

/// Error of a command: message and exit code.
pub struct Problem {
    pub message: String,
    pub code: u8,
}

/// The end of a command.
pub type Done = Result<(), Problem>;

fn failed(error: impl Display) -> Problem {
    Problem { message: error.to_string(), code: GRADER_FAILED }
}

fn unusable(error: impl Display) -> Problem {
    Problem { message: error.to_string(), code: UNUSABLE }
}

pub fn handout(to: &Path, rubric: Option<&Path>) -> Done {
    let rubric = Rubric::load(rubric).map_err(unusable)?;
    handout::write(&repository(), &rubric, to).map_err(unusable)?;
    rubric.unfinishable().iter().for_each(|sentence| eprintln!("{sentence}"));
    println!("The students' repository is in {}; its README.md tells how to begin.", to.display());
    Ok(())
}

pub fn check(options: &grader::check::Options) -> Done {
    grader::check::run(options).map_err(|error| Problem { message: error.to_string(), code: error.exit_code() })
}

pub fn grade(
    submission: &Path,
    options: &GradeOptions,
    metadata: Option<&Path>,
    again: &Again,
    ends_with: Option<u32>,
) -> Done {
    if let Some(parent) = ends_with {
        class::end_with(parent).map_err(failed)?;
    }
    let rubric = Rubric::load(options.rubric.as_deref()).map_err(unusable)?;
    own_checks::have(&rubric, &repository(), &tools()?).map_err(unusable)?;
    if !submission.exists() {
        return Err(unusable(format!(
            "{}: there is no such submission; name a folder or archive",
            submission.display()
        )));
    }
    writable(&options.out)?;
    let origin = reports::classroom50::Origin::from_environment();
    let reports = Options { show_diagnosis: rubric.students.diagnosis, origin };
    let show_hints = rubric.students.hints;
    let metadata = metadata.map(Metadata::read).transpose().map_err(unusable)?;
    let earlier = again.earlier.as_deref().map(reports::json::read).transpose().map_err(failed)?;
    let seed = options.seed.or(earlier.as_ref().map(|earlier| earlier.seed)).unwrap_or_else(seed::drawn);
    let accounts = Accounts::new(rubric.clone(), Adjustments::default());
    let grading = Grading::new(&repository(), rubric, (sandbox(options)?, tools()?), seed).map_err(failed)?;
    let grading = if options.report { grading.with_study() } else { grading };
    let read = read(submission);
    let graded = match &earlier {
        Some(earlier) => grading.grade_again(&read, earlier, &again.function),
        None => grading.grade(&read),
    };
    let mut grade = graded.map_err(failed)?;
    if let Some(Metadata { submitted, students }) = &metadata {
        grade = accounts.assess(grade, &students.iter().map(String::as_str).collect::<Vec<_>>(), Some(*submitted));
    }
    if !show_hints {
        grade.functions.iter_mut().for_each(|function| function.hint = None);
    }
    reports::write_all(&grade, &options.out, &reports).map_err(|error| failed(unwritable(&options.out, &error)))?;
    reports::terminal::print(&grade, reports.show_diagnosis).map_err(failed)
}

fn unwritable(folder: &Path, error: &dyn Display) -> String {
    format!("{}: {error}; name a folder that can be written to", folder.display())
}

/// Makes the folder for results, before any work is done for them.
fn writable(out: &Path) -> Done {
    let tried = fs::create_dir_all(out).and_then(|()| tempfile::tempfile_in(out));
    tried.map(drop).map_err(|error| unusable(unwritable(out, &error)))
}

/// Reads a submission. One that cannot be read is graded without any function, and the report gives the reason.
fn read(path: &Path) -> Submission {
    archive::read_submission(path).unwrap_or_else(|error| {
        let why = "the submission cannot be read";
        let functions: BTreeMap<_, _> = NAMES.into_iter().map(|name| (name, Source::Missing(why.to_owned()))).collect();
        Submission { name: archive::name(path), functions, remarks: vec![error.to_string()] }
    })
}

/// Sandbox for the grader's own compilers.
fn tools() -> Result<Sandbox, Problem> {
    Ok(Sandbox::own_tools(&env::current_exe().map_err(failed)?))
}

fn sandbox(options: &GradeOptions) -> Result<Sandbox, Problem> {
    if options.without_sandbox {
        return Ok(Sandbox::none());
    }
    enough(Sandbox::probe(&env::current_exe().map_err(failed)?))
}

/// Refuses a sandbox that leaves files or the network within reach.
fn enough(sandbox: Sandbox) -> Result<Sandbox, Problem> {
    let missing: Vec<_> = sandbox.missing().iter().map(ToString::to_string).collect();
    if missing.is_empty() {
        return Ok(sandbox);
    }
    let advice = "grade on Linux, as root or where the kernel and the container allow user namespaces or Landlock and seccomp \
        (docs/book/instructors.md, Sandbox), or give --without-sandbox if you trust the submissions as you trust yourself";
    Err(failed(format!("this machine cannot confine submissions: {}; {advice}", missing.join("; "))))
}

/// Prints the layers of this machine's sandbox. Fails where submissions would be refused.
pub fn sandbox_layers() -> Done {
    let sandbox = Sandbox::probe(&env::current_exe().map_err(failed)?);
    for (layer, holds) in sandbox.layers() {
        println!("{layer}: {}", if holds { "yes" } else { "no" });
    }
    if let Some(why) = sandbox.without_cgroup() {
        println!("The memory of the compiler's processes is summed, not limited by a cgroup: {why}");
    }
    enough(sandbox)?;
    println!("Submissions are isolated from files and from the network.");
    Ok(())
}

pub fn class(
    (folder, roster): (&Path, Option<PathBuf>),
    options: &GradeOptions,
    jobs: Option<usize>,
    shard: Option<(usize, usize)>,
    (only, functions): (Vec<String>, Vec<String>),
) -> Done {
    let rubric = Rubric::load(options.rubric.as_deref()).map_err(unusable)?;
    own_checks::have(&rubric, &repository(), &tools()?).map_err(unusable)?;
    if let Some(name) = functions.iter().find(|name| rubric.role(name) != Role::Asked) {
        return Err(unusable(format!("--function {name}: the rubric asks for no such function")));
    }
    let opened = class::open(folder).map_err(unusable)?;
    let folder = opened.folder.as_path();
    let adjustments = Adjustments::of_class(folder, &rubric).map_err(unusable)?;
    let accounts = Accounts::new(rubric.clone(), adjustments);
    let longest = Duration::from_secs_f64(LONGEST * rubric.submission_seconds.max(60.0));
    class::apart(folder, &options.out).map_err(unusable)?;
    writable(&options.out)?;
    // The libraries of all submissions are built before the first one, and the sandbox is probed once.
    let seed = seed::of_class(&options.out, options.seed, shard.is_some()).map_err(unusable)?;
    let _ = Grading::new(&repository(), rubric, (sandbox(options)?, tools()?), seed).map_err(failed)?;
    let flags = [(options.without_sandbox, "--without-sandbox"), (options.report, "--report")];
    let extra = flags.iter().filter(|(is_given, _)| *is_given).map(|(_, flag)| (*flag).to_owned()).collect();
    let cores = thread::available_parallelism().map_or(1, Into::into);
    let summary = class::run(&class::ClassOptions {
        folder: folder.to_owned(),
        roster,
        out: options.out.clone(),
        jobs: jobs.unwrap_or(cores).max(1),
        shard,
        seed,
        grader: env::current_exe().map_err(failed)?,
        time_limit: longest,
        rubric: options.rubric.clone(),
        accounts,
        only,
        functions,
        extra,
        report: reports::write_class,
        write: reports::write_final,
    });
    told(summary, &options.out)
}

pub fn feedback(results: &Path, out: &Path, archive: Option<&Path>) -> Done {
    let count = feedback::write(results, out, archive, Timestamp::now()).map_err(unusable)?;
    println!("{count} students have a folder in {}: {}", out.display(), feedback::FILES.join(", "));
    Ok(())
}

pub fn similar((folder, roster): (&Path, Option<&Path>), given: &[PathBuf], out: &Path, rubric: Option<&Path>) -> Done {
    let rubric = Rubric::load(rubric).map_err(unusable)?;
    let opened = class::open(folder).map_err(unusable)?;
    class::apart(&opened.folder, out).map_err(unusable)?;
    new_folder::check(out).map_err(unusable)?;
    let class = class::list(&opened.folder, roster).map_err(unusable)?;
    let mut handout = handout::files(&repository(), &rubric).map_err(failed)?;
    given.iter().try_for_each(|path| handout::add_given(path, &mut handout)).map_err(unusable)?;
    let given = similar::given(&handout);
    let document = |listed: &class::Listed| {
        let mut texts = similar::texts(&read(&listed.path));
        texts.retain(|(name, _)| rubric.role(name) == Role::Asked);
        Document::new(listed.submission.clone(), listed.students.clone(), texts, &given)
    };
    let documents: Vec<Document> = class.submissions.iter().map(document).collect();
    let found = similar::Found::in_class(&documents);
    let written = new_folder::create(out, |out| {
        reports::similar::write(&documents, &found, out)
            .map_err(|error| FolderError::Io { path: out.to_owned(), error })
    });
    written.map_err(unusable)?;
    class.remarks.iter().for_each(|remark| println!("{remark}"));
    print!("{}", reports::similar::text(&documents, &found));
    println!("{}", out.join("similar.html").display());
    Ok(())
}

pub fn weights(rubric: Option<&Path>) -> Done {
    let rubric = Rubric::load(rubric).map_err(unusable)?;
    own_checks::have(&rubric, &repository(), &tools()?).map_err(unusable)?;
    print!("{}", weights::table(&rubric));
    Ok(())
}

pub fn merge(folders: &[PathBuf], out: &Path) -> Done {
    class::distinct(folders, out).map_err(unusable)?;
    writable(out)?;
    told(class::merge(folders, out, reports::write_class), out)
}

/// Prints the summary of a class.
fn told(summary: Result<class::Summary, class::ClassError>, out: &Path) -> Done {
    let summary = summary.map_err(unusable)?;
    let count = |wanted: fn(&Outcome) -> bool| summary.entries.iter().filter(|entry| wanted(&entry.outcome)).count();
    println!("{} graded: {} now, {} before", summary.graded_now + summary.kept, summary.graded_now, summary.kept);
    match count(|outcome| matches!(outcome, Outcome::NoSubmission(_))) {
        0 => {}
        1 => println!("1 student of the roster has submitted nothing"),
        several => println!("{several} students of the roster have submitted nothing"),
    }
    print!("{}", reports::regrade::text(&summary.changes));
    for entry in &summary.entries {
        if let Outcome::NotGraded(reason) = &entry.outcome {
            println!("not graded: {} ({reason}); it has no score, which is not zero", entry.submission);
        }
    }
    summary.remarks.iter().for_each(|remark| println!("{remark}"));
    println!("grades.csv, canvas.csv, moodle.csv and class.html are in {}", out.display());
    if summary.interrupted {
        return Err(failed("stopped; the same command goes on from here"));
    }
    Ok(())
}

pub fn pack(mut options: PackOptions) -> Done {
    let rubric = Rubric::load(options.rubric.as_deref()).map_err(unusable)?;
    if options.rubric.is_some() && options.platform != Platform::Gradescope {
        return Err(unusable(
            "--rubric is for Gradescope; elsewhere hand the rubric to the grader that the package calls",
        ));
    }
    options.functions = rubric.functions.len();
    options.checks = rubric.checks.into_iter().map(|check| check.file).collect();
    pack::pack(&options).map_err(unusable)?;
    println!("{} is ready; the page in it tells what to do with it.", options.out.display());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grading_refuses_to_start_without_isolation_and_names_what_is_missing() {
        let problem = enough(Sandbox::none()).err().unwrap();
        assert_eq!(problem.code, GRADER_FAILED);
        for words in ["the files of others", "landlock", "the network", "seccomp", "--without-sandbox"] {
            assert!(problem.message.contains(words), "{}", problem.message);
        }
    }
}
