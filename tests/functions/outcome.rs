//! How a check passes or fails: comparisons whose messages say what is wrong and where to read.

use std::fmt;
use std::panic::Location;
use std::path::Path;

use nalgebra::{Dim, Matrix, RawStorage};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngSeed, TestRunner};

/// What a check found wrong, as a sentence for whoever wrote the function.
pub struct Mistake(String);

pub type Outcome = Result<(), Mistake>;

// A test that returns an error prints its `Debug` form, so that is the sentence itself.
impl fmt::Debug for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Fails with the sentence `rule` where the condition does not hold.
#[track_caller]
pub fn holds(rule: &str, condition: bool) -> Outcome {
    if condition { Ok(()) } else { Err(mistake(rule.to_owned())) }
}

/// Compares two numbers; NaN is never near, equal infinities are.
#[track_caller]
pub fn near_number(rule: &str, actual: f64, expected: f64, allowed: f64) -> Outcome {
    if is_near(actual, expected, allowed) {
        return Ok(());
    }
    Err(mistake(format!("{rule}: got {actual:e}, expected {expected:e} (may differ by {allowed:.1e})")))
}

/// Compares two vectors or matrices entry by entry.
#[track_caller]
pub fn near<R1: Dim, C1: Dim, S1, R2: Dim, C2: Dim, S2>(
    rule: &str,
    actual: &Matrix<f64, R1, C1, S1>,
    expected: &Matrix<f64, R2, C2, S2>,
    allowed: f64,
) -> Outcome
where
    S1: RawStorage<f64, R1, C1>,
    S2: RawStorage<f64, R2, C2>,
{
    if actual.shape() != expected.shape() {
        return Err(mistake(format!("{rule}: got shape {:?}, expected {:?}", actual.shape(), expected.shape())));
    }
    for column in 0..actual.ncols() {
        for row in 0..actual.nrows() {
            let (a, e) = (actual[(row, column)], expected[(row, column)]);
            if !is_near(a, e, allowed) {
                let place = if actual.ncols() == 1 { format!("[{row}]") } else { format!("[({row}, {column})]") };
                let figures = format!("entry {place} is {a:e}, expected {e:e} (may differ by {allowed:.1e})");
                return Err(mistake(format!("{rule}: {figures}")));
            }
        }
    }
    Ok(())
}

fn is_near(actual: f64, expected: f64, allowed: f64) -> bool {
    // A comparison with NaN is false, and ∞ − ∞ is NaN.
    actual == expected || (actual - expected).abs() <= allowed
}

/// Adds the page of the function whose check, a file of the same name, called.
#[track_caller]
fn mistake(sentence: String) -> Mistake {
    let file = Location::caller().file().replace('\\', "/");
    let check = file.rsplit_once("functions/").map_or(&*file, |(_, inside)| inside);
    let name = check.split(['/', '.']).next().unwrap_or(check);
    let page = format!("include-docs/{name}.md");
    let exists = Path::new(env!("CARGO_MANIFEST_DIR")).join(&page).exists();
    Mistake(format!("{sentence}. Read {}", if exists { &page } else { "include-docs/given.md" }))
}

/// Where the random inputs start; the same ones in every run.
const SEED: u64 = 2024;
const CASES: usize = 200;
const SHRINKING_STEPS: usize = 100;

/// Holds a property to random inputs; where it fails, a simpler input that also fails is looked for and shown.
pub fn for_all<S: Strategy>(inputs: S, property: impl Fn(S::Value) -> Outcome) -> Outcome {
    let config = Config { rng_seed: RngSeed::Fixed(SEED), failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new(config);
    for _ in 0..CASES {
        let mut tree = inputs.new_tree(&mut runner).expect("inputs can be made");
        let Err(mut found) = property(tree.current()) else { continue };
        let mut input = tree.current();
        let mut goes_on = tree.simplify();
        for _ in 0..SHRINKING_STEPS {
            if !goes_on {
                break;
            }
            goes_on = match property(tree.current()) {
                Err(simpler) => {
                    (found, input) = (simpler, tree.current());
                    tree.simplify()
                }
                Ok(()) => tree.complicate(),
            };
        }
        return Err(Mistake(format!("{found:?}\nwith input {input:?}\n(random inputs from seed {SEED})")));
    }
    Ok(())
}
