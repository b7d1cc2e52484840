//! Sweeps with each kind of registers.

use std::process::Command;

use fem_solvers::{Preconditioner, SolverChoice};

use super::beam::random;

/// Set in a process that writes its numbers after this word.
const NUMBERS: &str = "FEM_TEST_NUMBERS";

/// A residual preconditioned by both sweeps, a solution of a few digits, and the iterations that it took.
fn swept() -> (Vec<f64>, Vec<f64>, usize) {
    let (beam, mut solver) = super::beam::<f64>(SolverChoice::Pcg(Preconditioner::Ssor), 4);
    let (values, b) = (beam.values(), random(beam.pattern.rows(), 5));
    solver.prepare(&values).unwrap();
    let [mut z, mut x] = [vec![[0.0; 3]; b.len()], vec![[0.0; 3]; b.len()]];
    solver.apply(&b, &mut z);
    let iterations = solver.solve(&values, &b, &mut x, 1e-2).unwrap();
    (z.as_flattened().to_vec(), x.as_flattened().to_vec(), iterations)
}

#[test]
fn sweeps_with_the_registers_of_this_processor_and_with_those_of_every_processor_agree() {
    let (z, x, iterations) = swept();
    if std::env::var_os(NUMBERS).is_some() {
        let numbers: Vec<_> = [&[iterations as f64], &z[..], &x[..]].concat().iter().map(f64::to_string).collect();
        return println!("\n{NUMBERS} {}", numbers.join(" "));
    }
    let name = std::thread::current().name().map(str::to_owned).unwrap();
    let mut portable = Command::new(std::env::current_exe().unwrap());
    portable.args(["--exact", &name, "--nocapture", "--test-threads=1"]);
    let output = portable.env("FEM_INSTRUCTIONS", "fallback").env(NUMBERS, "1").output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let line = text.lines().find_map(|line| line.strip_prefix(NUMBERS)).unwrap_or_else(|| panic!("{text}"));
    let numbers: Vec<f64> = line.split_whitespace().map(|number| number.parse().unwrap()).collect();
    assert_eq!(numbers.len(), 1 + z.len() + x.len());
    let (other_z, other_x) = numbers[1..].split_at(z.len());
    let largest_part = |a: &[f64], b: &[f64]| {
        let size = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |largest: f64, a| largest.max(a.abs()));
        size(&mut a.iter().zip(b).map(|(a, b)| a - b)) / size(&mut a.iter().copied())
    };
    let errors = [largest_part(&z, other_z), largest_part(&x, other_x)];
    assert!(errors[0] <= 1e-5 && errors[1] <= 1e-5, "{errors:?}");
    assert_eq!(iterations as f64, numbers[0]);
}
