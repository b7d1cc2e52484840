//! Checks of numbers and vectors.

/// A field, and its problem together with the remedy. The message is both in one sentence.
pub(crate) type Problem = (String, String);

pub(crate) fn problem<T>(field: &str, text: impl Into<String>) -> Result<T, Problem> {
    Err((field.to_owned(), text.into()))
}

/// Products of two or three numbers of larger magnitude could overflow.
const LARGEST: f64 = 1e60;

/// Products of two or three positive numbers below this one could underflow.
const SMALLEST: f64 = 1e-60;

pub(crate) fn check_positive(field: &str, value: f64, unit: &str) -> Result<(), Problem> {
    // NaN fails the comparison.
    if !(value > 0.0 && value.is_finite()) {
        return problem(field, format!("is {value}; give a positive number{unit}"));
    }
    if value < SMALLEST {
        return problem(field, format!("is {value:e}, too small to compute with; give {SMALLEST:e} or more{unit}"));
    }
    check_size(field, value)
}

pub(crate) fn check_not_negative(field: &str, value: f64, unit: &str) -> Result<(), Problem> {
    // NaN fails the comparison.
    if !(value >= 0.0 && value.is_finite()) {
        return problem(field, format!("is {value}; give 0 {unit} or more"));
    }
    check_size(field, value)
}

pub(crate) fn check_finite(field: &str, values: &[f64]) -> Result<(), Problem> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => problem(field, format!("is {value}; give finite numbers")),
        None => values.iter().try_for_each(|&value| check_size(field, value)),
    }
}

fn check_size(field: &str, value: f64) -> Result<(), Problem> {
    if value.abs() <= LARGEST {
        return Ok(());
    }
    problem(field, format!("is {value:e}, too large to compute with; give at most {LARGEST:e}"))
}

/// Checks that the components are finite and small enough for the length to be finite.
pub(crate) fn check_vector(field: &str, vector: &[f64; 3]) -> Result<(), Problem> {
    match vector.iter().any(|x| x.is_finite() && x.abs() > LARGEST) {
        true => problem(field, format!("is too long to compute with; give a shorter vector, of at most {LARGEST:e}")),
        false => check_finite(field, vector),
    }
}
