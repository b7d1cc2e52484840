//! Checks of numbers and vectors.

use crate::Refusal;

/// Refuses a field; `text` is the problem with its remedy.
pub fn problem<T>(field: &str, text: impl Into<String>) -> Result<T, Refusal> {
    Err(Refusal::new(field, text))
}

/// Products of two or three numbers of larger magnitude could overflow.
const LARGEST: f64 = 1e60;

/// Products of two or three positive numbers below this one could underflow.
const SMALLEST: f64 = 1e-60;

/// Refuses a number that is not positive, or too small or too large to compute with. `unit` continues "a positive number".
pub fn check_positive(field: &str, value: f64, unit: &str) -> Result<(), Refusal> {
    // NaN fails the comparison.
    if !(value > 0.0 && value.is_finite()) {
        return problem(field, format!("is {value}; give a positive number{unit}"));
    }
    if value < SMALLEST {
        return problem(field, format!("is {value:e}, too small to compute with; give {SMALLEST:e} or more{unit}"));
    }
    check_size(field, value)
}

/// Refuses a number that is negative or too large to compute with.
pub fn check_not_negative(field: &str, value: f64, unit: &str) -> Result<(), Refusal> {
    // NaN fails the comparison.
    if !(value >= 0.0 && value.is_finite()) {
        return problem(field, format!("is {value}; give 0 {unit} or more"));
    }
    check_size(field, value)
}

/// Refuses numbers that are not finite or too large to compute with.
pub fn check_finite(field: &str, values: &[f64]) -> Result<(), Refusal> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => problem(field, format!("is {value}; give finite numbers")),
        None => values.iter().try_for_each(|&value| check_size(field, value)),
    }
}

fn check_size(field: &str, value: f64) -> Result<(), Refusal> {
    if value.abs() <= LARGEST {
        return Ok(());
    }
    problem(field, format!("is {value:e}, too large to compute with; give at most {LARGEST:e}"))
}

/// Checks that the components of a vector are finite and small enough for the length to be finite.
pub fn check_vector(field: &str, vector: &[f64; 3]) -> Result<(), Refusal> {
    match vector.iter().any(|x| x.is_finite() && x.abs() > LARGEST) {
        true => problem(field, format!("is too long to compute with; give a shorter vector, of at most {LARGEST:e}")),
        false => check_finite(field, vector),
    }
}
