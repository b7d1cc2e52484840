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

/// Refuses a number that is negative, or too large or too small to compute with.
pub fn check_not_negative(field: &str, value: f64, unit: &str) -> Result<(), Refusal> {
    // NaN fails the comparison.
    if !(value >= 0.0 && value.is_finite()) {
        return problem(field, format!("is {value}; give 0 {unit} or more"));
    }
    check_size(field, value)
}

/// Refuses numbers that are not finite, or too large or too small to compute with.
pub fn check_finite(field: &str, values: &[f64]) -> Result<(), Refusal> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => problem(field, format!("is {value}; give finite numbers")),
        None => values.iter().try_for_each(|&value| check_size(field, value)),
    }
}

fn check_size(field: &str, value: f64) -> Result<(), Refusal> {
    match value.abs() {
        size if size > LARGEST => {
            problem(field, format!("is {value:e}, too large to compute with; give at most {LARGEST:e}"))
        }
        size if size > 0.0 && size < SMALLEST => {
            problem(field, format!("is {value:e}, too small to compute with; give 0, or {SMALLEST:e} or more"))
        }
        _ => Ok(()),
    }
}

/// Refuses a vector that is not finite, or so long or so short that its square could overflow or underflow.
pub fn check_vector(field: &str, vector: &[f64; 3]) -> Result<(), Refusal> {
    check_direction(field, vector)?;
    let size = vector.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if size > 0.0 && size < SMALLEST {
        return problem(
            field,
            format!("is too short to compute with; give zeros, or a vector of at least {SMALLEST:e}"),
        );
    }
    Ok(())
}

/// Refuses a vector of which the direction alone matters if it is not finite, or too long.
pub fn check_direction(field: &str, vector: &[f64; 3]) -> Result<(), Refusal> {
    if let Some(value) = vector.iter().find(|value| !value.is_finite()) {
        return problem(field, format!("is {value}; give finite numbers"));
    }
    if vector.iter().any(|x| x.abs() > LARGEST) {
        return problem(field, format!("is too long to compute with; give a shorter vector, of at most {LARGEST:e}"));
    }
    Ok(())
}
