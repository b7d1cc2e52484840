//! Arrays of numbers in the history of a checkpoint. Single precision becomes double and back without a change.

use fem_model::simulation::History;

use crate::number::Float;

/// Adds an array.
pub fn put<T: Float>(history: &mut History, name: &str, values: &[T]) {
    history.put(name, values.iter().map(|x| x.as_f64()));
}

/// Reads an array into one of the same length; an error if it has another one.
pub fn take<T: Float>(history: &History, name: &str, values: &mut [T]) -> Result<(), String> {
    let found = history.get(name)?;
    if found.len() != values.len() {
        return Err(format!("its history has {} numbers of `{name}` and not {}", found.len(), values.len()));
    }
    for (value, &found) in values.iter_mut().zip(found) {
        *value = T::of(found);
    }
    Ok(())
}

/// Adds a number, or an empty array without one.
pub fn put_option(history: &mut History, name: &str, value: Option<f64>) {
    history.put(name, value);
}

/// Reads a number, if there is one.
pub fn take_option(history: &History, name: &str) -> Result<Option<f64>, String> {
    Ok(history.get(name)?.first().copied())
}

/// Adds a flag.
pub fn put_flag(history: &mut History, name: &str, value: bool) {
    history.put(name, [f64::from(u8::from(value))]);
}

/// Reads a flag.
pub fn take_flag(history: &History, name: &str) -> Result<bool, String> {
    Ok(take_option(history, name)? == Some(1.0))
}
