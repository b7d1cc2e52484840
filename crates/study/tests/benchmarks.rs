//! Every published case comes out right on its coarser meshes: a test for each.

use std::path::Path;

use fem_study::experiments::Experiments;
use fem_study::experiments::benchmarks::BENCHMARKS;
use fem_study::study::Study;
use libtest_mimic::{Arguments, Failed, Trial};

fn main() {
    let trials = BENCHMARKS.parts().map(|name| Trial::test(name, move || comes_out_right(name)));
    libtest_mimic::run(&Arguments::from_args(), trials.collect()).exit();
}

fn comes_out_right(name: &str) -> Result<(), Failed> {
    let study = Experiments { of: &BENCHMARKS, part: Some(name), data: Path::new(""), quick: true };
    let marks: Vec<_> = study.cases().into_iter().flat_map(|case| (case.work)().marks).collect();
    let wrong: Vec<_> = marks.iter().filter(|mark| mark.holds != Some(true)).collect();
    match (marks.is_empty(), wrong.is_empty()) {
        (false, true) => Ok(()),
        (true, _) => Err("it has no marks".into()),
        (false, false) => Err(format!("{wrong:#?}").into()),
    }
}
